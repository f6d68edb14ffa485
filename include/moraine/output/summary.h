// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_output_summary_h
#define moraine_output_summary_h

#include <moraine/core/finding.h>
#include <moraine/core/units.h>

#include <mpi.h>

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace moraine
{
  /** The largest shares that a GhostTerm had in a step. */
  struct GhostShares
  {
    double of_forces = 0; ///< of the norm of all forces
    double of_work   = 0; ///< over the largest of other terms
  };

  /** What summary.json says about a run; lists keep their order. */
  struct Summary
  {
    template <class T>
    using List = std::vector<std::pair<std::string, T>>;

    /** How large the scene and the run are. */
    struct Sizes
    {
      unsigned int  dimension       = 0;
      unsigned int  ranks           = 1;
      std::uint64_t cells           = 0;
      std::uint64_t active_cells    = 0;
      std::uint64_t unknowns        = 0;
      std::uint64_t points          = 0;
      unsigned int  bytes_per_point = 0;
      double        peak_memory_mib = 0;
      Units         units; ///< left out if there are none
    };

    /** What solving linear systems took. */
    struct LinearSystems
    {
      unsigned int             iterations = 0;
      std::vector<std::string> solvers; ///< see LinearSolver::choices()
      /** Left out if not asked for. */
      std::optional<double> condition_number;
    };

    /** How good the results are. */
    struct Quality
    {
      /** Left out without a ghost term. */
      std::optional<GhostShares> ghost_term;
      /** See estimated_stress_error(). */
      std::optional<double> stress_error;
      /** Of points [length]. */
      double largest_displacement = 0;
      /** Of the volume of all bodies; left out if nothing can yield. */
      std::optional<double> plastic_share;
    };

    /** Findings of diagnostics; left out if there are none. */
    struct Findings
    {
      std::vector<Finding> warnings, hints;
    };

    /** After the last step. */
    struct LastValues
    {
      List<double> probes; ///< by column name
      /** Force of each boundary, by component. */
      List<std::vector<double>> reactions;
      List<double>              history; ///< all columns; not in summary.json
    };

    /** "ok", "not converged", "interrupted" or "failed". */
    std::string status = "ok";
    /** What went wrong; left out if nothing did. */
    std::string message;
    /** It ended with NoEquilibrium; in the message alone in summary.json. */
    bool        no_equilibrium = false;
    std::string version;
    Sizes       sizes;
    /** End of the last accepted step. */
    double       time           = 0;
    unsigned int steps          = 0;
    unsigned int rejected_steps = 0;
    /** Steps that ended by Newton::pseudo_transient(). */
    unsigned int n_pseudo_transient = 0;
    unsigned int newton_iterations  = 0;
    Quality      quality;
    double       wall_seconds = 0;
    /** Seconds by part of the program. */
    List<double> timings;
    /** Names of the effects simulated. */
    std::vector<std::string> effects;
    LinearSystems            linear;
    Findings                 found;
    /** Left out if the scene has no exact solution. */
    List<std::optional<double>> errors;
    /** Parts of the energy at the end, and what is out of balance over the
     * largest of them; left out in quasi-static runs. */
    List<double> energy;
    LastValues   last;

    /**
     * Write summary.json from rank 0, as a whole. A number that is not finite
     * becomes null. Collective.
     *
     * @throws InputError naming @p path if it cannot be written.
     */
    void
    write(const std::string &path, const MPI_Comm &communicator) const;
  };
} // namespace moraine

#endif
