// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// What a surface carries from step to step, and through archives.

#include <moraine/boundary/implicit_boundary.h>

#include <moraine/core/archive_components.h>

#include <deal.II/base/mpi.h>

#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  void
  ImplicitBoundary<dim>::take_over(const std::vector<CarriedPlace<dim>> &from)
  {
    const Tensor<2, dim> R = at_start.pose().rotation();
    const Tensor<2, dim> from_frame =
      constraint.kind == Constraint<dim>::roller ?
        R :
        Tensor<2, dim>(unit_symmetric_tensor<dim>());
    const bool is_straight_roller =
      constraint.kind == Constraint<dim>::roller && !kind.projects;
    for (unsigned int q = 0; q < boundary_points.size(); ++q)
      {
        BoundaryPoint<dim> &point   = boundary_points[q];
        point.multiplier_at_start   = from_frame * from[q].multiplier;
        point.accumulated_violation = from_frame * from[q].violation;
        // It may come from a segment with another normal, and nothing but the
        // normal component is ever corrected.
        if (is_straight_roller)
          point.multiplier_at_start =
            constraint.projection(point.normal) * point.multiplier_at_start;
      }
    for (BoundarySlope<dim> &slope : held_slopes.all)
      slope.traction_at_start =
        from_frame * from[slope.point].slope * (transpose(R) * slope.offset);
  }



  template <int dim>
  std::vector<CarriedPlace<dim>>
  ImplicitBoundary<dim>::places_of_points() const
  {
    const Placement<dim>          &pose       = at_start.pose();
    const Tensor<2, dim>           into_frame = transpose(pose.rotation());
    std::vector<CarriedPlace<dim>> places;
    for (const auto &point : boundary_points)
      places.push_back({Tensor<1, dim>(pose.inverse(point.x)),
                        {},
                        {},
                        {},
                        point.JxW,
                        into_frame * point.normal,
                        point.h,
                        {{point.cell, point.number}}});
    return places;
  }



  namespace
  {
    /** What all ranks have, in the same order on any number of them. */
    template <int dim>
    std::vector<CarriedPlace<dim>>
    gather(const std::vector<CarriedPlace<dim>> &of_this_rank,
           const MPI_Comm                       &communicator)
    {
      std::vector<CarriedPlace<dim>> all;
      for (const auto &of_one_rank :
           Utilities::MPI::all_gather(communicator, of_this_rank))
        all.insert(all.end(), of_one_rank.begin(), of_one_rank.end());
      std::sort(all.begin(), all.end(), [](const auto &a, const auto &b) {
        return a.id < b.id;
      });
      return all;
    }



    /** For each of @p places the nearest of @p among that faces the same way
     * but for 30 degrees, no further than a cell; or an invalid number. */
    template <int dim>
    std::vector<unsigned int>
    nearest_of(const std::vector<CarriedPlace<dim>> &places,
               const std::vector<CarriedPlace<dim>> &among)
    {
      namespace bgi                = boost::geometry::index;
      constexpr double        same = 0.866;
      std::vector<Point<dim>> points;
      double                  largest_h = 0;
      for (const auto &entry : among)
        {
          points.emplace_back(entry.place);
          largest_h = std::max(largest_h, entry.h);
        }
      const auto                tree = pack_rtree_of_indices(points);
      std::vector<unsigned int> nearest(places.size(),
                                        numbers::invalid_unsigned_int);
      for (unsigned int k = 0; k < places.size(); ++k)
        {
          const CarriedPlace<dim> &entry = places[k];
          Tensor<1, dim>           reach;
          for (unsigned int d = 0; d < dim; ++d)
            reach[d] = std::max(entry.h, largest_h);
          const Point<dim> x(entry.place);
          const auto       is_of_it = [&](const unsigned int other) {
            return entry.normal * among[other].normal > same &&
                   (entry.place - among[other].place).norm() <=
                     std::max(entry.h, among[other].h);
          };
          const auto found = tree.qbegin(
            bgi::intersects(BoundingBox<dim>({x - reach, x + reach})) &&
            bgi::satisfies(is_of_it) && bgi::nearest(x, 1));
          if (found != tree.qend())
            nearest[k] = *found;
        }
      return nearest;
    }



    /** Of the @p places with these numbers, by area. */
    template <int dim>
    CarriedPlace<dim>
    mean_of(const std::vector<unsigned int>      &numbers,
            const std::vector<CarriedPlace<dim>> &places)
    {
      CarriedPlace<dim> mean = places[numbers[0]];
      for (unsigned int k = 1; k < numbers.size(); ++k)
        {
          const CarriedPlace<dim> &place = places[numbers[k]];
          mean.area += place.area;
          const double share = place.area / mean.area;
          mean.multiplier += share * (place.multiplier - mean.multiplier);
          mean.violation += share * (place.violation - mean.violation);
        }
      return mean;
    }
  } // namespace



  template <int dim>
  void
  ImplicitBoundary<dim>::take_over_nearest(const MPI_Comm &communicator)
  {
    // Of all ranks, because a moving surface takes its points from rank to
    // rank.
    const auto old_places = gather(carried, communicator);
    if (old_places.empty() || n_points(communicator) == 0)
      return;
    const auto of_this_rank = places_of_points();
    const auto nearest_old  = nearest_of(of_this_rank, old_places);
    std::map<std::array<unsigned int, 2>, std::vector<unsigned int>> nearest_to;
    if (kind.holds_means)
      {
        const auto new_places  = gather(of_this_rank, communicator);
        const auto nearest_new = nearest_of(old_places, new_places);
        for (unsigned int k = 0; k < old_places.size(); ++k)
          if (nearest_new[k] != numbers::invalid_unsigned_int)
            nearest_to[new_places[nearest_new[k]].id].push_back(k);
      }
    std::vector<CarriedPlace<dim>> of_points;
    for (unsigned int q = 0; q < boundary_points.size(); ++q)
      {
        const auto found = nearest_to.find(of_this_rank[q].id);
        const bool is_new_place =
          nearest_old[q] == numbers::invalid_unsigned_int;
        const CarriedPlace<dim> &nearest =
          is_new_place ? of_this_rank[q] : old_places[nearest_old[q]];
        of_points.push_back(found == nearest_to.end() ?
                              nearest :
                              mean_of(found->second, old_places));
        of_points.back().slope = nearest.slope;
      }
    take_over(of_points);
  }



  template <int dim>
  void
  ImplicitBoundary<dim>::prepare(const std::vector<Tensor<1, dim>> &tractions,
                                 const std::vector<Tensor<1, dim>> &violations,
                                 const std::vector<Tensor<1, dim>> &of_slopes)
  {
    const Placement<dim> &pose = at_start.pose();
    const Tensor<2, dim>  into_frame =
      constraint.kind == Constraint<dim>::roller ?
         transpose(pose.rotation()) :
         Tensor<2, dim>(unit_symmetric_tensor<dim>());
    prepared = places_of_points();
    for (unsigned int q = 0; q < boundary_points.size(); ++q)
      {
        const auto    &point      = boundary_points[q];
        Tensor<1, dim> multiplier = tractions[q];
        // In the next step a roller pushes other material at the same place.
        if (kind.projects)
          multiplier =
            std::copysign(multiplier.norm(), multiplier * point.normal) *
            point.normal;
        prepared[q].multiplier = into_frame * multiplier;
        if (how.carries_multiplier)
          prepared[q].violation =
            into_frame * (point.accumulated_violation + violations[q]);
      }
    for (unsigned int k = 0; k < of_slopes.size(); ++k)
      {
        const BoundarySlope<dim> &slope = held_slopes.all[k];
        prepared[slope.point].slope +=
          outer_product(into_frame * of_slopes[k],
                        transpose(pose.rotation()) * slope.offset) /
          slope.offset.norm_square();
      }
  }



  template <int dim>
  void
  ImplicitBoundary<dim>::write(Archive &archive) const
  {
    using Carried           = CarriedPlace<dim>;
    const std::string group = "boundaries/" + boundary_name;
    archive.write(group + "/is_placed", placed_at ? 1u : 0u);
    archive.write(group + "/t_placed", placed_at.value_or(0.), "time");
    std::vector<unsigned int> ids;
    for (const Carried &of : carried)
      ids.insert(ids.end(), of.id.begin(), of.id.end());
    archive.distribute(group + "/carried", ids, 2);
    const auto write = [&](const std::string &name,
                           const auto         member,
                           const unsigned int n_components,
                           const std::string &unit) {
      archive.write(group + "/carried/" + name,
                    components_of(carried, member),
                    n_components,
                    unit);
    };
    write("place", &Carried::place, dim, "length");
    write("multiplier", &Carried::multiplier, dim, "stress");
    write("violation", &Carried::violation, dim, "length");
    write("slope", &Carried::slope, dim * dim, "stress/length");
    write("area", &Carried::area, 1, dim == 2 ? "length" : "length^2");
    write("normal", &Carried::normal, dim, "");
    write("cell_size", &Carried::h, 1, "length");
  }



  template <int dim>
  void
  ImplicitBoundary<dim>::read(const Archive &archive)
  {
    const std::string group = "boundaries/" + boundary_name;
    placed_at.reset();
    if (archive.integer(group + "/is_placed") != 0)
      place_at(archive.number(group + "/t_placed"));
    using Carried   = CarriedPlace<dim>;
    const auto &ids = archive.integers(group + "/carried/id", 2);
    carried.resize(ids.size() / 2);
    for (unsigned int k = 0; k < carried.size(); ++k)
      carried[k].id = {{ids[2 * k], ids[2 * k + 1]}};
    const auto read = [&](const std::string &name,
                          const auto         member,
                          const unsigned int n_components) {
      set_components(archive.numbers(group + "/carried/" + name, n_components),
                     carried,
                     member);
    };
    read("place", &Carried::place, dim);
    read("multiplier", &Carried::multiplier, dim);
    read("violation", &Carried::violation, dim);
    read("slope", &Carried::slope, dim * dim);
    read("area", &Carried::area, 1);
    read("normal", &Carried::normal, dim);
    read("cell_size", &Carried::h, 1);
    // The points are derived from that by the next begin_step().
    search.done = kept_at_points = false;
    undo();
  }



#define INSTANTIATE(dim)                                                    \
  template void ImplicitBoundary<dim>::take_over(                           \
    const std::vector<CarriedPlace<dim>> &);                                \
  template void ImplicitBoundary<dim>::take_over_nearest(const MPI_Comm &); \
  template void ImplicitBoundary<dim>::prepare(                             \
    const std::vector<Tensor<1, dim>> &,                                    \
    const std::vector<Tensor<1, dim>> &,                                    \
    const std::vector<Tensor<1, dim>> &);                                   \
  template void ImplicitBoundary<dim>::write(Archive &) const;              \
  template void ImplicitBoundary<dim>::read(const Archive &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
