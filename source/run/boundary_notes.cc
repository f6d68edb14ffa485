// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/run/boundary_notes.h>

#include <moraine/core/exceptions.h>
#include <moraine/core/words.h>
#include <moraine/run/boundary_ends.h>
#include <moraine/run/drawn_bodies.h>

#include <deal.II/base/mpi.h>

#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <optional>
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
          if (!contains(stage.boundaries, boundary.name()) ||
              contains(stage.absorbing, boundary.name()))
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



    template <int dim>
    void
    check_flux_of_boundaries(const Scene<dim>         &scene,
                             const Model<dim>         &model,
                             std::vector<std::string> &notes)
    {
      const bool finite =
        model.state->strain_measure() == StrainMeasure::finite;
      const bool any_yields = scene.any_yields();
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
    for (const auto &[name, boundary] : scene.boundaries)
      for (const std::string &key : boundary.enforcement.keys_in_vain())
        notes.push_back(name + ": '" + key + "' says nothing with " +
                        "'Enforcement = " + boundary.enforcement.enforcement +
                        "', the one of this boundary");
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
                                        std::vector<std::string> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
