// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_material_undrained_h
#define moraine_material_undrained_h

#include <moraine/material/material_decorator.h>

#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace moraine
{
  struct MaterialKey;
  class MaterialInput;

  /** A time in which water flows out of and into a material: its excess
   * pressure goes to zero until @p released, linearly, and stays there. */
  struct DrainedSpan
  {
    double start, released, end; ///< [time]
  };

  /** What Undrained knows of the water. */
  struct PoreWaterParameters
  {
    /** @f$\nu_u@f$, if there is no modulus. */
    double poisson_ratio = 0.495;
    /** @f$K_w/n@f$ [stress]; 0: of @f$\nu_u@f$. */
    double modulus = 0;
    /** The largest one that the water bears [stress]. */
    double suction = std::numeric_limits<double>::infinity();
    /** When it drains. */
    std::vector<DrainedSpan> drained = {};
    /** From when on the excess pressure stays as it is [time]. */
    double frozen_from = std::numeric_limits<double>::infinity();
    /** Of messages, as "Materials/clay". */
    std::string section = {};

    bool
    has_limit() const
    {
      return suction < std::numeric_limits<double>::infinity();
    }
  };

  /**
   * A material of effective stress with water in its pores that cannot flow:
   *
   * @f[ \sigma = \sigma' - p_e 1, \qquad
   *     \Delta p_e = -\frac{K_w}{n}\,\Delta\varepsilon_v, \qquad
   *     \frac{K_w}{n} = K_u - K' = \frac{2G}{3} \left[
   *       \frac{1+\nu_u}{1-2\nu_u} - \frac{1+\nu'}{1-2\nu'} \right] . @f]
   *
   * The excess pressure @f$p_e@f$ is positive in compression and 0 at the
   * start; @f$\varepsilon_v@f$ is the trace of the whole strain, elastic and
   * plastic, at finite strain ln J, and stresses are @f$\tau = J\sigma@f$
   * there, @f$p_e@f$ too. So both have an energy,
   * @f$\frac12 p_e^2 n/K_w@f$. G and @f$\nu'@f$ are those of the elastic
   * stiffness of the point at the start.
   *
   * At @f$p_e = -s@f$, with the suction s that water bears, it cavitates: the
   * pressure stays, the cavities grow, and they must close before it rises.
   *
   * A step belongs to that span of time which has its middle.
   *
   * Internal variables: those of the material, @f$p_e@f$, the elastic change of
   * volume, which tells how much of the trial one is of this step; the volume
   * of cavities if there is a limit; @f$K_w/n@f$ if it is not the same
   * everywhere.
   */
  class Undrained : public MaterialDecorator
  {
  public:
    Undrained(const std::shared_ptr<const Material> &inner,
              const PoreWaterParameters             &parameters);

    using MaterialDecorator::respond;

    void
    respond(const StepTime                          &time,
            const dealii::ArrayView<PrincipalState> &points) const override;

    std::vector<InternalVariable>
    internal_variables() const override;

    /** That of skeleton and water. */
    LameConstants
    elastic_stiffness() const override;

    LameConstants
    elastic_stiffness_at(const double *internal) const override;

    /** The stress depends on the pressure too. */
    bool
    has_linear_elasticity() const override
    {
      return false;
    }

    /** Of the total stress, without the pressure of the point. */
    dealii::SymmetricTensor<2, 3>
    elastic_strain_of(const dealii::SymmetricTensor<2, 3> &stress,
                      const double *internal) const override;

    /** @p stress is the effective one: there is no excess pressure.
     * @throws InputError for @f$\nu_u \le \nu'@f$. */
    void
    initialise(const dealii::SymmetricTensor<2, 3> &stress,
               const unsigned int                   vertical,
               double                              *internal) const override;

    bool
    is_linear() const override
    {
      return false;
    }

    /** With the energy of water and cavities. */
    void
    stored_energies(const dealii::ArrayView<const ElasticPoint> &points,
                    const dealii::ArrayView<double> &energies) const override;

    double
    dissipated_by_water(const double        trial_volume,
                        const ElasticPoint &at_end,
                        const double       *at_start) const override;

    bool
    dissipates() const override
    {
      return inner->dissipates() || parameters.has_limit() ||
             !parameters.drained.empty();
    }

    std::shared_ptr<const Material>
    with_strength_over(const double factor) const override;

    std::shared_ptr<const Material>
    with_frozen_water(const double from) const override;

  private:
    /** How the excess pressure changes in a step. Without strain it becomes
     * @p share times its old value. */
    struct Change
    {
      bool   is_free; ///< whether strains change it
      double share;
    };

    Change
    change_in(const StepTime &time) const;

    /** @f$K_w/n@f$ of a stiffness of the skeleton. */
    double
    modulus_of(const LameConstants &C) const;

    /** @f$K_w/n@f$ at a point. */
    double
    modulus_at(const double *internal) const;

    /** Volumetric strain of the water, and of cavities, that is stored. */
    double
    strain_of_water(const double *internal) const;

    const PoreWaterParameters parameters;
    const bool                has_one_modulus; ///< at all points and times
    const double              modulus;         ///< of the nominal stiffness
    /** Places of the internal variables. */
    const unsigned int pressure, volume, cavities, kept_modulus;
  };

  /** `Drainage` and what belongs to it, for every isotropic model. */
  const std::vector<MaterialKey> &
  drainage_keys();

  /** The @p material, undrained if the scene says so. @throws InputError for
   * keys that contradict each other. */
  std::shared_ptr<const Material>
  with_drainage(const std::shared_ptr<const Material> &material,
                const MaterialInput                   &input);
} // namespace moraine

#endif
