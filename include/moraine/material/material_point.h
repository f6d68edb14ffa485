// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_material_material_point_h
#define moraine_material_material_point_h

#include <moraine/material/spectral.h>

#include <memory>
#include <vector>

namespace moraine
{
  /**
   * One point of a material, without a mesh: its committed state, and a trial
   * state in which it asks the material as TrialPoints does.
   */
  class MaterialPoint
  {
  public:
    /**
     * At the start it has @p stress, which at finite strain is that of F = 1.
     * stress() then tells what the material makes of it: another stress where
     * it yields before.
     */
    MaterialPoint(const std::shared_ptr<const Material> &material,
                  const StrainMeasure                    measure,
                  const dealii::SymmetricTensor<2, 3>   &stress);

    /** Try a step with the gradient @p H of its displacements, with regard to
     * the place at its start. @return whether there is a stress. */
    bool
    try_step(const StepTime &time, const dealii::Tensor<2, 3> &H);

    /** Commit what was tried. */
    void
    keep()
    {
      committed = trial;
    }

    /** Of the trial state; at finite strain Kirchhoff's. */
    const dealii::SymmetricTensor<2, 3> &
    stress() const
    {
      return trial.stress;
    }

    /** By how much the stress changes for a small change of the trial state,
     * @f$\dot F = l F@f$. */
    dealii::SymmetricTensor<2, 3>
    stress_rate(const dealii::Tensor<2, 3> &l) const;

    const VoigtMatrix<3> &
    tangent_matrix() const
    {
      return tangent;
    }

    /** In the order of Material::internal_variables(). */
    const std::vector<double> &
    internal() const
    {
      return trial.internal;
    }

    const Material &
    law() const
    {
      return *material;
    }

    StrainMeasure
    strain_measure() const
    {
      return measure;
    }

  private:
    struct State
    {
      dealii::SymmetricTensor<2, 3> stress;
      std::vector<double>           internal;
      /** At finite strain. */
      dealii::Tensor<2, 3>          F;
      dealii::SymmetricTensor<2, 3> b; ///< elastic, if isotropic
    };

    void
    answer_in_principal_values(const StepTime             &time,
                               const dealii::Tensor<2, 3> &H);

    void
    answer_in_tensors(const StepTime &time, const dealii::Tensor<2, 3> &H);

    std::shared_ptr<const Material> material;
    StrainMeasure                   measure;
    State                           committed, trial;
    /** Of the trial state: sums over J of c_IJ d_J give the stress. */
    VoigtMatrix<3> tangent{};
  };
} // namespace moraine

#endif
