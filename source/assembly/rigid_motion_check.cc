// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/assembly/rigid_motion_check.h>

#include <moraine/core/exceptions.h>

#include <deal.II/base/mpi.h>

#include <deal.II/lac/lapack_full_matrix.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /**
     * The part of the material each active cell belongs to: parts share no
     * vertex. Every rank knows every cell, so all get the same numbers.
     */
    template <int dim>
    std::pair<std::vector<unsigned int>, unsigned int>
    connected_parts(const GridSpace<dim> &space)
    {
      const auto               &tria = space.mesh().triangulation();
      std::vector<unsigned int> root(tria.n_vertices());
      std::iota(root.begin(), root.end(), 0u);
      const auto find = [&root](unsigned int v) {
        while (root[v] != v)
          v = root[v] = root[root[v]];
        return v;
      };
      for (const auto &cell : tria.active_cell_iterators())
        if (space.is_active(cell))
          for (const unsigned int v : cell->vertex_indices())
            root[find(cell->vertex_index(v))] = find(cell->vertex_index(0));

      std::vector<unsigned int> number(tria.n_vertices(),
                                       numbers::invalid_unsigned_int);
      std::vector<unsigned int> part(tria.n_active_cells(), 0);
      unsigned int              n_parts = 0;
      for (const auto &cell : tria.active_cell_iterators())
        if (space.is_active(cell))
          {
            unsigned int &n = number[find(cell->vertex_index(0))];
            if (n == numbers::invalid_unsigned_int)
              n = n_parts++;
            part[cell->active_cell_index()] = n;
          }
      return {part, n_parts};
    }



    /** @throws InputError or ComputationError naming part @p k and how it is
     * free. */
    template <int dim>
    [[noreturn]] void
    report_free_part(const StepContext<dim>            &context,
                     const std::vector<unsigned int>   &part,
                     const unsigned int                 k,
                     const std::vector<Vector<double>> &free_motions,
                     const std::vector<std::string>    &body_names,
                     const bool                         first_step)
    {
      const GridSpace<dim> &space = context.state.grid();
      Point<dim>            centre;
      unsigned int          n_cells = 0;
      int                   body    = -1;
      for (const auto &cell :
           space.mesh().triangulation().active_cell_iterators())
        if (space.is_active(cell) && part[cell->active_cell_index()] == k)
          {
            centre += cell->center();
            ++n_cells;
            if (cell->is_locally_owned())
              body = std::max<int>(
                body, context.cell_materials.body(cell->active_cell_index()));
          }
      centre /= n_cells;
      body = Utilities::MPI::max(body, space.communicator());

      // A rotation with the translation that belongs to it, or a translation.
      const Vector<double> &motion   = free_motions[0];
      double                rotation = 0, translation = 0;
      for (unsigned int m = 0; m < motion.size(); ++m)
        if (m < dim)
          translation = std::abs(motion[m]) > std::abs(translation) ?
                          motion[m] :
                          translation;
        else
          rotation = std::max(rotation, std::abs(motion[m]));
      const bool turns = rotation > 1e-6 * std::abs(translation);

      std::ostringstream message;
      message << "the scene is not held" << (first_step ? "" : " any more")
              << ": body '" << body_names.at(body) << "' around (" << centre
              << ") is ";
      if (free_motions.size() == motion.size())
        message << "free to move and rotate";
      else if (free_motions.size() > 1)
        message << "free to move in " << free_motions.size()
                << " independent ways";
      else if (turns)
        message << "free to rotate";
      else
        {
          message << "free to move along (";
          for (unsigned int d = 0; d < dim; ++d)
            message << (d > 0 ? ", " : "")
                    << std::round(1e3 * motion[d] / translation) / 1e3 + 0.;
          message << ")";
        }
      if (first_step)
        throw InputError(message.str() +
                         "; hold it by a boundary or a grid condition");
      throw ComputationError(message.str() +
                             "; what held it has lost the material, or next "
                             "to nothing of its stiffness is left");
    }
  } // namespace



  template <int dim>
  std::vector<LA::Vector>
  rigid_modes_of(const GridSpace<dim> &space)
  {
    constexpr unsigned      n_rotations = dim == 2 ? 1 : 3;
    std::vector<LA::Vector> modes(dim + n_rotations,
                                  LA::Vector(space.locally_owned(),
                                             space.communicator()));
    // About the middle, wherever the origin is, and as large as translations,
    // whatever the unit of length.
    Point<dim> lower, upper;
    for (unsigned int d = 0; d < dim; ++d)
      {
        lower[d] = std::numeric_limits<double>::max();
        upper[d] = -lower[d];
      }
    for (unsigned int node = 0; node < space.n_nodes(); ++node)
      for (unsigned int d = 0; d < dim; ++d)
        {
          lower[d] = std::min(lower[d], space.node_position(node)[d]);
          upper[d] = std::max(upper[d], space.node_position(node)[d]);
        }
    for (unsigned int d = 0; d < dim; ++d)
      {
        lower[d] = Utilities::MPI::min(lower[d], space.communicator());
        upper[d] = Utilities::MPI::max(upper[d], space.communicator());
      }
    const Point<dim> middle = lower + 0.5 * (upper - lower);
    const double     size   = 0.5 * (upper - lower).norm();
    for (unsigned int node = 0; node < space.n_nodes(); ++node)
      for (unsigned int c = 0; c < dim; ++c)
        {
          const auto dof = space.node_dof(node) + c;
          if (!space.locally_owned().is_element(dof))
            continue;
          modes[c](dof)          = 1;
          const Tensor<1, dim> x = space.node_position(node) - middle;
          // Rotation r turns direction i towards direction j.
          constexpr unsigned int turn[3][2] = {{0, 1}, {1, 2}, {2, 0}};
          for (unsigned int r = 0; r < n_rotations; ++r)
            {
              if (c == turn[r][0])
                modes[dim + r](dof) = -x[turn[r][1]] / size;
              if (c == turn[r][1])
                modes[dim + r](dof) = x[turn[r][0]] / size;
            }
        }
    for (auto &mode : modes)
      mode.compress(VectorOperation::insert);
    return modes;
  }



  template <int dim>
  void
  check_rigid_motion(const StepContext<dim>         &context,
                     const LA::SparseMatrix         &tangent,
                     const ConstraintTable          &constraints,
                     const std::vector<LA::Vector>  &rigid_modes,
                     const std::vector<std::string> &body_names,
                     const bool                      first_step)
  {
    const GridSpace<dim> &space = context.state.grid();
    const auto [part, n_parts]  = connected_parts(space);
    const unsigned int n_modes  = rigid_modes.size();

    std::vector<unsigned int> part_of_node(space.n_nodes(), 0);
    for (const auto &cell :
         space.mesh().triangulation().active_cell_iterators())
      if (space.knows(cell))
        for (unsigned int a = 0; a < space.nodes_per_cell(); ++a)
          part_of_node[space.cell_nodes(cell)[a]] =
            part[cell->active_cell_index()];

    // Gram matrices of rigid motions part by part: with 1, with K, and with 1
    // where they are prescribed, for which the mean of K's diagonal stands as
    // stiffness. That also says what round-off leaves of a free one: it grows
    // with a stiff boundary's share of the part, as round-off does.
    const unsigned int      size = n_modes * n_modes;
    std::vector<double>     gram(3 * size * n_parts, 0.);
    std::vector<double>     diagonal(n_parts, 0.), n_rows(n_parts, 0.);
    std::vector<LA::Vector> modes = rigid_modes, forces = rigid_modes;
    for (unsigned int m = 0; m < n_modes; ++m)
      {
        constraints.homogeneous().set_zero(modes[m]);
        tangent.vmult(forces[m], modes[m]);
      }
    for (unsigned int node = 0; node < space.n_nodes(); ++node)
      for (unsigned int c = 0; c < dim; ++c)
        {
          const auto dof = space.node_dof(node) + c;
          if (!space.locally_owned().is_element(dof))
            continue;
          const unsigned int k              = part_of_node[node];
          const bool         prescribed_dof = constraints.prescribes(dof);
          if (!constraints.homogeneous().is_constrained(dof))
            {
              diagonal[k] += std::abs(tangent.diag_element(dof));
              ++n_rows[k];
            }
          for (unsigned int i = 0; i < n_modes; ++i)
            for (unsigned int j = 0; j < n_modes; ++j)
              {
                const unsigned int entry = 3 * size * k + i * n_modes + j;
                const double one = rigid_modes[i](dof) * rigid_modes[j](dof);
                gram[entry] += one;
                gram[entry + size] += modes[i](dof) * forces[j](dof);
                gram[entry + 2 * size] += prescribed_dof ? one : 0.;
              }
        }
    for (auto *sums : {&gram, &diagonal, &n_rows})
      Utilities::MPI::sum(*sums, space.communicator(), *sums);

    for (unsigned int k = 0; k < n_parts; ++k)
      {
        if (n_rows[k] == 0) // every node is prescribed
          continue;
        // Smallest Rayleigh quotient: K a = lambda M a with M > 0.
        LAPACKFullMatrix<double> K(n_modes), M(n_modes);
        for (unsigned int i = 0; i < n_modes; ++i)
          for (unsigned int j = 0; j < n_modes; ++j)
            {
              const double *G = &gram[3 * size * k];
              M(i, j)         = G[i * n_modes + j];
              K(i, j) =
                0.5 * (G[size + i * n_modes + j] + G[size + j * n_modes + i]) +
                diagonal[k] / n_rows[k] * G[2 * size + i * n_modes + j];
            }
        std::vector<Vector<double>> vectors(n_modes, Vector<double>(n_modes));
        K.compute_generalized_eigenvalues_symmetric(M, vectors, 1);
        std::vector<Vector<double>> free;
        for (unsigned int m = 0; m < n_modes; ++m)
          if (K.eigenvalue(m).real() <= 1e-13 * diagonal[k] / n_rows[k])
            free.push_back(vectors[m]);
        if (!free.empty())
          report_free_part(context, part, k, free, body_names, first_step);
      }
  }



#define INSTANTIATE(dim)                                          \
  template decltype(rigid_modes_of<dim>)     rigid_modes_of<dim>; \
  template decltype(check_rigid_motion<dim>) check_rigid_motion<dim>;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
