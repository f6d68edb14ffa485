// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_run_simulation_h
#define moraine_run_simulation_h

#include <moraine/assembly/mechanics_system.h>
#include <moraine/core/console.h>
#include <moraine/output/history.h>
#include <moraine/output/output_directory.h>
#include <moraine/output/pvd_history.h>
#include <moraine/output/summary.h>
#include <moraine/points/bodies.h>
#include <moraine/run/scene.h>

#include <deal.II/base/timer.h>

#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace moraine
{
  /** How `moraine run` was called. */
  struct RunOptions
  {
    std::string output_directory; ///< overrides the scene's
    bool        overwrite    = false;
    bool        write_output = true; ///< studies keep the summary only
  };

  /**
   * A scene turned into rooms in order, and the loop over its steps. It knows
   * everybody's name and computes nothing itself.
   */
  template <int dim>
  class Simulation
  {
  public:
    /**
     * Build the mesh, the points and everything that acts on them.
     * @throws InputError for mistakes that show only now: empty or overlapping
     * bodies, bodies outside the mesh, boundaries that touch no body.
     */
    Simulation(Scene<dim>     &scene,
               const MPI_Comm &communicator,
               Console        &console);

    /** Say what will be simulated. */
    void
    describe();

    /**
     * Step to the end.
     * @return the summary, also when the run ended early; its status says so.
     */
    Summary
    run(const RunOptions &options, const InputFile &input);

  private:
    void
    make_basis();

    /**
     * Find cells and pieces for the first step; check that boundaries touch a
     * body and that every body is held.
     */
    void
    begin_first_step();

    void
    check_prescribed_motion();

    void
    check_loads() const;

    void
    check_sides_of_boundaries();

    /** One step that must be accepted, with as many cuts as it takes. */
    void
    advance(TimeControl &time);

    /**
     * A matrix that cannot be factorised, because too few points touch some
     * nodes: give empty parts of cells a stiffness from now on.
     * @return whether that is new.
     * @throw ComputationError if a body is not held.
     */
    bool
    hold_empty_parts(const NewtonReport &report);

    /** Add what a solve took to the sums. */
    void
    count(const NewtonReport &report);

    /** Newton::jump() after a solution that @p failed. */
    NewtonReport
    jump(Newton &newton, const NewtonReport &failed, LA::Vector &x);

    /** Why the solution @p x of a step cannot be accepted; empty if it can. */
    std::string
    reason_to_reject(const NewtonReport &report, const LA::Vector &x);

    /** Say how far the trial state is from the accepted one. Collective. */
    void
    note_jump(const TimeControl &time);

    /** Say what became of domains and points in the last step. Collective. */
    void
    note_domains();

    /** A row of history.csv and the VTU files that are due. */
    void
    write_results(const TimeControl &time, const bool due);

    void
    write_vtu(const double t);

    /**
     * The points alone, which a run that ends early leaves behind: the mesh may
     * be that of the next step already.
     */
    void
    write_points(const double t);

    /** @throw ComputationError naming the point that the step pushes out. */
    void
    check_that_points_stay(const TimeControl &time, const LA::Vector &x);

    void
    print_step(const TimeControl &time, const NewtonReport &report);

    void
    print_closing(const Summary &summary);

    Summary
    make_summary(const TimeControl &time);

    void
    keep_summary_of_failure(const TimeControl &time, const std::string &what);

    Scene<dim>                                  &scene;
    const MPI_Comm                               communicator;
    Console                                     &console;
    dealii::Timer                                wall_time;
    std::ostringstream                           unused_timer_output;
    dealii::TimerOutput                          timer;
    std::vector<std::shared_ptr<const Material>> materials;
    std::vector<Body<dim>>                       bodies;
    std::vector<std::string>                     body_names;
    std::vector<double>                          body_volumes;
    std::unique_ptr<BackgroundMesh<dim>>         mesh;
    std::unique_ptr<GridSpace<dim>>              space;
    std::unique_ptr<PointSet<dim>>               points;
    std::unique_ptr<Basis<dim>>                  basis;
    std::unique_ptr<State<dim>>                  state;
    std::vector<ImplicitBoundary<dim>>           boundaries;
    std::vector<GridCondition<dim>>              grid_conditions;
    Loads<dim>                                   loads;
    MeshMotion<dim>                              mesh_motion;
    std::unique_ptr<MechanicsSystem<dim>>        system;
    std::unique_ptr<LinearSolver>                linear_solver;
    std::unique_ptr<Probes<dim>>                 probes;
    std::vector<std::string>                     effects;
    std::vector<std::string>                     notes;

    std::optional<OutputDirectory>      directory;
    std::optional<History>              history;
    std::optional<PvdHistory>           points_pvd;
    std::optional<PvdHistory>           mesh_pvd;
    std::optional<PvdHistory>           domains_pvd;
    unsigned int                        n_vtu_written = 0;
    double                              t_written     = 0;
    std::vector<BoundaryReport<dim>>    reports;
    std::vector<dealii::Tensor<1, dim>> last_increments;
    unsigned int                        newton_iterations = 0;
    unsigned int                        linear_iterations = 0;
    unsigned int                        n_jumps           = 0;
    std::optional<double>               condition_number;
    std::string                         solver_name;
    unsigned int                        n_put_back        = 0;
    bool                                has_far_domains   = false;
    bool                                first_step        = true;
    bool                                holds_empty_parts = false;
  };

} // namespace moraine

#endif
