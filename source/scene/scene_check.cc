// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// The part of Scene that finds what cannot be right, as far as the text tells.

#include <moraine/scene/check_contact.h>
#include <moraine/scene/scene.h>
#include <moraine/scene/scene_bodies.h>

#include <moraine/core/exceptions.h>
#include <moraine/core/ranges.h>
#include <moraine/core/words.h>

#include <algorithm>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** Whether loads of this type look at the key. */
    bool
    load_uses(const std::string &type, const std::string &key)
    {
      const bool is_of_surface = !contains(
        {"Type", "Value", "Curve", "Bodies", "Coordinates", "Side", "Location"},
        key);
      return contains({"Type", "Value", "Curve"}, key) ||
             (contains({"body force", "gravity"}, type) &&
              contains({"Bodies", "Coordinates"}, key)) ||
             (contains({"side traction", "pressure"}, type) && key == "Side") ||
             (type == "point force" && key == "Location") ||
             (type == "force on points" && key == "Location") ||
             (contains({"surface traction", "pressure"}, type) &&
              is_of_surface);
    }



    /** Keys of a load of type pressure that do not go together. */
    template <int dim>
    void
    check_pressure(const std::string                   &section,
                   const LoadParameters<dim>           &load,
                   const Scene<dim>                    &scene,
                   const std::vector<InputFile::Entry> &given)
    {
      bool has_surface = false;
      for (const auto &entry : given)
        if (entry.section == section &&
            !contains({"Type", "Value", "Curve", "Side"}, entry.key))
          {
            has_surface = true;
            if (!load.side.empty())
              reject(entry, "nothing; key 'Side' says where it acts");
          }
      if (load.side.empty() && !has_surface)
        throw InputError("section '" + section +
                         "': found no place of the pressure, allowed: 'Side', "
                         "or a surface as 'Body' and 'Part', or 'Points'");
      if (scene.method.strain_measure() == StrainMeasure::finite &&
          scene.linear_solver.solver == "amg-cg")
        reject("Solver",
               "Solver",
               scene.linear_solver.solver,
               "auto, direct or gmres: the tangent of '" + section +
                 "' is not symmetric");
    }



    /** Whether a key of section 'Time' is one of this integrator. */
    bool
    integrator_uses(const IntegratorParameters &chosen, const std::string &key)
    {
      if (contains({"Newmark beta", "Newmark gamma"}, key))
        return chosen.integrator == "Newmark";
      if (key == "Spectral radius")
        return contains({"generalised-alpha", "Bathe"}, chosen.integrator);
      if (contains({"Mass", "Velocity transfer", "Error tolerance"}, key))
        return chosen.dynamic();
      if (key == "FLIP share")
        return chosen.dynamic() && chosen.transfer == "blend";
      if (key == "FMPM order")
        return chosen.dynamic() && chosen.transfer == "FMPM";
      return true;
    }



    /** Keys that the integrator of a stage does not look at. */
    template <int dim>
    void
    check_integrator(const Scene<dim>                    &scene,
                     const std::string                   &section,
                     const IntegratorParameters          &chosen,
                     const std::vector<InputFile::Entry> &given)
    {
      if (chosen.integrator == "energy-momentum" &&
          scene.method.chosen().has_own_internal_force)
        reject(section,
               "Integrator",
               chosen.integrator,
               "another one with method '" + scene.method.method + "'");
      if (chosen.integrator == "energy-momentum" &&
          scene.method.averages_volume())
        reject(section,
               "Integrator",
               chosen.integrator,
               "another one with 'Volumetric strain = cell mean'");
      for (const auto &entry : given)
        {
          if (entry.section != section)
            continue;
          if (!integrator_uses(chosen, entry.key))
            reject(entry,
                   "nothing with 'Integrator = " + chosen.integrator + "'" +
                     (chosen.dynamic() ?
                        ", 'Velocity transfer = " + chosen.transfer + "'" :
                        ""));
          if (entry.key == "Velocity transfer" &&
              scene.method.after_step() != MeshAfterStep::reset)
            reject(entry,
                   "nothing where nodes stay with the material, as with method "
                   "'finite element'; they keep their velocity");
        }
      const IntegratorParameters &first =
        scene.first_dynamic_stage().time.integrator;
      if (chosen.dynamic() &&
          (chosen.transfer != first.transfer || chosen.mass != first.mass))
        reject(section,
               chosen.mass != first.mass ? "Mass" : "Velocity transfer",
               chosen.mass != first.mass ? chosen.mass : chosen.transfer,
               (chosen.mass != first.mass ? first.mass : first.transfer) +
                 ", as in the first stage with inertia");
      // One rule of transfer serves all stages.
      const auto as_first =
        [&](const std::string &key, const double found, const double wanted) {
          if (chosen.dynamic() && found != wanted)
            reject(section,
                   key,
                   text_of(found),
                   text_of(wanted) + ", as in the first stage with inertia");
        };
      if (chosen.transfer == "blend")
        as_first("FLIP share", chosen.flip_share, first.flip_share);
      if (chosen.transfer == "FMPM")
        as_first("FMPM order", chosen.fmpm_order, first.fmpm_order);
    }



    /** What only scenes with or without inertia may say. */
    template <int dim>
    void
    check_dynamics(const Scene<dim>                    &scene,
                   const std::vector<InputFile::Entry> &given)
    {
      for (const auto &[name, stage] : scene.stages)
        check_integrator(scene,
                         time_section(name),
                         stage.time.integrator,
                         given);
      if (scene.method.averages_volume())
        for (const auto &entry : given)
          if (contains({"Stiffness damping", "Damping ratio"}, entry.key))
            reject(entry, "nothing with 'Volumetric strain = cell mean'");
      for (const auto &entry : given)
        {
          if (entry.key == "Initial velocity" && !scene.is_dynamic())
            reject(entry,
                   "nothing in a quasi-static scene; 'Integrator = Newmark' in "
                   "section 'Time' makes it dynamic");
          if (entry.section == "Solver" && entry.key == "Limit points" &&
              entry.value == "pseudo-transient" && scene.is_dynamic())
            reject(entry,
                   "stop; a dynamic scene passes limit points by inertia");
        }
      if (scene.is_dynamic())
        for (const auto &[name, material] : scene.materials)
          if (!(make_material(material, "Materials/" + name)->density() > 0))
            throw InputError("section 'Materials/" + name +
                             "': found no 'Density', allowed: a density > 0; "
                             "a dynamic scene needs that of every material");
    }



    /** Where a path of equilibria cannot be followed. */
    template <int dim>
    void
    check_path(const Scene<dim> &scene)
    {
      for (const auto &[name, stage] : scene.stages)
        {
          if (!stage.time.follows_path())
            continue;
          const auto refuse = [&, &of = name](const std::string &why) {
            reject(time_section(of),
                   "Arc length",
                   text_of(stage.time.arc_length),
                   "0; " + why);
          };
          if (stage.time.integrator.dynamic())
            refuse("'Integrator' is '" + stage.time.integrator.integrator +
                   "', and inertia takes a body past limit points");
          if (&stage != &scene.stages.back().second)
            refuse("another stage follows, which begins at 'End time', where a "
                   "path need not end");
          if (!scene.mesh_motion.follow.empty() ||
              !scene.mesh_motion.stretch.empty())
            refuse("section 'Mesh motion' moves the mesh by times that are "
                   "known before the step");
          if (scene.newton.limit_points != "stop")
            refuse("'Limit points' in section 'Solver' is '" +
                   scene.newton.limit_points +
                   "', which leaves the path, or 'stop' there");
        }
    }



    /** Where displacements are reset, though what comes asks for the places
     * where the material was at the start of the run. */
    template <int dim>
    void
    check_resets(const Scene<dim> &scene)
    {
      if (scene.method.after_step() == MeshAfterStep::keep)
        return;
      // The first stage has nothing to reset.
      for (auto stage = scene.stages.begin() + 1; stage != scene.stages.end();
           ++stage)
        {
          if (!stage->second.reset_displacements)
            continue;
          const auto refuse = [&](const std::string &why) {
            reject("Stages/" + stage->first,
                   "Reset displacements",
                   "true",
                   "false; " + why +
                     " where the material was at the start of the run, which "
                     "only displacements since then tell");
          };
          for (const auto &load : scene.loads)
            {
              const auto acts = [&](const auto &other) {
                return contains(other.second.loads, load.first);
              };
              if (!std::any_of(stage, scene.stages.end(), acts))
                continue;
              if (load.second.coordinates == "original")
                refuse("load '" + load.first +
                       "' with 'Coordinates = original' is a function of");
              if (load.second.type == "force on points" &&
                  std::none_of(scene.stages.begin(), stage, acts))
                refuse("load '" + load.first +
                       "', which first acts then, looks for its points");
            }
          if (!scene.exact.displacement.empty() || !scene.exact.stress.empty())
            refuse("section 'Exact solution' is a function of");
        }
    }



    /** What prescribes or enforces a motion. */
    bool
    is_of_motion(const std::string &key)
    {
      return contains({"Components",
                       "Displacement",
                       "Translation",
                       "Rotation angle",
                       "Rotation centre",
                       "Rotation axis",
                       "Penetration limit",
                       "Held in a cell",
                       "Enforcement",
                       "Band width",
                       "Nitsche factor",
                       "Penalty factor"},
                      key);
    }



    void
    check_absorbing(const std::string                   &section,
                    const std::string                   &constraint,
                    const AbsorbingParameters           &parameters,
                    const bool                           dynamic,
                    const bool                           later,
                    const std::vector<InputFile::Entry> &given)
    {
      const bool absorbs = constraint == "absorbing";
      for (const auto &entry : given)
        if (entry.section == section &&
            (absorbs ? is_of_motion(entry.key) :
                       !later && AbsorbingParameters::has(entry.key)))
          reject(entry,
                 "nothing; key 'Constraint' is '" + constraint + "'" +
                   (absorbs ? "" :
                              ", and no stage names it in key 'Absorbing'"));
      if (!absorbs && !later)
        return;
      if (!dynamic)
        reject(section,
               "Constraint",
               constraint,
               "what holds; key 'Integrator' of section 'Time' is "
               "'quasi-static', and only waves are absorbed");
      parameters.law(section);
    }
  } // namespace



  template <int dim>
  void
  Scene<dim>::check(const InputFile                     &input,
                    const std::vector<InputFile::Entry> &given) const
  {
    for (const auto &entry : given)
      if (entry.section == "Mesh" && !mesh.uses(entry.key))
        reject(entry,
               "nothing; a mesh of type '" + mesh.type + "' has no such key");
      else if (entry.section == "Method" && entry.key == "Ghost factor" &&
               !method.has_ghost_term())
        reject(entry, "nothing with 'Cut cells = " + method.cut_cells + "'");
    if (mesh.is_box())
      for (const char *key : {"Lower corner", "Upper corner"})
        input.require("Mesh", key);
    mesh.check();
    CheckpointTimes::from_text(output.times.checkpoint_every);
    check_dynamics(*this, given);
    check_path(*this);
    check_resets(*this);
    if (!mesh_motion.stretch.empty() && mesh_motion.stretch.size() != 2)
      reject("Mesh motion",
             "Stretch between",
             input.get("Mesh motion", "Stretch between", ""),
             "two names");
    if (!mesh_motion.follow.empty() && !mesh_motion.stretch.empty())
      reject("Mesh motion",
             "Follow",
             mesh_motion.follow,
             "nothing if 'Stretch between' is given");
    if ((!mesh_motion.follow.empty() || !mesh_motion.stretch.empty()) &&
        method.after_step() != MeshAfterStep::reset)
      throw InputError(
        "section 'Mesh motion': found a motion of a mesh that is "
        "not reset after a step, allowed: nothing with method "
        "'finite element' or key 'Mesh after step' = '" +
        method.mesh_after_step + "'");
    check_operands(given);
    check_bodies(input);
    method.check();
    for (const auto &[name, load] : loads)
      {
        if (load.type == "force on points" && method.split_domains == "true")
          reject("Loads/" + name,
                 "Type",
                 load.type,
                 "point force, or 'Split domains = false' in section 'Method': "
                 "halves of a point would not share the force");
        for (const auto &entry : given)
          if (entry.section == "Loads/" + name &&
              !load_uses(load.type, entry.key))
            reject(entry, "nothing; a " + load.type + " has no such key");
        if (load.type == "pressure")
          check_pressure("Loads/" + name, load, *this, given);
      }
    check_conditions(given);
    check_water(given);
    strength_reduction.check(materials, study.finds_factor_of_safety());
    study.check(given);
    for (const auto &probe : probes)
      probe.check(is_dynamic(), has_water());
  }



  template <int dim>
  void
  Scene<dim>::check_conditions(const std::vector<InputFile::Entry> &given) const
  {
    for (const auto &[name, boundary] : boundaries)
      {
        const std::string section = "Boundaries/" + name;
        if (!boundary.components.empty() && boundary.constraint != "components")
          reject(section,
                 "Components",
                 boundary.components,
                 "nothing; key 'Constraint' is '" + boundary.constraint + "'");
        if (boundary.enforcement.enforcement == "symmetric Nitsche" &&
            conserves_energy())
          reject(
            section,
            "Enforcement",
            boundary.enforcement.enforcement,
            "another one with 'Integrator = energy-momentum', whose forces "
            "are those of the middle of a step");
        check_absorbing(section,
                        boundary.constraint,
                        boundary.absorbing,
                        is_dynamic(),
                        absorbs_later(name),
                        given);
        check_contact(*this, name, boundary, given);
      }
    for (const auto &[name, condition] : grid_conditions)
      {
        const std::string section = "Grid conditions/" + name;
        if (any_of(boundaries, [&](const auto &boundary) {
              return boundary.first == name;
            }))
          throw InputError("section '" + section +
                           "': found a name that 'Boundaries/" + name +
                           "' has too, allowed: another one, as columns of "
                           "history.csv are named by it");
        check_absorbing(section,
                        condition.constraint,
                        condition.absorbing,
                        is_dynamic(),
                        absorbs_later(name),
                        given);
        if (condition.constraint != "absorbing" && !absorbs_later(name))
          continue;
        if (condition.side.empty())
          throw InputError(place(section, "Side") +
                           ": found nothing, allowed: a side of the mesh that "
                           "absorbs");
        if (!mesh_motion.follow.empty() || !mesh_motion.stretch.empty())
          reject(section,
                 "Constraint",
                 condition.constraint,
                 "fixed; section 'Mesh motion' moves the mesh");
      }
  }



  template <int dim>
  void
  Scene<dim>::check_bodies(const InputFile &input) const
  {
    if (bodies.empty())
      throw InputError("section 'Bodies': found no body, allowed: at least one "
                       "subsection with a shape");
    if (materials.empty())
      throw InputError("section 'Materials': found no material, allowed: at "
                       "least one subsection");
    std::vector<std::string> material_names;
    for (const auto &[name, material] : materials)
      {
        material_names.push_back(name);
        if (!mesh.is_box() && Utilities::string_to_double(
                                material.texts.at("Softening length")) > 0)
          reject("Materials/" + name,
                 "Softening length",
                 input.get("Materials/" + name, "Softening length", ""),
                 "nothing; only a mesh of type 'box' has cells of one size");
        const auto made = make_material(material, "Materials/" + name);
        if (!made->has_small_strain_limit() && method.strain == "small")
          reject("Materials/" + name,
                 "Model",
                 material.model,
                 "a model for small strain; key 'Strain' of section 'Method' "
                 "is 'small'");
        if (!made->is_isotropic() && is_dynamic())
          reject("Materials/" + name,
                 "Model",
                 material.model,
                 "without inertia; in dynamics a model whose elastic energy is "
                 "known");
        if (made->with_frozen_water(0) && conserves_energy())
          reject("Materials/" + name,
                 "Drainage",
                 "undrained",
                 "drained; integrator 'energy-momentum' needs stress that is "
                 "linear in the elastic strain");
        if (!made->has_linear_elasticity() && conserves_energy())
          reject("Materials/" + name,
                 "Model",
                 material.model,
                 "another integrator than 'energy-momentum', which needs "
                 "linear elasticity");
        if (!made->has_symmetric_tangent() && linear_solver.solver == "amg-cg")
          reject("Solver",
                 "Solver",
                 linear_solver.solver,
                 "auto, direct or gmres: the tangent of material '" + name +
                   "' is not symmetric");
      }
    const auto operands = operands_of(*this);
    for (const auto &[name, body] : bodies)
      {
        const std::string section = "Bodies/" + name;
        body.damping.factors(section, !is_dynamic());
        body.initial_stress.check(section);
        if (!body.initial_velocity.empty() &&
            !contains(first_dynamic_stage().bodies, name))
          reject(section,
                 "Initial velocity",
                 body.initial_velocity,
                 "nothing; the body is not there in the first stage with "
                 "inertia, and comes at rest later");
        if (!body.point_grid.empty() &&
            (body.shape.kind() != "box" || body.point_grid.size() != dim))
          reject(section,
                 "Point grid",
                 input.get(section, "Point grid", ""),
                 std::to_string(dim) + " numbers, of a box");
        if (body.material.empty() ?
              materials.size() > 1 && operands.count(name) == 0 :
              !contains(material_names, body.material))
          reject(section,
                 "Material",
                 body.material,
                 "the name of a material" +
                   suggest(body.material, material_names));
      }
  }



  template <int dim>
  void
  Scene<dim>::check_water(const std::vector<InputFile::Entry> &given) const
  {
    water.levels.check("Water", dim);
    for (const auto &[name, stage] : stages)
      {
        stage.water.check(water_section(name), dim);
        const bool has_height =
          !stage.water.level.empty() || !stage.water.free_level.empty();
        if (has_height && !(water.unit_weight > 0))
          reject("Water",
                 "Unit weight",
                 text_of(water.unit_weight),
                 "a force per volume > 0; 'Level' and 'Free level' need it");
        const auto &integrator = stage.time.integrator;
        if (stage.water.any() && integrator.integrator == "energy-momentum")
          reject(time_section(name),
                 "Integrator",
                 integrator.integrator,
                 "another one with section 'Water'");
      }
    for (const auto &entry : given)
      if (entry.section == "Water" && !has_water())
        reject(entry,
               "nothing without 'Level' or 'Pressure' of section 'Water'");
      else if (entry.key == "Saturated density")
        {
          if (!has_water())
            reject(entry, "nothing without section 'Water'");
          if (is_dynamic())
            reject(entry,
                   "nothing in dynamics, where mass stays; a body of its own "
                   "for the wet part, with its 'Density'");
        }
    if (has_water() && method.chosen().has_own_internal_force)
      reject("Method",
             "Method",
             method.method,
             "a method without double mapping; section 'Water' is given");
    for (const auto &[name, material] : materials)
      extra_density_of(material, "Materials/" + name);
    const bool differs = any_of(stages, [this](const auto &stage) {
      return stage.second.water.differs_outside(water.suction);
    });
    for (const auto &[name, boundary] : boundaries)
      if (const std::string &how = boundary.enforcement.enforcement;
          differs && boundary.constraint != "absorbing" &&
          how.find("Nitsche") != std::string::npos)
        reject("Boundaries/" + name,
               "Enforcement",
               how,
               "one without a flux, as 'augmented Lagrangian', with 'Free "
               "level' or 'Suction = kept'");
  }



  template <int dim>
  void
  Scene<dim>::check_operands(const std::vector<InputFile::Entry> &given) const
  {
    const auto operands = operands_of(*this);
    for (const auto &[name, body] : bodies)
      for (const auto &entry : given)
        if (operands.count(name) > 0 && entry.section == "Bodies/" + name &&
            body.shape.texts.count(entry.key) == 0)
          reject(
            entry,
            "nothing; '" + name +
              "' is but a region of which another body is made ('Operands' "
              "of that one), which needs the key itself");
  }



  template void
  Scene<2>::check(const InputFile &,
                  const std::vector<InputFile::Entry> &) const;
  template void
  Scene<3>::check(const InputFile &,
                  const std::vector<InputFile::Entry> &) const;
} // namespace moraine
