// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_assembly_local_system_h
#define moraine_assembly_local_system_h

#include <moraine/assembly/mean_dilatation.h>
#include <moraine/state/state.h>

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

#include <string>
#include <vector>

namespace moraine
{
  /**
   * Matrix and force of the unknowns of one batch of points or one cell, in
   * node major order, with the scratch arrays the terms share.
   */
  template <int dim>
  struct LocalSystem
  {
    dealii::FullMatrix<double>                   matrix;
    dealii::Vector<double>                       force;
    std::vector<dealii::types::global_dof_index> dofs;
    const unsigned int                          *nodes = nullptr;
    std::vector<dealii::Tensor<1, dim>>          nodal_increments;
    /** Moments of gradients. */
    std::vector<double> moments;
    TrialPoints<dim>    trial_points;
    MeanDilatation<dim> dilatation;
    /** Why a point has no stress, if one has none since it was made. */
    std::string failure;

    /** Take the unknowns and increments of @p n_nodes nodes and zero the rest.
     */
    void
    reinit(const State<dim>   &state,
           const unsigned int *nodes,
           const unsigned int  n_nodes,
           const bool          tangent);

    /** Add the force @p f at a place where nodes have the functions @p N. */
    void
    add_force(const double *N, const dealii::Tensor<1, dim> &f)
    {
      for (unsigned int a = 0; a < nodal_increments.size(); ++a)
        for (unsigned int i = 0; i < dim; ++i)
          force[dim * a + i] += N[a] * f[i];
    }

    /** Add @f$N_a N_b K@f$. */
    void
    add_stiffness(const double *N, const dealii::Tensor<2, dim> &K)
    {
      const unsigned int n = nodal_increments.size();
      for (unsigned int a = 0; a < n; ++a)
        for (unsigned int b = 0; b < n; ++b)
          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int j = 0; j < dim; ++j)
              matrix(dim * a + i, dim * b + j) += N[a] * N[b] * K[i][j];
    }

    /** Add @p c times the row-major matrix @p of_nodes in every direction. */
    void
    add_in_all_directions(const double c, const std::vector<double> &of_nodes)
    {
      const unsigned int n = nodal_increments.size();
      for (unsigned int a = 0; a < n; ++a)
        for (unsigned int b = 0; b < n; ++b)
          for (unsigned int d = 0; d < dim; ++d)
            matrix(dim * a + d, dim * b + d) += c * of_nodes[a * n + b];
    }

    /** @f$\sum f \cdot \Delta u@f$ */
    double
    work() const
    {
      double sum = 0;
      for (unsigned int a = 0; a < nodal_increments.size(); ++a)
        for (unsigned int d = 0; d < dim; ++d)
          sum += force[dim * a + d] * nodal_increments[a][d];
      return sum;
    }
  };
} // namespace moraine

#endif
