// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// The part of Simulation that turns a scene into objects.

#include <moraine/run/simulation.h>

#include <moraine/core/exceptions.h>
#include <moraine/core/expression.h>
#include <moraine/core/nearest.h>
#include <moraine/points/combined_shapes.h>
#include <moraine/points/seeding.h>

#include <deal.II/base/mpi.h>

#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <fstream>
#include <sstream>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** dim numbers of a key as a point. */
    template <int dim>
    Point<dim>
    to_point(const std::vector<double> &numbers, const std::string &place)
    {
      if (numbers.size() != dim)
        throw InputError(place + ": found " + std::to_string(numbers.size()) +
                         " numbers, allowed: " + std::to_string(dim));
      Point<dim> point;
      for (unsigned int d = 0; d < dim; ++d)
        point[d] = numbers[d];
      return point;
    }



    /** A vector function from text; zero if the text is empty. */
    template <int dim>
    VectorFunction<dim>
    vector_function(const std::string &text, const std::string &place)
    {
      if (text.empty())
        return
          [](const Point<dim> &, const double) { return Tensor<1, dim>(); };
      const auto expression =
        std::make_shared<Expression<dim>>(text, place, dim);
      return [expression](const Point<dim> &x, const double t) {
        return expression->vector_value(x, t);
      };
    }



    /** Flags for the components named "x, y"; all if nothing is named. */
    template <int dim>
    std::array<bool, dim>
    component_flags(const std::string &names, const std::string &place)
    {
      std::array<bool, dim> flags{};
      for (const std::string &name : Utilities::split_string_list(names, ','))
        {
          const int c = name[0] - 'x';
          if (c >= dim)
            throw InputError(place + ": found '" + name + "', allowed: x, y");
          flags[c] = true;
        }
      if (names.empty())
        flags.fill(true);
      return flags;
    }



    template <int dim>
    double
    common_volume(const std::shared_ptr<const Shape<dim>>          &a,
                  const std::shared_ptr<const Shape<dim>>          &b,
                  const typename ConvexPolytope<dim>::CellVertices &vertices)
    {
      return CombinedShape<dim>(CombinedShape<dim>::Operation::intersect, a, b)
        .clip(ConvexPolytope<dim>(vertices))
        .volume;
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



    template <int dim>
    RigidMotion<dim>
    make_motion(const BoundaryParameters<dim> &parameters,
                const std::string             &section)
    {
      using Curve = typename RigidMotion<dim>::Curve;
      std::array<Curve, dim> translation;
      if (!parameters.translation.empty())
        {
          const auto expression =
            std::make_shared<Expression<dim>>(parameters.translation,
                                              place(section, "Translation"),
                                              dim);
          for (unsigned int d = 0; d < dim; ++d)
            translation[d] = [expression, d](const double t) {
              return expression->value(Point<dim>(), t, d);
            };
        }
      Curve angle;
      if (!parameters.rotation_angle.empty())
        {
          const auto curve =
            std::make_shared<TimeCurve>(parameters.rotation_angle,
                                        place(section, "Rotation angle"));
          angle = [curve](const double t) { return curve->value(t); };
        }
      Point<dim> centre;
      if (!parameters.rotation_centre.empty())
        centre = to_point<dim>(parameters.rotation_centre,
                               place(section, "Rotation centre"));
      Tensor<1, dim> axis = Point<dim>::unit_vector(dim - 1);
      if (!parameters.rotation_axis.empty())
        axis = to_point<dim>(parameters.rotation_axis,
                             place(section, "Rotation axis"));
      return RigidMotion<dim>(translation, angle, centre, axis);
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
    mesh  = std::make_unique<BackgroundMesh<dim>>(scene.mesh, communicator);
    space = std::make_unique<GridSpace<dim>>(*mesh, scene.method.degree);
    PointFields fields;
    if (scene.method.method == "GIMP")
      GimpBasis<dim>::request_fields(fields);
    points = std::make_unique<PointSet<dim>>(*mesh, fields);
    make_bodies();
    make_basis();
    state = std::make_unique<State<dim>>(
      *space, *points, *basis, materials, scene.method.after_step());
    make_boundaries();
    make_grid_conditions();
    make_loads();
    system =
      std::make_unique<MechanicsSystem<dim>>(*state,
                                             boundaries,
                                             grid_conditions,
                                             loads,
                                             body_names,
                                             timer,
                                             scene.method.empty_stiffness);
    linear_solver = std::make_unique<LinearSolver>(scene.linear_solver, dim);
    probes        = std::make_unique<Probes<dim>>(
      scene.probes, *points, scene.method.after_step() == MeshAfterStep::reset);
  }



  template <int dim>
  void
  Simulation<dim>::make_bodies()
  {
    std::map<std::string, ShapeParameters<dim>> shape_parameters;
    for (const auto &[name, body] : scene.bodies)
      shape_parameters[name] = body.shape;
    const NamedShapes<dim> shapes = make_shapes(shape_parameters, "Bodies");

    // What another body is made from is a tool without material of its own.
    std::set<std::string> operands;
    for (const auto &[name, body] : scene.bodies)
      operands.insert(body.shape.operands.begin(), body.shape.operands.end());

    std::vector<std::shared_ptr<const Shape<dim>>> in_order;
    for (const auto &[name, body] : scene.bodies)
      {
        if (operands.count(name) > 0)
          continue;
        body_names.push_back(name);
        for (const auto &[material_name, parameters] : scene.materials)
          if (body.material == material_name || scene.materials.size() == 1)
            materials.push_back(
              make_material(parameters, "Materials/" + material_name));
        in_order.push_back(body.is_seeded_by_cells() ? shapes.at(name) :
                                                       nullptr);
      }
    seed(in_order);
    for (const auto &[name, body] : scene.bodies)
      for (unsigned int b = 0; b < body_names.size(); ++b)
        if (name == body_names[b] && body.shape.is_point_file())
          insert_point_file(body.shape.point_file, b);
        else if (name == body_names[b] && !body.is_seeded_by_cells())
          insert_point_grid(body, b);
    points->finish_insertion();
    check_bodies(in_order);
  }



  template <int dim>
  void
  Simulation<dim>::seed(
    const std::vector<std::shared_ptr<const Shape<dim>>> &shapes)
  {
    const bool         fe = scene.method.is_finite_element();
    const unsigned int n_per_direction =
      fe ? scene.method.degree + 1 : scene.method.points_per_direction;
    const CellSeeder<dim> seeder(n_per_direction,
                                 fe || scene.method.point_layout == "Gauss" ?
                                   PointLayout::gauss :
                                   PointLayout::equal);
    const unsigned int    n_ids = seeder.max_points();
    first_free_id =
      mesh->triangulation().n_active_cells() * shapes.size() * n_ids;

    std::string                   overlap;
    std::vector<SeededPoint<dim>> seeded;
    for (const auto &cell : mesh->triangulation().active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const auto                vertices = vertices_of<dim>(cell);
          std::vector<unsigned int> earlier;
          for (unsigned int b = 0; b < shapes.size(); ++b)
            {
              if (!shapes[b])
                continue;
              seeded.clear();
              seeder.seed(vertices, *shapes[b], seeded);
              if (!seeded.empty())
                {
                  for (const unsigned int other : earlier)
                    if (overlap.empty() &&
                        common_volume<dim>(shapes[other], shapes[b], vertices) >
                          1e-10 * cell->measure())
                      {
                        std::ostringstream message;
                        message << "section 'Bodies': '" << body_names[other]
                                << "' and '" << body_names[b]
                                << "' overlap near (" << cell->center()
                                << "), allowed: bodies that share no volume";
                        overlap = message.str();
                      }
                  earlier.push_back(b);
                }
              // The id counts sub-cells of cells, so it does not depend on
              // the number of ranks.
              for (unsigned int i = 0; i < seeded.size(); ++i)
                points->insert(cell,
                               seeded[i].position,
                               mesh->mapping().transform_real_to_unit_cell(
                                 cell, seeded[i].position),
                               (cell->active_cell_index() * shapes.size() + b) *
                                   n_ids +
                                 i,
                               b,
                               seeded[i].volume);
            }
        }
    for (const std::string &message :
         Utilities::MPI::all_gather(communicator, overlap))
      if (!message.empty())
        throw InputError(message);
  }



  template <int dim>
  void
  Simulation<dim>::insert_point_file(const std::string &file,
                                     const unsigned int body)
  {
    if (!std::ifstream(file))
      throw InputError(place("Bodies/" + body_names[body], "Point file") +
                       ": found '" + file +
                       "', which cannot be read, allowed: the path of a CSV "
                       "file");
    const auto content = PointFile<dim>::read(file);
    insert_points(content.positions,
                  content.volumes,
                  body,
                  [&](const unsigned int i) {
                    return file + ':' + std::to_string(content.lines[i]);
                  });
  }



  template <int dim>
  void
  Simulation<dim>::insert_point_grid(const BodyParameters<dim> &parameters,
                                     const unsigned int         body)
  {
    const std::string    section   = "Bodies/" + body_names[body];
    const Placement<dim> placement = make_placement(parameters.shape, section);
    const Point<dim>     lower  = to_point<dim>(parameters.shape.lower_corner,
                                           place(section, "Lower corner"));
    Tensor<1, dim>       length = to_point<dim>(parameters.shape.upper_corner,
                                          place(section, "Upper corner")) -
                            lower;
    const auto  &n        = parameters.point_grid;
    double       volume   = 1;
    unsigned int n_points = 1;
    for (unsigned int d = 0; d < dim; ++d)
      {
        length[d] /= n[d];
        volume *= length[d];
        n_points *= n[d];
      }
    std::vector<Point<dim>> positions;
    for (unsigned int i = 0; i < n_points; ++i)
      {
        Point<dim>   x    = lower;
        unsigned int rest = i;
        for (unsigned int d = 0; d < dim; rest /= n[d], ++d)
          x[d] += (rest % n[d] + 0.5) * length[d];
        positions.push_back(placement.apply(x));
      }
    insert_points(positions,
                  std::vector<double>(n_points, volume),
                  body,
                  [&](const unsigned int) {
                    return "section '" + section + "', key 'Point grid'";
                  });
  }



  template <int dim>
  void
  Simulation<dim>::insert_points(
    const std::vector<Point<dim>>                        &positions,
    const std::vector<double>                            &volumes,
    const unsigned int                                    body,
    const std::function<std::string(const unsigned int)> &where)
  {
    const GridTools::Cache<dim> cache(mesh->triangulation(), mesh->mapping());
    typename Triangulation<dim>::active_cell_iterator hint;
    for (unsigned int i = 0; i < positions.size(); ++i)
      {
        const auto [cell, reference] =
          GridTools::find_active_cell_around_point(cache, positions[i], hint);
        if (cell.state() != IteratorState::valid)
          {
            std::ostringstream message;
            message << where(i) << ": found a point at (" << positions[i]
                    << "), allowed: points inside the mesh";
            throw InputError(message.str());
          }
        hint = cell;
        if (cell->is_locally_owned())
          points->insert(
            cell, positions[i], reference, first_free_id + i, body, volumes[i]);
      }
    first_free_id += positions.size();
  }



  template <int dim>
  void
  Simulation<dim>::check_bodies(
    const std::vector<std::shared_ptr<const Shape<dim>>> &shapes) const
  {
    std::vector<double> volumes(body_names.size(), 0.);
    for (unsigned int p = 0; p < points->n_local(); ++p)
      volumes[points->body(p)] += points->volume(p);
    Utilities::MPI::sum(volumes, communicator, volumes);
    const BoundingBox<dim> box =
      GridTools::compute_bounding_box(mesh->triangulation());
    for (unsigned int b = 0; b < volumes.size(); ++b)
      {
        const std::string where = "section 'Bodies/" + body_names[b] + "': ";
        if (volumes[b] == 0)
          throw InputError(where +
                           "found no part of the body inside the mesh, "
                           "allowed: a body that is not empty and lies in the "
                           "mesh");
        if (!shapes[b] || !is_finite(shapes[b]->bounding_box()))
          continue;
        const auto whole = ConvexPolytope<dim>(
          shapes[b]->bounding_box().get_boundary_points().first,
          shapes[b]->bounding_box().get_boundary_points().second);
        if (fits_into(shapes[b]->bounding_box(), box))
          continue;
        const double volume = shapes[b]->clip(whole).volume;
        if (volumes[b] >
            (1 - (shapes[b]->is_straight() ? 1e-9 : 1e-3)) * volume)
          continue;
        std::ostringstream message;
        message << where << "found " << 100 * (1 - volumes[b] / volume)
                << " % of its volume outside the mesh, which is ("
                << box.get_boundary_points().first << ") to ("
                << box.get_boundary_points().second
                << "), allowed: a body in the mesh; only half-spaces and "
                   "expressions are cut by it";
        throw InputError(message.str());
      }
  }



  template <int dim>
  void
  Simulation<dim>::make_basis()
  {
    std::vector<bool> is_seeded;
    for (const std::string &name : body_names)
      for (const auto &[body_name, body] : scene.bodies)
        if (body_name == name)
          is_seeded.push_back(body.is_seeded_by_cells());
    if (scene.method.method == "GIMP")
      basis = std::make_unique<GimpBasis<dim>>(
        *space, *points, scene.method.points_per_direction, is_seeded);
    else if (scene.method.degree == 1)
      basis = std::make_unique<CellBasis<dim, 1>>(*space, *points);
    else
      basis = std::make_unique<CellBasis<dim, 2>>(*space, *points);
    basis->initialise_points(*points);
  }



  template <int dim>
  void
  Simulation<dim>::make_boundaries()
  {
    for (const auto &[name, parameters] : scene.boundaries)
      {
        const std::string section = "Boundaries/" + name;
        Constraint<dim>   constraint;
        if (parameters.constraint == "roller")
          constraint.kind = Constraint<dim>::roller;
        else if (parameters.constraint == "components")
          {
            constraint.kind = Constraint<dim>::components;
            if (parameters.components.empty())
              throw InputError(place(section, "Components") +
                               ": found nothing, allowed: the components to "
                               "constrain, as x, y");
            constraint.component =
              component_flags<dim>(parameters.components,
                                   place(section, "Components"));
          }
        boundaries.emplace_back(name,
                                make_surface<dim>(parameters.surface, section),
                                make_motion<dim>(parameters, section),
                                vector_function<dim>(parameters.displacement,
                                                     place(section,
                                                           "Displacement")),
                                constraint,
                                parameters.enforcement.enforcement_of(),
                                parameters.penetration_limit);
      }
  }



  template <int dim>
  void
  Simulation<dim>::make_grid_conditions()
  {
    for (const auto &[name, parameters] : scene.grid_conditions)
      {
        const std::string  section = "Grid conditions/" + name;
        GridCondition<dim> condition;
        condition.name = name;
        if (!parameters.side.empty())
          condition.side =
            mesh->boundary_id(parameters.side, place(section, "Side"));
        if (!parameters.lower_corner.empty() ||
            !parameters.upper_corner.empty())
          condition.region = BoundingBox<dim>(
            std::make_pair(to_point<dim>(parameters.lower_corner,
                                         place(section, "Lower corner")),
                           to_point<dim>(parameters.upper_corner,
                                         place(section, "Upper corner"))));
        if (!condition.side && !condition.region)
          throw InputError("section '" + section +
                           "': found neither 'Side' nor 'Lower corner' and "
                           "'Upper corner', allowed: one of them or both");
        condition.component =
          component_flags<dim>(parameters.components,
                               place(section, "Components"));
        condition.value = vector_function<dim>(parameters.displacement,
                                               place(section, "Displacement"));
        grid_conditions.push_back(condition);
      }
  }



  template <int dim>
  void
  Simulation<dim>::make_loads()
  {
    for (const auto &[name, parameters] : scene.loads)
      {
        const std::string section = "Loads/" + name;
        if (parameters.value.empty())
          throw InputError(place(section, "Value") +
                           ": found nothing, allowed: " + std::to_string(dim) +
                           " expressions separated by ';'");
        VectorFunction<dim> value =
          vector_function<dim>(parameters.value, place(section, "Value"));
        if (!parameters.curve.empty())
          {
            const auto curve =
              std::make_shared<TimeCurve>(parameters.curve,
                                          place(section, "Curve"));
            value = [value, curve](const Point<dim> &x, const double t) {
              return curve->value(t) * value(x, t);
            };
          }
        if (parameters.type == "body force" || parameters.type == "gravity")
          {
            BodyForce<dim> force{name,
                                 value,
                                 parameters.type == "gravity",
                                 std::vector<bool>(body_names.size(),
                                                   parameters.bodies.empty())};
            for (const std::string &body : parameters.bodies)
              {
                const auto found =
                  std::find(body_names.begin(), body_names.end(), body);
                if (found == body_names.end())
                  throw InputError(place(section, "Bodies") + ": found '" +
                                   body + "', allowed: names of bodies" +
                                   suggest(body, body_names));
                force.acts_on[found - body_names.begin()] = true;
              }
            loads.body_forces.push_back(force);
          }
        else if (parameters.type == "side traction")
          loads.side_tractions.push_back(
            {name,
             mesh->boundary_id(parameters.side, place(section, "Side")),
             value});
        else if (parameters.type == "surface traction")
          {
            const auto surface = make_surface<dim>(parameters.surface, section);
            loads.carried.emplace_back(name, value, places_on(*surface, *mesh));
          }
        else
          {
            typename CarriedLoad<dim>::Place at;
            at.x =
              to_point<dim>(parameters.location, place(section, "Location"));
            at.weight = 1;
            loads.carried.emplace_back(
              name,
              value,
              std::vector<typename CarriedLoad<dim>::Place>(1, at));
          }
      }
  }



  /** A motion without a value at the end of a step is found here, before
   * anything is computed or written. */
  template <int dim>
  void
  Simulation<dim>::check_prescribed_motion()
  {
    const double size =
      (scene.time.end_time - scene.time.start_time) / scene.time.n_steps;
    for (auto &boundary : boundaries)
      for (unsigned int step = 1; step <= scene.time.n_steps; ++step)
        boundary.set_target(scene.time.start_time + step * size);
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
