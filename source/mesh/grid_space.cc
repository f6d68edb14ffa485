// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/mesh/grid_space.h>

#include <deal.II/base/mpi.h>

#include <deal.II/fe/fe_nothing.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>

#include <algorithm>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  GridSpace<dim>::GridSpace(const BackgroundMesh<dim> &mesh,
                            const unsigned int         degree)
    : background(mesh)
    , fe_degree(degree)
    , n_nodes_per_cell(Utilities::pow(degree + 1, dim))
    , dofs(mesh.triangulation())
    , active_cells(mesh.triangulation().n_active_cells(), 0)
    , cell_slot(mesh.triangulation().n_active_cells(), no_cell)
  {
    const FE_Q<dim>     scalar(degree);
    const FESystem<dim> vector(scalar, dim);
    fe_collection.push_back(vector);
    fe_collection.push_back(FESystem<dim>(FE_Nothing<dim>(), dim));

    const auto lexicographic = scalar.get_poly_space_numbering_inverse();
    fe_index_of_node.resize(n_nodes_per_cell);
    for (unsigned int a = 0; a < n_nodes_per_cell; ++a)
      {
        fe_index_of_node[a] =
          vector.component_to_system_index(0, lexicographic[a]);
        // In the middle of its corners: no other is nearer than 1.
        const Point<dim> xi      = scalar.unit_support_point(lexicographic[a]);
        auto            &corners = corners_around.emplace_back();
        for (const unsigned int v : GeometryInfo<dim>::vertex_indices())
          if (GeometryInfo<dim>::unit_cell_vertex(v).distance_square(xi) < 0.9)
            corners.push_back(v);
      }
  }



  template <int dim>
  bool
  GridSpace<dim>::set_active_cells(std::vector<unsigned char> active)
  {
    AssertDimension(active.size(), active_cells.size());
    wanted_cells = active;
    MPI_Allreduce(MPI_IN_PLACE,
                  active.data(),
                  active.size(),
                  MPI_UNSIGNED_CHAR,
                  MPI_MAX,
                  communicator());
    if (active == active_cells && n_active > 0)
      {
        bool missing = false;
        for (unsigned int cell = 0; cell < wanted_cells.size(); ++cell)
          missing =
            missing || (wanted_cells[cell] && cell_slot[cell] == no_cell);
        if (!Utilities::MPI::logical_or(missing, communicator()))
          return false;
        number_nodes();
        return true;
      }

    active_cells = std::move(active);
    for (const auto &cell : dofs.active_cell_iterators())
      if (cell->is_locally_owned())
        cell->set_active_fe_index(is_active(cell) ? 0 : 1);
    dofs.distribute_dofs(fe_collection);
    owned = dofs.locally_owned_dofs();
    number_nodes();
    return true;
  }



  template <int dim>
  void
  GridSpace<dim>::number_nodes()
  {
    const auto &tria = background.triangulation();

    std::vector<bool> vertex_of_own_cell(tria.n_vertices(), false);
    n_active = 0;
    for (const auto &cell : tria.active_cell_iterators())
      if (is_active(cell))
        {
          ++n_active;
          if (cell->is_locally_owned())
            for (const unsigned int v : cell->vertex_indices())
              vertex_of_own_cell[cell->vertex_index(v)] = true;
        }

    constexpr unsigned int    no_node = numbers::invalid_unsigned_int;
    std::vector<unsigned int> node_of_dof(dofs.n_dofs(), no_node);
    std::vector<types::global_dof_index> cell_dofs(
      fe_collection[0].n_dofs_per_cell());
    std::vector<types::global_dof_index> relevant_dofs;
    first_dof.clear();
    first_vertex.assign(1, 0);
    vertices_of_nodes.clear();
    moves.clear();
    nodes_of_cells.clear();
    std::fill(cell_slot.begin(), cell_slot.end(), no_cell);
    for (const auto &cell : dofs.active_cell_iterators())
      if (is_active(cell))
        {
          bool near = wanted_cells[cell->active_cell_index()] != 0;
          for (const unsigned int v : cell->vertex_indices())
            near = near || vertex_of_own_cell[cell->vertex_index(v)];
          if (!near)
            continue;
          cell_slot[cell->active_cell_index()] =
            nodes_of_cells.size() / n_nodes_per_cell;
          cell->get_dof_indices(cell_dofs);
          for (unsigned int a = 0; a < n_nodes_per_cell; ++a)
            {
              const auto dof = cell_dofs[fe_index_of_node[a]];
              if (node_of_dof[dof] == no_node)
                {
                  node_of_dof[dof] = first_dof.size();
                  first_dof.push_back(dof);
                  for (const unsigned int v : corners_around[a])
                    vertices_of_nodes.push_back(cell->vertex_index(v));
                  first_vertex.push_back(vertices_of_nodes.size());
                  for (unsigned int c = 0; c < dim; ++c)
                    relevant_dofs.push_back(dof + c);
                }
              nodes_of_cells.push_back(node_of_dof[dof]);
            }
        }
    std::sort(relevant_dofs.begin(), relevant_dofs.end());
    relevant = IndexSet(dofs.n_dofs());
    relevant.add_indices(relevant_dofs.begin(), relevant_dofs.end());
    relevant.add_indices(owned);
    relevant.compress();

    unknowns.reinit(owned, relevant, communicator());
    unknown_of_node.resize(first_dof.size());
    for (unsigned int node = 0; node < first_dof.size(); ++node)
      unknown_of_node[node] = unknowns.index(first_dof[node]);
  }



  template <int dim>
  void
  GridSpace<dim>::node_values(const LA::Vector            &vector,
                              std::vector<Tensor<1, dim>> &values) const
  {
    const std::vector<double> &all = unknowns.array_of(vector);
    values.resize(first_dof.size());
    for (unsigned int node = 0; node < first_dof.size(); ++node)
      for (unsigned int c = 0; c < dim; ++c)
        values[node][c] = all[unknown_of_node[node] + c];
  }



  template <int dim>
  void
  GridSpace<dim>::sum_node_values(const std::vector<Tensor<1, dim>> &values,
                                  LA::Vector &vector) const
  {
    AssertDimension(values.size(), first_dof.size());
    std::vector<double> &all = unknowns.zero_array();
    for (unsigned int node = 0; node < first_dof.size(); ++node)
      for (unsigned int c = 0; c < dim; ++c)
        all[unknown_of_node[node] + c] = values[node][c];
    unknowns.add_to_owners(vector);
  }



  template <int dim>
  void
  GridSpace<dim>::sum_over_ranks(std::vector<Tensor<1, dim>> &values) const
  {
    if (Utilities::MPI::n_mpi_processes(communicator()) == 1)
      return;
    LA::Vector sums = vector();
    sum_node_values(values, sums);
    node_values(sums, values);
  }



  template <int dim>
  LA::Vector
  GridSpace<dim>::vector_of(const std::vector<Tensor<1, dim>> &values) const
  {
    LA::Vector result = vector();
    if (owned.n_elements() == 0)
      return result;
    AssertThrow(owned.is_contiguous(), ExcInternalError());
    double                       *entries = result.begin();
    const types::global_dof_index first   = owned.nth_index_in_set(0);
    for (unsigned int node = 0; node < first_dof.size(); ++node)
      if (owned.is_element(first_dof[node]))
        std::copy_n(values[node].begin_raw(),
                    dim,
                    entries + (first_dof[node] - first));
    return result;
  }



  template <int dim>
  void
  GridSpace<dim>::move_nodes(const std::vector<Tensor<1, dim>> &displacement)
  {
    AssertDimension(displacement.size(), n_nodes());
    moves.resize(n_nodes());
    for (unsigned int node = 0; node < n_nodes(); ++node)
      moves[node] += displacement[node];
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



  template class GridSpace<2>;
  template class GridSpace<3>;
} // namespace moraine
