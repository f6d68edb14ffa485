// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_material_material_test_h
#define moraine_material_material_test_h

#include <moraine/material/material_point.h>

#include <array>
#include <functional>
#include <optional>
#include <string>

namespace moraine
{
  /** Numbers for the components xx, yy, zz, xy, xz, yz, the order of
   * dealii::SymmetricTensor. */
  using SixNumbers = std::array<double, 6>;

  /** A sum of stresses and strains, each times a factor. */
  struct StressStrainSum
  {
    SixNumbers of_stress{};
    SixNumbers of_strain{};
  };

  /** A part of a test: each sum goes to its value at the start of the test plus
   * @p factor times what is missing to @p values; without a value it stays. */
  struct MaterialTestLeg
  {
    std::string                          text; ///< for messages
    std::array<StressStrainSum, 6>       sums;
    std::array<std::optional<double>, 6> values;
    double                               factor  = 1;
    unsigned int                         n_steps = 1;
  };

  /**
   * A test of one MaterialPoint. Six sums of stresses and strains are led to
   * values that they should have; Newton's method with the tangent of the
   * material, symmetric or not, finds the strains.
   *
   * The strains are @f$\varepsilon_{xx}@f$, ..., and of the shear components
   * the angles @f$\gamma_{xy} = 2\varepsilon_{xy}@f$, .... At finite strain x
   * lines stay along x, and z planes normal to z:
   * @f[
   *   F = \begin{pmatrix} e^{\varepsilon_{xx}} & \gamma_{xy} & \gamma_{xz} \\
   *     & e^{\varepsilon_{yy}} & \gamma_{yz} \\
   *     & & e^{\varepsilon_{zz}} \end{pmatrix}
   * @f]
   * which is any deformation up to a rotation; without shear the strains are
   * logarithmic. The stress is Kirchhoff's then.
   */
  class MaterialTest
  {
  public:
    MaterialTest(const std::shared_ptr<const Material> &material,
                 const StrainMeasure                    measure,
                 const dealii::SymmetricTensor<2, 3>   &initial_stress);

    /**
     * Do @p leg in equal steps within a unit of time; @p after_step is called
     * after each. A step without an answer is halved, up to a 1024th.
     * @throw ComputationError if the smallest step has no answer.
     */
    void
    lead(const MaterialTestLeg &leg, const std::function<void()> &after_step);

    const dealii::SymmetricTensor<2, 3> &
    stress() const
    {
      return point.stress();
    }

    /** Of the last step. */
    const VoigtMatrix<3> &
    tangent() const
    {
      return point.tangent_matrix();
    }

    const SixNumbers &
    strain() const
    {
      return committed_strain;
    }

    const std::vector<double> &
    internal() const
    {
      return point.internal();
    }

    /** Of the last step, those of its parts together. */
    unsigned int
    n_iterations() const
    {
      return iterations;
    }

    /**
     * Of the last step: largest difference of the tangent from difference
     * quotients of the stress, over the largest entry. At a kink the quotient
     * to either side may count.
     */
    double
    tangent_error() const
    {
      return error_of_tangent;
    }

  private:
    /** Ask the material at @p strain. */
    bool
    try_strain(const StepTime &time, const SixNumbers &strain);

    /** How the stress changes with a strain, in the trial state; @p elastic: by
     * the elastic stiffness. */
    dealii::SymmetricTensor<2, 3>
    slope(const unsigned int component, const bool elastic) const;

    /** @param elastic_first whether the first correction is elastic
     * @return whether there are strains with these values. */
    bool
    try_values(const StepTime                       &time,
               const std::array<StressStrainSum, 6> &sums,
               const SixNumbers                     &values,
               const bool                            elastic_first);

    void
    find_error_of_tangent(const StepTime &time);

    [[noreturn]] void
    fail() const;

    dealii::SymmetricTensor<2, 3> initial_stress;

    MaterialPoint point;
    double        stiffness;
    SixNumbers    committed_strain{}, trial_strain{};
    bool          has_stress       = true;
    double        time             = 0;
    unsigned int  iterations       = 0;
    double        error_of_tangent = 0;
  };

  /** What strain paths of one point find wrong with a law, each in one line. */
  std::vector<std::string>
  faults_of(const std::shared_ptr<const Material> &material);
} // namespace moraine

#endif
