// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_scene_scene_h
#define moraine_scene_scene_h

#include <moraine/geometry/shape_library.h>
#include <moraine/core/input_file.h>
#include <moraine/core/units.h>
#include <moraine/material/material_library.h>
#include <moraine/mesh/background_mesh.h>
#include <moraine/output/error_norms.h>
#include <moraine/output/probes.h>
#include <moraine/scene/condition_parameters.h>
#include <moraine/scene/damping_parameters.h>
#include <moraine/scene/initial_stress_parameters.h>
#include <moraine/scene/method.h>
#include <moraine/scene/stage_parameters.h>
#include <moraine/scene/strength_reduction.h>
#include <moraine/scene/study_parameters.h>
#include <moraine/scene/water_parameters.h>
#include <moraine/solver/linear_solver.h>
#include <moraine/solver/newton.h>
#include <moraine/time/time_control.h>

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <vector>

namespace moraine
{
  /**
   * The dimension a scene asks for, known before anything else is read.
   * @throw InputError unless 2 or 3.
   */
  unsigned int
  dimension_of(const InputFile &input);

  /** Section `Bodies/<name>`. */
  template <int dim>
  struct BodyParameters
  {
    std::string               material;
    ShapeParameters<dim>      shape;
    std::vector<unsigned int> point_grid;
    std::vector<double>       aggregate_below; ///< none or one
    std::string               initial_velocity;
    InitialStressParameters   initial_stress;
    DampingParameters         damping;

    /** That of the groups of cells it names, once it is asked for. */
    mutable ShapePointer<dim> of_groups;

    /** Whether the cells of the mesh give the body its points. */
    bool
    is_seeded_by_cells() const
    {
      return point_grid.empty() && !shape.is_point_file();
    }

    void
    add_parameters(dealii::ParameterHandler &prm);
  };

  /** Section `Mesh motion`. */
  struct MeshMotionParameters
  {
    std::string              follow;
    std::vector<std::string> stretch;

    void
    add_parameters(dealii::ParameterHandler &prm);
  };

  /** Section `Output`. */
  struct OutputParameters
  {
    std::string title; ///< key `Title` of the scene
    std::string directory;
    bool        points    = true;
    bool        mesh      = true;
    bool        residuals = false;
    /** Ids of diagnostics that are not asked. */
    std::vector<std::string> silence;
    OutputTimes              times;
    Units                    units; ///< key `Units` of the scene

    void
    add_parameters(dealii::ParameterHandler &prm);
  };

  /**
   * Everything a scene says, read strictly and checked across sections. The
   * members of the named sections keep the order of the file.
   */
  template <int dim>
  class Scene
  {
  public:
    template <class Parameters>
    using Named = std::vector<std::pair<std::string, Parameters>>;

    /**
     * @param input the scene file
     * @param for_materials whether only materials and their test are of
     * interest: all else may be missing, and is not checked across sections.
     * @throws InputError for anything wrong that can be seen in the text.
     */
    explicit Scene(const InputFile &input, const bool for_materials = false);

    /**
     * No scene, but all parameters with their defaults; everything that the
     * user names is there once, named "<name>".
     */
    Scene();

    Scene(const Scene &) = delete;

    /** All parameters with their values. */
    dealii::ParameterHandler &
    parameters()
    {
      return prm;
    }

    MeshParameters<dim>                 mesh;
    MethodParameters<dim>               method;
    Named<MaterialParameters>           materials;
    Named<BodyParameters<dim>>          bodies;
    Named<BoundaryParameters<dim>>      boundaries;
    Named<GridConditionParameters<dim>> grid_conditions;
    Named<LoadParameters<dim>>          loads;
    MeshMotionParameters                mesh_motion;
    WaterParameters                     water;
    TimeParameters                      time;   ///< of a scene without stages
    NamedStages                         stages; ///< at least one
    NewtonParameters                    newton;
    LinearSolverParameters              linear_solver;
    OutputParameters                    output;
    std::vector<ProbeParameters<dim>>   probes;
    ExactSolutionParameters<dim>        exact;
    StrengthReductionParameters         strength_reduction;
    StudyParameters                     study;

    /** Whether there is a stage with inertia. */
    bool
    is_dynamic() const;

    /** Whether there is a stage with water. */
    bool
    has_water() const;

    /** Whether some integrator has the energy of the motion as it was. */
    bool
    conserves_energy() const;

    /** Whether some integrator divides steps into two parts. */
    bool
    divides_steps() const;

    /** The first stage with inertia, or else the first. */
    const StageParameters &
    first_dynamic_stage() const;

    double
    start_time() const
    {
      return stages.front().second.time.start_time;
    }

    double
    end_time() const
    {
      return stages.back().second.time.end_time;
    }

    /** Whether there are stages without some of the bodies. */
    bool
    changes_bodies() const;

    /** Whether the body @p name is in a stage but not in the one before, or not
     * in the first. */
    bool
    comes_later(const std::string &name) const;

    /** Whether a stage has both bodies. */
    bool
    are_together(const std::string &a, const std::string &b) const;

    /** The first stage that has the body @p name; the last if none has. */
    unsigned int
    first_stage_with(const std::string &name) const;

    /** Whether the boundary or grid condition @p name becomes absorbing in a
     * stage. */
    bool
    absorbs_later(const std::string &name) const;

    /** The stage in which an absorbing boundary or grid condition begins to
     * absorb; the last one if it never does. */
    const StageParameters &
    first_absorbing_stage(const std::string &name) const;

  private:
    void
    declare();

    /** Name files as seen from here, not from the folder of the scene. */
    void
    locate_files(const InputFile &input);

    /** @p given: what InputFile::parse() returned. */
    void
    check(const InputFile                     &input,
          const std::vector<InputFile::Entry> &given) const;

    void
    check_bodies(const InputFile &input) const;

    /** Section 'Water' and what belongs to it. */
    void
    check_water(const std::vector<InputFile::Entry> &given) const;

    /** Keys of bodies of which others are made. */
    void
    check_operands(const std::vector<InputFile::Entry> &given) const;

    /** Boundaries and grid conditions. */
    void
    check_conditions(const std::vector<InputFile::Entry> &given) const;

    /** What boundaries are enforced by if nothing is said, and how wide the
     * band is then: not by a flux where stress is not elastic, nor where one
     * that is not that of an energy would feed vibrations. */
    void
    choose_enforcement(const std::string &if_left_out, const InputFile &input);

    /** The same of contact. */
    void
    choose_enforcement_of_contact(const std::string &if_left_out,
                                  const InputFile   &input);

    /** Set the default of the spectral radius if the scene has contact. */
    void
    choose_spectral_radius(const InputFile &input);

    /** GIMP, which needs equal cells, or else CPDI1. */
    void
    choose_method();

    /** Cell means if nothing is said, cells may lock and nothing that is
     * @p given excludes them. */
    void
    choose_volumetric_strain(const std::vector<InputFile::Entry> &given);

    /** Pseudo-transient continuation at rest where flow is not associated. */
    void
    choose_limit_points();

    /** Reduced integration of degree 2 if a material yields and nothing is
     * @p given. */
    void
    choose_gauss_points(const std::vector<InputFile::Entry> &given,
                        const bool                           any_yields);

    unsigned int             dimension = dim;
    dealii::ParameterHandler prm;
  };
} // namespace moraine

#endif
