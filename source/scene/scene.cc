// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/scene/scene.h>

#include <moraine/core/exceptions.h>
#include <moraine/core/patterns.h>
#include <moraine/core/ranges.h>
#include <moraine/core/words.h>
#include <moraine/scene/scene_bodies.h>

#include <filesystem>

namespace moraine
{
  using namespace dealii;

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
    prm.add_parameter("Silence",
                      silence,
                      "Ids of diagnostics that are not asked, separated by "
                      "commas; see doc/diagnostics.md.");
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



    template <class List>
    std::vector<std::string>
    undrained_of(const List &materials)
    {
      std::vector<std::string> names;
      for (const auto &[name, parameters] : materials)
        if (parameters.texts.at("Drainage") == "undrained")
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



    /** What a key was called, or one of its values. */
    struct OldName
    {
      const char *section; ///< the first word of its path
      const char *key;
      const char *value; ///< empty: the key itself has another name
      const char *now;
    };

    constexpr OldName old_names[] = {
      {"Boundaries",
       "Carry reaction",
       "",
       "'Enforcement = augmented Lagrangian' carries it, 'weighted' and "
       "'penalty' do not"},
      {"Solver", "Limit points", "jump", "'pseudo-transient'"},
      {"Method", "Put back", "", "'Return tolerance'"},
      {"Method", "Empty stiffness", "", "'Fictitious stiffness'"}};



    /** Keys and values that earlier versions knew are refused with what they
     * are called now. */
    void
    refuse_old_names(const InputFile &input)
    {
      for (const auto &entry : input.entries())
        for (const OldName &old : old_names)
          {
            const std::string value = old.value;
            if (entry.key == old.key &&
                entry.section.substr(0, entry.section.find('/')) ==
                  old.section &&
                (value.empty() || entry.value == value))
              throw InputError(entry.origin + ": " +
                               place(entry.section, entry.key) + ": " +
                               (value.empty() ? "the key" : "'" + value + "'") +
                               " has another name now: " + old.now);
          }
    }
  } // namespace



  template <int dim>
  Scene<dim>::Scene(const InputFile &input, const bool for_materials)
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
    output.units     = Units(Utilities::split_string_list(prm.get("Units")));
    if (for_materials)
      return;
    locate_files(input);
    choose_spectral_radius(input);
    complete_stages(given,
                    time,
                    {names_of(boundaries),
                     names_of(grid_conditions),
                     names_of(loads),
                     simulated_bodies(*this),
                     undrained_of(materials)},
                    stages);
    complete_water(water.levels, stages);
    strength_reduction.find_start(stages);
    // Where water flows stress is not that of the undrained stiffness either.
    const bool any_yields =
      any_of(materials,
             [](const auto &named) {
               return make_material(named.second, "Materials/" + named.first)
                 ->dissipates();
             }) ||
      any_of(stages,
             [](const auto &named) { return !named.second.drained.empty(); });
    // A flux of effective stress would miss what water presses from one side.
    const bool water_differs = any_of(stages, [this](const auto &stage) {
      return stage.second.water.differs_outside(water.suction);
    });
    if (method.strain_measure() == StrainMeasure::finite || any_yields ||
        conserves_energy() || water_differs)
      choose_enforcement("augmented Lagrangian", input);
    else if (is_dynamic())
      choose_enforcement("symmetric Nitsche", input);
    if (method.method == "auto")
      choose_method();
    if (method.volumetric_strain == "auto")
      choose_volumetric_strain(given);
    choose_gauss_points(given, any_yields);
    const bool has_flux = !is_dynamic() && !water_differs &&
                          method.strain_measure() == StrainMeasure::small;
    choose_enforcement_of_contact(has_flux ? "incomplete Nitsche" :
                                             "augmented Lagrangian",
                                  input);
    if (newton.limit_points == "auto")
      choose_limit_points();
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
  Scene<dim>::is_dynamic() const
  {
    return first_dynamic_stage().time.integrator.dynamic();
  }



  template <int dim>
  bool
  Scene<dim>::has_water() const
  {
    return any_of(stages,
                  [](const auto &stage) { return stage.second.water.any(); });
  }



  template <int dim>
  bool
  Scene<dim>::conserves_energy() const
  {
    return any_of(stages, [](const auto &named) {
      return named.second.time.integrator.integrator == "energy-momentum";
    });
  }



