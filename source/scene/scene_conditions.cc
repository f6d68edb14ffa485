// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/scene/scene_conditions.h>

#include <moraine/core/arithmetic.h>
#include <moraine/core/exceptions.h>
#include <moraine/core/expression.h>
#include <moraine/core/words.h>
#include <moraine/scene/scene_bodies.h>
#include <moraine/scene/surface_motion.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>

namespace moraine
{
  using namespace dealii;

  namespace
  {
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
    Constraint<dim>
    make_constraint(const BoundaryParameters<dim> &parameters,
                    const std::string             &section)
    {
      Constraint<dim> constraint;
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
      return constraint;
    }



    /** A function of (x, t) times a curve over time, if there is one. */
    template <class Function>
    Function
    times_curve(const Function    &value,
                const std::string &text,
                const std::string &place)
    {
      if (text.empty())
        return value;
      const auto curve = std::make_shared<TimeCurve>(text, place);
      return [value, curve](const auto &x, const double t) {
        return curve->value(t) * value(x, t);
      };
    }



    /** That of a load of type pressure, times its curve. */
    template <int dim>
    ScalarFunction<dim>
    pressure_value(const LoadParameters<dim> &parameters,
                   const std::string         &section)
    {
      if (parameters.value.empty())
        throw InputError(place(section, "Value") +
                         ": found nothing, allowed: an expression");
      const auto expression =
        std::make_shared<Expression<dim>>(parameters.value,
                                          place(section, "Value"));
      return times_curve<ScalarFunction<dim>>(
        [expression](const Point<dim> &x, const double t) {
          return expression->value(x, t);
        },
        parameters.curve,
        place(section, "Curve"));
    }



    /** The value of a load, times its curve. */
    template <int dim>
    VectorFunction<dim>
    load_value(const LoadParameters<dim> &parameters,
               const std::string         &section)
    {
      if (parameters.value.empty())
        throw InputError(place(section, "Value") +
                         ": found nothing, allowed: " + std::to_string(dim) +
                         " expressions separated by ';'");
      return times_curve(vector_function<dim>(parameters.value,
                                              place(section, "Value")),
                         parameters.curve,
                         place(section, "Curve"));
    }



    /** The wave that comes from outside; none without a text. */
    template <int dim>
    VectorFunction<dim>
    incident_velocity(const AbsorbingParameters &parameters,
                      const std::string         &section)
    {
      if (parameters.incident_velocity.empty())
        return {};
      return times_curve(vector_function<dim>(parameters.incident_velocity,
                                              place(section,
                                                    "Incident velocity")),
                         parameters.incident_curve,
                         place(section, "Incident curve"));
    }



    /** The box of a grid condition, if it names one. */
    template <int dim>
    std::optional<BoundingBox<dim>>
    region_of(const GridConditionParameters<dim> &parameters,
              const std::string                  &section)
    {
      if (parameters.lower_corner.empty() && parameters.upper_corner.empty())
        return {};
      const auto corners =
        std::make_pair(point_from<dim>(parameters.lower_corner,
                                       place(section, "Lower corner")),
                       point_from<dim>(parameters.upper_corner,
                                       place(section, "Upper corner")));
      for (unsigned int d = 0; d < dim; ++d)
        if (corners.second[d] < corners.first[d])
          reject(section,
                 "Upper corner",
                 coordinates(corners.second),
                 "coordinates that are not below those of 'Lower corner'");
      return BoundingBox<dim>(corners);
    }



    /** Flags for the bodies a load acts on; all if none is named. */
    std::vector<bool>
    body_flags(const std::vector<std::string> &names,
               const std::vector<std::string> &body_names,
               const std::string              &section)
    {
      std::vector<bool> flags(body_names.size(), names.empty());
      for (const std::string &body : names)
        {
          const auto found =
            std::find(body_names.begin(), body_names.end(), body);
          if (found == body_names.end())
            throw InputError(place(section, "Bodies") + ": found '" + body +
                             "', allowed: names of bodies" +
                             suggest(body, body_names));
          flags[found - body_names.begin()] = true;
        }
      return flags;
    }



