// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/scene/scene_bodies.h>

#include <moraine/core/exceptions.h>
#include <moraine/core/patterns.h>
#include <moraine/core/ranges.h>
#include <moraine/core/words.h>
#include <moraine/geometry/mesh_groups.h>

#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <memory>
#include <set>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  void
  BodyParameters<dim>::add_parameters(ParameterHandler &prm)
  {
    prm.add_parameter("Material",
                      material,
                      "Name of its material; may be left out if there is one "
                      "only, or if other bodies are combined from it.");
    prm.add_parameter("Point grid",
                      point_grid,
                      "Of a box: its points are the middles of this many equal "
                      "parts in each direction of the box, turned and moved "
                      "with it, whatever the cells of the mesh are: standard "
                      "MPM wants as many in each cell. If left out, each cell "
                      "is divided (section 'Method').",
                      patterns::positive_integers(0, dim));
    prm.add_parameter("Aggregate below",
                      aggregate_below,
                      "That of section 'Method' for cells with points of this "
                      "body, if it is another one. Of bodies in one cell the "
                      "least counts.",
                      Patterns::List(Patterns::Double(0., 1.), 0, 1));
    prm.add_parameter("Initial velocity",
                      initial_velocity,
                      "In dynamics: of its points at the start, an expression "
                      "of x for each component, separated by semicolons (t is "
                      "'Start time' in it). If left out, the body is at rest.");
    initial_stress.add_parameters(prm, dim);
    damping.add_parameters(prm);
    shape.add_parameters(prm);
  }



  template <int dim>
  NamedShapes<dim>
  body_shapes(const Scene<dim> &scene)
  {
    std::map<std::string, ShapeParameters<dim>> parameters;
    for (const auto &[name, body] : scene.bodies)
      parameters[name] = body.shape;
    // One reading of the file serves all bodies.
    std::unique_ptr<const MeshGroups<dim>> of_mesh;
    const auto of_groups = [&](const std::vector<std::string> &groups,
                               const std::string              &section) {
      if (scene.mesh.type != "file")
        reject(section,
               "Group",
               list_of(groups),
               "nothing; only a mesh of type 'file' has groups of cells");
      const auto body =
        std::find_if(scene.bodies.begin(),
                     scene.bodies.end(),
                     [&](const auto &named) {
                       return "Bodies/" + named.first == section;
                     });
      ShapePointer<dim> &shape = body->second.of_groups;
      if (!shape)
        {
          if (!of_mesh)
            of_mesh = std::make_unique<MeshGroups<dim>>(scene.mesh);
          shape = of_mesh->shape(groups, section);
        }
      return shape;
    };
    return make_shapes<dim>(parameters, "Bodies", of_groups);
  }



  template <int dim>
  std::set<std::string>
  operands_of(const Scene<dim> &scene)
  {
    std::set<std::string> operands;
    for (const auto &[name, body] : scene.bodies)
      for (const std::string &operand : body.shape.words("Operands"))
        operands.insert(operand);
    return operands;
  }



  template <int dim>
  std::vector<std::string>
  simulated_bodies(const Scene<dim> &scene)
  {
    const std::set<std::string> operands = operands_of(scene);
    std::vector<std::string>    names;
    for (const auto &[name, body] : scene.bodies)
      if (operands.count(name) == 0)
        names.push_back(name);
    return names;
  }



  template <int dim>
  std::vector<Body<dim>>
  make_bodies(const Scene<dim> &scene)
  {
    const std::set<std::string> operands = operands_of(scene);
    const NamedShapes<dim>      shapes   = body_shapes(scene);

    std::vector<Body<dim>> bodies;
    for (const auto &[name, body] : scene.bodies)
      {
        if (operands.count(name) > 0)
          continue;
        const std::string section = "Bodies/" + name;
        const std::string file    = body.shape.text("Point file");
        if (body.is_seeded_by_cells())
          bodies.push_back({name, shapes.at(name)});
        else if (!body.shape.is_point_file())
          bodies.push_back(
            {name,
             make_point_grid(body.shape, body.point_grid, section),
             shapes.at(name)});
        else if (std::ifstream(file))
          bodies.push_back({name, read_point_file<dim>(file)});
        else
          throw InputError(place(section, "Point file") + ": found '" + file +
                           "', which cannot be read, allowed: the path of a "
                           "CSV file");
      }
    return bodies;
  }



  template <int dim>
  void
  check_groups(const Scene<dim> &scene, const BackgroundMesh<dim> &mesh)
  {
    for (const auto &[name, body] : scene.bodies)
      {
        if (body.shape.kind() != "mesh" || body.shape.given("Group"))
          continue;
        std::vector<std::string> known;
        for (const auto &group :
             groups_of_cells(scene.mesh, mesh.triangulation()))
          known.push_back(group.first);
        if (known.size() > 1)
          throw InputError(place("Bodies/" + name, "Group") +
                           ": not set, but the cells of the mesh are in "
                           "several groups, allowed: one or more of " +
                           list_of(known));
      }
  }



  template <int dim>
  std::vector<std::shared_ptr<const Material>>
  make_materials(const Scene<dim>             &scene,
                 const std::vector<Body<dim>> &bodies,
                 const BackgroundMesh<dim>    &mesh)
  {
    MaterialPlace place;
    if (const auto &box = mesh.box_grid())
      {
        place.cell_size = 1;
        for (unsigned int d = 0; d < dim; ++d)
          place.cell_size *= box->cell_size[d];
        place.cell_size = std::pow(place.cell_size, 1. / dim);
      }
    const auto everywhere =
      GridTools::compute_bounding_box(mesh.triangulation());
    std::vector<std::shared_ptr<const Material>> materials;
    for (const Body<dim> &body : bodies)
      {
        const auto parameters =
          std::find_if(scene.bodies.begin(),
                       scene.bodies.end(),
                       [&](const auto &b) { return b.first == body.name; });
        // A list of points has no shape.
        Point<dim> middle;
        for (unsigned int d = 0; d < dim; ++d)
          {
            double lower = everywhere.lower_bound(d),
                   upper = everywhere.upper_bound(d);
            if (body.shape)
              {
                lower =
                  std::max(lower, body.shape->bounding_box().lower_bound(d));
                upper =
                  std::min(upper, body.shape->bounding_box().upper_bound(d));
              }
            middle[d] = 0.5 * (lower + upper);
          }
        place.middle = point_in_space(middle);
        for (const auto &[name, material] : scene.materials)
          if (parameters->second.material == name ||
              scene.materials.size() == 1)
            {
              place.drained = drained_spans(scene.stages, name);
              materials.push_back(scene.strength_reduction.reduced(
                name, make_material(material, "Materials/" + name, place)));
            }
      }
    return materials;
  }



  template <int dim>
  std::vector<double>
  fill_of_bodies(const Scene<dim> &scene, const std::vector<Body<dim>> &bodies)
  {
    std::vector<double> fill;
    for (const Body<dim> &body : bodies)
      for (const auto &[name, parameters] : scene.bodies)
        if (name == body.name)
          fill.push_back(parameters.aggregate_below.empty() ?
                           scene.method.aggregate_below :
                           parameters.aggregate_below[0]);
    return fill;
  }



  template <int dim>
  std::vector<RayleighFactors>
  make_damping(const Scene<dim> &scene, const std::vector<Body<dim>> &bodies)
  {
    std::vector<RayleighFactors> factors;
    for (const Body<dim> &body : bodies)
      for (const auto &[name, parameters] : scene.bodies)
        if (name == body.name)
          factors.push_back(
            parameters.damping.factors("Bodies/" + name, !scene.is_dynamic()));
    return factors;
  }



  template <int dim>
  bool
  Scene<dim>::changes_bodies() const
  {
    const unsigned int n = simulated_bodies(*this).size();
    return any_of(stages, [n](const auto &stage) {
      return stage.second.bodies.size() != n;
    });
  }



  template <int dim>
  bool
  Scene<dim>::comes_later(const std::string &name) const
  {
    bool before = true;
    for (const auto &[stage_name, stage] : stages)
      {
        const bool now = contains(stage.bodies, name);
        if (now && !before)
          return true;
        before = now;
      }
    return false;
  }



  template <int dim>
  bool
  Scene<dim>::are_together(const std::string &a, const std::string &b) const
  {
    return any_of(stages, [&](const auto &stage) {
      const auto &names = stage.second.bodies;
      return contains(names, a) && contains(names, b);
    });
  }



  template <int dim>
  unsigned int
  Scene<dim>::first_stage_with(const std::string &name) const
  {
    unsigned int k = 0;
    while (k + 1 < stages.size() && !contains(stages[k].second.bodies, name))
      ++k;
    return k;
  }



#define INSTANTIATE(dim)                                                       \
  template void BodyParameters<dim>::add_parameters(ParameterHandler &);       \
  template NamedShapes<dim>              body_shapes(const Scene<dim> &);      \
  template std::set<std::string>         operands_of(const Scene<dim> &);      \
  template std::vector<std::string>      simulated_bodies(const Scene<dim> &); \
  template std::vector<Body<dim>>        make_bodies(const Scene<dim> &);      \
  template decltype(check_groups<dim>)   check_groups<dim>;                    \
  template decltype(make_materials<dim>) make_materials<dim>;                  \
  template decltype(fill_of_bodies<dim>) fill_of_bodies<dim>;                  \
  template decltype(make_damping<dim>)   make_damping<dim>;                    \
  template bool                          Scene<dim>::changes_bodies() const;   \
  template bool         Scene<dim>::comes_later(const std::string &) const;    \
  template bool         Scene<dim>::are_together(const std::string &,          \
                                         const std::string &) const;   \
  template unsigned int Scene<dim>::first_stage_with(const std::string &) const;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
