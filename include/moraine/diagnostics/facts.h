// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_diagnostics_facts_h
#define moraine_diagnostics_facts_h

#include <moraine/assembly/mechanics_system.h>
#include <moraine/points/bodies.h>
#include <moraine/scene/scene.h>

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace moraine
{
  /**
   * A run as diagnostics read it: its objects, the current step and stage, and
   * shared quantities, which are computed once for each moment. Functions are
   * collective.
   */
  template <int dim>
  class Facts
  {
  public:
    /** The objects of a run. */
    struct Objects
    {
      const Scene<dim>                                   &scene;
      const std::vector<Body<dim>>                       &bodies;
      const std::vector<std::string>                     &body_names;
      const std::vector<bool>                            &present;
      const std::vector<std::shared_ptr<const Material>> &materials;
      const BackgroundMesh<dim>                          &mesh;
      const GridSpace<dim>                               &space;
      const PointSet<dim>                                &points;
      const Basis<dim>                                   &basis;
      const State<dim>                                   &state;
      const Motion<dim> *motion; ///< null without inertia
      const std::vector<ImplicitBoundary<dim>>  &boundaries;
      const std::vector<GridCondition<dim>>     &grid_conditions;
      const std::vector<AbsorbingBoundary<dim>> &absorbing_boundaries;
      const Loads<dim>                          &loads;
      const MeshMotion<dim>                     &mesh_motion;
      MechanicsSystem<dim>                      &system;
    };

    /** Where a run is. */
    struct Moment
    {
      const StageParameters *stage  = nullptr;
      const StageParameters *before = nullptr; ///< null in the first stage
      double                 t      = 0;
      /** Of the last step; null before. */
      const std::vector<BoundaryReport<dim>> *reports = nullptr;
      /** Largest motion in the last step [length]. */
      double node_motion = 0, point_motion = 0;
      bool   follows_path  = false;
      bool   between_parts = false; ///< of a step
      /** At the end: see stress_error(). */
      std::optional<double> stress_error;
    };

    explicit Facts(const Objects &objects)
      : of(objects)
    {}

    /** Go to another moment; computed quantities are forgotten. */
    void
    set(const Moment &moment)
    {
      now = moment;
      fills.clear();
      nodes.clear();
    }

    /** Whether the boundary @p name holds in the stage. */
    bool
    holds(const std::string &name) const;

    /** Whether it holds but did not in the stage before. */
    bool
    begins_to_hold(const std::string &name) const;

    /** Whether a body is there but was not in the stage before. */
    bool
    is_new(const std::string &body) const;

    /** Whether all bodies have shapes. */
    bool
    are_drawn() const;

    /** Whether a body that is there has been drawn around @p x. */
    bool
    in_a_body(const dealii::Point<dim> &x) const;

    /** Whether points leave the mesh as it is or nodes go with them, at small
     * strain. */
    bool
    is_small_and_moves() const
    {
      return of.state.strain_measure() == StrainMeasure::small &&
             of.state.mesh_after_step() != MeshAfterStep::keep;
    }

    bool
    has_inertia() const
    {
      return of.system.step_context().motion;
    }

    double
    cell_size() const
    {
      return of.mesh.cell_size();
    }

    MPI_Comm
    communicator() const
    {
      return of.space.communicator();
    }

    /** Of the materials, the largest @f$\lambda + 2\mu@f$ [stress]. */
    double
    largest_modulus() const;

    /** The filled fraction of each active cell: [body][cell], the same on all
     * ranks. */
    const std::vector<std::vector<double>> &
    filled_parts();

    /** For each body, the nodes that its points touch. */
    const std::vector<std::vector<bool>> &
    touched_nodes();

    const Objects of;
    Moment        now;

  private:
    std::vector<std::vector<double>> fills;
    std::vector<std::vector<bool>>   nodes;
  };

  /** Of @p conditions those that prescribe displacements in @p stage. */
  template <int dim>
  std::vector<GridCondition<dim>>
  acting_conditions(const std::vector<GridCondition<dim>> &conditions,
                    const StageParameters                 &stage);

  /** Whether a boundary absorbs in a stage. */
  template <int dim>
  bool
  absorbs_in(const StageParameters        &stage,
             const Scene<dim>             &scene,
             const AbsorbingBoundary<dim> &boundary);
} // namespace moraine

#endif
