// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_material_soil_strength_h
#define moraine_material_soil_strength_h

#include <moraine/material/material_input.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace moraine
{
  /**
   * The parameters of a soil. Strengths are tables: pairs of the accumulated
   * plastic strain @f$\kappa@f$ and a value, linear in between, constant after
   * the last; the first @f$\kappa@f$ is 0, and they increase.
   */
  struct SoilParameters
  {
    using Table = std::vector<std::pair<double, double>>;

    IsotropicElasticity elasticity;

    Table cohesion       = {{0., 0.}}; ///< c >= 0 [stress]
    Table friction_angle = {{0., 0.}}; ///< in degrees, c > 0 where it is 0
    Table dilation_angle = {{0., 0.}}; ///< in degrees, at most the friction's

    /** The largest principal stress >= 0; infinity: no limit. */
    Table tensile_strength = {{0., 0.}};

    /** The accumulated volumetric plastic strain from which on there is no
     * dilation angle; infinity: dilation does not end. */
    double largest_dilation = std::numeric_limits<double>::infinity();

    /** Factors of cohesion, friction angle, dilation angle and tensile
     * strength; one that is a field has the table {0, 1}. */
    std::array<Parameter, 4> scales{{1, 1, 1, 1}};
  };

  /** The strength of a soil at one point, or its derivative. */
  struct SoilStrength
  {
    double cohesion = 0;
    double sin_phi  = 0; ///< of the friction angle
    double cos_phi  = 0;
    double sin_psi  = 0; ///< of the dilation angle
    double tension  = 0;
  };

  /** Strengths as functions of the accumulated plastic strain. */
  class SoilStrengthTables
  {
  public:
    /** A strength and its derivative by @f$\kappa@f$. */
    struct Row
    {
      SoilStrength value, slope;
    };

    explicit SoilStrengthTables(const SoilParameters &parameters);

    /** The same with c / F, tan(phi) / F, tensile strength / F, and no more
     * dilation than friction. */
    SoilStrengthTables
    over(const double factor) const;

    /** Whether they are the same at all points and at any strain. */
    bool
    are_constant() const
    {
      return segments.size() == 1 &&
             std::none_of(scales.begin(), scales.end(), [](const auto &scale) {
               return scale.is_field();
             });
    }

    /** Whether there is a friction angle anywhere. */
    bool
    have_friction() const
    {
      return std::any_of(segments.begin(),
                         segments.end(),
                         [](const auto &segment) {
                           return segment.value[1] > 0;
                         });
    }

    unsigned int
    n_segments() const
    {
      return segments.size();
    }

    /** The segment that @p kappa >= 0 lies in; at a kink, the later one. */
    unsigned int
    segment_at(const double kappa) const;

    /** Where a segment ends; the last does at infinity. */
    double
    end_of(const unsigned int segment) const
    {
      return segment + 1 < segments.size() ?
               segments[segment + 1].kappa :
               std::numeric_limits<double>::infinity();
    }

    /** At @p kappa, as @p segment says, at a point with these @p fields. */
    Row
    at(const double       kappa,
       const unsigned int segment,
       const double      *fields) const;

  private:
    /** Cohesion, angles in radians and tension at its start and their slopes.
     */
    struct Segment
    {
      double                kappa;
      std::array<double, 4> value, slope;
    };

    std::vector<Segment>     segments;
    std::array<Parameter, 4> scales;
    double                   reduction = 1;
  };

  /** Hooke's law in principal values. */
  inline dealii::Tensor<1, 3>
  principal_stress(const LameConstants &C, const dealii::Tensor<1, 3> &strain)
  {
    const double         mean = C.lambda * (strain[0] + strain[1] + strain[2]);
    dealii::Tensor<1, 3> stress;
    for (unsigned int A = 0; A < 3; ++A)
      stress[A] = 2 * C.mu * strain[A] + mean;
    return stress;
  }

  /** The derivative of principal_stress(). */
  inline dealii::Tensor<2, 3>
  principal_tangent(const LameConstants &C)
  {
    dealii::Tensor<2, 3> D;
    for (unsigned int A = 0; A < 3; ++A)
      for (unsigned int B = 0; B < 3; ++B)
        D[A][B] = C.lambda + (A == B ? 2 * C.mu : 0.);
    return D;
  }

  /** The inverse of principal_stress(). */
  inline dealii::Tensor<1, 3>
  principal_strain(const LameConstants &C, const dealii::Tensor<1, 3> &stress)
  {
    const double         bulk_3  = 3 * C.lambda + 2 * C.mu;
    const double         inverse = 1 / (2 * C.mu * bulk_3);
    const double         mean = C.lambda * (stress[0] + stress[1] + stress[2]);
    dealii::Tensor<1, 3> strain;
    for (unsigned int A = 0; A < 3; ++A)
      strain[A] = inverse * (bulk_3 * stress[A] - mean);
    return strain;
  }

  /**
   * The stress that exceeds a yield function only by round-off. A point that
   * yielded and rests has the elastic tangent, whatever that did to its strain:
   * a fraction of the strain, and what is lost next to 1 where strains are
   * logarithms of stretches.
   *
   * @param C the elastic stiffness
   * @param strain the trial strain
   * @param cohesion the yield function at no stress, or any part of it
   */
  inline double
  yield_round_off(const LameConstants        &C,
                  const dealii::Tensor<1, 3> &strain,
                  const double                cohesion)
  {
    const double size =
      std::abs(strain[0]) + std::abs(strain[1]) + std::abs(strain[2]);
    return 1e-12 * cohesion +
           (std::abs(C.lambda) + 2 * C.mu) * (1e-12 * size + 2e-15);
  }

  /** The result of a return mapping with the strengths at one @f$\kappa@f$. */
  struct SoilReturn
  {
    bool                 yields = false;
    dealii::Tensor<1, 3> stress;
    dealii::Tensor<2, 3> tangent; ///< by the trial strain
    dealii::Tensor<1, 3> slope;   ///< of the stress by @f$\kappa@f$

    dealii::Tensor<1, 3> elastic; ///< strain
    dealii::Tensor<1, 3> plastic; ///< strain of the step

    /** Fill what follows from the stress. */
    void
    split(const LameConstants &C, const dealii::Tensor<1, 3> &trial_strain)
    {
      elastic = principal_strain(C, stress);
      plastic = trial_strain - elastic;
    }

    double
    plastic_strain() const
    {
      return std::sqrt(2. / 3.) * plastic.norm();
    }
  };

  /** The value of a function and its slope, or 0 for what round-off leaves. */
  struct Residual
  {
    double value, slope;
  };

  /** The zero of a function from a value < 0 at @p low to one >= 0 at @p high,
   * by Newton's method within bounds that come closer. */
  template <typename Function>
  double
  zero_between(const Function &f,
               double          low,
               const double    f_low,
               double          high,
               const double    f_high)
  {
    double x = low - f_low * (high - low) / (f_high - f_low);
    for (unsigned int iteration = 0; iteration < 100; ++iteration)
      {
        const Residual at = f(x);
        if (at.value == 0 || !(high - low > 1e-16 * high))
          break;
        (at.value < 0 ? low : high) = x;
        x -= at.value / at.slope;
        if (!(x > low && x < high))
          x = 0.5 * (low + high);
      }
    return x;
  }

  /**
   * Close a return: find the @f$\kappa@f$ at which @f$r(\kappa) = \kappa -
   * \kappa_n - \Delta\kappa(\kappa) = 0@f$, where @f$\Delta\kappa =
   * \sqrt{2/3}\, \|\varepsilon^{tr} - C^{-1} \sigma(\kappa)\|@f$ and @p give
   * returns to the strength at @f$\kappa@f$; segment by segment, so that it is
   * the first one. The tangent becomes
   * @f[
   *   \frac{\partial\sigma}{\partial\varepsilon} +
   *   \frac{\partial\sigma}{\partial\kappa} \otimes
   *   \frac{\partial\Delta\kappa/\partial\varepsilon}
   *        {1 - \partial\Delta\kappa/\partial\kappa} .
   * @f]
   *
   * @param tables the strengths
   * @param C the elastic stiffness
   * @param kappa in: at the start of the step, out: at its end; nan if r does
   * not grow over a segment before, so that there is no return
   * @param give a function of @f$\kappa@f$ and segment that answers with a
   * SoilReturn
   */
  template <typename Give>
  SoilReturn
  close_return(const SoilStrengthTables &tables,
               const LameConstants      &C,
               const Give               &give,
               double                   &kappa)
  {
    constexpr double nan     = std::numeric_limits<double>::quiet_NaN();
    const double     kappa_n = kappa;
    unsigned int     segment = tables.segment_at(kappa);
    SoilReturn       at;
    double           increment = 0;
    const auto       residual  = [&](const double k) {
      at               = give(k, segment);
      increment        = at.plastic_strain();
      const double r   = k - kappa_n - increment;
      const double all = at.plastic * principal_strain(C, at.slope);
      return Residual{std::abs(r) <= 1e-15 * (k + at.elastic.norm()) ? 0. : r,
                      increment > 0 ? 1 + 2. / 3. * all / increment : 1.};
    };

    double low = kappa_n, r_low = residual(low).value;
    if (!at.yields)
      return at;
    for (kappa = nan;; ++segment)
      {
        const double end = tables.end_of(segment);
        if (std::isinf(end))
          {
            kappa = kappa_n + increment; // as at low
            break;
          }
        const double r_end = residual(end).value;
        if (r_end >= 0)
          kappa = zero_between(residual, low, r_low, end, r_end);
        if (r_end >= 0 || !(r_end > r_low))
          break;
        low   = end;
        r_low = r_end;
      }
    const double slope = residual(kappa).slope;
    if (!(slope > 0))
      kappa = nan;
    if (std::isnan(kappa))
      at.stress[0] = at.stress[1] = at.stress[2] = nan;
    else if (increment > 0)
      at.tangent +=
        outer_product(at.slope,
                      (at.plastic -
                       principal_strain(C, at.plastic) * at.tangent) *
                        (2. / 3. / (increment * slope)));
    return at;
  }

  /** A material with the strength of a soil. */
  class SoilMaterial : public IsotropicMaterial
  {
  public:
    bool
    dissipates() const override
    {
      return true;
    }

    /** Symmetric if flow is associated and strength constant. */
    bool
    has_symmetric_tangent() const override
    {
      if (!strengths.have_friction())
        return strengths.n_segments() == 1;
      if (!strengths.are_constant())
        return false;
      const SoilStrength at_start = strengths.at(0, 0, nullptr).value;
      return at_start.sin_psi == at_start.sin_phi;
    }

    bool
    has_friction() const override
    {
      return strengths.have_friction();
    }

    double
    least_stiffness() const override
    {
      return 1e-8;
    }

    std::string
    why_no_stress() const override
    {
      return "it cannot return to its yield surface: the strength falls too "
             "steeply with plastic strain";
    }

  protected:
    /** With the accumulated plastic strain @f$\kappa@f$ and, if dilation
     * ends, the volumetric one. */
    explicit SoilMaterial(const SoilParameters &parameters)
      : IsotropicMaterial(parameters.elasticity, history_of(parameters))
      , strengths(parameters)
    {}

    /** Whether elasticity and strength are the same at all points and at any
     * strain. */
    bool
    is_constant() const
    {
      return strengths.are_constant() && has_uniform_stiffness();
    }

    SoilStrengthTables strengths;

  private:
    static std::vector<InternalVariable>
    history_of(const SoilParameters &parameters)
    {
      std::vector<InternalVariable> variables{{"plastic_strain", "-"}};
      if (std::isfinite(parameters.largest_dilation))
        variables.push_back({"plastic_dilation", "-"});
      return variables;
    }
  };

  /** Elasticity, `Cohesion`, `Friction angle`, `Dilation angle` and `Softening
   * length`. */
  std::vector<MaterialKey>
  soil_keys();

  /** Read them and, with @p has_tension, `Tensile strength` and `Largest
   * plastic dilation`. @throws InputError for what a soil cannot have. */
  SoilParameters
  read_soil(MaterialInput &input, const bool has_tension);

  /** Elasticity, `Shear strength` and `Softening length`. */
  std::vector<MaterialKey>
  undrained_keys();

  /** Read them: a cohesion without friction and without a limit of tension. */
  SoilParameters
  read_undrained(MaterialInput &input);
} // namespace moraine

#endif
