// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/boundary/absorbing_boundary.h>

#include <moraine/core/archive_components.h>
#include <moraine/core/exceptions.h>

#include <cmath>
#include <sstream>

namespace moraine
{
  using namespace dealii;

  AbsorbingLaw::Coefficients
  AbsorbingLaw::coefficients(const LameConstants &C, const double density) const
  {
    const double rho = medium ? medium->density : density;
    const double M =
      medium ? rho * medium->c_p * medium->c_p : C.lambda + 2 * C.mu;
    const double         G = medium ? rho * medium->c_s * medium->c_s : C.mu;
    const NormalAndAlong rho_c =
      impedances ? *impedances :
                   NormalAndAlong{std::sqrt(rho * M), std::sqrt(rho * G)};
    Coefficients result;
    result.dashpots = {dashpot_factors.normal * rho_c.normal,
                       dashpot_factors.along * rho_c.along};
    if (springs == Springs::radius)
      result.springs = {2 * G / spring_length, G / (2 * spring_length)};
    else if (springs == Springs::thickness)
      result.springs = {M / spring_length, G / spring_length};
    else if (springs == Springs::given)
      result.springs = spring_stiffness;
    return result;
  }



  template <int dim>
  void
  AbsorbingBoundary<dim>::find_cells(const GridSpace<dim> &space,
                                     const double          search_tolerance,
                                     const double          t)
  {
    if (!placed)
      carried = CarriedPlaces<dim>(find_places(space, t));
    const auto without = carried.find_cells(space, search_tolerance);
    if (!on_side && !without.empty())
      {
        if (placed)
          {
            std::ostringstream message;
            message << "absorbing boundary '" << boundary_name
                    << "': its place (" << places()[without[0]].x
                    << ") is no longer on any material, or beyond the mesh";
            throw ComputationError(message.str());
          }
        carried.remove(without);
      }
    if (!placed)
      {
        carried.catch_up(space);
        extensions.assign(places().size(), {});
        held.assign(places().size(), {});
      }
    n_with_cell = places().size() - (on_side ? without.size() : 0);
    placed = found = true;
  }



  template <int dim>
  Tensor<1, dim>
  AbsorbingBoundary<dim>::incident_increment(const unsigned int place,
                                             const double       t_start,
                                             const double       t_end) const
  {
    return incident ? 0.5 * (t_end - t_start) *
                        (incident_velocity(place, t_start) +
                         incident_velocity(place, t_end)) :
                      Tensor<1, dim>();
  }



  template <int dim>
  void
  AbsorbingBoundary<dim>::prepare(
    const GridSpace<dim>              &space,
    const std::vector<Tensor<1, dim>> &nodal_increments,
    const double                       t_start,
    const double                       t_end,
    const Following                   &following)
  {
    const auto increments = carried.increments(space, nodal_increments);
    next_extensions.assign(places().size(), {});
    if (following.attached)
      for (unsigned int k = 0; k < increments.size(); ++k)
        next_extensions[k] =
          extensions[k] +
          (increments[k].u - incident_increment(k, t_start, t_end));
    if (following.moves)
      carried.prepare_move(increments, following.through_mesh, following.turns);
  }



  template <int dim>
  void
  AbsorbingBoundary<dim>::remove_places(
    const std::vector<unsigned int> &numbers)
  {
    carried.remove(numbers);
    for (auto number = numbers.rbegin(); number != numbers.rend(); ++number)
      {
        extensions.erase(extensions.begin() + *number);
        held.erase(held.begin() + *number);
      }
    found = false;
  }



  template <int dim>
  void
  AbsorbingBoundary<dim>::write(Archive &archive) const
  {
    carried.write(archive, group());
    archive.write(group() + "/extension",
                  components_of(extensions),
                  dim,
                  "length");
    archive.write(group() + "/held traction",
                  components_of(held),
                  dim,
                  "stress");
    archive.write(group() + "/is_placed", placed ? 1u : 0u);
  }



  template <int dim>
  void
  AbsorbingBoundary<dim>::read(const Archive &archive)
  {
    carried.read(archive, group());
    placed = archive.integer(group() + "/is_placed") != 0;
    found  = false;
    extensions.resize(places().size());
    held.resize(places().size());
    set_components(archive.numbers(group() + "/extension", dim), extensions);
    set_components(archive.numbers(group() + "/held traction", dim), held);
    undo();
  }



  template class AbsorbingBoundary<2>;
  template class AbsorbingBoundary<3>;
} // namespace moraine