    template <int dim>
    ImplicitBoundary<dim>
    make_boundary(const std::string             &name,
                  const BoundaryParameters<dim> &parameters,
                  const NamedShapes<dim>        &shapes,
                  const Scene<dim>              &scene)
    {
      const std::string section = "Boundaries/" + name;
      return {name,
              make_surface<dim>(parameters.surface, shapes, section),
              motion_of_surface(name, parameters, scene),
              vector_function<dim>(varies(parameters) ?
                                     parameters.displacement :
                                     std::string(),
                                   place(section, "Displacement")),
              make_constraint<dim>(parameters, section),
              parameters.enforcement.enforcement_of(),
              parameters.penetration_limit};
    }
  } // namespace



  template <int dim>
  std::vector<ImplicitBoundary<dim>>
  make_boundaries(const Scene<dim> &scene)
  {
    const NamedShapes<dim>             shapes = body_shapes(scene);
    std::vector<ImplicitBoundary<dim>> boundaries;
    for (const auto &[name, parameters] : scene.boundaries)
      if (parameters.constraint != "absorbing" &&
          parameters.constraint != "contact")
        boundaries.push_back(make_boundary(name, parameters, shapes, scene));
    return boundaries;
  }



  namespace
  {
    /**
     * Places of a surface where its motion has brought it. A mesh that does not
     * let material through is cut where the surface stood at first; if its
     * nodes move they take the places along, and the motion the normals.
     */
    template <int dim>
    typename AbsorbingBoundary<dim>::Finder
    finder_on(const SurfacePointer<dim> &surface,
              const RigidMotion<dim>    &motion,
              const double               first_time,
              const MeshAfterStep        mesh_after_step,
              const ShapePointer<dim>   &body)
    {
      return [=](const GridSpace<dim> &space, const double t) {
        const Placement<dim> at_first = motion.pose(first_time),
                             now      = motion.pose(t);
        if (mesh_after_step == MeshAfterStep::reset)
          // Where bodies are beside one that has moved, cells tell.
          return places_on(MovedSurface<dim>(surface, now),
                           space.mesh(),
                           motion.moves() ? nullptr : body);
        auto places =
          places_on(MovedSurface<dim>(surface, at_first), space.mesh(), body);
        if (mesh_after_step == MeshAfterStep::follow_material)
          for (auto &place : places)
            place.normal = now.rotate(at_first.inverse().rotate(place.normal));
        return places;
      };
    }



    /** Places of a side of the mesh, those in @p region if there is one. */
    template <int dim>
    typename AbsorbingBoundary<dim>::Finder
    finder_on_side(const types::boundary_id               side,
                   const std::optional<BoundingBox<dim>> &region,
                   const Covers<dim>                     &covers)
    {
      return [=](const GridSpace<dim> &space, const double) {
        auto places = places_on_side(space.mesh(), side, covers);
        if (region)
          places.erase(std::remove_if(places.begin(),
                                      places.end(),
                                      [&](const auto &place) {
                                        return !is_inside(
                                          *region,
                                          place.x,
                                          space.mesh().round_off());
                                      }),
                       places.end());
        return places;
      };
    }
  } // namespace



  template <int dim>
  std::vector<AbsorbingBoundary<dim>>
  make_absorbing_boundaries(const Scene<dim>               &scene,
                            const BackgroundMesh<dim>      &mesh,
                            const std::vector<std::string> &body_names,
                            const ShapesOfBodies<dim>      &shapes_of_bodies)
  {
    const NamedShapes<dim> shapes     = body_shapes(scene);
    const auto             present_at = [&](const StageParameters &stage) {
      ShapesOfBodies<dim> present;
      for (unsigned int b = 0; b < body_names.size(); ++b)
        if (contains(stage.bodies, body_names[b]))
          present.push_back(shapes_of_bodies[b]);
      return present;
    };
    std::vector<AbsorbingBoundary<dim>> absorbing;
    for (const auto &[name, parameters] : scene.boundaries)
      if (parameters.constraint == "absorbing" || scene.absorbs_later(name))
        {
          const std::string section = "Boundaries/" + name;
          absorbing.emplace_back(
            name,
            finder_on<dim>(
              make_surface<dim>(parameters.surface, shapes, section),
              parameters.motion.make_motion(section),
              first_time_of(name, scene),
              scene.method.after_step(),
              united(present_at(scene.first_absorbing_stage(name)))),
            parameters.absorbing.law(section),
            incident_velocity<dim>(parameters.absorbing, section),
            false);
        }
    for (const auto &[name, parameters] : scene.grid_conditions)
      if (parameters.constraint == "absorbing" || scene.absorbs_later(name))
        {
          const std::string section = "Grid conditions/" + name;
          absorbing.emplace_back(
            name,
            finder_on_side<dim>(
              mesh.boundary_id(parameters.side, place(section, "Side")),
              region_of(parameters, section),
              covers_of<dim>(present_at(scene.first_absorbing_stage(name)))),
            parameters.absorbing.law(section),
            incident_velocity<dim>(parameters.absorbing, section),
            true);
        }
    return absorbing;
  }



