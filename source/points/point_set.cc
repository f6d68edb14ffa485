// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/points/point_set.h>

#include <moraine/core/exceptions.h>

#include <deal.II/base/mpi.h>

#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <iomanip>
#include <sstream>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    PointFields
    with_basic_fields(PointFields fields)
    {
      fields.request(FieldNames<dim>::volume);
      fields.request(FieldNames<dim>::body);
      fields.request(FieldNames<dim>::displacement);
      fields.request(FieldNames<dim>::stress);
      return fields;
    }



    template <int dim>
    Point<dim>
    clamp(const Point<dim> &xi, const double margin)
    {
      Point<dim> clamped;
      for (unsigned int d = 0; d < dim; ++d)
        clamped[d] = std::clamp(xi[d], margin, 1 - margin);
      return clamped;
    }



    /**
     * The place next to @p x, with the unit place @p xi in @p cell, at which
     * the search finds this cell. The search has no tolerance: a point on a
     * face can be outside of the cells on both sides by round-off.
     */
    template <int dim>
    std::pair<Point<dim>, Point<dim>>
    found_place(const typename PointSet<dim>::CellIterator &cell,
                const Mapping<dim>                         &mapping,
                const Point<dim>                           &x,
                const Point<dim>                           &xi)
    {
      std::pair<Point<dim>, Point<dim>> found(x, xi);
      for (double margin = 1e-14;
           clamp(found.second, 0.) != found.second && margin < 1e-3;
           margin *= 4)
        {
          found.first =
            mapping.transform_unit_to_real_cell(cell, clamp(xi, margin));
          found.second = mapping.transform_real_to_unit_cell(cell, found.first);
        }
      return found;
    }
  } // namespace



  template <int dim>
  PointSet<dim>::PointSet(const BackgroundMesh<dim> &mesh, PointFields fields)
    : background(mesh)
    , layout(with_basic_fields<dim>(std::move(fields)))
    , volume_field(layout.find(FieldNames<dim>::volume))
    , body_field(layout.find(FieldNames<dim>::body))
    , u_field(layout.find(FieldNames<dim>::displacement))
    , sigma_field(layout.find(FieldNames<dim>::stress))
    , handler(mesh.triangulation(), mesh.mapping(), layout.n_values())
    , pool(&handler.get_property_pool())
  {
    handler.signals.particle_lost.connect(
      [this](const auto &particle, const auto &) {
        const auto properties = particle->get_properties();
        lost_points.push_back(
          {particle->get_id(),
           particle->get_location(),
           std::vector<double>(properties.begin(), properties.end())});
      });
  }



  template <int dim>
  void
  PointSet<dim>::insert(const CellIterator &cell,
                        const Point<dim>   &position,
                        const Point<dim>   &reference_position,
                        const unsigned int  id,
                        const unsigned int  body,
                        const double        volume)
  {
    std::vector<double> values(layout.n_values(), 0.);
    volume_field.store(volume, values.data());
    body_field.store(body, values.data());
    const auto [place, reference] =
      found_place(cell, background.mapping(), position, reference_position);
    handler.insert_particle(place, reference, id, cell, values);
  }



  template <int dim>
  void
  PointSet<dim>::finish_insertion()
  {
    handler.update_cached_numbers();
    find_cells();
    first_new_id = next_id();
  }



  template <int dim>
  unsigned int
  PointSet<dim>::next_id() const
  {
    unsigned int next = first_new_id;
    for (unsigned int p = 0; p < n_local(); ++p)
      next = std::max(next, id(p) + 1);
    return Utilities::MPI::max(next,
                               background.triangulation().get_communicator());
  }



  template <int dim>
  typename PointSet<dim>::Record
  PointSet<dim>::record(const CellIterator &cell, const unsigned int p) const
  {
    return {cell,
            position(p),
            reference_position(p),
            id(p),
            std::vector<double>(values(p), values(p) + layout.n_values())};
  }



  template <int dim>
  std::vector<typename PointSet<dim>::Record>
  PointSet<dim>::records_of(const unsigned int wanted) const
  {
    std::vector<Record> records;
    for (const CellPoints &in_cell : cell_points)
      for (unsigned int p = in_cell.first; p < in_cell.last; ++p)
        if (body(p) == wanted)
          records.push_back(record(in_cell.cell, p));
    return records;
  }



  template <int dim>
  void
  PointSet<dim>::exchange_bodies(const std::vector<bool>   &stay,
                                 const std::vector<Record> &others)
  {
    std::vector<Record> all;
    for (const CellPoints &in_cell : cell_points)
      for (unsigned int p = in_cell.first; p < in_cell.last; ++p)
        if (stay[body(p)])
          all.push_back(record(in_cell.cell, p));
    all.insert(all.end(), others.begin(), others.end());
    handler.clear_particles();
    for (const Record &point : all)
      handler.insert_particle(point.position,
                              point.reference_position,
                              point.id,
                              point.cell,
                              point.values);
    handler.update_cached_numbers();
    number_points();
    was_exchanged = true;
  }



  template <int dim>
  std::vector<double>
  PointSet<dim>::volumes_in_cells() const
  {
    const auto         &tria = background.triangulation();
    std::vector<double> volumes(tria.n_active_cells(), 0.);
    for (const CellPoints &in_cell : cell_points)
      for (unsigned int p = in_cell.first; p < in_cell.last; ++p)
        volumes[in_cell.cell->active_cell_index()] += volume(p);
    Utilities::MPI::sum(volumes, tria.get_communicator(), volumes);
    return volumes;
  }



  template <int dim>
  std::pair<unsigned int, unsigned int>
  PointSet<dim>::points_in(const unsigned int active_cell_index) const
  {
    const auto in_cell =
      std::lower_bound(cell_points.begin(),
                       cell_points.end(),
                       active_cell_index,
                       [](const CellPoints &points, const unsigned int index) {
                         return points.cell->active_cell_index() < index;
                       });
    return in_cell != cell_points.end() &&
               in_cell->cell->active_cell_index() == active_cell_index ?
             std::make_pair(in_cell->first, in_cell->last) :
             std::make_pair(0u, 0u);
  }



  template <int dim>
  double
  PointSet<dim>::gap_before(const unsigned int    active_cell_index,
                            const Point<dim>     &x,
                            const Tensor<1, dim> &normal,
                            const double          largest) const
  {
    double gap               = largest;
    const auto [first, last] = points_in(active_cell_index);
    for (unsigned int p = first; p < last; ++p)
      gap = std::min(gap,
                     (x - position(p)) * normal -
                       0.5 * std::pow(volume(p), 1. / dim));
    return gap;
  }



  template <int dim>
  typename PointSet<dim>::CellIterator
  PointSet<dim>::cell_of(const unsigned int p) const
  {
    const auto in_cell =
      std::upper_bound(cell_points.begin(),
                       cell_points.end(),
                       p,
                       [](const unsigned int p, const CellPoints &points) {
                         return p < points.last;
                       });
    return in_cell != cell_points.end() ?
             in_cell->cell :
             cells_of_copies[p - (cell_points.empty() ?
                                    0 :
                                    cell_points.back().last)];
  }



  template <int dim>
  void
  PointSet<dim>::insert_copies(const std::vector<Copy> &copies)
  {
    for (const Copy &copy : copies)
      {
        const CellIterator        cell = cell_of(copy.of);
        const std::vector<double> numbers(values(copy.of),
                                          values(copy.of) + layout.n_values());
        const Point<dim>          reference = reference_position(copy.of);
        handles.push_back(
          handler
            .insert_particle(copy.position, reference, copy.id, cell, numbers)
            ->get_local_index());
        cells_of_copies.push_back(cell);
      }
    handler.update_cached_numbers();
  }



  template <int dim>
  void
  PointSet<dim>::find_cells()
  {
    const auto n_points = handler.n_global_particles();
    lost_points.clear();
    handler.sort_particles_into_subdomains_and_cells();
    if (Utilities::MPI::sum<unsigned int>(
          lost_points.size(), background.triangulation().get_communicator()) >
        0)
      reinsert_lost_points();
    if (handler.n_global_particles() != n_points)
      throw ComputationError(
        "the search for cells lost " +
        std::to_string(n_points - handler.n_global_particles()) + " of " +
        std::to_string(n_points) + " points");
    number_points();
  }



  template <int dim>
  void
  PointSet<dim>::reinsert_lost_points()
  {
    const MPI_Comm communicator = background.triangulation().get_communicator();
    const auto     everyones =
      Utilities::MPI::all_gather(communicator, lost_points);

    const LostPoint *outside = nullptr;
    for (const auto &of_one_rank : everyones)
      for (const LostPoint &lost : of_one_rank)
        {
          // Every rank knows every cell, so all ranks agree on what is outside.
          Point<dim> place = lost.position;
          auto       found = background.cell_around(place);
          if (!found)
            if (const auto inside = place_for(place))
              {
                place = *inside;
                found = background.cell_around(place);
                returned_points += found && found->first->is_locally_owned();
              }
          if (!found)
            outside = &lost;
          else if (const auto &[cell, reference] = *found;
                   cell->is_locally_owned())
            {
              const auto inside =
                found_place(cell, background.mapping(), place, reference);
              handler
                .insert_particle(inside.first, inside.second, lost.id, cell)
                ->set_properties(lost.values);
            }
        }
    handler.update_cached_numbers();

    if (outside != nullptr)
      {
        std::ostringstream message;
        message << std::setprecision(10) << "point " << outside->id
                << " left the mesh at (";
        for (unsigned int d = 0; d < dim; ++d)
          message << (d > 0 ? ", " : "") << outside->position[d];
        message << ")";
        throw ComputationError(message.str());
      }
    // Renews the order of the storage, which insertion has broken.
    lost_points.clear();
    handler.sort_particles_into_subdomains_and_cells();
  }



  template <int dim>
  std::optional<Point<dim>>
  PointSet<dim>::place_for(const Point<dim> &x) const
  {
    if (return_tolerance == 0)
      return {};
    const auto               &cache   = background.search_cache();
    double                    nearest = return_tolerance;
    std::optional<Point<dim>> place;
    const auto                near = boost::geometry::index::nearest(x, 1);
    for (auto vertex = cache.get_used_vertices_rtree().qbegin(near);
         vertex != cache.get_used_vertices_rtree().qend();
         ++vertex)
      for (const auto &cell : cache.get_vertex_to_cell_map()[vertex->second])
        {
          // Halve the way from the middle of the cell until it ends at its
          // edge.
          const Point<dim>     middle = cell->center();
          const Tensor<1, dim> way    = x - middle;
          double               in = 0, out = 1;
          for (unsigned int i = 0; i < 40; ++i)
            (cell->point_inside(middle + 0.5 * (in + out) * way) ? in : out) =
              0.5 * (in + out);
          // A little less, so that searches agree that it is inside.
          const Point<dim> edge = middle + (1 - 1e-9) * in * way;
          if (edge.distance(x) <= nearest)
            {
              nearest = edge.distance(x);
              place   = edge;
            }
        }
    return place;
  }



  template <int dim>
  void
  PointSet<dim>::number_points()
  {
    handles.clear();
    handles.reserve(handler.n_locally_owned_particles());
    cell_points.clear();
    cells_of_copies.clear();
    for (auto particle = handler.begin(); particle != handler.end();)
      {
        const CellIterator cell  = particle->get_surrounding_cell();
        const unsigned int n     = handler.n_particles_in_cell(cell);
        const unsigned int first = handles.size();
        for (unsigned int i = 0; i < n; ++i, ++particle)
          handles.push_back(particle->get_local_index());
        Assert(cell_points.empty() ||
                 cell_points.back().cell->active_cell_index() <
                   cell->active_cell_index(),
               ExcMessage("Points do not come in the order of cells."));
        cell_points.push_back({cell, first, first + n});
      }
  }



  template <int dim>
  void
  PointSet<dim>::reset_displacements()
  {
    const auto F      = layout.find(FieldNames<dim>::deformation_gradient);
    const auto F_then = layout.find(FieldNames<dim>::deformation_gradient_then);
    double     largest = 0;
    for (unsigned int p = 0; p < n_local(); ++p)
      {
        largest = std::max(largest, u_field(values(p)).norm());
        u_field.store(Tensor<1, dim>(), values(p));
        if (F_then.exists())
          F_then.store(F(values(p)), values(p));
      }
    forgotten +=
      Utilities::MPI::max(largest,
                          background.triangulation().get_communicator());
  }



  template class PointSet<2>;
  template class PointSet<3>;
} // namespace moraine
