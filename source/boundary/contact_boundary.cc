// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/boundary/contact_boundary.h>

#include <moraine/core/archive_components.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

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

    /** Of the size of a cell: a gap at the start that is none. */
    constexpr double touching = 1e-6;

    /** Of the size of a cell: a place uses the cell this far inside the body.
     * Without it, places on faces of cells change cells by round-off. */
    constexpr double inside = 1e-5;

    /** Of the size of a cell: longer places of a rim that stretches are halved,
     * where they move through the mesh. */
    constexpr double longest_place = 0.25;
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
  bool
  ContactBoundary<dim>::faces(const unsigned int       k,
                              const NearestPoint<dim> &nearest) const
  {
    return nearest.in_extent &&
           nearest.normal * rim.places()[k].normal > cosine_of_contact;
  }



  template <int dim>
  std::optional<double>
  ContactBoundary<dim>::distance_at_start(const unsigned int k) const
  {
    const NearestPoint<dim> nearest = at_start.nearest(position(k));
    if (!faces(k, nearest))
      return {};
    return nearest.level;
  }



  template <int dim>
  double
  ContactBoundary<dim>::depth(const unsigned int    k,
                              const Tensor<1, dim> &du) const
  {
    const NearestPoint<dim> nearest = at_end.nearest(position(k) + du);
    if (!faces(k, nearest) || nearest.level >= 0)
      return 0.;
    // A place that starts more than a cell behind the surface belongs to the
    // ground on the other side of the wall.
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
