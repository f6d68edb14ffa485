// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/run/boundary_notes.h>

#include <moraine/core/exceptions.h>
#include <moraine/core/words.h>

#include <deal.II/base/mpi.h>

#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <optional>
#include <set>
#include <sstream>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** Of a cell: from there on boundaries that begin are told to be away from
     * the material. */
    constexpr double told_gap = 0.1;

    /** Of a cell: material behind a boundary up to there is round-off of its
     * points; of its surface: a corner. */
    constexpr double told_depth = 0.25, told_share_behind = 0.1;

    /** Of a surface: what it holds past its ends shows in forces. */
    constexpr double told_past_ends = 0.05, least_own_share = 0.02;



    /** Where the surface is beside a place that stands for a piece of it: the
     * mean of a curve lies off it. */
    template <int dim>
    SurfacePoint<dim>
    foot_of(const BoundaryPoint<dim>    &place,
            const ImplicitBoundary<dim> &boundary)
    {
      SurfacePoint<dim> foot = {place.x, place.normal, place.JxW};
      // Levels of expressions are estimates.
      for (unsigned int k = 0; k < 3; ++k)
        {
          const NearestPoint<dim> nearest = boundary.nearest_at_start(foot.x);
          foot.x += nearest.level * nearest.normal;
          foot.normal = nearest.normal;
        }
      return foot;
    }



    /** How far the material of its cells is from a boundary, less half the size
     * of points, in the mean over its surface. Collective. */
    template <int dim>
    double
    gap_before(const ImplicitBoundary<dim> &boundary,
               const PointSet<dim>         &points)
    {
      std::vector<double> sums(2, 0.);
      for (const auto &place : boundary.points())
        {
          const double gap =
            points.gap_before(place.cell, place.x, place.normal, place.h);
          sums[0] += std::max(gap, 0.) * place.JxW;
          sums[1] += place.JxW;
        }
      Utilities::MPI::sum(sums,
                          points.mesh().triangulation().get_communicator(),
                          sums);
      return sums[1] > 0 ? sums[0] / sums[1] : 0.;
    }



    /** How far a boundary is from the nearest material in its cells, less half
     * the size of points; nothing if they have none. Collective. */
    template <int dim>
    std::optional<double>
    least_gap_before(const ImplicitBoundary<dim> &boundary,
                     const PointSet<dim>         &points)
    {
      double least = std::numeric_limits<double>::max();
      for (const auto &place : boundary.points())
        {
          const double gap =
            points.gap_before(place.cell, place.x, place.normal, place.h);
          if (gap < place.h)
            least = std::min(least, gap);
        }
      least =
        Utilities::MPI::min(least,
                            points.mesh().triangulation().get_communicator());
      if (least == std::numeric_limits<double>::max())
        return {};
      return std::max(least, 0.);
    }



    /** Whether no body comes from a file of points. */
    template <int dim>
    bool
    are_drawn(const std::vector<Body<dim>> &bodies)
    {
      return std::all_of(bodies.begin(), bodies.end(), [](const auto &body) {
        return body.shape != nullptr;
      });
    }



    /** Whether a body that is there has been drawn at @p x. */
    template <int dim>
    bool
    in_a_body(const Point<dim> &x, const Model<dim> &model)
    {
      for (unsigned int b = 0; b < model.bodies.size(); ++b)
        if (model.present[b] && model.bodies[b].shape->contains(x))
          return true;
      return false;
    }



    /** The body must lie on the inner side of a surface. */
    template <int dim>
    void
    check_sides_of_boundaries(const StageParameters    &stage,
                              const Model<dim>         &model,
                              std::vector<std::string> &notes)
    {
      if (!are_drawn(model.bodies))
        return;
      for (const auto &boundary : model.boundaries)
        {
          if (!contains(stage.boundaries, boundary.name()))
            continue;
          std::vector<double> area(2, 0.); // inside, behind
          for (const auto &point : boundary.points())
            {
              const SurfacePoint<dim> foot = foot_of(point, boundary);
              const Tensor<1, dim>    step = 1e-3 * point.h * foot.normal;
              area[0] += in_a_body(foot.x - step, model) ? point.JxW : 0.;
              area[1] += in_a_body(foot.x + step, model) ? point.JxW : 0.;
            }
          Utilities::MPI::sum(area, model.space->communicator(), area);
          const std::string where = "Boundaries/" + boundary.name();
          if (area[0] == 0 && area[1] > 0)
            throw InputError(
              "section '" + where +
              "': found the body behind the surface, allowed: a surface whose "
              "normal points out of the body (in 2D the body is on the left of a "
              "line's points, in 3D those of a patch run counter-clockwise seen "
              "from outside of it; reverse them, or use 'Flip')");
          if (area[0] > 0)
            continue;
          const auto gap = least_gap_before(boundary, *model.points);
          if (gap && *gap > told_gap * model.mesh->cell_size())
            {
              std::ostringstream text;
              text << boundary.name() << ": no body is at it at the start; it "
                   << "holds what is " << std::setprecision(2) << *gap
                   << " away in its cells all the same, and smaller cells let "
                      "that come closer";
              notes.push_back(text.str());
            }
          else
            notes.push_back(boundary.name() +
                            ": no body is beside it at the start");
        }
    }



    /** The material on the outer side of a boundary. */
    struct Behind
    {
      double share = 0; ///< of its surface, that has some next to it
      double depth = 0; ///< of the bodies that are there, at most
    };



    /** Which part of the surface has material of the points behind it, no
     * further than half a cell, and how deep it is. Collective. */
    template <int dim>
    Behind
    material_behind(const ImplicitBoundary<dim> &boundary,
                    const Model<dim>            &model)
    {
      const PointSet<dim>        &points       = *model.points;
      const MPI_Comm              communicator = model.space->communicator();
      const double                h            = model.mesh->cell_size();
      std::vector<Tensor<1, dim>> feet; ///< of what is next to the surface
      std::vector<double>         depths(model.bodies.size(), 0.);
      std::vector<unsigned int>   is_next(model.bodies.size(), 0);
      for (unsigned int p = 0; p < points.n_local(); ++p)
        {
          const Point<dim>       &x       = points.position(p);
          const NearestPoint<dim> nearest = boundary.nearest_at_start(x);
          if (!(nearest.level < 0) || !nearest.in_extent)
            continue;
          const double       half = 0.5 * std::pow(points.volume(p), 1. / dim);
          const unsigned int b    = points.body(p);
          depths[b]               = std::max(depths[b], half - nearest.level);
          if (-nearest.level > 0.5 * told_depth * h &&
              -nearest.level < half + 0.5 * h)
            {
              feet.push_back(x + nearest.level * nearest.normal);
              is_next[b] = 1;
            }
        }
      Utilities::MPI::max(depths, communicator, depths);
      Utilities::MPI::max(is_next, communicator, is_next);
      Behind behind;
      for (unsigned int b = 0; b < depths.size(); ++b)
        if (is_next[b])
          behind.depth = std::max(behind.depth, depths[b]);
      std::vector<Point<dim>> all;
      for (const auto &of_rank : Utilities::MPI::all_gather(communicator, feet))
        all.insert(all.end(), of_rank.begin(), of_rank.end());
      const auto          tree = pack_rtree(all);
      std::vector<double> area(2, 0.); // with material behind, all
      for (const auto &place : boundary.points())
        {
          for (auto it =
                 tree.qbegin(boost::geometry::index::nearest(place.x, 1));
               it != tree.qend();
               ++it)
            area[0] += it->distance(place.x) < h ? place.JxW : 0.;
          area[1] += place.JxW;
        }
      Utilities::MPI::sum(area, communicator, area);
      behind.share = area[1] > 0 ? area[0] / area[1] : 0.;
      return behind;
    }



    /** What of a boundary a body is at, and whether it goes through bodies. */
    struct AtBody
    {
      std::vector<double> area; ///< in each cell
      double              sum      = 0;
      bool                embedded = false;
    };



    template <int dim>
    AtBody
    area_at_body(const ImplicitBoundary<dim> &boundary, const Model<dim> &model)
    {
      AtBody              at;
      std::vector<double> area(2, 0.); // with a body inside, on both sides
      at.area.resize(model.mesh->triangulation().n_active_cells(), 0.);
      for (const auto &place : boundary.points())
        {
          const SurfacePoint<dim> foot = foot_of(place, boundary);
          const Tensor<1, dim>    step = 0.1 * place.h * foot.normal;
          if (!in_a_body(foot.x - step, model))
            continue;
          at.area[place.cell] += place.JxW;
          area[0] += place.JxW;
          area[1] += in_a_body(foot.x + step, model) ? place.JxW : 0.;
        }
      Utilities::MPI::sum(area, model.space->communicator(), area);
      at.sum      = area[0];
      at.embedded = area[1] > 0.5 * area[0];
      return at;
    }



    /** The share of a point that @p is_there, asked at places that are spread
     * over its cube and moved along @p normal into the plane of its middle. */
    template <int dim, typename Predicate>
    double
    share_of_point(const PointSet<dim>  &points,
                   const unsigned int    p,
                   const Tensor<1, dim> &normal,
                   const Predicate      &is_there)
    {
      constexpr unsigned int n     = dim == 2 ? 16 : 4; // along each axis
      const unsigned int     n_all = Utilities::fixed_power<dim>(n);
      const double           size  = std::pow(points.volume(p), 1. / dim) / n;
      unsigned int           found = 0;
      for (unsigned int k = 0; k < n_all; ++k)
        {
          Tensor<1, dim> offset;
          unsigned int   i = k;
          for (unsigned int d = 0; d < dim; ++d, i /= n)
            offset[d] = (i % n - 0.5 * (n - 1)) * size;
          found +=
            is_there(points.position(p) + offset - (offset * normal) * normal);
        }
      return 1. * found / n_all;
    }



    /** Whether all of a point's cube is between the ends of a boundary. */
    template <int dim>
    bool
    is_within_ends(const ImplicitBoundary<dim> &boundary,
                   const PointSet<dim>         &points,
                   const unsigned int           p)
    {
      const double half = 0.5 * std::pow(points.volume(p), 1. / dim);
      for (const unsigned int corner : GeometryInfo<dim>::vertex_indices())
        {
          Point<dim> x = points.position(p);
          for (unsigned int d = 0; d < dim; ++d)
            x[d] += (corner >> d) & 1 ? half : -half;
          if (!boundary.nearest_at_start(x).in_extent)
            return false;
        }
      return true;
    }



    /** Whether another boundary of a stage goes on where one ends, so that it
     * is as deep below @p x. */
    template <int dim>
    bool
    goes_on(const ImplicitBoundary<dim> &boundary,
            const StageParameters       &stage,
            const Model<dim>            &model,
            const Point<dim>            &x,
            const double                 depth)
    {
      return std::any_of(model.boundaries.begin(),
                         model.boundaries.end(),
                         [&](const auto &other) {
                           if (other.name() == boundary.name() ||
                               !contains(stage.boundaries, other.name()))
                             return false;
                           const NearestPoint<dim> nearest =
                             other.nearest_at_start(x);
                           return nearest.in_extent &&
                                  std::abs(nearest.level - depth) <
                                    told_past_ends * model.mesh->cell_size();
                         });
    }



    /** The area past the ends of a boundary that its cells have and bodies are
     * at as they are at it, over its own: it holds that, too. From the volume
     * of points in a cell, and how deep they lie. Collective. */
    template <int dim>
    double
    area_past_ends(const ImplicitBoundary<dim> &boundary,
                   const StageParameters       &stage,
                   const Model<dim>            &model)
    {
      const PointSet<dim> &points = *model.points;
      const AtBody         at     = area_at_body(boundary, model);
      const double         step   = 0.1 * model.mesh->cell_size();
      double               past   = 0;
      for (const auto &in_cell : points.cells())
        {
          const double own = at.area[in_cell.cell->active_cell_index()];
          if (own == 0)
            continue;
          double volume = 0, moment = 0; // of a layer along the surface
          for (unsigned int p = in_cell.first; p < in_cell.last; ++p)
            {
              const NearestPoint<dim> middle =
                boundary.nearest_at_start(points.position(p));
              if (middle.level <= 0 || is_within_ends(boundary, points, p))
                continue;
              const Tensor<1, dim> out = (middle.level + step) * middle.normal;
              const double         part =
                points.volume(p) *
                share_of_point(points, p, middle.normal, [&](const auto &x) {
                  return !boundary.nearest_at_start(x).in_extent &&
                         in_a_body(x, model) &&
                         in_a_body(x + out, model) == at.embedded &&
                         !goes_on(boundary, stage, model, x, middle.level);
                });
              volume += part;
              moment += part * middle.level;
            }
          if (volume == 0)
            continue;
          const double area = volume / (2 * moment / volume);
          // A sliver of it hardly holds its cell.
          if (own > least_own_share * area)
            past += area;
        }
      past = Utilities::MPI::sum(past, model.space->communicator());
      return at.sum > 0 ? past / at.sum : 0.;
    }



    /** Whether a body has been drawn less than told_gap of a cell from @p x. */
    template <int dim>
    bool
    is_near_a_body(const Point<dim> &x, const Model<dim> &model)
    {
      for (const unsigned int corner : GeometryInfo<dim>::vertex_indices())
        {
          Tensor<1, dim> way;
          for (unsigned int d = 0; d < dim; ++d)
            way[d] = ((corner >> d) & 1 ? told_gap : -told_gap) *
                     model.mesh->cell_size();
          if (in_a_body(x + way, model))
            return true;
        }
      return false;
    }



    /** Whether a place of a face, of a lattice on it, is what @p is_it says. */
    template <typename Face, typename Predicate>
    bool
    any_of_face(const Face &face, const Predicate &is_it)
    {
      constexpr unsigned int n = 5; // along an edge
      const unsigned int     m = face->n_vertices() == 4 ? n : 1;
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < m; ++j)
          {
            const double s = i / (n - 1.), t = j / (n - 1.);
            auto         x = (1 - s) * face->vertex(0) + s * face->vertex(1);
            if (m > 1)
              x = (1 - t) * x +
                  t * ((1 - s) * face->vertex(2) + s * face->vertex(3));
            if (is_it(x))
              return true;
          }
      return false;
    }



    /** Of the nodes of a condition: those off bodies, all. Collective. */
    template <int dim>
    std::vector<unsigned int>
    nodes_off_bodies(const GridCondition<dim> &condition,
                     const Model<dim>         &model,
                     const double              t)
    {
      const GridSpace<dim>  &space = *model.space;
      std::set<unsigned int> nodes;
      for (const auto &entry :
           find_prescribed_nodes<dim>({condition}, space, t).entries)
        if (space.locally_owned().is_element(space.node_dof(entry.node)))
          nodes.insert(entry.node);
      std::vector<unsigned int> n(2, 0);
      for (const unsigned int node : nodes)
        {
          n[0] += !is_near_a_body(space.node_position(node), model);
          ++n[1];
        }
      Utilities::MPI::sum(n, space.communicator(), n);
      return n;
    }



    template <int dim>
    void
    check_flux_of_boundaries(const Scene<dim>         &scene,
                             const Model<dim>         &model,
                             std::vector<std::string> &notes)
    {
      const bool finite =
        model.state->strain_measure() == StrainMeasure::finite;
      const bool any_yields =
        std::any_of(scene.materials.begin(),
                    scene.materials.end(),
                    [](const auto &named) { return named.second.yields(); });
      for (const auto &boundary : model.boundaries)
        if (boundary.enforcement().w_constrained > 0 && (finite || any_yields))
          notes.push_back(
            boundary.name() + ": its flux is elastic" +
            (finite ?
               " and of the increment of a step; 'Enforcement = "
               "augmented Lagrangian' holds at any strain" :
               ", and beside material that yields its reaction and limit "
               "loads are off by some per cent; 'Enforcement = "
               "augmented Lagrangian' has no flux"));
    }
  } // namespace



  template <int dim>
  void
  tell_of_boundaries(const Scene<dim>         &scene,
                     const Model<dim>         &model,
                     std::vector<std::string> &notes)
  {
    const StageParameters &stage = scene.stages.front().second;
    check_sides_of_boundaries(stage, model, notes);
    tell_of_material_behind(stage, {}, model, notes);
    tell_of_ends(stage, {}, model, notes);
    check_flux_of_boundaries(scene, model, notes);
  }



  template <int dim>
  void
  tell_of_gaps(const StageParameters    &stage,
               const StageParameters    &before,
               const Model<dim>         &model,
               std::vector<std::string> &notes)
  {
    for (const auto &boundary : model.boundaries)
      {
        if (!contains(stage.boundaries, boundary.name()) ||
            contains(before.boundaries, boundary.name()))
          continue;
        const double gap = gap_before(boundary, *model.points);
        if (!(gap > told_gap * model.mesh->cell_size()))
          continue;
        std::ostringstream text;
        text << boundary.name() << ": as it begins, the material is "
             << std::setprecision(2) << gap
             << " away from it, and is held across the gap as if it filled "
                "it; draw the surface where the material is by then";
        notes.push_back(text.str());
      }
  }



  template <int dim>
  void
  tell_of_material_behind(const StageParameters          &stage,
                          const std::vector<std::string> &known,
                          const Model<dim>               &model,
                          std::vector<std::string>       &notes)
  {
    for (const auto &boundary : model.boundaries)
      {
        if (!contains(stage.boundaries, boundary.name()) ||
            contains(stage.absorbing, boundary.name()) ||
            contains(known, boundary.name()))
          continue;
        const Behind behind = material_behind(boundary, model);
        if (!(behind.share > told_share_behind &&
              behind.depth > told_depth * model.mesh->cell_size()))
          continue;
        std::ostringstream text;
        text << boundary.name() << ": as it begins, material lies behind "
             << std::lround(100 * behind.share) << " % of its surface, up to "
             << std::setprecision(2) << behind.depth
             << " deep: it holds that as well, or cuts it off; "
             << (boundary.rigid_motion().moves() ?
                   "let its motion begin then, from the rim of a body" :
                   "draw the surface along the rim of a body");
        notes.push_back(text.str());
      }
  }



  template <int dim>
  void
  tell_of_ends(const StageParameters          &stage,
               const std::vector<std::string> &known,
               const Model<dim>               &model,
               std::vector<std::string>       &notes)
  {
    if (!are_drawn(model.bodies))
      return;
    for (const auto &boundary : model.boundaries)
      {
        if (!contains(stage.boundaries, boundary.name()) ||
            contains(stage.absorbing, boundary.name()) ||
            contains(known, boundary.name()))
          continue;
        const double past = area_past_ends(boundary, stage, model);
        if (past > told_past_ends)
          notes.push_back(
            boundary.name() + ": it ends inside cells and holds all of them, " +
            std::to_string(std::lround(100 * past)) +
            " % more than was drawn; forces on it can come out as much larger, "
            "or more; let it end on faces of cells, or take smaller ones");
      }
  }



  template <int dim>
  void
  tell_of_nodes_off_bodies(const std::vector<GridCondition<dim>> &conditions,
                           const Model<dim>                      &model,
                           const double                           t,
                           std::vector<std::string>              &notes)
  {
    if (!are_drawn(model.bodies))
      return;
    for (const auto &condition : conditions)
      {
        // Pieces of the side, or nodes: off bodies, all.
        std::vector<unsigned int> n(2, 0);
        if (condition.side)
          for (const auto &cell :
               model.mesh->triangulation().active_cell_iterators())
            {
              if (model.space->is_active(cell))
                for (const auto &face : cell->face_iterators())
                  if (face->at_boundary() &&
                      face->boundary_id() == *condition.side)
                    {
                      n[0] += !any_of_face(face, [&](const Point<dim> &x) {
                        return is_near_a_body(x, model);
                      });
                      ++n[1];
                    }
            }
        else
          n = nodes_off_bodies(condition, model, t);
        // A body may lie between the nodes that it moves.
        if (n[0] == 0 || (condition.side ? 2 * n[0] <= n[1] : n[0] < n[1]))
          continue;
        notes.push_back(
          condition.name + ": " + std::to_string(n[0]) + " of the " +
          std::to_string(n[1]) + (condition.side ? " faces" : " nodes") +
          " that it holds are off the bodies, which end before these and are "
          "held as if they went on to there; let them end on faces of cells, "
          "or hold their rim in section 'Boundaries'");
      }
  }



#define INSTANTIATE(dim)                                                  \
  template void tell_of_boundaries(const Scene<dim> &,                    \
                                   const Model<dim> &,                    \
                                   std::vector<std::string> &);           \
  template void tell_of_gaps(const StageParameters &,                     \
                             const StageParameters &,                     \
                             const Model<dim> &,                          \
                             std::vector<std::string> &);                 \
  template void tell_of_material_behind(const StageParameters &,          \
                                        const std::vector<std::string> &, \
                                        const Model<dim> &,               \
                                        std::vector<std::string> &);      \
  template void tell_of_ends(const StageParameters &,                     \
                             const std::vector<std::string> &,            \
                             const Model<dim> &,                          \
                             std::vector<std::string> &);                 \
  template void tell_of_nodes_off_bodies(                                 \
    const std::vector<GridCondition<dim>> &,                              \
    const Model<dim> &,                                                   \
    const double,                                                         \
    std::vector<std::string> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
