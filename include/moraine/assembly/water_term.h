// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_assembly_water_term_h
#define moraine_assembly_water_term_h

#include <moraine/assembly/term.h>
#include <moraine/load/load.h>

#include <vector>

namespace moraine
{
  /** Half the lengths of a box that stands for a point: its domain, or else a
   * cube which no Gauss point of a cell shares with another cell. */
  template <int dim>
  dealii::Tensor<1, dim>
  half_lengths(const State<dim> &state, const unsigned int p);

  /**
   * Given water pressures. With the total stress @f$\sigma' - p_w 1@f$ and the
   * pressure @f$p_r@f$ of the water outside on the whole surface, whose load
   * the divergence theorem brings inside,
   *
   * @f[ f_a = \sum_p v_p\, [(p_w - p_r)\, \nabla S_{ap}
   *   - \nabla p_r\, S_{ap}] \;+\; \sum_p w_p\, V_p\,
   *   (\rho_{sat} - \rho)\, g\, S_{ap} , @f]
   *
   * w the part of a point below the phreatic line. The first part is integrated
   * over the volumes of stress, the others over those of weight. At finite
   * strain @f$v_p@f$, @f$\nabla S@f$ and the pressures are those in the trial
   * state, and with @f$g_a = \nabla S_{ap}@f$ there the derivative is
   *
   * @f[ \frac{\partial f_{ai}}{\partial u_{bj}} = v\, [
   *   (p_w - p_r)(g_{ai} g_{bj} - g_{aj} g_{bi})
   *   + g_{ai} S_b\, \partial_j (p_w - p_r)
   *   - S_a\, \partial_i p_r\, g_{bj} - S_a S_b\, \partial_i \partial_j p_r]
   *   + V (\rho_{sat} - \rho)\, g_i\, S_a S_b\, \partial_j w , @f]
   *
   * which is not symmetric: a pressure that differs from place to place is no
   * stress of an energy. Else nothing moves while the step is tried, and the
   * forces depend on time alone.
   */
  template <int dim>
  class WaterTerm : public PointTerm<dim>
  {
  public:
    /**
     * @param water of the bodies in this stage
     * @param points get the pressure and the total stress
     * @param gravities loads that act in this stage
     * @param measure of the strain
     */
    WaterTerm(const WaterInBodies<dim>           &water,
              PointSet<dim>                      &points,
              std::vector<const BodyForce<dim> *> gravities,
              const StrainMeasure                 measure);

    std::vector<Effect>
    effects(const StepContext<dim> &context) const override;

    TermTraits
    traits() const override
    {
      TermTraits is;
      is.is_dead = !follows;
      return is;
    }

    bool
    begin_step(const StepContext<dim> &context) override;

    using PointTerm<dim>::add;

    void
    add(const StepContext<dim>  &context,
        const StencilBlock<dim> &block,
        const bool               tangent,
        LocalSystem<dim>        &local) const override;

    bool
    symmetric(const StepContext<dim> &) const override
    {
      return !follows;
    }

    /** Give points the pressure at the end of the step. */
    void
    report(const StepContext<dim> &context,
           std::vector<BoundaryReport<dim>> &) const override;

  private:
    /** A point in the trial state. */
    struct TrialState
    {
      dealii::Point<dim>            x;
      double                        v;        ///< of stress
      double                        v_weight; ///< of weight
      double                        J = 1;    ///< over the start of the step
      const dealii::Tensor<1, dim> *gradients;
    };

    TrialState
    trial_state(const StepContext<dim>              &context,
                const StencilBlock<dim>             &block,
                const unsigned int                   i,
                const LocalSystem<dim>              &local,
                std::vector<dealii::Tensor<1, dim>> &moved) const;

    void
    add_tangent(const WaterAt<dim>           &water,
                const TrialState             &at,
                const double                 *N,
                const dealii::Tensor<1, dim> &extra_weight,
                LocalSystem<dim>             &local) const;

    /** The weight of the water in the pores: saturated less dry soil. */
    dealii::Tensor<1, dim>
    extra_weight(const StepContext<dim> &context, const unsigned int p) const;

    const WaterInBodies<dim>                 &water;
    PointSet<dim>                            &points;
    const std::vector<const BodyForce<dim> *> gravities;
    const bool                                follows; ///< the trial state
    std::vector<dealii::Tensor<1, dim>>       half;    ///< of points
  };

  /** Give the points pressure and total stress at time @p t. */
  template <int dim>
  void
  set_water_at_points(const WaterInBodies<dim> &water,
                      const double              t,
                      const State<dim>         &state,
                      PointSet<dim>            &points);

  /** The force of the water outside on all bodies, @f$-\sum_p v_p \nabla
   * p_r@f$. Collective. */
  template <int dim>
  dealii::Tensor<1, dim>
  force_of_outer_water(const WaterInBodies<dim> &water,
                       const double              t,
                       const State<dim>         &state);
} // namespace moraine

#endif
