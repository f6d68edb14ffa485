// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/load/load.h>

#include <moraine/core/exceptions.h>
#include <moraine/core/object_error.h>
#include <moraine/mesh/active_search.h>

#include <deal.II/base/mpi.h>

#include <deal.II/grid/grid_tools.h>

#include <limits>
#include <sstream>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  CarriedLoad<dim>::CarriedLoad(const std::string         &name,
                                const VectorFunction<dim> &value,
                                std::vector<Place>         places)
    : load_name(name)
    , function(value)
    , load_places(std::move(places))
  {}



  template <int dim>
  void
  CarriedLoad<dim>::find_cells(const GridSpace<dim> &space,
                               const double          search_tolerance)
  {
    typename GridSpace<dim>::CellIterator hint;
    for (Place &place : load_places)
      {
        place.active_cell_index = GridSpace<dim>::no_cell;
        const auto cell =
          GridTools::find_active_cell_around_point(space.mesh().search_cache(),
                                                   place.x,
                                                   hint)
            .first;
        if (cell.state() == IteratorState::valid)
          {
            hint = cell;
            const auto owner =
              nearest_active_cell(space, cell, place.x, search_tolerance);
            if (owner.state() == IteratorState::valid)
              {
                if (owner->is_locally_owned())
                  place.active_cell_index = owner->active_cell_index();
                continue;
              }
          }
        std::ostringstream message;
        if (!placed)
          {
            message << "found the place (" << place.x
                    << "), allowed: places on or in the material of a body";
            throw ObjectError("load", load_name, message.str());
          }
        message << "load '" << load_name << "': its place (" << place.x
                << ") is no longer on any material";
        throw ComputationError(message.str());
      }
    placed = true;
  }



  template <int dim>
  void
  CarriedLoad<dim>::prepare_move(
    const GridSpace<dim>              &space,
    const std::vector<Tensor<1, dim>> &nodal_increments)
  {
    const unsigned int          n = space.nodes_per_cell();
    std::vector<double>         N(n);
    std::vector<Tensor<1, dim>> grad_N(n);
    std::vector<double>         moved(dim * load_places.size(), 0.);
    for (unsigned int k = 0; k < load_places.size(); ++k)
      {
        const unsigned int cell = load_places[k].active_cell_index;
        if (cell == GridSpace<dim>::no_cell)
          continue;
        evaluate_shapes(space, cell, load_places[k].x, N.data(), grad_N.data());
        const unsigned int *nodes = space.cell_nodes(cell);
        for (unsigned int a = 0; a < n; ++a)
          for (unsigned int d = 0; d < dim; ++d)
            moved[dim * k + d] += N[a] * nodal_increments[nodes[a]][d];
      }
    Utilities::MPI::sum(moved, space.communicator(), moved);
    next_places = load_places;
    for (unsigned int k = 0; k < load_places.size(); ++k)
      for (unsigned int d = 0; d < dim; ++d)
        next_places[k].x[d] += moved[dim * k + d];
  }



  template <int dim>
  void
  CarriedLoad<dim>::move() noexcept
  {
    if (!next_places.empty())
      std::swap(load_places, next_places);
    next_places.clear();
  }



  template <int dim>
  void
  CarriedLoad<dim>::write(Archive &archive) const
  {
    std::vector<double> places;
    for (const Place &place : load_places)
      for (unsigned int d = 0; d < dim; ++d)
        places.push_back(place.x[d]);
    archive.write("loads/" + load_name + "/place", places, dim);
    archive.write("loads/" + load_name + "/is_placed", placed ? 1u : 0u);
  }



  template <int dim>
  void
  CarriedLoad<dim>::read(const Archive &archive)
  {
    const std::string name   = "loads/" + load_name + "/place";
    const auto       &places = archive.numbers(name, dim);
    if (places.size() != dim * load_places.size())
      throw InputError("'" + name + "' is not of this load");
    for (unsigned int k = 0; k < load_places.size(); ++k)
      for (unsigned int d = 0; d < dim; ++d)
        load_places[k].x[d] = places[dim * k + d];
    placed = archive.integer("loads/" + load_name + "/is_placed") != 0;
    undo();
  }



  template <int dim>
  void
  CarriedLoad<dim>::undo()
  {
    next_places.clear();
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
  ForceOnPoints<dim>::choose(const PointSet<dim> &points)
  {
    const MPI_Comm communicator =
      points.mesh().triangulation().get_communicator();
    double nearest = std::numeric_limits<double>::max();
    for (unsigned int p = 0; p < points.n_local(); ++p)
      nearest = std::min(nearest, points.position(p).distance(place));
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
      if (points.position(p).distance(place) <=
          nearest + 1e-6 * points.mesh().cell_size())
        near.push_back(points.id(p));
    for (const auto &of_rank : Utilities::MPI::all_gather(communicator, near))
      ids.insert(ids.end(), of_rank.begin(), of_rank.end());
    std::sort(ids.begin(), ids.end());
  }



  template <int dim>
  void
  ForceOnPoints<dim>::find_points(const PointSet<dim> &points)
  {
    if (ids.empty())
      choose(points);
    local_points.clear();
    for (unsigned int p = 0; p < points.n_local(); ++p)
      if (std::binary_search(ids.begin(), ids.end(), points.id(p)))
        local_points.push_back(p);
  }



  template <int dim>
  std::vector<typename CarriedLoad<dim>::Place>
  places_on(const Surface<dim> &surface, const BackgroundMesh<dim> &mesh)
  {
    std::vector<SurfacePoint<dim>> pieces;
    const BoundingBox<dim>         box = surface.bounding_box();
    for (const auto &cell : mesh.triangulation().active_cell_iterators())
      {
        const BoundingBox<dim> cell_box = cell->bounding_box();
        bool                   apart    = false;
        for (unsigned int d = 0; d < dim; ++d)
          apart = apart ||
                  box.lower_bound(d) >
                    cell_box.upper_bound(d) + 1e-9 * mesh.cell_size() ||
                  cell_box.lower_bound(d) >
                    box.upper_bound(d) + 1e-9 * mesh.cell_size();
        if (!apart)
          surface.pieces(vertices_of<dim>(cell), 3, pieces);
      }
    std::vector<typename CarriedLoad<dim>::Place> places;
    for (const auto &piece : pieces)
      {
        typename CarriedLoad<dim>::Place place;
        place.x      = piece.x;
        place.weight = piece.JxW;
        places.push_back(place);
      }
    return places;
  }



  template class CarriedLoad<2>;
  template class CarriedLoad<3>;
  template class ForceOnPoints<2>;
  template class ForceOnPoints<3>;
  template std::vector<CarriedLoad<2>::Place>
  places_on(const Surface<2> &, const BackgroundMesh<2> &);
  template std::vector<CarriedLoad<3>::Place>
  places_on(const Surface<3> &, const BackgroundMesh<3> &);
} // namespace moraine
