// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/boundary/absorbing_boundary.h>

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
  AbsorbingBoundary<dim>::AbsorbingBoundary(const std::string  &name,
                                            const Finder       &find_places,
                                            const AbsorbingLaw &law,
                                            const Velocity     &incident,
                                            const bool          on_side)
    : boundary_name(name)
    , find_places(find_places)
    , absorbing_law(law)
    , incident(incident)
    , on_side(on_side)
  {}



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
  AbsorbingBoundary<dim>::keep() noexcept
  {
    std::swap(extensions, next_extensions);
    carried.move();
  }



  template <int dim>
  void
  AbsorbingBoundary<dim>::hold(std::vector<Tensor<1, dim>> tractions)
  {
    AssertDimension(tractions.size(), places().size());
    held = std::move(tractions);
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
    std::vector<double> of_extensions, of_held;
    for (unsigned int k = 0; k < places().size(); ++k)
      for (unsigned int d = 0; d < dim; ++d)
        {
          of_extensions.push_back(extensions[k][d]);
          of_held.push_back(held[k][d]);
        }
    carried.write(archive, group());
    archive.write(group() + "/extension", of_extensions, dim, "length");
    archive.write(group() + "/held traction", of_held, dim, "stress");
    archive.write(group() + "/is_placed", placed ? 1u : 0u);
  }



  template <int dim>
  void
  AbsorbingBoundary<dim>::read(const Archive &archive)
  {
    carried.read(archive, group());
    const auto &of_extensions = archive.numbers(group() + "/extension", dim);
    const auto &of_held = archive.numbers(group() + "/held traction", dim);
    placed              = archive.integer(group() + "/is_placed") != 0;
    found               = false;
    extensions.resize(places().size());
    held.resize(places().size());
    for (unsigned int k = 0; k < places().size(); ++k)
      for (unsigned int d = 0; d < dim; ++d)
        {
          extensions[k][d] = of_extensions[dim * k + d];
          held[k][d]       = of_held[dim * k + d];
        }
    undo();
  }



  template <int dim>
  void
  AbsorbingBoundary<dim>::undo()
  {
    carried.undo();
    next_extensions.clear();
  }



  template class AbsorbingBoundary<2>;
  template class AbsorbingBoundary<3>;
} // namespace moraine
