// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_assembly_contact_flux_h
#define moraine_assembly_contact_flux_h

#include <moraine/assembly/step_context.h>

#include <deal.II/base/symmetric_tensor.h>

#include <map>
#include <vector>

namespace moraine
{
  /** Integrals over the points in a cell: of the stress at the start of the
   * step, and of the gradients of functions of nodes by which it changes. */
  template <int dim>
  struct CellFlux
  {
    struct Gradients
    {
      dealii::Tensor<1, dim> own;  ///< of the points
      dealii::Tensor<1, dim> mean; ///< by which the volume changes

      void
      add(const Gradients &other, const double factor)
      {
        own += factor * other.own;
        mean += factor * other.mean;
      }

      /** One gradient for both. */
      void
      add(const dealii::Tensor<1, dim> &both)
      {
        own += both;
        mean += both;
      }
    };

    double                            volume = 0;
    dealii::SymmetricTensor<2, dim>   stress;
    std::map<unsigned int, Gradients> gradients; ///< by node
  };

  /** By active_cell_index(). */
  template <int dim>
  using CellFluxes = std::map<unsigned int, CellFlux<dim>>;

  /** Of some @p cells of this rank; the volume is zero where no point is. */
  template <int dim>
  CellFluxes<dim>
  fluxes_in_cells(const StepContext<dim>          &context,
                  const std::vector<unsigned int> &cells);
} // namespace moraine

#endif