  template <int dim>
  std::vector<GridCondition<dim>>
  make_grid_conditions(const Scene<dim> &scene, const BackgroundMesh<dim> &mesh)
  {
    std::vector<GridCondition<dim>> conditions;
    for (const auto &[name, parameters] : scene.grid_conditions)
      {
        if (parameters.constraint == "absorbing")
          continue;
        const std::string  section = "Grid conditions/" + name;
        GridCondition<dim> condition;
        condition.name = name;
        if (!parameters.side.empty())
          condition.side =
            mesh.boundary_id(parameters.side, place(section, "Side"));
        condition.region = region_of(parameters, section);
        if (!condition.side && !condition.region)
          throw InputError("section '" + section +
                           "': found neither 'Side' nor 'Lower corner' and "
                           "'Upper corner', allowed: one of them or both");
        condition.component =
          component_flags<dim>(parameters.components,
                               place(section, "Components"));
        condition.displacement =
          vector_function<dim>(parameters.displacement,
                               place(section, "Displacement"));
        condition.motion = parameters.motion.make_motion(section);
        conditions.push_back(condition);
      }
    return conditions;
  }



  namespace
  {
    /** Turns normals out of @p body where it is seen on their side alone. */
    template <int dim>
    void
    turn_outward(const ShapePointer<dim>                         &body,
                 const double                                     h,
                 std::vector<typename CarriedPlaces<dim>::Place> &places)
    {
      constexpr double step = 0.01; // of a cell
      if (!body)
        return;
      for (auto &place : places)
        if (covers_place(*body, place.x + step * h * place.normal, 0.) &&
            !covers_place(*body, place.x - step * h * place.normal, 0.))
          place.normal *= -1;
    }



    /** A load on a side of the mesh or on a surface. */
    template <int dim>
    CarriedLoad<dim>
    make_load_on_surface(const std::string         &name,
                         const LoadParameters<dim> &parameters,
                         const Scene<dim>          &scene,
                         const BackgroundMesh<dim> &mesh,
                         const NamedShapes<dim>    &shapes,
                         const ShapePointer<dim>   &body,
                         const Covers<dim>         &covers)
    {
      const std::string section = "Loads/" + name;
      const bool        through_mesh =
        scene.method.after_step() == MeshAfterStep::reset;
      // Finer than functions need, as an expression may jump inside of a face.
      const QIterated<dim - 1> face_quadrature(
        QGauss<1>(scene.method.degree + 1),
        (dim == 2 ? 4 : 2) * (through_mesh ? 2 : 1));
      std::vector<typename CarriedLoad<dim>::Place> places;
      const bool                                    on_side =
        parameters.type == "side traction" ||
        (parameters.type == "pressure" && !parameters.side.empty());
      double outside = 0;
      if (on_side)
        places = places_on_side(mesh,
                                mesh.boundary_id(parameters.side,
                                                 place(section, "Side")),
                                covers,
                                face_quadrature);
      else
        {
          const SurfacePointer<dim> surface =
            make_surface<dim>(parameters.surface, shapes, section);
          places  = places_on(*surface,
                             mesh,
                             body,
                             through_mesh ? Spacing::through_mesh :
                                             Spacing::for_cells);
          outside = share_outside(*surface, mesh, body);
        }
      if (parameters.type != "pressure")
        return CarriedLoad<dim>(name,
                                parameters.type,
                                load_value<dim>(parameters, section),
                                places,
                                outside);
      if (!on_side)
        turn_outward(body, mesh.cell_size(), places);
      return CarriedLoad<dim>(
        name,
        on_side ? "side pressure" : "pressure",
        Pressure<dim>{pressure_value<dim>(parameters, section),
                      scene.method.strain_measure() == StrainMeasure::finite},
        places,
        outside);
    }
  } // namespace



