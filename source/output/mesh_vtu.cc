// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/output/mesh_vtu.h>

#include <moraine/output/stress_rows.h>

#include <deal.II/base/utilities.h>

#include <deal.II/grid/reference_cell.h>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** Place of corner @p v among the lexicographic nodes of a cell. */
    template <int dim>
    unsigned int
    corner_node(const unsigned int v, const unsigned int degree)
    {
      unsigned int node = 0;
      for (unsigned int d = 0; d < dim; ++d)
        if (v & (1u << d))
          node += degree * Utilities::pow(degree + 1, d);
      return node;
    }

    /** At the corners of a cell; those without have the mean of the others. */
    template <int dim>
    std::array<typename SmoothedStress<dim>::Stress, (1 << dim)>
    stress_of_corners(const typename GridSpace<dim>::CellIterator &cell,
                      const SmoothedStress<dim>                   &stress)
    {
      std::array<typename SmoothedStress<dim>::Stress, (1 << dim)> corners;
      typename SmoothedStress<dim>::Stress                         mean{};
      std::vector<unsigned int>                                    without;
      for (const unsigned int v : cell->vertex_indices())
        if (const auto here = stress.at_vertex(cell->vertex_index(v)))
          {
            corners[v] = *here;
            for (unsigned int c = 0; c < mean.size(); ++c)
              mean[c] += corners[v][c];
          }
        else
          without.push_back(v);
      if (without.size() < corners.size())
        for (double &component : mean)
          component /= corners.size() - without.size();
      for (const unsigned int v : without)
        corners[v] = mean;
      return corners;
    }



    /** Append the rows of the stress at all nodes of a patch, from
     * @p first_row, and of its invariants if wanted. */
    template <int dim>
    void
    add_stress(const GridSpace<dim>                        &space,
               const typename GridSpace<dim>::CellIterator &cell,
               const SmoothedStress<dim>                   &stress,
               const unsigned int                           first_row,
               const bool                                   with_invariants,
               Table<2, float>                             &data)
    {
      const auto         corners = stress_of_corners(cell, stress);
      const unsigned int n       = space.degree() + 1;
      for (unsigned int a = 0; a < space.nodes_per_cell(); ++a)
        {
          Point<dim> unit;
          for (unsigned int d = 0, rest = a; d < dim; ++d, rest /= n)
            unit[d] = static_cast<double>(rest % n) / space.degree();
          typename SmoothedStress<dim>::Stress here{};
          for (const unsigned int v : GeometryInfo<dim>::vertex_indices())
            for (unsigned int c = 0; c < here.size(); ++c)
              here[c] += GeometryInfo<dim>::d_linear_shape_function(unit, v) *
                         corners[v][c];
          unsigned int row = first_row;
          for (const unsigned int c : tensor_components<dim>)
            data(row++, a) = c < here.size() ? here[c] : 0.;
          if (!with_invariants)
            continue;
          data(row++, a) = von_mises_stress<dim>(here.data());
          data(row++, a) = mean_stress(here.data());
        }
    }



    /** A cell drawn through its nodes, which may be anywhere. */
    template <int dim>
    DataOutBase::Patch<dim, dim>
    make_patch(const GridSpace<dim>                        &space,
               const typename GridSpace<dim>::CellIterator &cell,
               const std::vector<NodeField<dim>>           &fields,
               const SmoothedStress<dim>                   &stress,
               const SmoothedStress<dim>                   *effective,
               const unsigned int                           n_rows)
    {
      const unsigned int           n_nodes = space.nodes_per_cell();
      const unsigned int          *nodes   = space.cell_nodes(cell);
      DataOutBase::Patch<dim, dim> patch;
      patch.reference_cell       = ReferenceCells::get_hypercube<dim>();
      patch.n_subdivisions       = space.degree();
      patch.points_are_available = true;
      for (const unsigned int v : GeometryInfo<dim>::vertex_indices())
        patch.vertices[v] =
          space.node_position(nodes[corner_node<dim>(v, space.degree())]);

      // After these come the places of the nodes, from the first vertex.
      patch.data.reinit(n_rows + dim, n_nodes);
      const unsigned int first = dim * fields.size();
      add_stress(space, cell, stress, first, true, patch.data);
      if (effective)
        add_stress(space, cell, *effective, first + 11, false, patch.data);
      for (unsigned int a = 0; a < n_nodes; ++a)
        {
          unsigned int row = 0;
          for (const auto &field : fields)
            for (unsigned int c = 0; c < dim; ++c)
              patch.data(row++, a) = field.values[nodes[a]][c];
          for (unsigned int c = 0; c < dim; ++c)
            patch.data(n_rows + c, a) =
              (space.node_position(nodes[a]) - patch.vertices[0])[c];
        }
      return patch;
    }
  } // namespace



  template <int dim>
  void
  write_mesh_vtu(const GridSpace<dim>              &space,
                 const std::vector<NodeField<dim>> &fields,
                 const SmoothedStress<dim>         &stress,
                 const VtuTarget                   &target,
                 const SmoothedStress<dim>         *effective)
  {
    VtuFile<dim, dim> file(target);
    for (const auto &field : fields)
      {
        AssertDimension(field.values.size(), space.n_nodes());
        file.add_vector(field.name, field.unit);
      }
    file.add_tensor("smoothed_stress", "stress");
    file.add_scalar("smoothed_von_mises_stress", "stress");
    file.add_scalar("smoothed_mean_stress", "stress");
    if (effective)
      file.add_tensor("smoothed_effective_stress", "stress");
    std::vector<typename GridSpace<dim>::CellIterator> cells;
    for (const auto &cell :
         space.mesh().triangulation().active_cell_iterators())
      if (cell->is_locally_owned() && space.is_active(cell))
        cells.push_back(cell);
    file.write(space.communicator(), cells.size(), [&](const unsigned int i) {
      return make_patch(
        space, cells[i], fields, stress, effective, file.n_rows());
    });
  }



#define INSTANTIATE(dim) \
  template decltype(write_mesh_vtu<dim>) write_mesh_vtu<dim>;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
