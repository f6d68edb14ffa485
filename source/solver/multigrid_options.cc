// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/solver/multigrid_options.h>

#include <deal.II/base/mpi.h>

#include <deal.II/lac/trilinos_precondition.h>

#include <ml_MultiLevelPreconditioner.h>

#include <algorithm>
#include <limits>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /**
     * Whether inertia holds nearly every node: a rigid translation takes a
     * force of two hundredths of the diagonal or more, as it does for Courant
     * numbers below about twelve. Stiffness alone has none but beside held
     * nodes.
     */
    bool
    is_held_by_inertia(const LA::SparseMatrix        &matrix,
                       const std::vector<LA::Vector> &near_null_space,
                       const unsigned int             dim)
    {
      if (near_null_space.size() < dim)
        return false;
      constexpr double least_share = 0.02, most_nodes = 0.9;
      LA::Vector       diagonal(near_null_space[0]), forces(diagonal);
      matrix.trilinos_matrix().ExtractDiagonalCopy(
        *diagonal.trilinos_vector()(0));
      unsigned int counts[2] = {0, 0};
      for (unsigned int c = 0; c < dim; ++c)
        {
          matrix.vmult(forces, near_null_space[c]);
          const double *t = near_null_space[c].trilinos_vector()[0];
          const double *d = diagonal.trilinos_vector()[0];
          const double *f = forces.trilinos_vector()[0];
          for (unsigned int i = 0; i < forces.locally_owned_size(); ++i)
            if (t[i] != 0.)
              {
                ++counts[0];
                counts[1] += f[i] * t[i] >= least_share * d[i] * t[i] * t[i];
              }
        }
      Utilities::MPI::sum(counts,
                          near_null_space[0].get_mpi_communicator(),
                          counts);
      return counts[1] >= most_nodes * counts[0];
    }



    /**
     * Whether the unknowns of a node follow each other, component by component,
     * on every rank. The first dim modes are the translations, so they tell the
     * component of an unknown; without any nobody knows. Collective.
     */
    bool
    unknowns_come_by_node(const std::vector<LA::Vector> &near_null_space,
                          const unsigned int             dim)
    {
      if (near_null_space.size() < dim)
        return false;
      const auto n_owned = near_null_space[0].locally_owned_size();
      bool       by_node = n_owned % dim == 0;
      for (unsigned int c = 0; by_node && c < dim; ++c)
        {
          const double *values = near_null_space[c].trilinos_vector()[0];
          for (unsigned int i = 0; by_node && i < n_owned; ++i)
            by_node = (values[i] == 0. || i % dim == c);
        }
      return !Utilities::MPI::logical_or(
        !by_node, near_null_space[0].get_mpi_communicator());
    }
  } // namespace



  MultigridOptions::MultigridOptions(
    const LA::SparseMatrix        &matrix,
    const bool                     symmetric,
    const std::vector<LA::Vector> &near_null_space,
    const unsigned int             dim)
  {
    TrilinosWrappers::PreconditionAMG::AdditionalData data;
    data.elliptic              = true;
    data.aggregation_threshold = 1e-4;
    data.smoother_sweeps       = symmetric ? 2 : 3;
    data.smoother_type = symmetric ? "Chebyshev" : "symmetric Gauss-Seidel";
    data.set_parameters(list, modes, matrix);
    if (!symmetric)
      {
        // Rollers at an angle couple the components of a node firmly. Its
        // block knows them in any axes; one component at a time, Gauss-Seidel
        // is good where they follow the mesh. Coarse levels have other blocks,
        // and ML ends the program if theirs do not come out even.
        list.set("smoother: type (level 0)", "symmetric block Gauss-Seidel");
        list.set("smoother: pre or post", "post");
        list.set("eigen-analysis: type", "power-method");
      }
    list.set("ML output", 0);
    // ML adds this number to the diagonal on the coarsest level: 1e-12,
    // whatever the unit of stiffness, unless told. It does not find the key
    // in its own table of valid ones.
    list.set("ML validate parameter list", false);
    list.set("coarse: add to diag",
             std::numeric_limits<double>::epsilon() * matrix.linfty_norm());
    if (near_null_space.empty())
      return;

    unsigned int n_modes = near_null_space.size();
    if (is_held_by_inertia(matrix, near_null_space, dim))
      {
        // The coarse space has little to do then; a smooth one with rotations
        // would take more memory than the matrix where rows are long.
        list.set("aggregation: damping factor", 0.);
        n_modes = std::min(n_modes, dim);
      }
    const Epetra_Map &map = matrix.trilinos_matrix().DomainMap();
    modes                 = std::make_unique<Epetra_MultiVector>(map, n_modes);
    for (unsigned int m = 0; m < n_modes; ++m)
      *(*modes)(m) = *near_null_space[m].trilinos_vector()(0);
    list.set("null space: type", "pre-computed");
    list.set("null space: dimension", modes->NumVectors());
    list.set("null space: vectors", modes->Values());
    if (unknowns_come_by_node(near_null_space, dim))
      list.set("PDE equations", static_cast<int>(dim));
  }



  void
  renew_smoother(TrilinosWrappers::PreconditionAMG &multigrid)
  {
    const auto *ml = dynamic_cast<ML_Epetra::MultiLevelPreconditioner &>(
                       multigrid.trilinos_operator())
                       .GetML();
    ML_Smoother &smoother = ml->post_smoother[ml->ML_finest_level];
    if (smoother.data_destroy != ML_Smoother_Clean_BGS_Data)
      return;
    const int    sweeps  = smoother.ntimes;
    const double damping = smoother.omega;
    const int    size =
      static_cast<ML_Sm_BGS_Data *>(smoother.smoother->data)->blocksize;
    ML_Smoother_Clean(&smoother);
    ML_Smoother_Init(&smoother, &ml->SingleLevel[ml->ML_finest_level]);
    ML_Gen_Smoother_SymBlockGaussSeidel(const_cast<ML *>(ml),
                                        ml->ML_finest_level,
                                        ML_POSTSMOOTHER,
                                        sweeps,
                                        damping,
                                        size);
  }
} // namespace moraine
