// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/run/scene_conditions.h>

#include <moraine/core/exceptions.h>
#include <moraine/core/expression.h>
#include <moraine/core/nearest.h>

#include <algorithm>

namespace moraine
{
  using namespace dealii;

  namespace
  {
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
      const VectorFunction<dim> value =
        vector_function<dim>(parameters.value, place(section, "Value"));
      if (parameters.curve.empty())
        return value;
      const auto curve =
        std::make_shared<TimeCurve>(parameters.curve, place(section, "Curve"));
      return [value, curve](const Point<dim> &x, const double t) {
        return curve->value(t) * value(x, t);
      };
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
  } // namespace



  template <int dim>
  std::vector<ImplicitBoundary<dim>>
  make_boundaries(const Scene<dim> &scene)
  {
    std::vector<ImplicitBoundary<dim>> boundaries;
    for (const auto &[name, parameters] : scene.boundaries)
      {
        const std::string section = "Boundaries/" + name;
        boundaries.emplace_back(name,
                                make_surface<dim>(parameters.surface, section),
                                parameters.motion.make_motion(section),
                                vector_function<dim>(parameters.displacement,
                                                     place(section,
                                                           "Displacement")),
                                make_constraint<dim>(parameters, section),
                                parameters.enforcement.enforcement_of(),
                                parameters.penetration_limit);
      }
    return boundaries;
  }



  template <int dim>
  std::vector<GridCondition<dim>>
  make_grid_conditions(const Scene<dim> &scene, const BackgroundMesh<dim> &mesh)
  {
    std::vector<GridCondition<dim>> conditions;
    for (const auto &[name, parameters] : scene.grid_conditions)
      {
        const std::string  section = "Grid conditions/" + name;
        GridCondition<dim> condition;
        condition.name = name;
        if (!parameters.side.empty())
          condition.side =
            mesh.boundary_id(parameters.side, place(section, "Side"));
        if (!parameters.lower_corner.empty() ||
            !parameters.upper_corner.empty())
          condition.region = BoundingBox<dim>(
            std::make_pair(point_from<dim>(parameters.lower_corner,
                                           place(section, "Lower corner")),
                           point_from<dim>(parameters.upper_corner,
                                           place(section, "Upper corner"))));
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



  template <int dim>
  Loads<dim>
  make_loads(const Scene<dim>               &scene,
             const BackgroundMesh<dim>      &mesh,
             const std::vector<std::string> &body_names)
  {
    using Place = typename CarriedLoad<dim>::Place;
    Loads<dim> loads;
    for (const auto &[name, parameters] : scene.loads)
      {
        const std::string section = "Loads/" + name;
        const auto        value   = load_value<dim>(parameters, section);
        if (parameters.type == "body force" || parameters.type == "gravity")
          loads.body_forces.push_back(
            {name,
             value,
             parameters.type == "gravity",
             body_flags(parameters.bodies, body_names, section)});
        else if (parameters.type == "side traction")
          loads.side_tractions.push_back(
            {name,
             mesh.boundary_id(parameters.side, place(section, "Side")),
             value});
        else if (parameters.type == "surface traction")
          loads.carried.emplace_back(
            name,
            value,
            places_on(*make_surface<dim>(parameters.surface, section), mesh));
        else
          {
            Place at;
            at.x =
              point_from<dim>(parameters.location, place(section, "Location"));
            at.weight = 1;
            loads.carried.emplace_back(name, value, std::vector<Place>{at});
          }
      }
    return loads;
  }



#define INSTANTIATE(dim)                                         \
  template std::vector<ImplicitBoundary<dim>> make_boundaries(   \
    const Scene<dim> &);                                         \
  template std::vector<GridCondition<dim>> make_grid_conditions( \
    const Scene<dim> &, const BackgroundMesh<dim> &);            \
  template Loads<dim> make_loads(const Scene<dim> &,             \
                                 const BackgroundMesh<dim> &,    \
                                 const std::vector<std::string> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
