// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_boundary_constraint_h
#define moraine_boundary_constraint_h

#include <deal.II/base/point.h>
#include <deal.II/base/symmetric_tensor.h>

#include <array>
#include <string>

namespace moraine
{
  /** The constraint of a surface, @f$M (u - g) = 0@f$. */
  template <int dim>
  struct Constraint
  {
    enum Kind
    {
      fixed,     ///< @f$M = 1@f$
      roller,    ///< @f$M = n \otimes n@f$
      components ///< @f$M = \sum e_i \otimes e_i@f$
    };
    Kind                  kind = fixed;
    std::array<bool, dim> component{};

    /** M for a normal. */
    dealii::SymmetricTensor<2, dim>
    projection(const dealii::Tensor<1, dim> &normal) const;

    /** In words. */
    std::string
    name() const;
  };

  /** A place's constraint in the trial state: projection, violation of the step
   * and the normal they refer to. */
  template <int dim>
  struct ConstraintState
  {
    dealii::Tensor<1, dim>          normal;
    dealii::SymmetricTensor<2, dim> M;
    dealii::Tensor<1, dim>          violation; ///< @f$M(\Delta u - \Delta g)@f$
    /** Along the normal, its mean over the piece of the surface in the cell,
     * where that is penalised. */
    double mean_violation = 0;
    /** Where a roller pushes: along the normal, or along the mean of both ends
     * of the step, in which a curved wall does no work and has no moment. */
    dealii::Tensor<1, dim> push;
    /** Where the force on the place acts: at the end of the step, or in the
     * middle of it as the push. */
    dealii::Point<dim> place;
  };
} // namespace moraine

#endif
