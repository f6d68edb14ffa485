// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/run/model.h>

#include <moraine/assembly/absorbing_term.h>
#include <moraine/assembly/aggregation.h>
#include <moraine/assembly/contact_term.h>
#include <moraine/assembly/hourglass_stiffness.h>
#include <moraine/assembly/load_terms.h>
#include <moraine/assembly/water_term.h>
#include <moraine/assembly/conflict_term.h>
#include <moraine/basis/rim_of_boxes.h>
#include <moraine/core/archive.h>
#include <moraine/core/exceptions.h>
#include <moraine/core/ranges.h>
#include <moraine/core/words.h>
#include <moraine/geometry/covered_pieces.h>
#include <moraine/run/initial_stress.h>
#include <moraine/scene/scene_bodies.h>
#include <moraine/scene/scene_conditions.h>
#include <moraine/scene/scene_mesh_motion.h>

#include <deal.II/base/mpi.h>

#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** Of a cell without points over that of one with points. */
    constexpr double work_of_empty_cell = 0.05;



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
          else if (is_inside(boxes[b], centre, size))
            filled =
              std::max(filled, filled_part(*bodies[b].shape, centre, size));
        return std::clamp(filled, work_of_empty_cell, 1.);
      };
    }



    template <int dim>
    VelocityTransfer
    velocity_transfer(const Scene<dim> &scene)
    {
      return scene.method.after_step() == MeshAfterStep::reset ?
               VelocityTransfer(scene.first_dynamic_stage().time.integrator) :
               VelocityTransfer();
    }



    /** Whether a boundary absorbs before the stage that starts at @p t, and
     * after. */
    template <int dim>
    bool
    absorbs_around(const double                  t,
                   const Scene<dim>             &scene,
                   const AbsorbingBoundary<dim> &boundary)
    {
      bool before = false, after = false;
      for (const auto &[name, stage] : scene.stages)
        if (absorbs_in(stage, scene, boundary))
          {
            before = before || stage.time.start_time < t;
            after  = after || stage.time.start_time > t;
          }
      return before && after;
    }



    /** The bodies that a load may lie on: as drawn they are within half a cell
     * of one of its places. All of them if there is none. */
    template <int dim>
    std::vector<std::string>
    bodies_under(const CarriedLoad<dim> &load, const Model<dim> &model)
    {
      const double             margin = 0.5 * model.mesh->cell_size();
      std::vector<std::string> names;
      for (const Body<dim> &body : model.bodies)
        {
          const auto &shape  = body.filled();
          const auto &places = load.places_as_drawn();
          if (!shape || any_of(places, [&](const auto &place) {
                return covers_place(*shape, place.x, margin);
              }))
            names.push_back(body.name);
        }
      return names.empty() ? model.body_names : names;
    }



    /** Whether a load that does not push in this stage pushes in a later one,
     * on material that is there now. */
    template <int dim>
    bool
    is_carried_to_later_stage(const CarriedLoad<dim> &load,
                              const StageParameters  &stage,
                              const Scene<dim>       &scene,
                              const Model<dim>       &model)
    {
      const auto any_before = [&](const auto &holds) {
        return any_of(scene.stages, [&](const auto &other) {
          return other.second.time.start_time < stage.time.start_time &&
                 holds(other.second);
        });
      };
      const bool has_pushed = any_before([&](const StageParameters &other) {
        return contains(other.loads, load.name());
      });
      const std::vector<std::string> under = bodies_under(load, model);
      // Its surface may be that of a body still to come, unless it has pushed;
      // then of one that went and comes back.
      const auto may_be_its = [&](const std::string &body) {
        return contains(under, body) && !contains(stage.bodies, body) &&
               (!has_pushed || any_before([&](const StageParameters &other) {
                 return contains(other.bodies, body);
               }));
      };
      return any_of(scene.stages, [&](const auto &other) {
        const auto &bodies_then = other.second.bodies;
        return other.second.time.start_time > stage.time.start_time &&
               contains(other.second.loads, load.name()) &&
               none_of(bodies_then, may_be_its);
      });
    }



    /** Finds the rim of a body as drawn, or that of the boxes of its points if
     * these are given. */
    template <int dim>
    typename ContactBoundary<dim>::Finder
    finder_of_rim(const ShapesOfBodies<dim> &shapes,
                  const PointSet<dim>       &points,
                  const Basis<dim>          &basis)
    {
      return [shapes, &points, &basis](const BackgroundMesh<dim> &mesh,
                                       const unsigned int         body) {
        return shapes[body] ? places_on<dim>(*shapes[body]->rim(),
                                             mesh,
                                             nullptr,
                                             Spacing::through_mesh) :
                              rim_of_boxes(points, basis, body);
      };
    }



    /** Of bodies as drawn; of those whose points are given, whole cells. */
    template <int dim>
    Covers<dim>
    covers_of_bodies(const std::vector<Body<dim>> &bodies,
                     const BackgroundMesh<dim>    &mesh,
                     const PointSet<dim>          &points)
    {
      if (const Covers<dim> covers = covers_of(shapes_of(bodies)))
        return covers;
      return [&mesh, filled = points.volumes_in_cells()](const Point<dim> &x,
                                                         const double) {
        const auto found = mesh.cell_around(x);
        return found && filled[found->first->active_cell_index()] > 0;
      };
    }



    /** Of all that holds in a stage. */
    template <int dim>
    std::unique_ptr<Term<dim>>
    make_conflict_term(const StageParameters                 &stage,
                       std::vector<ImplicitBoundary<dim>>    &boundaries,
                       const std::vector<GridCondition<dim>> &conditions)
    {
      constexpr unsigned int               most_spans = 8;
      std::vector<ImplicitBoundary<dim> *> acting;
      for (auto &boundary : boundaries)
        if (contains(stage.boundaries, boundary.name()) &&
            !contains(stage.absorbing, boundary.name()))
          acting.push_back(&boundary);
      const TimeParameters &time = stage.time;
      const unsigned int    n    = std::min(time.n_steps, most_spans);
      std::vector<double>   times;
      // Of uneven spans, lest they are periods of a motion.
      for (unsigned int k = 0; k <= n; ++k)
        times.push_back(time.start_time +
                        std::pow(double(k) / n, n < most_spans ? 1. : 1.3) *
                          (time.end_time - time.start_time));
      return std::make_unique<ConflictTerm<dim>>(
        acting, acting_conditions(conditions, stage), times);
    }



    /** Loads of type gravity that act in a stage. */
    template <int dim>
    std::vector<const BodyForce<dim> *>
    gravities_of(const StageParameters &stage, const Loads<dim> &loads)
    {
      std::vector<const BodyForce<dim> *> gravities;
      for (const auto &force : loads.body_forces)
        if (force.times_density && contains(stage.loads, force.name))
          gravities.push_back(&force);
      return gravities;
    }



    /** @throws InputError if no point has water in any stage; where points
     * move, if none could come to it in the mesh. Collective. */
    template <int dim>
    void
    check_that_water_is_met(const Scene<dim> &scene, const Model<dim> &model)
    {
      constexpr unsigned int n_times  = 8;
      double                 greatest = std::numeric_limits<double>::lowest();
      const auto             base =
        GridTools::compute_bounding_box(model.mesh->triangulation())
          .lower_bound(dim - 1);
      const bool moves = scene.method.after_step() != MeshAfterStep::keep;
      for (const auto &[name, stage] : scene.stages)
        if (const auto water = make_water(scene, stage))
          for (unsigned int k = 0; k <= n_times; ++k)
            for (unsigned int p = 0; p < model.points->n_local(); ++p)
              {
                const TimeParameters &time = stage.time;
                const double          t =
                  time.start_time +
                  double(k) / n_times * (time.end_time - time.start_time);
                Point<dim> x = model.points->position(p);
                if (moves)
                  x[dim - 1] = base;
                greatest = std::max({greatest,
                                     water->uncut_pressure(x, t),
                                     water->outer_pressure(x, t)});
              }
      if (Utilities::MPI::max(greatest, model.space->communicator()) > 0)
        return;
      for (const auto &[name, stage] : scene.stages)
        if (stage.water.any())
          reject(water_section(name),
                 stage.water.level.empty() ? "Pressure" : "Level",
                 stage.water.level.empty() ? stage.water.pressure :
                                             stage.water.level,
                 stage.water.level.empty() ?
                   "one that is positive somewhere in a body" :
                 moves ? "a height above the base of the mesh" :
                         "a height above the lowest point of the bodies");
    }
  } // namespace



  template <int dim>
  Model<dim>::Model(const Scene<dim> &scene,
                    const MPI_Comm   &communicator,
                    TimerOutput      &timer)
  {
    TimerOutput::Scope scope(timer, "set up");
    mesh = std::make_unique<BackgroundMesh<dim>>(scene.mesh, communicator);
    check_groups(scene, *mesh);
    bodies = make_bodies(scene);
    mesh->share_cells(work_by_bodies(bodies));
    space = std::make_unique<GridSpace<dim>>(*mesh, scene.method.degree);
    for (const Body<dim> &body : bodies)
      body_names.push_back(body.name);
    materials = make_materials(scene, bodies, *mesh);
    make_points(scene);
    state                          = std::make_unique<State<dim>>(*space,
                                         *points,
                                         *basis,
                                         materials,
                                         scene.method.after_step(),
                                         scene.method.strain_measure(),
                                         scene.method.weights(),
                                         scene.method.volumetric());
    const std::vector<double> fill = fill_of_bodies(scene, bodies);
    if (any_of(fill, [](const double f) { return f > 0; }))
      state->aggregate_below(fill, scene.method.has_ghost_term());
    boundaries      = make_boundaries(scene);
    grid_conditions = make_grid_conditions(scene, *mesh);
    loads           = make_loads(scene,
                       *mesh,
                       body_names,
                       united(shapes_of(bodies)),
                       covers_of_bodies(bodies, *mesh, *points));
    absorbing_boundaries =
      make_absorbing_boundaries(scene, *mesh, body_names, shapes_of(bodies));
    contact_boundaries = make_contact_boundaries(
      scene, finder_of_rim(shapes_of(bodies), *points, *basis));
    if (scene.has_water())
      loads.water = std::make_unique<WaterInBodies<dim>>(WaterInBodies<dim>{
        {},
        extra_densities(scene, body_names),
        points->fields().find(FieldNames<dim>::pore_pressure),
        points->fields().find(FieldNames<dim>::total_stress)});
    set_initial_stress(scene, *this);
    if (scene.is_dynamic())
      {
        const auto &integrator = scene.first_dynamic_stage().time.integrator;
        motion                 = std::make_unique<Motion<dim>>(*state,
                                               *points,
                                               TimeIntegrator(integrator),
                                               velocity_transfer(scene),
                                               integrator.mass == "lumped");
      }
    system = std::make_unique<MechanicsSystem<dim>>(*state,
                                                    Terms<dim>(),
                                                    body_names,
                                                    &timer);
    probes = std::make_unique<Probes<dim>>(scene.probes,
                                           *points,
                                           body_names,
                                           scene.method.after_step() ==
                                             MeshAfterStep::reset);
    keep_for_later(scene);
    set_stage(scene, 0);
    if (loads.water)
      {
        check_that_water_is_met(scene, *this);
        set_water_at_points(*loads.water, scene.start_time(), *state, *points);
      }
    mesh_motion = make_mesh_motion(scene, *mesh, boundaries, grid_conditions);
    if (mesh_motion.moves())
      {
        for (const auto &[name, stage] : scene.stages)
          check_mesh_motion(mesh_motion,
                            scene.start_time(),
                            stage.time,
                            *mesh,
                            acting_conditions(grid_conditions, stage));
        system->move_mesh_by(mesh_motion, *mesh);
      }
    linear_solver = std::make_unique<LinearSolver>(scene.linear_solver, dim);
  }



  template <int dim>
  Terms<dim>
  Model<dim>::terms_of(const Scene<dim> &scene, const StageParameters &stage)
  {
    const auto active = [&](const std::string &section,
                            const std::string &name) {
      if (section == "Loads")
        return contains(stage.loads, name);
      return !contains(stage.absorbing, name) &&
             contains(section == "Boundaries" ? stage.boundaries :
                                                stage.grid_conditions,
                      name);
    };
    const IntegratorParameters &integrator = stage.time.integrator;
    Terms<dim>                  terms =
      make_terms(boundaries,
                 grid_conditions,
                 loads,
                 scene.method.fictitious_stiffness,
                 integrator.dynamic(),
                 TimeIntegrator(integrator).forces_in_the_middle(),
                 scene.method.chosen().make_internal_force(*space, *points),
                 active,
                 shapes_of(bodies));
    // What pushes in a later stage goes with the material from now on.
    for (auto &load : loads.carried)
      if (!contains(stage.loads, load.name()) &&
          is_carried_to_later_stage(load, stage, scene, *this))
        terms.push_back(
          std::make_unique<CarriedLoadTerm<dim>>(load, /* acts = */ false));
    if (scene.method.integrates_too_little())
      terms.push_back(std::make_unique<HourglassStiffness<dim>>());
    if (state->strict_aggregates())
      terms.push_back(std::make_unique<Aggregation<dim>>());
    else if (state->aggregates())
      {
        const double factor = scene.method.ghost_factor;
        terms.push_back(std::make_unique<GhostStiffness<dim>>(factor));
        if (integrator.dynamic())
          terms.push_back(std::make_unique<GhostMass<dim>>(factor));
      }
    const std::vector<RayleighFactors> damping = make_damping(scene, bodies);
    if (integrator.dynamic() &&
        any_of(damping, [](const auto &factors) { return factors.damps(); }))
      terms.push_back(std::make_unique<RayleighDamping<dim>>(damping));
    for (auto &boundary : boundaries)
      if (contains(stage.absorbing, boundary.name()))
        terms.push_back(std::make_unique<ReleasedBoundaryTerm<dim>>(boundary));
    for (auto &boundary : absorbing_boundaries)
      if (absorbs_in(stage, scene, boundary))
        terms.push_back(std::make_unique<AbsorbingTerm<dim>>(boundary));
      else if (absorbs_around(stage.time.start_time, scene, boundary))
        terms.push_back(
          std::make_unique<AbsorbingTerm<dim>>(boundary, /* acts = */ false));
    std::vector<bool> is_there;
    for (const std::string &body : body_names)
      is_there.push_back(contains(stage.bodies, body));
    for (auto &boundary : contact_boundaries)
      terms.push_back(std::make_unique<ContactTerm<dim>>(
        boundary, is_there, contains(stage.boundaries, boundary.name())));
    terms.push_back(make_conflict_term(stage, boundaries, grid_conditions));
    if (loads.water)
      terms.push_back(
        std::make_unique<WaterTerm<dim>>(*loads.water,
                                         *points,
                                         gravities_of(stage, loads),
                                         state->strain_measure()));
    return terms;
  }



  template <int dim>
  void
  Model<dim>::keep_for_later(const Scene<dim> &scene)
  {
    present.assign(body_names.size(), true);
    later.resize(body_names.size());
    for (unsigned int b = 0; b < body_names.size(); ++b)
      if (scene.comes_later(body_names[b]))
        later[b] = points->records_of(b);
  }



  template <int dim>
  void
  Model<dim>::set_bodies(const std::vector<std::string> &names)
  {
    const unsigned int n = body_names.size();
    std::vector<bool>  stay(n), come(n), wanted(n);
    for (unsigned int b = 0; b < n; ++b)
      {
        wanted[b] = contains(names, body_names[b]);
        stay[b]   = wanted[b] && present[b];
        come[b]   = wanted[b] && !present[b];
      }
    if (wanted == present)
      return;
    exchange_points(stay, come);
    present = wanted;
  }



  template <int dim>
  void
  Model<dim>::exchange_points(const std::vector<bool> &stay,
                              const std::vector<bool> &come)
  {
    std::vector<typename PointSet<dim>::Record> others;
    for (unsigned int b = 0; b < come.size(); ++b)
      if (come[b])
        others.insert(others.end(), later[b].begin(), later[b].end());
    // Nodes get other numbers.
    Archive of_nodes;
    space->write(of_nodes);
    if (motion)
      motion->write(of_nodes);
    points->exchange_bodies(stay, others);
    if (mesh_motion.moves())
      points->find_cells();
    state->points_changed();
    state->begin_step();
    space->read(of_nodes);
    if (motion)
      motion->read(of_nodes);
    state->place_by_nodes(come);
    if (motion)
      motion->slow_down(come);
  }



  template <int dim>
  void
  Model<dim>::set_stage(const Scene<dim> &scene, const unsigned int k)
  {
    const StageParameters &stage = scene.stages[k].second;
    set_bodies(stage.bodies);
    if (loads.water)
      loads.water->water = make_water(scene, stage);
    for (auto &condition : grid_conditions)
      condition.start = stage.time.start_time;
    for (ImplicitBoundary<dim> &boundary : boundaries)
      if (k > 0 && contains(stage.boundaries, boundary.name()) &&
          !contains(scene.stages[k - 1].second.boundaries, boundary.name()))
        boundary.forget();
    for (auto &load : loads.carried)
      if (k > 0 && !contains(scene.stages[k - 1].second.loads, load.name()) &&
          !is_carried_to_later_stage(
            load, scene.stages[k - 1].second, scene, *this))
        load.forget();
    system->set_terms(terms_of(scene, stage));
    const bool dynamic = stage.time.integrator.dynamic();
    if (dynamic)
      {
        motion->balance_means(
          stage.time.integrator.integrator == "Newmark" &&
          !motion->points_carry() &&
          state->mesh_after_step() != MeshAfterStep::keep &&
          any_of(boundaries, [&stage](const auto &boundary) {
            // Nitsche's fluxes would alternate with it.
            return boundary.is_curved_roller() &&
                   !boundary.enforcement().is_nitsche() &&
                   contains(stage.boundaries, boundary.name()) &&
                   !contains(stage.absorbing, boundary.name());
          }));
        motion->set_integrator(TimeIntegrator(stage.time.integrator));
      }
    system->set_motion(dynamic ? motion.get() : nullptr);
  }



  template <int dim>
  void
  Model<dim>::make_points(const Scene<dim> &scene)
  {
    MethodParameters<dim> parameters = scene.method;
    const Method<dim>    &method     = parameters.chosen();
    // Halves of a point would not share its force.
    for (const auto &[name, load] : scene.loads)
      if (load.type == "force on points")
        parameters.split_domains = "false";

    PointFields fields;
    method.request_fields(parameters, fields);
    StateFields<dim>(fields, parameters.strain_measure(), materials);
    if (scene.is_dynamic())
      Motion<dim>::request_fields(velocity_transfer(scene),
                                  fields,
                                  scene.divides_steps());
    if (scene.is_dynamic() && method.recovers_strains &&
        parameters.strain_measure() == StrainMeasure::small)
      fields.request(FieldNames<dim>::stress_of_recovery);
    if (parameters.strain_measure() == StrainMeasure::finite &&
        parameters.splits_domains() &&
        any_of(scene.stages, [](const auto &stage) {
          return stage.second.reset_displacements;
        }))
      fields.request(FieldNames<dim>::deformation_gradient_then);
    if (scene.has_water())
      {
        fields.request(FieldNames<dim>::pore_pressure);
        fields.request(FieldNames<dim>::total_stress);
      }
    request_columns(bodies, fields);
    points = std::make_unique<PointSet<dim>>(*mesh, fields);
    const std::vector<double> volumes =
      seed_bodies(bodies,
                  method.make_seeder(parameters),
                  *points,
                  [&](const unsigned int a, const unsigned int b) {
                    return scene.are_together(body_names[a], body_names[b]);
                  });
    for (unsigned int b = 0; b < bodies.size(); ++b)
      bodies[b].volume = volumes[b];
    points->set_return_tolerance(parameters.return_tolerance *
                                 mesh->cell_size());
    basis = method.make_basis({parameters, *space, *points, bodies});
    basis->initialise_points(*points);
  }



  template <int dim>
  typename Facts<dim>::Objects
  Model<dim>::objects(const Scene<dim> &scene) const
  {
    return {scene,
            bodies,
            body_names,
            present,
            materials,
            *mesh,
            *space,
            *points,
            *basis,
            *state,
            motion.get(),
            boundaries,
            grid_conditions,
            absorbing_boundaries,
            loads,
            mesh_motion,
            *system};
  }



  template struct Model<2>;
  template struct Model<3>;
} // namespace moraine
