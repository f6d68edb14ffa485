// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/run/scene.h>

#include <moraine/core/exceptions.h>
#include <moraine/core/expression.h>
#include <moraine/core/patterns.h>
#include <moraine/core/words.h>
#include <moraine/run/renamed_keys.h>
#include <moraine/run/scene_bodies.h>

#include <algorithm>
#include <filesystem>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  Point<dim>
  point_from(const std::vector<double> &numbers, const std::string &place)
  {
    if (numbers.size() != dim)
      throw InputError(place + ": found " + std::to_string(numbers.size()) +
                       " numbers, allowed: " + std::to_string(dim));
    Point<dim> point;
    for (unsigned int d = 0; d < dim; ++d)
      point[d] = numbers[d];
    return point;
  }



  template <int dim>
  void
  MotionParameters<dim>::add_parameters(ParameterHandler  &prm,
                                        const std::string &what)
  {
    prm.add_parameter("Translation",
                      translation,
                      "Motion of " + what +
                        " and of the material it holds (length), dim "
                        "expressions in t or tables 't: d, t: d, ...' "
                        "separated by ';'.");
    prm.add_parameter("Rotation angle",
                      rotation_angle,
                      "Rotation of " + what +
                        " (degrees), an expression in t or a table; a change "
                        "moves the material. history.csv then has the moment "
                        "about the axis.");
    prm.add_parameter("Rotation centre",
                      rotation_centre,
                      "Point of the axis of rotation; the origin if left out.",
                      patterns::numbers(0, dim));
    prm.add_parameter(
      "Rotation axis",
      rotation_axis,
      "In 3D: direction of the axis of rotation; z if left out.",
      patterns::numbers(0, 3));
  }



  template <int dim>
  RigidMotion<dim>
  MotionParameters<dim>::make_motion(const std::string &section) const
  {
    using Curve = typename RigidMotion<dim>::Curve;
    std::array<Curve, dim> shift;
    if (!translation.empty())
      {
        const auto curves =
          time_curves(translation, place(section, "Translation"), dim);
        for (unsigned int d = 0; d < dim; ++d)
          shift[d] = [curve = curves[d]](const double t) {
            return curve.value(t);
          };
      }
    Curve angle;
    if (!rotation_angle.empty())
      angle = [curve =
                 TimeCurve(rotation_angle, place(section, "Rotation angle"))](
                const double t) { return curve.value(t); };
    Point<dim> centre;
    if (!rotation_centre.empty())
      centre =
        point_from<dim>(rotation_centre, place(section, "Rotation centre"));
    Tensor<1, dim> axis = Point<dim>::unit_vector(dim - 1);
    if (dim == 2 && !rotation_axis.empty())
      reject(section,
             "Rotation axis",
             Patterns::Tools::to_string(rotation_axis),
             "nothing in 2D, where it turns in the plane");
    if (!rotation_axis.empty())
      axis = point_from<dim>(rotation_axis, place(section, "Rotation axis"));
    return RigidMotion<dim>(shift, angle, centre, axis);
  }



  template <int dim>
  void
  BoundaryParameters<dim>::add_parameters(ParameterHandler &prm)
  {
    surface.add_parameters(prm);
    prm.add_parameter(
      "Constraint",
      constraint,
      "fixed: all components. roller: the component normal to "
      "the surface. components: those of key 'Components'. "
      "absorbing: dashpots, and springs if wanted, that swallow "
      "waves, in dynamics; the material carries its places.",
      patterns::selection({"fixed", "roller", "components", "absorbing"}));
    prm.add_parameter("Components",
                      components,
                      "Of 'components': which, as x, y or x, y.",
                      patterns::several_of({"x", "y", "z"}));
    prm.add_parameter(
      "Displacement",
      displacement,
      "Prescribed displacement of the material relative to the moving surface "
      "(length), dim expressions in x, y, z, t separated by ';'. Its change "
      "over time acts; it is 0 at the start.");
    motion.add_parameters(prm, "the surface");
    prm.add_parameter(
      "Penetration limit",
      penetration_limit,
      "Largest depth a point may end behind the surface, in cell sizes; a step "
      "that goes deeper is rejected and halved. 0: no limit, only reported.",
      patterns::non_negative());
    enforcement.add_parameters(prm);
    absorbing.add_parameters(prm);
  }



  template <int dim>
  void
  GridConditionParameters<dim>::add_parameters(ParameterHandler &prm)
  {
    prm.add_parameter("Side",
                      side,
                      dim == 2 ?
                        "A side of the mesh: left, right, bottom, top of a "
                        "box; else a name of 'Side names' or a number." :
                        "A side of the mesh: left, right (x), front, back (y), "
                        "bottom, top (z) of a box; else a name of 'Side "
                        "names', a number, or bottom and top of what is "
                        "extruded.");
    prm.add_parameter(
      "Lower corner",
      lower_corner,
      "With 'Upper corner': the nodes in this box of the mesh as it was built, "
      "instead of or within a side.",
      patterns::numbers(0, dim));
    prm.add_parameter("Upper corner",
                      upper_corner,
                      "See 'Lower corner'.",
                      patterns::numbers(0, dim));
    prm.add_parameter(
      "Components",
      components,
      "Components that are prescribed, as x, y; all if left out.",
      patterns::several_of({"x", "y", "z"}));
    prm.add_parameter("Displacement",
                      displacement,
                      "Prescribed displacement (length), dim expressions in x, "
                      "y, z, t separated by ';', x where the node is in the "
                      "mesh as it was built; zero if left out. Its change over "
                      "time acts; it is 0 at the start.");
    motion.add_parameters(prm, "the nodes");
    prm.add_parameter("Constraint",
                      constraint,
                      "fixed: the components that are prescribed. absorbing: "
                      "dashpots, and springs if wanted, on a side, that "
                      "swallow waves, in dynamics.",
                      patterns::selection({"fixed", "absorbing"}));
    absorbing.add_parameters(prm);
  }



  template <int dim>
  void
  LoadParameters<dim>::add_parameters(ParameterHandler &prm)
  {
    prm.add_parameter(
      "Type",
      type,
      "body force (force/volume that the material has at the start of a step), "
      "gravity (acceleration, times density: its mass stays), side "
      "traction (force/area on a side of the mesh), surface traction "
      "(force on a surface carried by the material, a dead load per area of "
      "the undeformed body), point force (force "
      "at a place that the mesh carries along), force on points (force on the "
      "material points nearest to a place at the start).",
      patterns::selection({"body force",
                           "gravity",
                           "side traction",
                           "surface traction",
                           "point force",
                           "force on points"}));
    prm.add_parameter("Value",
                      value,
                      "dim expressions in x, y, z, t separated by ';'.");
    prm.add_parameter(
      "Curve",
      curve,
      "Factor over time: an expression in t or a table 't: f, t: "
      "f, ...'; 1 if left out.");
    prm.add_parameter("Bodies",
                      bodies,
                      "Of body force and gravity: names of the bodies; all if "
                      "left out.");
    prm.add_parameter("Coordinates",
                      coordinates,
                      "Of body force and gravity: whether x, y, z of 'Value' "
                      "are where the material is at the start of a step "
                      "(current) or where it was at "
                      "the start of the run (original).",
                      patterns::selection({"current", "original"}));
    prm.add_parameter("Side", side, "Of side traction: a side of the mesh.");
    prm.add_parameter("Location",
                      location,
                      "Of point force and force on points: where it acts at "
                      "the start.",
                      patterns::numbers(0, dim));
    surface.add_parameters(prm);
  }



  void
  MeshMotionParameters::add_parameters(ParameterHandler &prm)
  {
    prm.add_parameter("Follow",
                      follow,
                      "The mesh moves as a rigid body after each step, by the "
                      "prescribed motion of this boundary or grid condition. "
                      "If left out, it stays.");
    prm.add_parameter("Stretch between",
                      stretch,
                      "Names of two boundaries or grid conditions: the mesh is "
                      "stretched uniformly between them, so that it goes with "
                      "both.");
  }



  void
  OutputParameters::add_parameters(ParameterHandler &prm)
  {
    prm.add_parameter("Directory",
                      directory,
                      "Folder for the results; output/<name of the scene> if "
                      "left out.");
    prm.add_parameter(
      "Points",
      points,
      "Write the points as VTU, and their domains if they have any.");
    prm.add_parameter("Mesh", mesh, "Write the active cells as VTU.");
    prm.add_parameter("Residuals",
                      residuals,
                      "Print the residual at the start of each step and after "
                      "each Newton iteration (relative to the forces).");
    times.add_parameters(prm);
  }



  unsigned int
  dimension_of(const InputFile &input)
  {
    const std::string text = input.get("", "Dimension", "2");
    if (text != "2" && text != "3")
      throw InputError(place("", "Dimension") + ": found '" + text +
                       "', allowed: 2, 3");
    return text == "3" ? 3 : 2;
  }



  namespace
  {
    template <class Parameters>
    void
    take_names(const InputFile                                 &input,
               const std::string                               &section,
               std::vector<std::pair<std::string, Parameters>> &list)
    {
      for (const std::string &name : input.names_in(section))
        list.emplace_back(name, Parameters());
    }



    template <class List>
    std::vector<std::string>
    names_of(const List &list)
    {
      std::vector<std::string> names;
      for (const auto &[name, parameters] : list)
        names.push_back(name);
      return names;
    }



    template <class List, class Declare>
    void
    in_subsections(ParameterHandler  &prm,
                   const std::string &section,
                   List              &list,
                   const Declare     &declare)
    {
      prm.enter_subsection(section);
      for (auto &[name, parameters] : list)
        {
          prm.enter_subsection(name);
          declare(parameters);
          prm.leave_subsection();
        }
      prm.leave_subsection();
    }
  } // namespace



  template <int dim>
  Scene<dim>::Scene(const InputFile &input)
  {
    take_names(input, "Materials", materials);
    take_names(input, "Bodies", bodies);
    take_names(input, "Boundaries", boundaries);
    take_names(input, "Grid conditions", grid_conditions);
    take_names(input, "Loads", loads);
    for (const std::string &name : input.names_in("Probes"))
      {
        probes.emplace_back();
        probes.back().name = name;
      }
    take_names(input, "Stages", stages);
    take_names(input, "Study/Series", study.series);
    declare();
    refuse_old_names(input);
    const auto given = input.parse(prm);
    locate_files(input);
    complete_stages(given,
                    time,
                    {names_of(boundaries),
                     names_of(grid_conditions),
                     names_of(loads),
                     simulated_bodies(*this)},
                    stages);
    if (method.strain_measure() == StrainMeasure::finite || any_yields())
      choose_enforcement("augmented Lagrangian", input);
    else if (is_dynamic())
      choose_enforcement("symmetric Nitsche", input);
    if (method.volumetric_strain == "auto")
      choose_volumetric_strain(given);
    check(input, given);
  }



  template <int dim>
  const StageParameters &
  Scene<dim>::first_dynamic_stage() const
  {
    for (const auto &[name, stage] : stages)
      if (stage.time.integrator.dynamic())
        return stage;
    return stages.front().second;
  }



  template <int dim>
  bool
  Scene<dim>::any_yields() const
  {
    return std::any_of(materials.begin(),
                       materials.end(),
                       [](const auto &named) { return named.second.yields(); });
  }



  template <int dim>
  bool
  Scene<dim>::is_dynamic() const
  {
    return first_dynamic_stage().time.integrator.dynamic();
  }



  template <int dim>
  bool
  Scene<dim>::divides_steps() const
  {
    return std::any_of(stages.begin(), stages.end(), [](const auto &named) {
      return named.second.time.integrator.first_part() < 1.;
    });
  }



  template <int dim>
  bool
  Scene<dim>::absorbs_later(const std::string &name) const
  {
    // What absorbs once does so to the end.
    return contains(stages.back().second.absorbing, name);
  }



  template <int dim>
  const StageParameters &
  Scene<dim>::first_absorbing_stage(const std::string &name) const
  {
    const auto is_active = [&](const StageParameters &stage) {
      return contains(stage.boundaries, name) ||
             contains(stage.grid_conditions, name);
    };
    // Either the constraint is to absorb or it becomes that.
    for (const auto &[stage_name, stage] : stages)
      if (is_active(stage) &&
          (contains(stage.absorbing, name) || !absorbs_later(name)))
        return stage;
    return stages.back().second;
  }



  template <int dim>
  void
  Scene<dim>::locate_files(const InputFile &input)
  {
    const auto folder  = std::filesystem::path(input.name()).parent_path();
    const auto located = [&](const std::string &key, std::string &file) {
      const std::string path = (folder / file).string();
      prm.set(key, std::filesystem::absolute(path).string());
      file = path;
    };
    prm.enter_subsection("Bodies");
    for (auto &[name, body] : bodies)
      if (body.shape.is_point_file())
        {
          prm.enter_subsection(name);
          located("Point file", body.shape.texts.at("Point file"));
          prm.leave_subsection();
        }
    prm.leave_subsection();
    prm.enter_subsection("Mesh");
    if (!mesh.file.empty())
      located("File", mesh.file);
    prm.leave_subsection();
  }



  template <int dim>
  void
  Scene<dim>::choose_enforcement(const std::string &if_left_out,
                                 const InputFile   &input)
  {
    prm.enter_subsection("Boundaries");
    for (auto &[name, boundary] : boundaries)
      {
        if (boundary.constraint == "absorbing")
          continue;
        const std::string section = "Boundaries/" + name;
        prm.enter_subsection(name);
        if (!input.has(section, "Enforcement"))
          prm.set("Enforcement", if_left_out);
        if (if_left_out == "augmented Lagrangian" &&
            boundary.enforcement.enforcement == if_left_out &&
            !input.has(section, "Band width"))
          prm.set("Band width", 0.01);
        prm.leave_subsection();
      }
    prm.leave_subsection();
  }



  template <int dim>
  void
  Scene<dim>::choose_volumetric_strain(
    const std::vector<InputFile::Entry> &given)
  {
    const bool hardly_changes =
      std::any_of(materials.begin(), materials.end(), [](const auto &named) {
        return named.second.hardly_changes_volume();
      });
    const bool conserves =
      std::any_of(stages.begin(), stages.end(), [](const auto &named) {
        return named.second.time.integrator.integrator == "energy-momentum";
      });
    const bool is_damped =
      std::any_of(given.begin(), given.end(), [](const auto &entry) {
        return contains({"Stiffness damping", "Damping ratio"}, entry.key);
      });
    prm.enter_subsection("Method");
    prm.set("Volumetric strain",
            hardly_changes && method.can_average_volume() && !conserves &&
                !is_damped ?
              std::string("cell mean") :
              std::string("pointwise"));
    prm.leave_subsection();
  }



  template <int dim>
  Scene<dim>::Scene()
  {
    const std::string name = "<name>";
    materials.emplace_back(name, MaterialParameters());
    bodies.emplace_back(name, BodyParameters<dim>());
    boundaries.emplace_back(name, BoundaryParameters<dim>());
    grid_conditions.emplace_back(name, GridConditionParameters<dim>());
    loads.emplace_back(name, LoadParameters<dim>());
    stages.emplace_back(name, StageParameters());
    probes.emplace_back();
    probes.back().name = name;
    study.series.emplace_back(name, std::string());
    declare();
  }



  template <int dim>
  void
  Scene<dim>::declare()
  {
    prm.add_parameter("Dimension",
                      dimension,
                      "2 (plane strain) or 3.",
                      patterns::integer_in_range(2, 3));
    prm.add_parameter("Title", title, "Shown at the start of a run.");

    const auto section = [this](const std::string &name, auto &parameters) {
      prm.enter_subsection(name);
      parameters.add_parameters(prm);
      prm.leave_subsection();
    };
    const auto add_all = [this](auto &parameters) {
      parameters.add_parameters(prm);
    };
    section("Mesh", mesh);
    section("Method", method);
    in_subsections(prm, "Materials", materials, add_all);
    in_subsections(prm, "Bodies", bodies, add_all);
    in_subsections(prm, "Boundaries", boundaries, add_all);
    in_subsections(prm, "Grid conditions", grid_conditions, add_all);
    in_subsections(prm, "Loads", loads, add_all);
    section("Mesh motion", mesh_motion);
    section("Time", time);
    in_subsections(prm, "Stages", stages, add_all);
    prm.enter_subsection("Solver");
    newton.add_parameters(prm);
    linear_solver.add_parameters(prm);
    prm.leave_subsection();
    section("Output", output);
    prm.enter_subsection("Probes");
    for (auto &probe : probes)
      section(probe.name, probe);
    prm.leave_subsection();
    section("Exact solution", exact);
    section("Strength reduction", strength_reduction);
    prm.enter_subsection("Study");
    study.add_parameters(prm);
    in_subsections(prm, "Series", study.series, [this](std::string &settings) {
      prm.add_parameter(
        "Settings",
        settings,
        "Of 'moraine study': 'Section/Key = value' separated by ';', with "
        "choices {{a|b}} if wanted. A '*' stands for every name.");
    });
    prm.leave_subsection();
  }



  template Point<2>
  point_from(const std::vector<double> &, const std::string &);
  template Point<3>
  point_from(const std::vector<double> &, const std::string &);
  template struct MotionParameters<2>;
  template struct MotionParameters<3>;
  template struct BoundaryParameters<2>;
  template struct BoundaryParameters<3>;
  template struct GridConditionParameters<2>;
  template struct GridConditionParameters<3>;
  template struct LoadParameters<2>;
  template struct LoadParameters<3>;
  template class Scene<2>;
  template class Scene<3>;
} // namespace moraine