  template <int dim>
  bool
  Scene<dim>::divides_steps() const
  {
    return any_of(stages, [](const auto &named) {
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
  Scene<dim>::choose_spectral_radius(const InputFile &input)
  {
    const bool any = any_of(boundaries, [](const auto &named) {
      return named.second.constraint == "contact";
    });
    // Impacts would live on in the highest frequencies.
    const auto set_radius = [&](const std::string          &section,
                                const IntegratorParameters &chosen) {
      if (any && contains({"generalised-alpha", "Bathe"}, chosen.integrator) &&
          !input.has("Time", "Spectral radius") &&
          !input.has(section, "Spectral radius"))
        prm.set("Spectral radius", 0.);
    };
    prm.enter_subsection("Time");
    set_radius("Time", time.integrator);
    prm.leave_subsection();
    prm.enter_subsection("Stages");
    for (const auto &[name, stage] : stages)
      {
        prm.enter_subsection(name);
        prm.enter_subsection("Time");
        set_radius("Stages/" + name + "/Time", stage.time.integrator);
        prm.leave_subsection();
        prm.leave_subsection();
      }
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
        if (boundary.constraint == "absorbing" ||
            boundary.constraint == "contact")
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
  Scene<dim>::choose_enforcement_of_contact(const std::string &if_left_out,
                                            const InputFile   &input)
  {
    prm.enter_subsection("Boundaries");
    for (const auto &[name, boundary] : boundaries)
      if (boundary.constraint == "contact")
        {
          const std::string section = "Boundaries/" + name;
          prm.enter_subsection(name);
          if (!input.has(section, "Enforcement"))
            prm.set("Enforcement", if_left_out);
          if (boundary.enforcement.enforcement == "augmented Lagrangian" &&
              !input.has(section, "Band width"))
            prm.set("Band width", 0.05);
          prm.leave_subsection();
        }
    prm.leave_subsection();
  }



  template <int dim>
  void
  Scene<dim>::choose_method()
  {
    const bool keeps_equal_cells = mesh.is_box() &&
                                   mesh_motion.follow.empty() &&
                                   mesh_motion.stretch.empty();
    prm.enter_subsection("Method");
    prm.set("Method", std::string(keeps_equal_cells ? "GIMP" : "CPDI1"));
    prm.leave_subsection();
  }



  template <int dim>
  void
  Scene<dim>::choose_volumetric_strain(
    const std::vector<InputFile::Entry> &given)
  {
    bool may_lock = false, has_friction = false;
    for (const auto &[name, parameters] : materials)
      {
        const auto material = make_material(parameters, "Materials/" + name);
        may_lock            = may_lock || material->may_lock();
        has_friction        = has_friction || material->has_friction();
      }
    const bool is_damped = any_of(given, [](const auto &entry) {
      return contains({"Stiffness damping", "Damping ratio"}, entry.key);
    });
    // A mesh that forgets how it moved lets hourglass modes of the points grow
    // from step to step.
    const bool forgets = method.strain_measure() == StrainMeasure::finite &&
                         method.after_step() == MeshAfterStep::reset;
    prm.enter_subsection("Method");
    prm.set("Volumetric strain",
            !may_lock || !method.can_average_volume() || conserves_energy() ||
                is_damped ?
              std::string("pointwise") :
            has_friction && !forgets ? std::string("cell mean with shear") :
                                       std::string("cell mean"));
    prm.leave_subsection();
  }



  template <int dim>
  void
  Scene<dim>::choose_limit_points()
  {
    const bool is_associated =
      std::all_of(materials.begin(), materials.end(), [](const auto &named) {
        return make_material(named.second, "Materials/" + named.first)
          ->has_symmetric_tangent();
      });
    const bool follows_path = any_of(stages, [](const auto &named) {
      return named.second.time.follows_path();
    });
    // Soil that failed comes to rest in another shape, if its points move.
    const bool may_slide_to_rest =
      strength_reduction.factor > 1 &&
      (method.after_step() != MeshAfterStep::keep ||
       method.strain_measure() != StrainMeasure::small);
    prm.enter_subsection("Solver");
    prm.set("Limit points",
            is_associated || follows_path || is_dynamic() || may_slide_to_rest ?
              std::string("stop") :
              std::string("pseudo-transient"));
    prm.leave_subsection();
  }



  template <int dim>
  void
  Scene<dim>::choose_gauss_points(const std::vector<InputFile::Entry> &given,
                                  const bool any_yields)
  {
    const bool is_given = any_of(given, [](const auto &entry) {
      return entry.section == "Method" && entry.key == "Points per direction";
    });
    if (is_given || method.method != "finite element" || method.degree == 1)
      return;
    prm.enter_subsection("Method");
    prm.set("Points per direction", any_yields ? 2L : 3L);
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
    prm.add_parameter("Title", output.title, "Shown at the start of a run.");
    prm.declare_entry(
      "Units",
      "",
      Patterns::List(Patterns::Anything()),
      "Names of the units of length, force and time, as m, kN, s, for results "
      "and pictures. They change no number.");

    const auto section = [this](const std::string &name, auto &parameters) {
      prm.enter_subsection(name);
      parameters.add_parameters(prm);
      prm.leave_subsection();
    };
    for (auto &named : materials)
      named.second.dim = dim;
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
    prm.enter_subsection("Water");
    water.add_parameters(prm, dim);
    prm.leave_subsection();
    section("Time", time);
    in_subsections(prm, "Stages", stages, [this](auto &stage) {
      stage.add_parameters(prm);
      prm.enter_subsection("Water");
      stage.water.add_parameters(prm, dim, /* of_stage = */ true);
      prm.leave_subsection();
    });
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
    section("Material test", study.material_test);
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



  template class Scene<2>;
  template class Scene<3>;
} // namespace moraine
