// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// Places of vertices and moves of nodes in archives.

#include <moraine/mesh/grid_space.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  void
  BackgroundMesh<dim>::write(Archive &archive) const
  {
    std::vector<double> places;
    for (const Point<dim> &vertex : tria.get_vertices())
      places.insert(places.end(), vertex.begin_raw(), vertex.end_raw());
    archive.write("mesh/vertex_position", std::move(places), dim, "length");
    std::vector<double> grid;
    if (box)
      {
        grid.assign(box->lower_corner.begin_raw(), box->lower_corner.end_raw());
        grid.insert(grid.end(),
                    box->cell_size.begin_raw(),
                    box->cell_size.end_raw());
      }
    archive.write("mesh/box_corner_and_cell_size",
                  std::move(grid),
                  dim,
                  "length");
  }



  template <int dim>
  void
  BackgroundMesh<dim>::read(const Archive &archive)
  {
    const auto &places = archive.numbers("mesh/vertex_position", dim);
    AssertThrow(places.size() == dim * tria.n_vertices(),
                ExcMessage("The archive is of another mesh."));
    keep_built_vertices();
    for (const auto &cell : tria.active_cell_iterators())
      for (const unsigned int v : cell->vertex_indices())
        std::copy_n(places.begin() + dim * cell->vertex_index(v),
                    dim,
                    cell->vertex(v).begin_raw());
    const auto &grid = archive.numbers("mesh/box_corner_and_cell_size", dim);
    if (grid.empty())
      box.reset();
    else
      {
        box.emplace().n_cells = cells_of_box;
        std::copy_n(grid.begin(), dim, box->lower_corner.begin_raw());
        std::copy_n(grid.begin() + dim, dim, box->cell_size.begin_raw());
      }
    measure_cells();
    tria.signals.mesh_movement();
  }



  template <int dim>
  void
  GridSpace<dim>::write_node_values(const std::vector<Tensor<1, dim>> &values,
                                    const std::string                 &group,
                                    const std::string                 &unit,
                                    Archive &archive) const
  {
    std::vector<unsigned int> ids;
    std::vector<double>       rows;
    for (const auto &cell : background.triangulation().active_cell_iterators())
      if (!values.empty() && cell->is_locally_owned() && knows(cell))
        for (unsigned int a = 0; a < n_nodes_per_cell; ++a)
          {
            ids.push_back(cell->active_cell_index());
            ids.push_back(a);
            const Tensor<1, dim> &value = values[cell_nodes(cell)[a]];
            rows.insert(rows.end(), value.begin_raw(), value.end_raw());
          }
    archive.distribute(group, std::move(ids), 2);
    archive.write(group + "/value", std::move(rows), dim, unit);
  }



  template <int dim>
  void
  GridSpace<dim>::read_node_values(const Archive               &archive,
                                   const std::string           &group,
                                   std::vector<Tensor<1, dim>> &values) const
  {
    // A rank also knows nodes of cells that are another's.
    const auto ids =
      Utilities::MPI::all_gather(communicator(),
                                 archive.integers(group + "/id", 2));
    const auto rows =
      Utilities::MPI::all_gather(communicator(),
                                 archive.numbers(group + "/value", dim));
    values.clear();
    for (unsigned int rank = 0; rank < ids.size(); ++rank)
      for (unsigned int row = 0; row < ids[rank].size() / 2; ++row)
        {
          const unsigned int cell = ids[rank][2 * row],
                             a    = ids[rank][2 * row + 1];
          values.resize(n_nodes());
          if (cell_slot.at(cell) != no_cell)
            std::copy_n(rows[rank].begin() + dim * row,
                        dim,
                        values[cell_nodes(cell)[a]].begin_raw());
        }
  }



  template <int dim>
  void
  GridSpace<dim>::write(Archive &archive) const
  {
    write_node_values(moves, "nodes/move", "length", archive);
  }



  template <int dim>
  void
  GridSpace<dim>::read(const Archive &archive)
  {
    read_node_values(archive, "nodes/move", moves);
  }



  template void
  BackgroundMesh<2>::write(Archive &) const;
  template void
  BackgroundMesh<3>::write(Archive &) const;
  template void
  BackgroundMesh<2>::read(const Archive &);
  template void
  BackgroundMesh<3>::read(const Archive &);
  template void
  GridSpace<2>::write(Archive &) const;
  template void
  GridSpace<3>::write(Archive &) const;
  template void
  GridSpace<2>::read(const Archive &);
  template void
  GridSpace<3>::read(const Archive &);
  template void
  GridSpace<2>::write_node_values(const std::vector<Tensor<1, 2>> &,
                                  const std::string &,
                                  const std::string &,
                                  Archive &) const;
  template void
  GridSpace<3>::write_node_values(const std::vector<Tensor<1, 3>> &,
                                  const std::string &,
                                  const std::string &,
                                  Archive &) const;
  template void
  GridSpace<2>::read_node_values(const Archive &,
                                 const std::string &,
                                 std::vector<Tensor<1, 2>> &) const;
  template void
  GridSpace<3>::read_node_values(const Archive &,
                                 const std::string &,
                                 std::vector<Tensor<1, 3>> &) const;
} // namespace moraine
