// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_run_model_h
#define moraine_run_model_h

#include <moraine/assembly/mechanics_system.h>
#include <moraine/boundary/contact_boundary.h>
#include <moraine/diagnostics/facts.h>
#include <moraine/output/probes.h>
#include <moraine/points/bodies.h>
#include <moraine/scene/scene.h>

#include <deal.II/base/timer.h>

#include <memory>
#include <string>
#include <vector>

namespace moraine
{
  /**
   * A scene turned into the objects of the rooms, in the order in which they
   * need each other. Computes nothing itself.
   */
  template <int dim>
  struct Model
  {
    /**
     * @p timer gets the times of assembly and search.
     * @throws InputError for mistakes that show only now: empty or overlapping
     * bodies, bodies outside the mesh.
     */
    Model(const Scene<dim>    &scene,
          const MPI_Comm      &communicator,
          dealii::TimerOutput &timer);

    Model(const Model &) = delete;

    /** Let act what acts in stage @p k of @p scene, by its integrator, on the
     * bodies that it has, from the next MechanicsSystem::begin_step() on.
     * Collective. */
    void
    set_stage(const Scene<dim> &scene, const unsigned int k);

    /** Its parts for diagnostics. */
    typename Facts<dim>::Objects
    objects(const Scene<dim> &scene) const;

    std::vector<Body<dim>>                       bodies;
    std::vector<std::string>                     body_names;
    std::vector<bool>                            present; ///< bodies, by now
    std::vector<std::shared_ptr<const Material>> materials;
    std::unique_ptr<BackgroundMesh<dim>>         mesh;
    std::unique_ptr<GridSpace<dim>>              space;
    std::unique_ptr<PointSet<dim>>               points;
    std::unique_ptr<Basis<dim>>                  basis;
    std::unique_ptr<State<dim>>                  state;
    std::unique_ptr<Motion<dim>>                 motion; ///< in dynamics
    std::vector<ImplicitBoundary<dim>>           boundaries;
    std::vector<GridCondition<dim>>              grid_conditions;
    std::vector<AbsorbingBoundary<dim>>          absorbing_boundaries;
    std::vector<ContactBoundary<dim>>            contact_boundaries;
    Loads<dim>                                   loads;
    MeshMotion<dim>                              mesh_motion;
    std::unique_ptr<MechanicsSystem<dim>>        system;
    std::unique_ptr<LinearSolver>                linear_solver;
    std::unique_ptr<Probes<dim>>                 probes;

  private:
    void
    make_points(const Scene<dim> &scene);

    /** Keep the points of bodies that come in a later stage. */
    void
    keep_for_later(const Scene<dim> &scene);

    /** Let the bodies with these names be there, and no others. */
    void
    set_bodies(const std::vector<std::string> &names);

    /** The same for those that are flagged, with what nodes carry. */
    void
    exchange_points(const std::vector<bool> &stay,
                    const std::vector<bool> &come);

    Terms<dim>
    terms_of(const Scene<dim> &scene, const StageParameters &stage);

    /** Of each body, as drawn; empty of those that do not come later. */
    std::vector<std::vector<typename PointSet<dim>::Record>> later;
  };
} // namespace moraine

#endif
