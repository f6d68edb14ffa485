// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/output/mesh_vtu.h>

#include <moraine/output/vtu_file.h>

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

    /** A cell drawn through its nodes, which may be anywhere. */
    template <int dim>
    DataOutBase::Patch<dim, dim>
    make_patch(const GridSpace<dim>              &space,
               const unsigned int                *nodes,
               const std::vector<NodeField<dim>> &fields)
    {
      const unsigned int           n_nodes = space.nodes_per_cell();
      DataOutBase::Patch<dim, dim> patch;
      patch.reference_cell       = ReferenceCells::get_hypercube<dim>();
      patch.n_subdivisions       = space.degree();
      patch.points_are_available = true;
      for (const unsigned int v : GeometryInfo<dim>::vertex_indices())
        patch.vertices[v] =
          space.node_position(nodes[corner_node<dim>(v, space.degree())]);

      patch.data.reinit(dim * (fields.size() + 1), n_nodes);
      for (unsigned int a = 0; a < n_nodes; ++a)
        {
          unsigned int row = 0;
          for (const auto &field : fields)
            for (unsigned int c = 0; c < dim; ++c)
              patch.data(row++, a) = field.values[nodes[a]][c];
          for (unsigned int c = 0; c < dim; ++c)
            patch.data(row++, a) = space.node_position(nodes[a])[c];
        }
      return patch;
    }
  } // namespace



  template <int dim>
  void
  write_mesh_vtu(const GridSpace<dim>              &space,
                 const std::vector<NodeField<dim>> &fields,
                 const std::string                 &path,
                 const double                       time,
                 const unsigned int                 step)
  {
    VtuFile<dim, dim> file;
    for (const auto &field : fields)
      {
        AssertDimension(field.values.size(), space.n_nodes());
        file.add_vector(field.name, field.unit);
      }
    std::vector<const unsigned int *> cells;
    for (const auto &cell :
         space.mesh().triangulation().active_cell_iterators())
      if (cell->is_locally_owned() && space.is_active(cell))
        cells.push_back(space.cell_nodes(cell));
    file.write(path,
               time,
               step,
               space.communicator(),
               cells.size(),
               [&](const unsigned int i) {
                 return make_patch<dim>(space, cells[i], fields);
               });
  }



  template void
  write_mesh_vtu(const GridSpace<2> &,
                 const std::vector<NodeField<2>> &,
                 const std::string &,
                 const double,
                 const unsigned int);
  template void
  write_mesh_vtu(const GridSpace<3> &,
                 const std::vector<NodeField<3>> &,
                 const std::string &,
                 const double,
                 const unsigned int);
} // namespace moraine
