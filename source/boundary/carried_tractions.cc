// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/boundary/carried_tractions.h>

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
  typename CarriedTractions<dim>::Places
  CarriedTractions<dim>::handed_over(const Places   &to,
                                     const bool      means,
                                     const MPI_Comm &communicator) const
  {
    // Of all ranks, because a moving surface takes its points from rank to
    // rank.
    const Places old_places = gather(carried, communicator);
    if (old_places.empty() ||
        !Utilities::MPI::logical_or(!to.empty(), communicator))
      return {};
    const auto nearest_old = nearest_of(to, old_places);
    std::map<std::array<unsigned int, 2>, std::vector<unsigned int>> nearest_to;
    if (means)
      {
        const Places new_places  = gather(to, communicator);
        const auto   nearest_new = nearest_of(old_places, new_places);
        for (unsigned int k = 0; k < old_places.size(); ++k)
          if (nearest_new[k] != numbers::invalid_unsigned_int)
            nearest_to[new_places[nearest_new[k]].id].push_back(k);
      }
    Places result;
    for (unsigned int q = 0; q < to.size(); ++q)
      {
        const auto               found = nearest_to.find(to[q].id);
        const CarriedPlace<dim> &nearest =
          nearest_old[q] == numbers::invalid_unsigned_int ?
            to[q] :
            old_places[nearest_old[q]];
        result.push_back(found == nearest_to.end() ?
                           nearest :
                           mean_of(found->second, old_places));
        result.back().slope = nearest.slope;
      }
    return result;
  }



  template <int dim>
  void
  CarriedTractions<dim>::write(Archive &archive, const std::string &group) const
  {
    using Carried = CarriedPlace<dim>;
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
  CarriedTractions<dim>::read(const Archive &archive, const std::string &group)
  {
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
    undo();
  }



  template class CarriedTractions<2>;
  template class CarriedTractions<3>;
} // namespace moraine
