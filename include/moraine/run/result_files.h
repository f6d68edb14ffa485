// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_run_result_files_h
#define moraine_run_result_files_h

#include <moraine/output/history.h>
#include <moraine/output/output_directory.h>
#include <moraine/output/pvd_history.h>
#include <moraine/run/history_row.h>
#include <moraine/run/run_observer.h>

#include <deal.II/base/timer.h>

#include <map>
#include <string>
#include <vector>

namespace moraine
{
  /**
   * Writes history.csv, the VTU files with their lists, and at the end
   * summary.json.
   */
  template <int dim>
  class ResultFiles : public RunObserver<dim>, public StatePart
  {
  public:
    /** @p timer gets the time of writing. */
    ResultFiles(const Scene<dim>      &scene,
                const Model<dim>      &model,
                const OutputDirectory &directory,
                dealii::TimerOutput   &timer);

    StatePart *
    record() override
    {
      return this;
    }

    /** Data sets in the group "output". */
    void
    write(Archive &archive) const override;

    /** Writes the lists of files and the history of the archive. What was
     * written after it goes. Collective. */
    void
    read(const Archive &archive) override;

    void
    run_begins() override;

    void
    step_accepted(const AcceptedStep<dim> &step) override;

    void
    run_ends(const Summary &summary, const RunCounts &counts) override;

    void
    run_fails(const Summary &summary) override;

  private:
    /** Make the folders and lists of what this run writes as VTU. */
    void
    prepare_series();

    /** Write the next file of a series and put it into its list. */
    void
    add_file(const std::string                            &series,
             const double                                  t,
             const std::function<void(const VtuTarget &)> &write_vtu_file);

    using Increments = std::vector<dealii::Tensor<1, dim>>;

    void
    write_vtu(const double t, const Increments &increments);

    /**
     * The points alone, which a run that ends early leaves behind: the mesh may
     * be that of the next step already.
     */
    void
    write_points(const double t);

    const Scene<dim>      &scene;
    const Model<dim>      &model;
    const OutputDirectory &directory;
    dealii::TimerOutput   &timer;
    const MPI_Comm         communicator;
    History                history;
    /** By series: points, mesh, boundaries, domains, water. */
    std::map<std::string, PvdHistory> lists;
    /** Of conditions that move; see translations_of_conditions(). */
    NamedTranslations<dim>   translations;
    std::vector<std::string> acting; ///< boundaries, in the last step
    unsigned int             n_vtu_written = 0;
    double                   t_written     = 0; ///< of the last VTU file
    double                   t_accepted    = 0;
  };
} // namespace moraine

#endif
