// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// The part of PointSet that writes points to archives and reads them.

#include <moraine/points/point_set.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <numeric>
#include <tuple>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** Data sets of points that are no fields. */
    const std::string group     = "points";
    const std::string position  = group + "/position";
    const std::string reference = group + "/reference_position";
    const std::string cell      = group + "/cell";
    /** Of the point in the memory of its rank: sums go in this order. */
    const std::string order = group + "/order";
    /** How many points each rank returned to the mesh. */
    const std::string returned = "points_returned";
    /** See PointSet::forgotten_displacement(). */
    const std::string forgotten_set = "points_forgotten_displacement";
    /** Whether bodies have come or gone. */
    const std::string changed = "bodies/have_changed";

    /** Points on their way to another rank. */
    struct Rows
    {
      std::vector<unsigned int> ids;
      std::vector<unsigned int> orders;
      std::vector<unsigned int> cells;
      std::vector<double>       values;

      template <class Serializer>
      void
      serialize(Serializer &serializer, const unsigned int)
      {
        serializer &ids &orders &cells &values;
      }
    };
  } // namespace



  template <int dim>
  void
  PointSet<dim>::write(Archive &archive) const
  {
    const unsigned int        n = n_local();
    std::vector<unsigned int> ids(n), cells(n);
    std::vector<double>       places(n * dim), reference_places(n * dim);
    for (const CellPoints &in_cell : cell_points)
      for (unsigned int p = in_cell.first; p < in_cell.last; ++p)
        {
          ids[p]   = id(p);
          cells[p] = in_cell.cell->active_cell_index();
          std::copy_n(position(p).begin_raw(), dim, &places[p * dim]);
          std::copy_n(reference_position(p).begin_raw(),
                      dim,
                      &reference_places[p * dim]);
        }
    std::vector<std::vector<double>> columns;
    for (const auto &field : layout.fields())
      columns.emplace_back(n * field.n_components);
    for (unsigned int p = 0; p < n; ++p)
      {
        const double *value = values(p);
        for (unsigned int f = 0; f < columns.size(); ++f)
          {
            const unsigned int m = layout.fields()[f].n_components;
            std::copy_n(value, m, columns[f].begin() + p * m);
            value += m;
          }
      }

    archive.write(forgotten_set, forgotten, "length");
    archive.distribute(group, std::move(ids));
    std::vector<unsigned int> orders(n);
    std::iota(orders.begin(), orders.end(), 0u);
    archive.write(order, std::move(orders));
    archive.write(moraine::cell, std::move(cells));
    archive.write(moraine::position, std::move(places), dim, "length");
    archive.write(reference, std::move(reference_places), dim);
    for (unsigned int f = 0; f < columns.size(); ++f)
      archive.write(group + "/" + layout.fields()[f].name,
                    std::move(columns[f]),
                    layout.fields()[f].n_components,
                    layout.fields()[f].unit);
    archive.distribute(returned,
                       {Utilities::MPI::this_mpi_process(
                         background.triangulation().get_communicator())});
    archive.write(returned + "/count",
                  std::vector<unsigned int>{returned_points});
    archive.write(changed, was_exchanged ? 1u : 0u);
  }



  template <int dim>
  void
  PointSet<dim>::read(const Archive &archive)
  {
    forgotten                    = archive.number(forgotten_set);
    const auto &tria             = background.triangulation();
    const auto &ids              = archive.integers(group + "/id");
    const auto &orders           = archive.integers(order);
    const auto &cells            = archive.integers(moraine::cell);
    const auto &places           = archive.numbers(moraine::position, dim);
    const auto &reference_places = archive.numbers(reference, dim);
    const auto  n_values         = layout.n_values();
    std::vector<const std::vector<double> *> columns;
    for (const auto &field : layout.fields())
      columns.push_back(
        &archive.numbers(group + "/" + field.name, field.n_components));

    // Every rank knows every cell, and so whose a point is.
    std::vector<CellIterator> cell_of_index(tria.n_active_cells());
    for (const auto &active : tria.active_cell_iterators())
      cell_of_index[active->active_cell_index()] = active;
    std::map<unsigned int, Rows> to_ranks;
    for (unsigned int p = 0; p < ids.size(); ++p)
      {
        Rows &rows = to_ranks[cell_of_index.at(cells[p])->subdomain_id()];
        rows.ids.push_back(ids[p]);
        rows.orders.push_back(orders[p]);
        rows.cells.push_back(cells[p]);
        const auto add = [&](const std::vector<double> &from,
                             const unsigned int         n) {
          rows.values.insert(rows.values.end(),
                             from.begin() + p * n,
                             from.begin() + (p + 1) * n);
        };
        add(places, dim);
        add(reference_places, dim);
        for (unsigned int f = 0; f < columns.size(); ++f)
          add(*columns[f], layout.fields()[f].n_components);
      }

    // A file has them in the order of ids.
    struct Place
    {
      unsigned int order, id;
      const Rows  *rows;
      unsigned int row;
    };
    const auto of_ranks =
      Utilities::MPI::some_to_some(tria.get_communicator(), to_ranks);
    std::vector<Place> in_order;
    for (const auto &[rank, rows] : of_ranks)
      for (unsigned int p = 0; p < rows.ids.size(); ++p)
        in_order.push_back({rows.orders[p], rows.ids[p], &rows, p});
    std::sort(in_order.begin(),
              in_order.end(),
              [](const auto &a, const auto &b) {
                return std::tie(a.order, a.id) < std::tie(b.order, b.id);
              });

    handler.clear_particles();
    for (const Place &place : in_order)
      {
        const Rows   &rows = *place.rows;
        const double *row  = &rows.values[place.row * (2 * dim + n_values)];
        Point<dim>    x, x_reference;
        std::copy_n(row, dim, x.begin_raw());
        std::copy_n(row + dim, dim, x_reference.begin_raw());
        handler.insert_particle(x,
                                x_reference,
                                place.id,
                                cell_of_index[rows.cells[place.row]],
                                ArrayView<const double>(row + 2 * dim,
                                                        n_values));
      }
    handler.update_cached_numbers();
    lost_points.clear();
    const auto &counts = archive.integers(returned + "/count");
    returned_points    = std::accumulate(counts.begin(), counts.end(), 0u);
    was_exchanged      = archive.integer(changed) != 0;
    number_points();
  }



  template void
  PointSet<2>::write(Archive &) const;
  template void
  PointSet<3>::write(Archive &) const;
  template void
  PointSet<2>::read(const Archive &);
  template void
  PointSet<3>::read(const Archive &);
} // namespace moraine
