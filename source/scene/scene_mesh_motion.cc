// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/scene/scene_mesh_motion.h>

#include <moraine/core/exceptions.h>
#include <moraine/core/words.h>

#include <deal.II/grid/grid_tools.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** The middle of the box around the surface of a boundary; of one without
     * ends, the point nearest to @p near. */
    template <int dim>
    Point<dim>
    middle_of(const ImplicitBoundary<dim> &boundary, const Point<dim> &near)
    {
      const auto &surface = boundary.surface_at_start();
      if (is_finite(surface.bounding_box()))
        return surface.bounding_box().center();
      const NearestPoint<dim> nearest = surface.nearest(near);
      return near + nearest.level * nearest.normal; // positive in the body
    }



    /** The middle of what a condition holds. */
    template <int dim>
    Point<dim>
    middle_of(const GridCondition<dim>  &condition,
              const BackgroundMesh<dim> &mesh)
    {
      if (!condition.side)
        return condition.region->center();
      Tensor<1, dim> sum;
      double         area = 0;
      for (const auto &cell : mesh.triangulation().active_cell_iterators())
        for (const auto &face : cell->face_iterators())
          if (face->at_boundary() && face->boundary_id() == *condition.side)
            {
              sum += face->measure() * face->center();
              area += face->measure();
            }
      return Point<dim>(sum / area);
    }



    template <int dim>
    typename MeshMotion<dim>::Master
    master_called(const std::string                        &name,
                  const std::string                        &key,
                  const BackgroundMesh<dim>                &mesh,
                  const std::vector<ImplicitBoundary<dim>> &boundaries,
                  const std::vector<GridCondition<dim>>    &conditions)
    {
      std::vector<std::string> names;
      for (const auto &condition : conditions)
        {
          names.push_back(condition.name);
          if (condition.name == name)
            {
              const Point<dim> middle = middle_of(condition, mesh);
              return {middle,
                      condition.motion,
                      [condition, middle](const double t) {
                        Tensor<1, dim> u = condition.displacement(middle, t);
                        for (unsigned int d = 0; d < dim; ++d)
                          u[d] = condition.component[d] ? u[d] : 0.;
                        return u;
                      }};
            }
        }
      const Point<dim> middle_of_mesh =
        GridTools::compute_bounding_box(mesh.triangulation()).center();
      for (const auto &boundary : boundaries)
        {
          names.push_back(boundary.name());
          if (boundary.name() == name)
            return {middle_of(boundary, middle_of_mesh),
                    boundary.rigid_motion(),
                    {}};
        }
      std::string known;
      for (const std::string &other : names)
        known += (known.empty() ? "" : ", ") + other;
      reject("Mesh motion",
             key,
             name,
             "the name of a boundary or grid condition (" + known + ")" +
               suggest(name, names));
    }
  } // namespace



  template <int dim>
  MeshMotion<dim>
  make_mesh_motion(const Scene<dim>                         &scene,
                   const BackgroundMesh<dim>                &mesh,
                   const std::vector<ImplicitBoundary<dim>> &boundaries,
                   const std::vector<GridCondition<dim>>    &conditions)
  {
    const MeshMotionParameters &parameters = scene.mesh_motion;
    const auto master = [&](const std::string &name, const std::string &key) {
      return master_called<dim>(name, key, mesh, boundaries, conditions);
    };
    if (!parameters.follow.empty())
      return MeshMotion<dim>(master(parameters.follow, "Follow"));
    if (parameters.stretch.empty())
      return {};
    const auto A = master(parameters.stretch[0], "Stretch between");
    const auto B = master(parameters.stretch[1], "Stretch between");
    if (!(A.place.distance(B.place) > 1e-9 * mesh.cell_size()))
      reject("Mesh motion",
             "Stretch between",
             parameters.stretch[0] + ", " + parameters.stretch[1],
             "boundaries whose middles are apart");
    return MeshMotion<dim>(A, B, scene.start_time());
  }



  namespace
  {
    /** How far the mesh and a condition part from t_start to t_end at a face,
     * which is where it was at t_0, along its normal, and the larger of the two
     * motions. */
    template <int dim, class Face>
    std::pair<double, double>
    parting(const MeshMotion<dim>    &motion,
            const GridCondition<dim> &condition,
            const Face               &face,
            const double              t_0,
            const double              t_start,
            const double              t_end)
    {
      std::array<Point<dim>, (1u << (dim - 1))> X;
      Point<dim>                                middle;
      for (unsigned int v = 0; v < X.size(); ++v)
        {
          X[v] = motion.map(face->vertex(v), t_0, t_start);
          middle += X[v] / static_cast<double>(X.size());
        }
      Tensor<1, dim> normal;
      if constexpr (dim == 2)
        normal = cross_product_2d(X[1] - X[0]);
      else
        normal = cross_product_3d(X[3] - X[0], X[2] - X[1]);
      normal /= normal.norm();
      const Tensor<1, dim> mesh = motion.map(middle, t_start, t_end) - middle;
      const Tensor<1, dim> material =
        condition.increment(middle, face->center(), t_start, t_end);
      double apart = 0;
      for (unsigned int d = 0; d < dim; ++d)
        if (condition.component[d])
          apart += (mesh[d] - material[d]) * normal[d];
      return {std::abs(apart), std::max(mesh.norm(), material.norm())};
    }
  } // namespace



  template <int dim>
  void
  check_mesh_motion(const MeshMotion<dim>                 &motion,
                    const double                           t_0,
                    const TimeParameters                  &time,
                    const BackgroundMesh<dim>             &mesh,
                    const std::vector<GridCondition<dim>> &conditions)
  {
    // A polygon that turns in the circle it stands for parts a little from it.
    constexpr double allowed = 0.2;

    const double step = (time.end_time - time.start_time) / time.n_steps;
    for (const auto &condition : conditions)
      if (condition.side)
        for (const auto &cell : mesh.triangulation().active_cell_iterators())
          for (const auto &face : cell->face_iterators())
            if (face->at_boundary() && face->boundary_id() == *condition.side)
              for (unsigned int k = 0; k < time.n_steps; ++k)
                {
                  const double t = time.start_time + k * step;
                  const auto [apart, larger] =
                    parting<dim>(motion, condition, face, t_0, t, t + step);
                  // A mesh of no length, where nothing is a number, is named
                  // when it comes.
                  if (!(apart > allowed * larger + 1e-12 * mesh.cell_size()))
                    continue;
                  throw InputError(fmt::format(
                    "section 'Mesh motion': found a motion by which the side "
                    "of grid condition '{}' at ({}) moves off the material it "
                    "holds, by {:.6g} in the step from t = {:.6g}, allowed: "
                    "sides and conditions that move alike along the normal",
                    condition.name,
                    coordinates(face->center()),
                    apart,
                    t));
                }
  }



#define INSTANTIATE(dim)                                           \
  template decltype(make_mesh_motion<dim>)  make_mesh_motion<dim>; \
  template decltype(check_mesh_motion<dim>) check_mesh_motion<dim>;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
