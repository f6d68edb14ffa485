// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/run/checkpoints.h>

#include <moraine/core/exceptions.h>

#include <deal.II/base/mpi.h>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  Checkpoints<dim>::Checkpoints(const CheckpointTimes &times,
                                const std::string     &folder,
                                const CheckpointLabel &label,
                                Model<dim>            &model,
                                RunObserver<dim>      &observer,
                                TimerOutput           &timer)
    : times(times)
    , files(folder, model.space->communicator())
    , label(label)
    , model(model)
    , observer(observer)
    , timer(timer)
  {}



  template <int dim>
  void
  Checkpoints<dim>::go_on(const SavedRun &saved)
  {
    files.make_last(saved.path);
    last_step = saved.label.step;
  }



  template <int dim>
  bool
  Checkpoints<dim>::due(const TimeControl &time) const
  {
    if (times.never())
      return false;
    if (time.finished())
      return true;
    if (times.steps > 0)
      return time.n_accepted() % times.steps == 0;
    return Utilities::MPI::broadcast(model.space->communicator(),
                                     since_last.wall_time() >=
                                       60 * times.minutes);
  }



  template <int dim>
  void
  Checkpoints<dim>::after_step(const StepDriver<dim> &driver)
  {
    if (due(driver.time()))
      write(driver);
  }



  template <int dim>
  bool
  Checkpoints<dim>::write(const StepDriver<dim> &driver)
  {
    const TimeControl &time = driver.time();
    if (time.n_accepted() == last_step)
      return last_step > 0;
    TimerOutput::Scope scope(timer, "checkpoints");
    label.step = time.n_accepted();
    label.t    = time.time();
    Archive archive;
    label.write(archive);
    driver.write(archive);
    driver.write_progress(archive);
    try
      {
        files.write(archive);
        last_step = time.n_accepted();
      }
    catch (const InputError &error)
      {
        observer.note("no checkpoint was written after step " +
                      std::to_string(time.n_accepted()) + ": " + error.what() +
                      (last_step > 0 ? "; the one of step " +
                                         std::to_string(last_step) + " stays" :
                                       std::string()));
      }
    model.system->forget_couplings();
    model.linear_solver->clear();
    since_last.restart();
    return last_step == time.n_accepted();
  }



  template class Checkpoints<2>;
  template class Checkpoints<3>;
} // namespace moraine
