// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// The part of Simulation that turns a scene into objects.

#include <moraine/run/simulation.h>

#include <moraine/basis/cpdi_basis.h>
#include <moraine/basis/gimp_basis.h>
#include <moraine/core/exceptions.h>
#include <moraine/output/error_norms.h>
#include <moraine/output/grid_evaluation.h>
#include <moraine/run/scene_bodies.h>
#include <moraine/run/scene_conditions.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** Of a cell without points over that of one with points. */
    constexpr double work_of_empty_cell = 0.05;



    /** Whether @p x is in the box, which may be infinite, or @p size from it.
     */
    template <int dim>
    bool
    is_near(const BoundingBox<dim> &box, const Point<dim> &x, const double size)
    {
      for (unsigned int d = 0; d < dim; ++d)
        if (x[d] < box.lower_bound(d) - size ||
            x[d] > box.upper_bound(d) + size)
          return false;
      return true;
    }



    /**
     * The part of a cell of size @p size that a body with a flat surface fills,
     * by its level at the cell's centre @p x. Where an expression is no number
     * that is a guess: whoever needs the level there will say so.
     */
    template <int dim>
    double
    filled_part(const Shape<dim> &shape, const Point<dim> &x, const double size)
    {
      try
        {
          return 0.5 + shape.level(x) / size;
        }
      catch (const InputError &)
        {
          return 1.;
        }
    }



    /**
     * What a cell has to do with it, judged by the @p bodies before they are
     * seeded. Keeps a reference to them.
     */
    template <int dim>
    std::function<double(const typename BackgroundMesh<dim>::CellIterator &)>
    work_by_bodies(const std::vector<Body<dim>> &bodies)
    {
      std::vector<BoundingBox<dim>> boxes;
      for (const Body<dim> &body : bodies)
        boxes.push_back(body.shape ? body.shape->bounding_box() :
                                     BoundingBox<dim>());
      return [&bodies, boxes](const auto &cell) {
        const Point<dim> centre = cell->center();
        const double     size   = cell->diameter() / std::sqrt(dim);
        double           filled = 0;
        for (unsigned int b = 0; b < bodies.size(); ++b)
          if (bodies[b].shape == nullptr)
            filled = 1.;
          else if (is_near(boxes[b], centre, size))
            filled =
              std::max(filled, filled_part(*bodies[b].shape, centre, size));
        return std::clamp(filled, work_of_empty_cell, 1.);
      };
    }
  } // namespace



  template <int dim>
  Simulation<dim>::Simulation(Scene<dim>     &scene,
                              const MPI_Comm &communicator,
                              Console        &console)
    : scene(scene)
    , communicator(communicator)
    , console(console)
    , timer(unused_timer_output, TimerOutput::never, TimerOutput::wall_times)
  {
    TimerOutput::Scope scope(timer, "set up");
    mesh   = std::make_unique<BackgroundMesh<dim>>(scene.mesh, communicator);
    bodies = make_bodies(scene);
    mesh->share_cells(work_by_bodies(bodies));
    space = std::make_unique<GridSpace<dim>>(*mesh, scene.method.degree);
    for (const Body<dim> &body : bodies)
      body_names.push_back(body.name);
    materials = make_materials(scene, bodies);

    PointFields        fields;
    const std::string &method = scene.method.method;
    if (method == "GIMP")
      GimpBasis<dim>::request_fields(fields, scene.method.update_of_domains());
    else if (method == "CPDI1")
      Cpdi1Basis<dim>::request_fields(fields);
    else if (method == "CPDI2")
      Cpdi2Basis<dim>::request_fields(fields);
    StateFields<dim>(fields,
                     scene.method.strain_measure(),
                     std::any_of(materials.begin(),
                                 materials.end(),
                                 [](const auto &m) {
                                   return m->is_plastic();
                                 }));
    points       = std::make_unique<PointSet<dim>>(*mesh, fields);
    body_volumes = seed_bodies(bodies, make_seeder<dim>(scene.method), *points);
    points->allow_put_back(scene.method.put_back * mesh->cell_size());
    make_basis();
    state           = std::make_unique<State<dim>>(*space,
                                         *points,
                                         *basis,
                                         materials,
                                         scene.method.after_step(),
                                         scene.method.strain_measure());
    boundaries      = make_boundaries(scene);
    grid_conditions = make_grid_conditions(scene, *mesh);
    loads           = make_loads(scene, *mesh, body_names);
    system =
      std::make_unique<MechanicsSystem<dim>>(*state,
                                             boundaries,
                                             grid_conditions,
                                             loads,
                                             body_names,
                                             scene.method.empty_stiffness,
                                             &timer);
    mesh_motion = make_mesh_motion(scene, *mesh, boundaries, grid_conditions);
    if (mesh_motion.moves())
      {
        check_mesh_motion(mesh_motion, scene.time, *mesh, grid_conditions);
        system->move_mesh_by(mesh_motion, *mesh);
      }
    linear_solver = std::make_unique<LinearSolver>(scene.linear_solver, dim);
    probes        = std::make_unique<Probes<dim>>(
      scene.probes, *points, scene.method.after_step() == MeshAfterStep::reset);
  }



  template <int dim>
  void
  Simulation<dim>::make_basis()
  {
    std::vector<bool> is_seeded;
    for (const Body<dim> &body : bodies)
      is_seeded.push_back(body.shape != nullptr);
    const MethodParameters &method = scene.method;
    if (method.method == "GIMP")
      basis = std::make_unique<GimpBasis<dim>>(*space,
                                               *points,
                                               method.points_per_direction,
                                               is_seeded,
                                               method.update_of_domains(),
                                               method.split_domains);
    else if (method.method == "CPDI1")
      basis = std::make_unique<Cpdi1Basis<dim>>(*space,
                                                *points,
                                                make_seeder<dim>(method),
                                                bodies,
                                                method.split_domains);
    else if (method.method == "CPDI2")
      basis = std::make_unique<Cpdi2Basis<dim>>(*space,
                                                *points,
                                                make_seeder<dim>(method),
                                                bodies);
    else if (scene.method.degree == 1)
      basis = std::make_unique<CellBasis<dim, 1>>(*space, *points);
    else
      basis = std::make_unique<CellBasis<dim, 2>>(*space, *points);
    basis->initialise_points(*points);
  }



  /**
   * A motion without a value at the end of a step is found here, before
   * anything is computed or written; and a surface without a level at a body.
   */
  template <int dim>
  void
  Simulation<dim>::check_prescribed_motion()
  {
    const double size =
      (scene.time.end_time - scene.time.start_time) / scene.time.n_steps;
    for (unsigned int step = 0; step <= scene.time.n_steps; ++step)
      {
        const double t = scene.time.start_time + step * size;
        for (auto &boundary : boundaries)
          boundary.set_target(t);
        system->check_prescribed_values(t);
      }
    for (const auto &boundary : boundaries)
      for (const auto &in_cell : points->cells())
        boundary.is_far(points->position(in_cell.first), 0.);
  }



  /** A weight of nothing is a mistake, not a load; so is a push on nothing. */
  template <int dim>
  void
  Simulation<dim>::check_loads() const
  {
    for (const auto &force : loads.body_forces)
      for (unsigned int b = 0; b < bodies.size(); ++b)
        if (force.times_density && force.acts_on[b] &&
            !(materials[b]->density() > 0))
          throw InputError("section 'Loads/" + force.name +
                           "': found gravity on body '" + bodies[b].name +
                           "', whose material has no 'Density', allowed: "
                           "bodies with a density > 0");
    for (const auto &traction : loads.side_tractions)
      {
        unsigned int n_faces = 0;
        for (const auto &cell : mesh->triangulation().active_cell_iterators())
          if (cell->at_boundary() && space->is_active(cell))
            for (const auto &face : cell->face_iterators())
              n_faces +=
                face->at_boundary() && face->boundary_id() == traction.side;
        if (n_faces == 0)
          throw InputError("section 'Loads/" + traction.name +
                           "': found a side of the mesh without a body beside "
                           "it, allowed: a side that a body touches");
      }
  }



  /**
   * The body must lie on the inner side of a surface. Where there is none, a
   * constraint makes little sense, and the flux of Nitsche's method is that of
   * no material.
   */
  template <int dim>
  void
  Simulation<dim>::check_sides_of_boundaries()
  {
    const auto in_a_body = [this](const Point<dim> &x) {
      return std::any_of(bodies.begin(), bodies.end(), [&x](const auto &body) {
        return body.shape->contains(x);
      });
    };
    if (std::any_of(bodies.begin(), bodies.end(), [](const auto &body) {
          return !body.shape;
        }))
      return;
    for (const auto &boundary : boundaries)
      {
        std::vector<double> area(3, 0.); // inside, behind, all
        for (const auto &point : boundary.points())
          {
            const Tensor<1, dim> step = 1e-3 * point.h * point.normal;
            area[0] += in_a_body(point.x - step) ? point.JxW : 0.;
            area[1] += in_a_body(point.x + step) ? point.JxW : 0.;
            area[2] += point.JxW;
          }
        Utilities::MPI::sum(area, communicator, area);
        const std::string where = "Boundaries/" + boundary.name();
        if (area[0] == 0 && area[1] > 0)
          throw InputError(
            "section '" + where +
            "': found the body behind the surface, allowed: a surface whose "
            "normal points out of the body (in 2D the body is on the left of a "
            "line's points; reverse them)");
        if (area[0] == 0)
          notes.push_back(boundary.name() +
                          ": no body is beside it at the start");
        else if (area[0] < 0.99 * area[2])
          notes.push_back(
            boundary.name() + ": " +
            std::to_string(std::lround(100 * (1 - area[0] / area[2]))) +
            " % of its surface in the body's cells has no body on its inner "
            "side; end it with the body, or choose 'Enforcement = weighted'");
      }
  }



  template <int dim>
  void
  Simulation<dim>::begin_first_step()
  {
    system->begin_step(scene.time.start_time);
    const auto n_points = system->n_boundary_points();
    for (unsigned int b = 0; b < boundaries.size(); ++b)
      if (n_points[b] == 0)
        throw InputError("section 'Boundaries/" + boundaries[b].name() +
                         "': found a surface that touches no body, allowed: a "
                         "surface on or in a body");
    check_prescribed_motion();
    check_loads();
    check_sides_of_boundaries();
    if (state->strain_measure() == StrainMeasure::finite)
      for (const auto &boundary : boundaries)
        if (boundary.enforcement().w_constrained > 0)
          notes.push_back(boundary.name() +
                          ": its flux is elastic and of the increment of a "
                          "step; 'Enforcement = weighted' with the reaction "
                          "carried holds at any strain");
    probes->check_places(
      grid_evaluation<dim>(*space, state->nodal_increments()));
    const ExactSolution<dim> exact = scene.exact.solution();
    if (exact.displacement || exact.stress)
      error_norms(*points, exact, scene.time.end_time, false);
    system->set_target(scene.time.start_time);
    system->assemble(space->vector(), true);
    system->check_that_it_is_held(true);
  }



#define INSTANTIATE(dim)                                 \
  template Simulation<dim>::Simulation(Scene<dim> &,     \
                                       const MPI_Comm &, \
                                       Console &);       \
  template void Simulation<dim>::begin_first_step();
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
