// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/boundary/contact_boundary.h>

#include <moraine/core/archive_components.h>
#include <moraine/core/exceptions.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** Places further from the surface than this many cells are no part of a
     * unit: a step does not bring them to it. */
    constexpr double reach_of_contact = 1.;

    /** Of the angle between the rim and the surface: at the corner of a body
     * the side that faces away is not in contact. */
    constexpr double cosine_of_contact = 0.5;

    /** Pieces whose normals differ by more than 45 degrees meet in a corner. */
    constexpr double cosine_of_one_unit = 0.7071;

    /** Of the size of a cell: a mean gap that a step may close though nothing
     * else holds the body. */
    constexpr double touches_soon = 0.1;

    /** Of the size of a cell: pieces that are this much further away than the
     * nearest one come to the surface with it: the whole side of a block. */
    constexpr double as_near = 1e-2;

    /** Of the size of a cell: a gap at the start that is none. */
    constexpr double touching = 1e-6;

    /** Of the size of a cell: a place uses the cell this far inside the body.
     * Without it, places on faces of cells change cells by round-off. */
    constexpr double inside = 1e-5;

    /** Of the size of a cell, that a unit has at least if it has neighbours. */
    constexpr double least_unit = 0.5;

    /** Of the size of a cell: longer places of a rim that stretches are halved,
     * where they move through the mesh. */
    constexpr double longest_place = 0.25;

    /** Of the size of a cell: the part of the gap of a closed unit that one
     * step closes, and the largest gap that is deferred. Closing all at once
     * would be a jump of force that no shorter step reduces. */
    constexpr double taken_out = 2e-3, most_kept = 0.1;
  } // namespace



  template <int dim>
  ContactBoundary<dim>::ContactBoundary(const std::string         &name,
                                        const SurfacePointer<dim> &surface,
                                        const RigidMotion<dim>    &motion,
                                        const Finder              &find_places,
                                        const ContactLaw          &law,
                                        const Enforcement         &enforcement)
    : boundary_name(name)
    , at_start(surface)
    , at_end(surface)
    , motion(motion)
    , find_places(find_places)
    , contact_law(law)
    , how(enforcement)
  {}



  template <int dim>
  void
  ContactBoundary<dim>::find_cells(const GridSpace<dim>    &space,
                                   const double             search_tolerance,
                                   const double             t,
                                   const bool               acts,
                                   const bool               turns,
                                   const std::vector<bool> &present)
  {
    const double h = space.mesh().cell_size();
    reach          = reach_of_contact * h;
    at_start.see_over(h);
    at_end.see_over(h);
    at_start.set_pose(motion.pose(t));
    at_end.set_pose(motion.pose(t));
    has_rim.resize(present.size(), false);
    std::vector<unsigned int> gone;
    for (unsigned int k = 0; k < carried.size(); ++k)
      if (!present[carried[k].body])
        gone.push_back(k);
    rim.remove(gone);
    for (auto k = gone.rbegin(); k != gone.rend(); ++k)
      carried.erase(carried.begin() + *k);
    halve_long_places(h);
    rim.find_cells(space, search_tolerance, inside * h);
    const unsigned int n_before = carried.size();
    for (unsigned int b = 0; b < present.size(); ++b)
      if (present[b] && !has_rim[b])
        add_rim(space, search_tolerance, turns, b);
    has_rim = present;
    for (unsigned int k = acted ? n_before : 0; acts && k < carried.size(); ++k)
      {
        const auto distance = distance_at_start(k);
        carried[k].status   = distance && *distance <= touching * h ? 1 : 0;
      }
    began    = acts && !acted;
    acts_now = acts;
    all_units.clear();
  }



  template <int dim>
  void
  ContactBoundary<dim>::add_rim(const GridSpace<dim> &space,
                                const double          search_tolerance,
                                const bool            turns,
                                const unsigned int    body)
  {
    const double       h = space.mesh().cell_size();
    CarriedPlaces<dim> of_body(find_places(space.mesh(), body));
    of_body.remove(of_body.find_cells(space, search_tolerance, inside * h));
    of_body.catch_up(space, turns);
    rim.add(of_body);
    ContactPlace<dim> at_first;
    at_first.body = body;
    carried.resize(rim.places().size(), at_first);
  }



  template <int dim>
  void
  ContactBoundary<dim>::halve_long_places(const double h)
  {
    if constexpr (dim == 2)
      for (unsigned int k = 0; k < carried.size(); ++k)
        {
          const Place &place = rim.places()[k];
          if (place.weight > longest_place * h && place.in_mesh == place.x)
            {
              rim.halve(k);
              carried.insert(carried.begin() + k, carried[k]);
            }
        }
    else
      (void)h;
  }



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
        if (nearest.in_extent && std::abs(nearest.level) <= reach &&
            nearest.normal * rim.places()[k].normal > cosine_of_contact)
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



  template <int dim>
  void
  ContactBoundary<dim>::set_target(const double t_end, const bool anew)
  {
    at_end.set_pose(motion.pose(t_end));
    if (anew)
      for (ContactUnit<dim> &unit : all_units)
        unit.multiplier = unit.traction_at_start;
  }



  template <int dim>
  ContactGap<dim>
  ContactBoundary<dim>::gap(const ContactUnit<dim> &unit,
                            const Tensor<1, dim>   &du) const
  {
    const NearestPoint<dim> nearest = at_end.nearest(unit.x + du);
    ContactGap<dim>         state;
    state.gap    = nearest.level + unit.level;
    state.normal = nearest.normal;
    state.of_surface =
      at_end.pose().map(at_start.pose().inverse(unit.x)) - unit.x;
    state.slip = du - state.of_surface;
    state.slip -= (state.slip * state.normal) * state.normal;
    return state;
  }



  template <int dim>
  std::optional<double>
  ContactBoundary<dim>::distance_at_start(const unsigned int k) const
  {
    const NearestPoint<dim> nearest = at_start.nearest(position(k));
    if (!nearest.in_extent ||
        nearest.normal * rim.places()[k].normal <= cosine_of_contact)
      return {};
    return nearest.level;
  }



  template <int dim>
  double
  ContactBoundary<dim>::depth(const unsigned int    k,
                              const Tensor<1, dim> &du) const
  {
    const NearestPoint<dim> nearest = at_end.nearest(position(k) + du);
    if (!nearest.in_extent || nearest.level >= 0 ||
        nearest.normal * rim.places()[k].normal <= cosine_of_contact)
      return 0.;
    // What began far behind the surface is on the other side of a wall.
    const std::optional<double> before = distance_at_start(k);
    return before.value_or(nearest.level) < -reach ? 0. : -nearest.level;
  }



  template <int dim>
  void
  ContactBoundary<dim>::set_fluxes(const std::vector<Tensor<1, dim>> &fluxes)
  {
    AssertDimension(fluxes.size(), all_units.size());
    for (unsigned int u = 0; u < all_units.size(); ++u)
      {
        ContactUnit<dim> &unit = all_units[u];
        unit.excess -= (unit.excess * unit.normal) * unit.normal;
        unit.traction_at_start = unit.multiplier = fluxes[u] + unit.excess;
      }
  }



  template <int dim>
  void
  ContactBoundary<dim>::set_multipliers(
    const std::vector<Tensor<1, dim>> &multipliers)
  {
    AssertDimension(multipliers.size(), all_units.size());
    for (unsigned int u = 0; u < all_units.size(); ++u)
      all_units[u].multiplier = multipliers[u];
  }



  template <int dim>
  void
  ContactBoundary<dim>::prepare(
    const std::vector<OfUnit>                                 &of_units,
    const std::vector<typename CarriedPlaces<dim>::Increment> &moves,
    const bool                                                 moves_places,
    const bool                                                 through_mesh,
    const bool                                                 turns)
  {
    AssertDimension(of_units.size(), all_units.size());
    prepared = carried;
    // Away from the surface a place carries no traction.
    for (ContactPlace<dim> &place : prepared)
      {
        place.traction = place.excess = Tensor<1, dim>();
        place.status                  = 0;
      }
    for (unsigned int u = 0; u < all_units.size(); ++u)
      {
        const ContactUnit<dim> &unit = all_units[u];
        Tensor<1, dim>          du;
        for (const unsigned int k : unit.places)
          du += rim.places()[k].weight / unit.area * moves[k].u;
        const Tensor<1, dim> normal = at_end.normal(unit.x + du);
        for (const unsigned int k : unit.places)
          {
            const Tensor<1, dim> here = at_end.normal(position(k) + moves[k].u);
            prepared[k].traction =
              turned<dim>(of_units[u].traction, normal, here);
            prepared[k].excess = turned<dim>(of_units[u].excess, normal, here);
            prepared[k].status = unsigned(of_units[u].status);
            prepared[k].slip += of_units[u].slip;
            prepared[k].work += of_units[u].work;
          }
      }
    if (moves_places)
      rim.prepare_move(moves, through_mesh, turns);
    else
      for (unsigned int k = 0; k < moves.size(); ++k)
        prepared[k].displacement += moves[k].u;
  }



  template <int dim>
  double
  ContactBoundary<dim>::largest_slip() const
  {
    double largest = 0;
    for (const ContactPlace<dim> &place : prepared)
      largest = std::max(largest, place.slip);
    return largest;
  }



  template <int dim>
  double
  ContactBoundary<dim>::work_of_friction() const
  {
    double work = 0;
    for (unsigned int k = 0; k < prepared.size(); ++k)
      work += rim.places()[k].weight * prepared[k].work;
    return work;
  }



  template <int dim>
  void
  ContactBoundary<dim>::write(Archive &archive) const
  {
    using Of = ContactPlace<dim>;
    rim.write(archive, group());
    archive.write(group() + "/traction",
                  components_of(carried, &Of::traction),
                  dim,
                  "stress");
    archive.write(group() + "/excess",
                  components_of(carried, &Of::excess),
                  dim,
                  "stress");
    archive.write(group() + "/displacement",
                  components_of(carried, &Of::displacement),
                  dim,
                  "length");
    archive.write(group() + "/slip",
                  components_of(carried, &Of::slip),
                  1,
                  "length");
    archive.write(group() + "/work",
                  components_of(carried, &Of::work),
                  1,
                  "stress length");
    archive.write(group() + "/status", components_of(carried, &Of::status));
    archive.write(group() + "/body", components_of(carried, &Of::body));
    archive.write(group() + "/has_rim",
                  std::vector<unsigned int>(has_rim.begin(), has_rim.end()));
    archive.write(group() + "/acted", acted ? 1u : 0u);
  }



  template <int dim>
  void
  ContactBoundary<dim>::read(const Archive &archive)
  {
    using Of = ContactPlace<dim>;
    rim.read(archive, group());
    const auto &rims = archive.integers(group() + "/has_rim", 1);
    has_rim.assign(rims.begin(), rims.end());
    acted = archive.integer(group() + "/acted") != 0;
    carried.resize(rim.places().size());
    const auto read = [&](const std::string &name,
                          const auto         member,
                          const unsigned int n_components) {
      set_components(archive.numbers(group() + "/" + name, n_components),
                     carried,
                     member);
    };
    read("traction", &Of::traction, dim);
    read("excess", &Of::excess, dim);
    read("displacement", &Of::displacement, dim);
    read("slip", &Of::slip, 1);
    read("work", &Of::work, 1);
    read("status", &Of::status, 1);
    read("body", &Of::body, 1);
    undo();
  }



  template class ContactBoundary<2>;
  template class ContactBoundary<3>;
} // namespace moraine
