// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// The part of StepDriver that judges a step and rejects it.

#include <moraine/core/exceptions.h>
#include <moraine/core/words.h>
#include <moraine/run/step_driver.h>
#include <moraine/run/step_failure.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** After that many rejections in a row, shorter steps are no cure. */
    constexpr unsigned int rejections_before_support = 2;

    /** A node of a cell that is filled this much is touched by enough points.
     */
    constexpr double full_cell = 0.9;

    /** Held nodes carry next to nothing; a mechanism hangs on empty parts. */
    constexpr double largest_empty_share = 1e-3;

    /** Of all forces: a jump that is out of balance as a step begins. */
    constexpr double least_jump = 0.01;



    /** Whether the largest unbalanced force is where material that may yield
     * fills a cell: too few points are no cause there. Collective. */
    template <int dim>
    bool
    yields_in_full_cell(const Model<dim> &model, const NewtonReport &report)
    {
      if (!model.state->dissipates() ||
          (report.status != NewtonStatus::diverged &&
           report.status != NewtonStatus::too_many_iterations))
        return false;
      const auto found = largest_imbalance(*model.space,
                                           *model.points,
                                           model.system->residual());
      return found && found->fullest > full_cell;
    }



    /** The smallest factor on the step that a material asks for, at most 1.
     * Collective. */
    template <int dim>
    double
    wanted_cut(const Model<dim> &model)
    {
      double cut = 1;
      for (const auto &material : model.materials)
        cut = std::min(cut, material->wanted_cut(model.state->step_time()));
      return Utilities::MPI::min(cut, model.space->communicator());
    }
  } // namespace



  template <int dim>
  void
  StepDriver<dim>::reject(const NewtonReport &report,
                          const std::string  &reason,
                          unsigned int       &n_rejections)
  {
    for (RunObserver<dim> *observer : observers)
      observer->step_rejected(time_control.trial_time(), reason);
    const bool in_vain = shorter_is_no_cure(report);
    // At finite strain the stress of a point makes a matrix regular where it
    // should be singular, and nodes run away however short the step.
    const bool supported =
      model.state->mesh_after_step() == MeshAfterStep::reset &&
      (in_vain || n_rejections == rejections_before_support) &&
      ((!yields_in_full_cell(model, report) && hold_empty_parts()) ||
       (!in_vain && !report.converged() && take_back_support()));
    const double cut = wanted_cut(model);
    if (!in_vain && cut == 1)
      split_jump(report);
    const bool repeats = time_control.reject(reason, cut);
    if (supported)
      {
        time_control.take_back_cuts();
        n_rejections = 0;
      }
    if (supported || (repeats && !in_vain))
      return;
    const bool path_may_end =
      report.status == NewtonStatus::diverged ||
      report.status == NewtonStatus::too_many_iterations;
    const std::string message =
      time_control.message() +
      (in_vain ? " A shorter step has the same matrix." : "") +
      (scene.newton.limit_points == "stop" && path_may_end &&
           scene.strength_reduction.factor == 1 && // else the answer is there
           !time_control.follows_path() ?
         " If a path of equilibria ends here, 'Limit points = "
         "pseudo-transient' in section 'Solver' looks for one beyond; 'Arc "
         "length' in section 'Time' follows the path where the load falls." :
         "");
    if (report.ran_out_of_linear_iterations)
      throw ComputationError(message);
    throw NoEquilibrium(message);
  }



  template <int dim>
  void
  StepDriver<dim>::split_jump(const NewtonReport &report)
  {
    const double          t    = time_control.time();
    const TimeParameters &time = scene.stages[stage].second.time;
    // In later steps, points that cross cells leave forces out of balance; that
    // is no sudden load.
    if (report.status == NewtonStatus::linear_solver_failed ||
        time.integrator.dynamic() || time.follows_path() ||
        t != time.start_time || fading.acts_at(t))
      return;
    const auto jump = model.system->imbalance_at_start();
    if (!(jump.share > least_jump))
      return;
    std::vector<Tensor<1, dim>> of_nodes;
    model.space->node_values(jump.forces, of_nodes);
    fading.begin(of_nodes, t, time_control.trial_time());
    add_fading_forces();
    tell("the forces that begin to act at t = " + text_of(t, 6) +
         " come in parts until t = " + text_of(time_control.trial_time(), 6));
  }



  template <int dim>
  void
  StepDriver<dim>::add_fading_forces()
  {
    if (!fading.has_term)
      model.system->add(std::make_unique<FadingForcesTerm<dim>>(fading));
    fading.has_term = true;
  }



  template <int dim>
  bool
  StepDriver<dim>::shorter_is_no_cure(const NewtonReport &report) const
  {
    return report.ran_out_of_linear_iterations && report.iterations == 0 &&
           model.state->is_linear() &&
           !scene.stages[stage].second.time.integrator.dynamic();
  }



  template <int dim>
  std::string
  StepDriver<dim>::reason_to_reject(const NewtonReport &report,
                                    const LA::Vector   &x)
  {
    if (report.status == NewtonStatus::linear_solver_failed)
      return report.message +
             cause_of_unsolved(model,
                               report.ran_out_of_linear_iterations,
                               method.fictitious_stiffness > 0 || support);
    if (report.status == NewtonStatus::diverged ||
        report.status == NewtonStatus::too_many_iterations)
      return report.message + place_of_imbalance(*model.space,
                                                 *model.points,
                                                 model.system->residual());
    if (!report.converged())
      return report.message.empty() ? to_string(report.status) : report.message;
    if (support &&
        model.system
            ->share([this](const Term<dim> &term) { return &term == support; })
            .of_forces > largest_empty_share)
      return std::string("what points leave empty would carry the load: too "
                         "few points in the cells, ") +
             (model.state->dissipates() ?
                "a body that is not held, or a limit load of material that "
                "yields" :
                "or a body that is not held");
    return model.system->reason_to_reject(x);
  }



  template <int dim>
  std::string
  StepDriver<dim>::error_too_large(const NewtonReport &report,
                                   const LA::Vector   &x) const
  {
    const double tolerance = scene.stages[stage].second.time.error_tolerance;
    if (!report.converged() || !(tolerance > 0))
      return "";
    const double error = error_of_step(x);
    if (!(error > tolerance))
      return "";
    return "its estimated error is " + text_of(error) +
           " of a cell, more than Error tolerance = " + text_of(tolerance);
  }



  template <int dim>
  double
  StepDriver<dim>::error_of_step(const LA::Vector &x) const
  {
    model.state->set_trial(x);
    return model.motion->error_of_increment() / model.mesh->cell_size();
  }



  template <int dim>
  double
  StepDriver<dim>::allowed_growth(const LA::Vector &x) const
  {
    // The error goes with the cube of the size.
    constexpr double margin = 0.9;
    const double tolerance  = scene.stages[stage].second.time.error_tolerance;
    return tolerance > 0 ? margin * std::cbrt(tolerance / error_of_step(x)) :
                           std::numeric_limits<double>::infinity();
  }



#define INSTANTIATE(dim)                                                       \
  template void StepDriver<dim>::reject(const NewtonReport &,                  \
                                        const std::string &,                   \
                                        unsigned int &);                       \
  template void StepDriver<dim>::add_fading_forces();                          \
  template bool StepDriver<dim>::shorter_is_no_cure(const NewtonReport &)      \
    const;                                                                     \
  template std::string StepDriver<dim>::reason_to_reject(const NewtonReport &, \
                                                         const LA::Vector &);  \
  template std::string StepDriver<dim>::error_too_large(const NewtonReport &,  \
                                                        const LA::Vector &)    \
    const;                                                                     \
  template double StepDriver<dim>::allowed_growth(const LA::Vector &) const;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
