// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/load/load.h>

#include <moraine/core/exceptions.h>
#include <moraine/core/object_error.h>

#include <deal.II/base/mpi.h>

#include <limits>
#include <sstream>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  CarriedLoad<dim>::CarriedLoad(const std::string         &name,
                                const std::string         &kind,
                                const VectorFunction<dim> &value,
                                std::vector<Place>         places,
                                const double               share_outside)
    : load_name(name)
    , load_kind(kind)
    , function(value)
    , drawn(std::move(places))
    , carried(drawn)
    , outside(share_outside)
  {}



  template <int dim>
  CarriedLoad<dim>::CarriedLoad(const std::string   &name,
                                const std::string   &kind,
                                const Pressure<dim> &pressure,
                                std::vector<Place>   places,
                                const double         share_outside)
    : load_name(name)
    , load_kind(kind)
    , pressure(pressure)
    , drawn(std::move(places))
    , carried(drawn)
    , outside(share_outside)
  {}



  template <int dim>
  void
  CarriedLoad<dim>::find_cells(const GridSpace<dim> &space,
                               const double          search_tolerance)
  {
    // Cells of a side have material or none.
    const bool begins_at_side =
      (load_kind == "side traction" || load_kind == "side pressure") && !placed;
    auto without =
      carried.find_cells(space, begins_at_side ? 0. : search_tolerance);
    if (begins_at_side)
      {
        carried.remove(without);
        without.clear();
      }
    if (places().empty())
      throw ObjectError("load",
                        load_name,
                        "found a surface or side outside the mesh or beside no "
                        "body, allowed: one that a body touches");
    if (!without.empty())
      {
        const Point<dim>  &x = places()[without[0]].x;
        std::ostringstream message;
        if (!placed)
          {
            message << "found the place (" << x
                    << "), allowed: places on or in the material of a body";
            throw ObjectError("load", load_name, message.str());
          }
        message << "load '" << load_name << "': its place (" << x
                << ") is no longer on any material, or beyond the mesh";
        throw ComputationError(message.str());
      }
    if (!placed)
      carried.catch_up(space, follows());
    placed = true;
  }



  template <int dim>
  void
  CarriedLoad<dim>::forget()
  {
    carried = CarriedPlaces<dim>(drawn);
    placed  = false;
  }



  template <int dim>
  void
  CarriedLoad<dim>::prepare_move(
    const GridSpace<dim>              &space,
    const std::vector<Tensor<1, dim>> &nodal_increments,
    const bool                         through_mesh)
  {
    using Increment          = typename CarriedPlaces<dim>::Increment;
    const unsigned int     n = space.nodes_per_cell();
    std::vector<Increment> increments(places().size());
    for (unsigned int i = 0; i < place_functions.places.size(); ++i)
      {
        const unsigned int *nodes = space.cell_nodes(place_functions.cells[i]);
        Increment          &of    = increments[place_functions.places[i]];
        for (unsigned int a = 0; a < n; ++a)
          {
            const Tensor<1, dim> &u = nodal_increments[nodes[a]];
            of.u += place_functions.N[n * i + a] * u;
            if (follows())
              of.gradient +=
                outer_product(u, place_functions.grad_N[n * i + a]);
          }
      }
    CarriedPlaces<dim>::sum_over_ranks(increments, space.communicator());
    carried.prepare_move(increments, through_mesh, follows());
  }



  template <int dim>
  void
  CarriedLoad<dim>::move() noexcept
  {
    carried.move();
  }



  template <int dim>
  void
  CarriedLoad<dim>::write(Archive &archive) const
  {
    carried.write(archive, "loads/" + load_name);
    archive.write("loads/" + load_name + "/is_placed", placed ? 1u : 0u);
  }



  template <int dim>
  void
  CarriedLoad<dim>::read(const Archive &archive)
  {
    carried.read(archive, "loads/" + load_name);
    placed = archive.integer("loads/" + load_name + "/is_placed") != 0;
  }



  template <int dim>
  void
  CarriedLoad<dim>::undo()
  {
    carried.undo();
  }



  template <int dim>
  void
  ForceOnPoints<dim>::write(Archive &archive) const
  {
    archive.write("loads/" + load_name + "/points", ids);
  }



  template <int dim>
  void
  ForceOnPoints<dim>::read(const Archive &archive)
  {
    ids = archive.integers("loads/" + load_name + "/points");
  }



  template <int dim>
  ForceOnPoints<dim>::ForceOnPoints(const std::string         &name,
                                    const VectorFunction<dim> &value,
                                    const Point<dim>          &place)
    : load_name(name)
    , function(value)
    , place(place)
  {}



  template <int dim>
  void
  ForceOnPoints<dim>::choose(const PointSet<dim>    &points,
                             const OriginalPosition &original_position)
  {
    const MPI_Comm communicator =
      points.mesh().triangulation().get_communicator();
    double nearest = std::numeric_limits<double>::max();
    for (unsigned int p = 0; p < points.n_local(); ++p)
      nearest = std::min(nearest, original_position(p).distance(place));
    nearest = Utilities::MPI::min(nearest, communicator);
    if (nearest > 2 * points.mesh().cell_size())
      {
        std::ostringstream message;
        message << "found (" << place << "), which is " << nearest
                << " from the nearest point, allowed: a place on or beside a "
                   "body, less than two cells away";
        throw ObjectError("force on points", load_name, message.str());
      }
    std::vector<unsigned int> near;
    for (unsigned int p = 0; p < points.n_local(); ++p)
      if (original_position(p).distance(place) <=
          nearest + 1e-6 * points.mesh().cell_size())
        near.push_back(points.id(p));
    for (const auto &of_rank : Utilities::MPI::all_gather(communicator, near))
      ids.insert(ids.end(), of_rank.begin(), of_rank.end());
    std::sort(ids.begin(), ids.end());
  }



  template <int dim>
  void
  ForceOnPoints<dim>::find_points(const PointSet<dim>    &points,
                                  const OriginalPosition &original_position)
  {
    if (ids.empty())
      choose(points, original_position);
    local_points.clear();
    for (unsigned int p = 0; p < points.n_local(); ++p)
      if (is_on(points.id(p)))
        local_points.push_back(p);
  }



  template class CarriedLoad<2>;
  template class CarriedLoad<3>;
  template class ForceOnPoints<2>;
  template class ForceOnPoints<3>;
} // namespace moraine
