// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/solver/multigrid_options.h>

#include <deal.II/base/mpi.h>

#include <deal.II/lac/trilinos_precondition.h>

#include <limits>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /**
     * Whether the unknowns of a node follow each other, component by
     * component, on every rank. The first dim modes are the translations, so
     * they tell the component of an unknown.
     */
    bool
    unknowns_come_by_node(const std::vector<LA::Vector> &near_null_space,
                          const unsigned int             dim)
    {
      const auto         n_owned = near_null_space[0].locally_owned_size();
      const unsigned int n_modes = near_null_space.size();
      bool               by_node = n_modes >= dim && n_owned % dim == 0;
      for (unsigned int c = 0; by_node && c < dim; ++c)
        {
          const double *values = near_null_space[c].trilinos_vector()[0];
          for (unsigned int i = 0; by_node && i < n_owned; ++i)
            by_node = (values[i] == 0. || i % dim == c);
        }
      return Utilities::MPI::min(by_node ? 1 : 0,
                                 near_null_space[0].get_mpi_communicator()) ==
             1;
    }
  } // namespace



  MultigridOptions::MultigridOptions(
    const LA::SparseMatrix        &matrix,
    const bool                     symmetric,
    const std::vector<LA::Vector> &near_null_space,
    const unsigned int             dim)
  {
    TrilinosWrappers::PreconditionAMG::AdditionalData data;
    data.elliptic              = symmetric;
    data.aggregation_threshold = 1e-4;
    data.smoother_sweeps       = 2;
    data.smoother_type = symmetric ? "Chebyshev" : "symmetric Gauss-Seidel";
    data.set_parameters(list, modes, matrix);
    list.set("ML output", 0);
    // ML adds this number to the diagonal on the coarsest level: 1e-12,
    // whatever the unit of stiffness, unless told. It does not find the key
    // in its own table of valid ones.
    list.set("ML validate parameter list", false);
    list.set("coarse: add to diag",
             std::numeric_limits<double>::epsilon() * matrix.linfty_norm());
    if (near_null_space.empty())
      return;

    const Epetra_Map &map = matrix.trilinos_matrix().DomainMap();
    modes = std::make_unique<Epetra_MultiVector>(map, near_null_space.size());
    for (unsigned int m = 0; m < near_null_space.size(); ++m)
      *(*modes)(m) = *near_null_space[m].trilinos_vector()(0);
    list.set("null space: type", "pre-computed");
    list.set("null space: dimension", modes->NumVectors());
    list.set("null space: vectors", modes->Values());
    if (unknowns_come_by_node(near_null_space, dim))
      list.set("PDE equations", static_cast<int>(dim));
  }
} // namespace moraine