  template <int dim>
  Loads<dim>
  make_loads(const Scene<dim>               &scene,
             const BackgroundMesh<dim>      &mesh,
             const std::vector<std::string> &body_names,
             const ShapePointer<dim>        &body,
             const Covers<dim>              &covers)
  {
    using Place                   = typename CarriedLoad<dim>::Place;
    const NamedShapes<dim> shapes = body_shapes(scene);
    Loads<dim>             loads;
    for (const auto &[name, parameters] : scene.loads)
      {
        const std::string section = "Loads/" + name;
        if (contains({"side traction", "surface traction", "pressure"},
                     parameters.type))
          {
            loads.carried.push_back(make_load_on_surface(
              name, parameters, scene, mesh, shapes, body, covers));
            continue;
          }
        const auto value = load_value<dim>(parameters, section);
        if (parameters.type == "body force" || parameters.type == "gravity")
          loads.body_forces.push_back(
            {name,
             value,
             parameters.type == "gravity",
             body_flags(parameters.bodies, body_names, section),
             parameters.coordinates == "original"});
        else
          {
            const Point<dim> at =
              point_from<dim>(parameters.location, place(section, "Location"));
            if (parameters.type == "force on points")
              loads.on_points.emplace_back(name, value, at);
            else
              loads.carried.emplace_back(name,
                                         parameters.type,
                                         value,
                                         std::vector<Place>{{at, 1.}});
          }
      }
    return loads;
  }



  namespace
  {
    /** Where the water of a stage is given first. */
    template <int dim>
    std::string
    section_of_water(const Scene<dim> &scene, const StageParameters &stage)
    {
      const auto is_same = [&stage](const WaterLevels &other) {
        return other.level == stage.water.level &&
               other.pressure == stage.water.pressure &&
               other.free_level == stage.water.free_level;
      };
      if (!is_same(scene.water.levels))
        for (const auto &[name, other] : scene.stages)
          if (is_same(other.water))
            return water_section(name);
      return "Water";
    }
  } // namespace



  template <int dim>
  std::optional<Water<dim>>
  make_water(const Scene<dim> &scene, const StageParameters &stage)
  {
    if (!stage.water.any())
      return {};
    WaterTexts texts;
    texts.level        = stage.water.level;
    texts.pressure     = stage.water.pressure;
    texts.free_level   = stage.water.free_level;
    texts.curve        = scene.water.curve;
    texts.section      = section_of_water(scene, stage);
    texts.cuts_suction = scene.water.suction == "cut off";
    texts.unit_weight  = scene.water.unit_weight;
    return Water<dim>(texts);
  }



  template <int dim>
  std::vector<double>
  extra_densities(const Scene<dim>               &scene,
                  const std::vector<std::string> &body_names)
  {
    std::vector<double> densities;
    for (const std::string &name : body_names)
      for (const auto &[section, body] : scene.bodies)
        if (section == name)
          for (const auto &[material_name, material] : scene.materials)
            if (body.material.empty() || body.material == material_name)
              {
                densities.push_back(
                  extra_density_of(material, "Materials/" + material_name));
                break;
              }
    return densities;
  }



  template <int dim>
  std::function<Tensor<1, dim>(const unsigned int, const Point<dim> &)>
  initial_velocity(const Scene<dim>               &scene,
                   const std::vector<std::string> &body_names)
  {
    std::vector<VectorFunction<dim>> of_bodies;
    for (const std::string &name : body_names)
      for (const auto &[section, body] : scene.bodies)
        if (section == name)
          of_bodies.push_back(vector_function<dim>(body.initial_velocity,
                                                   place("Bodies/" + section,
                                                         "Initial velocity")));
    return [of_bodies, t = scene.start_time()](const unsigned int body,
                                               const Point<dim>  &x) {
      return of_bodies[body](x, t);
    };
  }



#define INSTANTIATE(dim)                                                       \
  template decltype(make_boundaries<dim>) make_boundaries<dim>;                \
  template decltype(make_absorbing_boundaries<dim>)                            \
                                               make_absorbing_boundaries<dim>; \
  template decltype(make_grid_conditions<dim>) make_grid_conditions<dim>;      \
  template decltype(make_loads<dim>)           make_loads<dim>;                \
  template decltype(make_water<dim>)           make_water<dim>;                \
  template decltype(extra_densities<dim>)      extra_densities<dim>;           \
  template std::function<Tensor<1, dim>(const unsigned int,                    \
                                        const Point<dim> &)>                   \
  initial_velocity(const Scene<dim> &, const std::vector<std::string> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
