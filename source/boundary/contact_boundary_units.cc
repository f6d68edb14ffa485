// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// The units of a contact: places of a rim that share a gap and a status.

#include <moraine/boundary/contact_boundary.h>
#include <moraine/core/exceptions.h>
#include <moraine/geometry/placement.h>

#include <deal.II/base/mpi.h>

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
    /** Pieces whose normals differ by more than 45 degrees meet in a corner. */
    constexpr double cosine_of_one_unit = 0.7071;

    /** Of the size of a cell: a mean gap that a step may close though nothing
     * else holds the body. */
    constexpr double touches_soon = 0.1;

    /** Of the size of a cell: pieces that are this much further away than the
     * nearest one come to the surface with it: the whole side of a block. */
    constexpr double as_near = 1e-2;

    /** Of the size of a cell, that a unit has at least if it has neighbours. */
    constexpr double least_unit = 0.5;

    /** Of the size of a cell: the part of the gap of a closed unit that one
     * step closes, and the largest gap that is deferred. Closing all at once
     * would be a jump of force that no shorter step reduces. */
    constexpr double taken_out = 2e-3, most_kept = 0.1;
  } // namespace



  template <int dim>
  void
  ContactBoundary<dim>::keep_gaps()
  {
    for (ContactUnit<dim> &unit : all_units)
      {
        // An overlap at the start is a fit.
        if (began || unit.was_open ||
            unit.traction_at_start == Tensor<1, dim>())
          continue;
        const double kept =
          std::min(std::abs(unit.gap) - taken_out * unit.h, most_kept * unit.h);
        if (kept <= 0.)
          continue;
        unit.level -= std::copysign(kept, unit.gap);
        unit.gap -= std::copysign(kept, unit.gap);
      }
  }



  template <int dim>
  void
  ContactBoundary<dim>::find_units(const GridSpace<dim> &space)
  {
    gather_units(space);
    merge_small_units();
    set_means();
    const double h     = space.mesh().cell_size();
    double       least = touches_soon * h;
    for (const ContactUnit<dim> &unit : all_units)
      least = std::min(least, unit.gap);
    // At first corners of a body may touch alone, by the rounding of numbers.
    for (ContactUnit<dim> &unit : all_units)
      unit.touches_first = (began || least > 0) && unit.gap > 0 &&
                           least < touches_soon * h &&
                           unit.gap <= std::max(least, 0.) + as_near * h;
    keep_gaps();
  }



  template <int dim>
  std::vector<unsigned int>
  ContactBoundary<dim>::cells_of(const std::vector<unsigned int> &places,
                                 const GridSpace<dim>            &space) const
  {
    // The rank that has the functions of a place knows its cell.
    std::vector<unsigned int> cells;
    for (const unsigned int k : places)
      {
        const unsigned int cell = rim.places()[k].active_cell_index;
        cells.push_back(cell == GridSpace<dim>::no_cell ? 0 : cell + 1);
      }
    Utilities::MPI::max(cells, space.communicator(), cells);
    for (unsigned int i = 0; i < cells.size(); ++i)
      if (cells[i]-- == 0)
        {
          std::ostringstream message;
          message << "contact boundary '" << boundary_name << "': the place ("
                  << position(places[i])
                  << ") of a rim near it is no longer on any material, or "
                     "beyond the mesh";
          throw ComputationError(message.str());
        }
    return cells;
  }



  template <int dim>
  void
  ContactBoundary<dim>::gather_units(const GridSpace<dim> &space)
  {
    const double              h = space.mesh().cell_size();
    std::vector<unsigned int> near;
    std::vector<bool>         apart;
    on_surface.resize(carried.size());
    for (unsigned int k = 0; k < rim.places().size(); ++k)
      {
        const NearestPoint<dim> nearest = at_start.nearest(position(k));
        if (faces(k, nearest) && std::abs(nearest.level) <= reach)
          {
            near.push_back(k);
            on_surface[k] = nearest;
            apart.push_back(carried[k].status == 0 && nearest.level > 0);
          }
      }
    const std::vector<unsigned int> cells = cells_of(near, space);
    all_units.clear();
    std::vector<unsigned int> order(near.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(),
                     order.end(),
                     [&](const auto a, const auto b) {
                       return cells[a] < cells[b];
                     });
    unsigned int first = 0;
    for (const unsigned int i : order)
      {
        if (first == all_units.size() || all_units[first].cell != cells[i])
          first = all_units.size();
        auto unit = std::find_if(
          all_units.begin() + first, all_units.end(), [&](const auto &of) {
            return of.apart == apart[i] &&
                   of.normal * on_surface[near[i]].normal > cosine_of_one_unit;
          });
        if (unit == all_units.end())
          {
            all_units.emplace_back();
            unit         = all_units.end() - 1;
            unit->cell   = cells[i];
            unit->h      = h;
            unit->normal = on_surface[near[i]].normal;
            unit->apart  = apart[i];
          }
        unit->places.push_back(near[i]);
      }
    set_means();
  }



  template <int dim>
  void
  ContactBoundary<dim>::set_means()
  {
    for (ContactUnit<dim> &unit : all_units)
      {
        std::sort(unit.places.begin(), unit.places.end());
        unit.area = unit.gap = 0;
        unit.x               = Point<dim>();
        unit.normal = unit.traction_at_start = unit.excess = Tensor<1, dim>();
        double open                                        = 0;
        for (const unsigned int k : unit.places)
          unit.area += rim.places()[k].weight;
        for (const unsigned int k : unit.places)
          {
            const double share = rim.places()[k].weight / unit.area;
            unit.x += share * Tensor<1, dim>(position(k));
            unit.gap += share * on_surface[k].level;
            unit.normal += share * on_surface[k].normal;
            open += carried[k].status == 0 ? share : 0.;
          }
        unit.normal /= unit.normal.norm();
        for (const unsigned int k : unit.places)
          {
            const double share   = rim.places()[k].weight / unit.area;
            const auto   in_unit = [&](const Tensor<1, dim> &traction) {
              return share *
                     turned<dim>(traction, on_surface[k].normal, unit.normal);
            };
            unit.traction_at_start += in_unit(carried[k].traction);
            unit.excess += in_unit(carried[k].excess);
          }
        unit.level      = unit.gap - at_start.level(unit.x);
        unit.was_open   = open > 0.5;
        unit.multiplier = unit.traction_at_start;
      }
  }



  template <int dim>
  void
  ContactBoundary<dim>::merge_small_units()
  {
    const auto is_small = [](const auto &unit) {
      return unit.area < least_unit * std::pow(unit.h, dim - 1);
    };
    std::vector<unsigned int> into(all_units.size());
    for (unsigned int u = 0; u < all_units.size(); ++u)
      {
        into[u] = u;
        if (!is_small(all_units[u]))
          continue;
        double nearest   = std::numeric_limits<double>::max();
        bool   same_kind = false;
        for (unsigned int v = 0; v < all_units.size(); ++v)
          {
            const double distance = all_units[u].x.distance(all_units[v].x);
            const bool   same     = all_units[u].apart == all_units[v].apart;
            if (u == v || distance >= 1.5 * all_units[u].h ||
                all_units[u].normal * all_units[v].normal <=
                  cosine_of_one_unit ||
                (is_small(all_units[v]) && v > u) ||
                (all_units[u].apart && !same))
              continue;
            if (same > same_kind || (same == same_kind && distance < nearest))
              {
                nearest   = distance;
                same_kind = same;
                into[u]   = v;
              }
          }
      }
    // A small one joins a large one, or a small one before it.
    for (unsigned int u = 0; u < all_units.size(); ++u)
      {
        unsigned int root = u;
        while (into[root] != root)
          root = into[root];
        if (root != u)
          {
            auto &places = all_units[u].places;
            all_units[root].places.insert(all_units[root].places.end(),
                                          places.begin(),
                                          places.end());
            places.clear();
          }
      }
    all_units.erase(std::remove_if(all_units.begin(),
                                   all_units.end(),
                                   [](const auto &unit) {
                                     return unit.places.empty();
                                   }),
                    all_units.end());
  }



#define INSTANTIATE(dim) \
  template void ContactBoundary<dim>::find_units(const GridSpace<dim> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
