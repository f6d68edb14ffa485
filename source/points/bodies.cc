// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/points/bodies.h>

#include <moraine/core/exceptions.h>
#include <moraine/core/memory.h>
#include <moraine/core/object_error.h>
#include <moraine/geometry/shapes.h>

#include <deal.II/base/mpi.h>

#include <deal.II/grid/grid_tools.h>

#include <deal.II/numerics/rtree.h>

#include <cmath>
#include <set>
#include <limits>
#include <sstream>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** Whether two shapes share more of a cell than the error of their common
     * part, which subdivision finds if both are curved. */
    template <int dim>
    bool
    overlap_in_cell(const std::shared_ptr<const Shape<dim>> &a,
                    const std::shared_ptr<const Shape<dim>> &b,
                    const CellVertices<dim>                 &vertices,
                    const double                             cell_volume)
    {
      double error = dim == 2 ? 1e-3 : 5e-3;
      if (a->is_straight() || b->is_straight())
        error = 1e-10;
      return combine<dim>(Operation::intersect, a, b)
               ->clip(ConvexPolytope<dim>(vertices))
               .volume > error * cell_volume;
    }



    /** Whether @p box lies in @p outer but for round-off. */
    template <int dim>
    bool
    fits_into(const BoundingBox<dim> &box, const BoundingBox<dim> &outer)
    {
      for (unsigned int d = 0; d < dim; ++d)
        {
          const double margin = 1e-9 * outer.side_length(d);
          if (box.lower_bound(d) < outer.lower_bound(d) - margin ||
              box.upper_bound(d) > outer.upper_bound(d) + margin)
            return false;
        }
      return true;
    }



    /** Whether two bodies are there at the same time. */
    using Meet = std::function<bool(const unsigned, const unsigned)>;



    /** Volume of the cell that points with this outline fill. */
    template <int dim>
    double
    listed_in_cell(const Shape<dim>          &outline,
                   const ConvexPolytope<dim> &cell,
                   const BoundingBox<dim>    &cell_box)
    {
      return intersection(outline.bounding_box(), cell_box).volume() == 0. ?
               0. :
               outline.clip(cell).volume;
    }



    /** The points of one cell; add to @p listed_volumes what of it is filled by
     * points given. @return where two bodies overlap, or "". */
    template <int dim>
    std::string
    seed_cell(const typename PointSet<dim>::CellIterator &cell,
              const std::vector<Body<dim>>               &bodies,
              const CellSeeder<dim>                      &seeder,
              const Meet                                 &meet,
              PointSet<dim>                              &points,
              std::vector<double>                        &listed_volumes)
    {
      const auto                    vertices = vertices_of<dim>(cell);
      std::string                   overlap;
      std::vector<unsigned int>     earlier;
      std::vector<SeededPoint<dim>> seeded;
      for (unsigned int b = 0; b < bodies.size(); ++b)
        {
          seeded.clear();
          if (bodies[b].shape)
            seeder.seed(vertices, *bodies[b].shape, seeded);
          const double listed = bodies[b].outline ?
                                  listed_in_cell(*bodies[b].outline,
                                                 ConvexPolytope<dim>(vertices),
                                                 cell->bounding_box()) :
                                  0.;
          listed_volumes[b] += listed;
          if (seeded.empty() && listed == 0.)
            continue;
          for (const unsigned int other : earlier)
            if (overlap.empty() && (!meet || meet(other, b)) &&
                overlap_in_cell<dim>(bodies[other].filled(),
                                     bodies[b].filled(),
                                     vertices,
                                     volume_of_cell(cell)))
              {
                std::ostringstream message;
                message << "'" << bodies[other].name << "' and '"
                        << bodies[b].name << "' overlap near ("
                        << cell->center()
                        << "), allowed: bodies that share no volume";
                overlap = message.str();
              }
          earlier.push_back(b);
          const unsigned int first_id =
            (cell->active_cell_index() * bodies.size() + b) *
            seeder.max_points();
          for (unsigned int i = 0; i < seeded.size(); ++i)
            points.insert(cell,
                          seeded[i].position,
                          points.mesh().mapping().transform_real_to_unit_cell(
                            cell, seeded[i].position),
                          first_id + i,
                          b,
                          seeded[i].volume);
        }
      return overlap;
    }



    /** @return what cells of this rank have of each body whose points are
     * given. */
    template <int dim>
    std::vector<double>
    seed_cells(const std::vector<Body<dim>> &bodies,
               const CellSeeder<dim>        &seeder,
               const Meet                   &meet,
               PointSet<dim>                &points)
    {
      const Triangulation<dim> &triangulation = points.mesh().triangulation();
      std::vector<double>       listed_volumes(bodies.size(), 0.);
      std::string               overlap;
      for (const auto &cell : triangulation.active_cell_iterators())
        if (cell->is_locally_owned())
          {
            const std::string found =
              seed_cell(cell, bodies, seeder, meet, points, listed_volumes);
            if (overlap.empty())
              overlap = found;
          }
      for (const std::string &message :
           Utilities::MPI::all_gather(triangulation.get_communicator(),
                                      overlap))
        if (!message.empty())
          throw ObjectError("bodies", "", message);
      return listed_volumes;
    }



    /** The points of a list, with ids from @p first_id. */
    template <int dim>
    void
    insert_list(const PointList<dim> &list,
                const unsigned int    body,
                const unsigned int    first_id,
                PointSet<dim>        &points)
    {
      typename PointSet<dim>::CellIterator hint;
      for (unsigned int i = 0; i < list.positions.size(); ++i)
        {
          const auto [cell, reference] =
            GridTools::find_active_cell_around_point(
              points.mesh().search_cache(), list.positions[i], hint);
          if (cell.state() != IteratorState::valid)
            {
              std::ostringstream message;
              message << list.origin(i) << ": found a point at ("
                      << list.positions[i]
                      << "), allowed: points inside the mesh";
              throw InputError(message.str());
            }
          hint = cell;
          if (cell->is_locally_owned())
            points.insert(cell,
                          list.positions[i],
                          reference,
                          first_id + i,
                          body,
                          list.volumes[i]);
        }
    }



    /** Refuse a point that is given twice, be it in one file or in those of two
     * bodies that are there at the same time. */
    template <int dim>
    void
    refuse_repeated_points(const std::vector<Body<dim>> &bodies,
                           const Meet                   &meet)
    {
      // Far less than the size of a point: round-off of who wrote the file.
      constexpr double        same_place = 1e-6;
      std::vector<Point<dim>> positions;
      // Of each position, its body and its number there.
      std::vector<std::pair<unsigned int, unsigned int>> owners;
      for (unsigned int b = 0; b < bodies.size(); ++b)
        if (!bodies[b].filled())
          for (unsigned int i = 0; i < bodies[b].listed.positions.size(); ++i)
            {
              positions.push_back(bodies[b].listed.positions[i]);
              owners.emplace_back(b, i);
            }
      const auto tree = pack_rtree_of_indices(positions);
      for (std::size_t k = 0; k < positions.size(); ++k)
        {
          const auto [b, i] = owners[k];
          BoundingBox<dim> around(std::make_pair(positions[k], positions[k]));
          around.extend(same_place *
                        std::pow(bodies[b].listed.volumes[i], 1. / dim));
          for (const auto other :
               tree | boost::geometry::index::adaptors::queried(
                        boost::geometry::index::intersects(around)))
            {
              const auto [c, j] = owners[other];
              if (other >= k || (b != c && meet && !meet(c, b)))
                continue;
              std::ostringstream message;
              message << bodies[b].listed.origin(i) << ": found a point at ("
                      << positions[k] << "), which "
                      << bodies[c].listed.origin(j)
                      << " gives too, allowed: each point once";
              throw InputError(message.str());
            }
        }
    }



    /** Values of the columns of a list, whose ids begin at @p first_id. */
    template <int dim>
    void
    fill_columns(const PointList<dim> &list,
                 const unsigned int    first_id,
                 PointSet<dim>        &points)
    {
      for (unsigned int c = 0; c < list.columns.size(); ++c)
        for (const auto &field : points.fields().fields())
          if (field.name == list.columns[c])
            for (unsigned int p = 0; p < points.n_local(); ++p)
              if (points.id(p) >= first_id &&
                  points.id(p) < first_id + list.positions.size())
                points.values(p)[field.offset] =
                  list.column_values[points.id(p) - first_id][c];
    }



    /** That a body has points, and lies in the mesh as a whole, of which @p
     * volume does. */
    template <int dim>
    void
    check_body(const Body<dim>        &body,
               const double            volume,
               const BoundingBox<dim> &mesh_box,
               const bool              mesh_is_box)
    {
      if (volume == 0)
        throw ObjectError("body",
                          body.name,
                          "found no part of the body inside the mesh, allowed: "
                          "a body that is not empty and lies in the mesh");
      if (!body.filled())
        return;
      const Shape<dim>      &shape = *body.filled();
      const BoundingBox<dim> box   = shape.bounding_box();
      if (!is_finite(box) || (mesh_is_box && fits_into(box, mesh_box)))
        return;
      const auto  &corners = box.get_boundary_points();
      const double whole =
        shape.clip(ConvexPolytope<dim>(corners.first, corners.second)).volume;
      if (volume > (1 - (shape.is_straight() ? 1e-9 : 1e-3)) * whole)
        return;
      std::ostringstream message;
      message << "found " << 100 * (1 - volume / whole)
              << " % of its volume outside the mesh, which is ("
              << mesh_box.get_boundary_points().first << ") to ("
              << mesh_box.get_boundary_points().second
              << (mesh_is_box ?
                    "), allowed: a body in the mesh; only half-spaces and "
                    "expressions are cut by it, and 'Shape = intersection' "
                    "with a box cuts others" :
                    ") with straight edges, allowed: a body in the mesh; only "
                    "half-spaces and expressions are cut by it, and 'Shape = "
                    "mesh' fills it");
      throw ObjectError("body", body.name, message.str());
    }



    /** Refuse points that do not fit into the memory, or have more ids than
     * there are. */
    template <int dim>
    void
    check_number_of_points(const std::vector<Body<dim>> &bodies,
                           const CellSeeder<dim>        &seeder,
                           const Triangulation<dim>     &cells)
    {
      const auto box    = GridTools::compute_bounding_box(cells);
      double     filled = 0;
      for (const Body<dim> &body : bodies)
        if (body.shape)
          filled += intersection(body.shape->bounding_box(), box).volume() /
                    box.volume();
      const double n_points =
        filled * cells.n_active_cells() * seeder.n_sub_cells();
      std::ostringstream what;
      what << "found about " << n_points << " points";
      const std::string lack =
        lack_of_memory(n_points * (dim == 2 ? 250. : 350.));
      if (!lack.empty())
        throw ObjectError("points", "", what.str() + lack);

      const double n_ids =
        1. * cells.n_active_cells() * bodies.size() * seeder.max_points();
      if (n_ids > std::numeric_limits<unsigned int>::max())
        {
          what << " and room for " << n_ids
               << " in all cells, allowed: 4e9; fewer points or cells";
          throw ObjectError("points", "", what.str());
        }
    }
  } // namespace



  template <int dim>
  void
  request_columns(const std::vector<Body<dim>> &bodies, PointFields &fields)
  {
    // Those that some method has, and that output and archives add.
    std::set<std::string> taken{"body",
                                "id",
                                "order",
                                "cell",
                                "reference_position",
                                "volume",
                                "displacement",
                                "velocity",
                                "acceleration",
                                "initial_volume",
                                "stress",
                                "von_mises_stress",
                                "mean_stress",
                                "smoothed_mean_stress",
                                "position"};
    for (const auto &field : fields.fields())
      taken.insert(field.name);
    for (const Body<dim> &body : bodies)
      for (const std::string &column : body.listed.columns)
        if (taken.count(column) > 0)
          throw ObjectError("point file",
                            body.name,
                            "found the column '" + column +
                              "', which is a name of what points have, "
                              "allowed: other names");
        else
          fields.request(FieldName<dim, double>{column, "-"});
  }



  template <int dim>
  std::vector<double>
  seed_bodies(const std::vector<Body<dim>> &bodies,
              const CellSeeder<dim>        &seeder,
              PointSet<dim>                &points,
              const Meet                   &meet)
  {
    const Triangulation<dim> &triangulation = points.mesh().triangulation();
    check_number_of_points(bodies, seeder, triangulation);
    refuse_repeated_points(bodies, meet);
    std::vector<double> in_cells = seed_cells(bodies, seeder, meet, points);
    const unsigned int  first_of_lists =
      triangulation.n_active_cells() * bodies.size() * seeder.max_points();
    const auto for_each_list = [&](const auto &action) {
      unsigned int first_id = first_of_lists;
      for (unsigned int b = 0; b < bodies.size(); ++b)
        if (!bodies[b].shape)
          {
            action(b, first_id);
            first_id += bodies[b].listed.positions.size();
          }
    };
    for_each_list([&](const unsigned int b, const unsigned int first_id) {
      insert_list(bodies[b].listed, b, first_id, points);
    });
    points.finish_insertion();
    for_each_list([&](const unsigned int b, const unsigned int first_id) {
      fill_columns(bodies[b].listed, first_id, points);
    });

    std::vector<double> volumes(bodies.size(), 0.);
    for (unsigned int p = 0; p < points.n_local(); ++p)
      volumes[points.body(p)] += points.volume(p);
    Utilities::MPI::sum(volumes, triangulation.get_communicator(), volumes);
    Utilities::MPI::sum(in_cells, triangulation.get_communicator(), in_cells);
    const BoundingBox<dim> mesh_box =
      GridTools::compute_bounding_box(triangulation);
    for (unsigned int b = 0; b < bodies.size(); ++b)
      check_body(bodies[b],
                 bodies[b].outline ? in_cells[b] : volumes[b],
                 mesh_box,
                 points.mesh().box_grid().has_value());
    return volumes;
  }



  template decltype(request_columns<2>) request_columns<2>;
  template decltype(request_columns<3>) request_columns<3>;
  template decltype(seed_bodies<2>)     seed_bodies<2>;
  template decltype(seed_bodies<3>)     seed_bodies<3>;
} // namespace moraine
