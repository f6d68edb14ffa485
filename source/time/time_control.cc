// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/time/time_control.h>

#include <deal.II/base/parameter_handler.h>

#include <moraine/core/exceptions.h>
#include <moraine/core/patterns.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** Times closer than this part of a step are the same time. */
    constexpr double same_time = 1e-9;

    /** Multipliers take more iterations than an easy step has, whatever the
     * size: what forced a cut is behind after that many steps without one. */
    constexpr unsigned int enough_in_a_row = 5;



    std::string
    in_words(const double number)
    {
      std::ostringstream text;
      text << number;
      return text.str();
    }
  } // namespace



  TimeControl::TimeControl(const std::vector<TimeParameters> &stages,
                           const std::vector<double>         &asked)
    : stages(stages)
    , current(stages.front().start_time)
    , trial(current)
    , current_time(current)
    , found_time(current)
  {
    for (unsigned int stage = 0; stage < stages.size(); ++stage)
      {
        stages[stage].check();
        Assert(stage == 0 ||
                 stages[stage].start_time == stages[stage - 1].end_time,
               ExcMessage("A stage starts where the one before ends."));
        add_stops(stage, asked);
      }
    size = accepted_size = parameters().one_step() * parameters().largest_step;
  }



  TimeControl::TimeControl(const TimeParameters      &parameters,
                           const std::vector<double> &asked)
    : TimeControl(std::vector<TimeParameters>{parameters}, asked)
  {}



  void
  TimeControl::add_stops(const unsigned int         stage,
                         const std::vector<double> &asked)
  {
    const TimeParameters &times = stages[stage];
    if (times.follows_path())
      {
        // The same for any number of steps: a run that goes on may have more.
        for (unsigned int k = 1; k <= times.n_steps; ++k)
          stops.push_back(
            {times.start_time + k * times.arc_length, true, stage});
        return;
      }
    const double      length = times.end_time - times.start_time;
    const std::size_t first  = stops.size();
    for (unsigned int k = 1; k < times.n_steps; ++k)
      stops.push_back(
        {times.start_time + length * k / times.n_steps, true, stage});
    stops.push_back({times.end_time, true, stage});

    const double margin = same_time * length / times.n_steps;
    for (const double time : asked)
      {
        const bool known =
          std::any_of(stops.begin() + first,
                      stops.end(),
                      [&](const Stop &stop) {
                        return std::abs(stop.time - time) <= margin;
                      });
        if (!known && time > times.start_time + margin && time < times.end_time)
          stops.push_back({time, false, stage});
      }
    std::sort(stops.begin() + first,
              stops.end(),
              [](const Stop &a, const Stop &b) { return a.time < b.time; });
  }



  void
  TimeControl::next()
  {
    Assert(!finished(), ExcMessage("The run is at its end."));
    const double stop = stops[next_stop].time;
    if (between_parts())
      {
        // Stops may be others than when the first part was accepted.
        const double margin = same_time * parameters().one_step();
        const double end    = parts.end > stop - margin ? stop : parts.end;
        trial_is_stop       = end == stop && parts.cut == 1.;
        trial = parts.cut == 1. ? end : current + parts.cut * (end - current);
        found_time = trial;
        return;
      }
    const double remaining = stop - current;
    const double n_parts =
      std::max(1., std::ceil(remaining / size - same_time));
    trial_is_stop = n_parts == 1.;
    trial         = trial_is_stop ? stop : current + remaining / n_parts;
    if (tries_first_part())
      {
        parts.end     = trial;
        trial_is_stop = false;
        trial         = current +
                parameters().integrator.first_part() * (parts.end - current);
      }
    if (!follows_path())
      found_time = trial;
  }



  void
  TimeControl::accept(const unsigned int iterations,
                      const double       allowed_growth)
  {
    Assert(trial > current, ExcMessage("next() comes before accept()."));
    const double       taken  = trial - current;
    const unsigned int before = stage();
    const bool         first  = tries_first_part();
    current                   = trial;
    rate                      = (found_time - current_time) / taken;
    current_time              = found_time;
    path_ended  = follows_path() && path_leaves_interval(current_time);
    on_step_end = trial_is_stop && stops[next_stop].ends_step;
    if (trial_is_stop)
      ++next_stop;
    if (on_step_end)
      ++completed_steps;
    if (first)
      {
        parts.first    = taken;
        parts.rejected = rejected > rejected_before;
      }
    else
      {
        choose_size(parts.first + taken, iterations, allowed_growth);
        parts = Parts();
      }
    if (stage() != before)
      size = parameters().one_step() * parameters().largest_step;
    accepted_size   = size;
    rejected_before = rejected;
  }



  void
  TimeControl::choose_size(const double       taken,
                           const unsigned int iterations,
                           const double       allowed_growth)
  {
    ++accepted;
    in_a_row = parts.rejected || rejected > rejected_before ? 1 : in_a_row + 1;
    size *= parts.cut;
    const double largest = parameters().one_step() * parameters().largest_step;
    if (iterations <= parameters().easy_iterations ||
        in_a_row == enough_in_a_row)
      {
        size     = std::min(size * parameters().growth, largest);
        in_a_row = 0;
      }
    if (allowed_growth * taken < size)
      size = std::max(allowed_growth * taken,
                      parameters().one_step() * parameters().smallest_step);
  }



  TimeIntegrator
  TimeControl::integrator() const
  {
    const IntegratorParameters &chosen = parameters().integrator;
    return between_parts() ?
             TimeIntegrator::second_part_of_bathe(chosen.spectral_radius,
                                                  (trial - current) /
                                                    parts.first) :
             TimeIntegrator(chosen);
  }



  void
  TimeControl::write(Archive &archive) const
  {
    archive.write("time/time", current, "time");
    if (follows_path())
      {
        archive.write("time/found_time", current_time, "time");
        archive.write("time/path_rate", rate, "time/length");
      }
    archive.write("time/step_size", accepted_size, "time");
    archive.write("time/at_step_end", on_step_end ? 1u : 0u);
    archive.write("time/accepted", accepted);
    archive.write("time/rejected", rejected_before);
    archive.write("time/in_a_row", in_a_row);
    archive.write("time/first_part", parts.first, "time");
    archive.write("time/end_of_parts", parts.end, "time");
    archive.write("time/first_part_rejected", parts.rejected ? 1u : 0u);
  }



  void
  TimeControl::read(const Archive &archive)
  {
    current = current_time = archive.number("time/time");
    if (archive.contains("time/found_time"))
      {
        current_time = archive.number("time/found_time");
        rate         = archive.number("time/path_rate");
      }
    path_ended    = false;
    accepted_size = archive.number("time/step_size");
    on_step_end   = archive.integer("time/at_step_end") != 0;
    // There may be other stops from here on.
    next_stop = completed_steps = 0;
    while (!finished() && stops[next_stop].time - current <=
                            same_time * parameters().one_step())
      completed_steps += stops[next_stop++].ends_step ? 1 : 0;
    path_ended = path_length() > 0 && path_leaves_interval(current_time);
    accepted_size =
      std::min(accepted_size,
               parameters().one_step() * parameters().largest_step);
    accepted        = archive.integer("time/accepted");
    rejected        = archive.integer("time/rejected");
    rejected_before = rejected;
    in_a_row        = archive.integer("time/in_a_row");
    parts.first     = archive.number("time/first_part");
    parts.end       = archive.number("time/end_of_parts");
    parts.rejected  = archive.integer("time/first_part_rejected") != 0;
    undo();
  }



  void
  TimeControl::undo()
  {
    trial      = current;
    found_time = current_time;
    size       = accepted_size;
    parts.cut  = 1.;
  }



  bool
  TimeControl::can_cut() const
  {
    return parameters().cut * trial_size() >= parameters().one_step() *
                                                parameters().smallest_step *
                                                (1. - same_time);
  }



  bool
  TimeControl::reject(const std::string &reason, const double wanted)
  {
    Assert(trial > current, ExcMessage("next() comes before reject()."));
    ++rejected;
    const bool   repeat = can_cut();
    const double least =
      parameters().one_step() * parameters().smallest_step / trial_size();
    const double cut = wanted < 1. ?
                         std::clamp(wanted, std::min(least, 0.99), 0.99) :
                         parameters().cut;
    if (between_parts())
      parts.cut *= cut;
    else
      size = cut * trial_size();
    text = "The step from t = " + in_words(current_time) +
           (follows_path() ? " along the path by " + in_words(trial - current) :
                             " to " + in_words(trial)) +
           " failed: " + reason + ".";
    trial      = current;
    found_time = current_time;
    if (repeat)
      return true;
    text += " A cut would go below the smallest step, " +
            in_words(parameters().one_step() * parameters().smallest_step) +
            " (Smallest step = " + in_words(parameters().smallest_step) +
            " of a step).";
    return false;
  }



  void
  TimeParameters::add_parameters(ParameterHandler &prm)
  {
    integrator.add_parameters(prm);
    prm.add_parameter("Start time", start_time, "time");
    prm.add_parameter("End time", end_time, "time");
    prm.add_parameter("Steps",
                      n_steps,
                      "equal steps from start to end; always hit exactly",
                      patterns::integer_in_range(1, 10000000));
    prm.add_parameter(
      "Arc length",
      arc_length,
      "0: steps are of time. Else each step goes this far along the path of "
      "equilibria (root mean square of the displacement of the material, "
      "length), and its time, on which loads and prescribed values depend, is "
      "found with it: a load may reach a limit and fall. The run ends after "
      "Steps such steps, or where time reaches End time or falls as far below "
      "Start time",
      patterns::non_negative());
    prm.add_parameter("Smallest step",
                      smallest_step,
                      "as a fraction of one step; the run stops below it",
                      Patterns::Double(1e-9, 1.));
    prm.add_parameter("Largest step",
                      largest_step,
                      "as a fraction of one step; the size tried first",
                      Patterns::Double(1e-9, 1.));
    prm.add_parameter(
      "Growth",
      growth,
      "factor on the size after an easy step, and after five in a row "
      "without a cut",
      Patterns::Double(1.));
    prm.add_parameter("Cut",
                      cut,
                      "factor on the size after a failed step",
                      Patterns::Double(0.01, 0.99));
    prm.add_parameter("Easy iterations",
                      easy_iterations,
                      "a step with no more Newton iterations is easy",
                      Patterns::Integer(0));
    prm.add_parameter(
      "Error tolerance",
      error_tolerance,
      "In dynamics: largest estimated error that a step makes in the "
      "displacement, in the mean over the mass, as a fraction of the cell "
      "size; steps become as small as it takes, between smallest and largest. "
      "0: no estimate",
      patterns::non_negative());
  }



  void
  TimeParameters::check(const std::string &section) const
  {
    if (!(end_time > start_time) || !std::isfinite(end_time) ||
        !std::isfinite(start_time))
      throw InputError("section '" + section + "', key 'End time': found " +
                       in_words(end_time) + "; it must be later than Start " +
                       "time, " + in_words(start_time) + ".");
    if (n_steps == 0)
      throw InputError("section '" + section +
                       "', key 'Steps': found 0; at least 1 is allowed.");
    if (!(smallest_step <= largest_step))
      throw InputError(
        "section '" + section + "', key 'Smallest step': found " +
        in_words(smallest_step) + "; it must not exceed Largest step, " +
        in_words(largest_step) + ".");
    integrator.check(section);
  }



  void
  OutputTimes::add_parameters(ParameterHandler &prm)
  {
    prm.add_parameter("Write",
                      when,
                      "steps: at the start and the ends of steps; all: after "
                      "every accepted part of a step too; end: only at the end",
                      Patterns::Selection("steps|all|end"));
    prm.add_parameter("Every",
                      every,
                      "with Write = steps: every n-th step, and the last",
                      Patterns::Integer(1));
    prm.add_parameter(
      "Checkpoint every",
      checkpoint_every,
      "10 steps: after every tenth accepted step and the last one, the whole "
      "state goes into the folder checkpoints, from which 'moraine resume' goes "
      "on; 30 minutes: after so much wall time; never. Ctrl-C and SIGTERM "
      "write one in any case.");
  }



  CheckpointTimes
  CheckpointTimes::from_text(const std::string &text)
  {
    CheckpointTimes    times;
    std::istringstream words(text);
    double             number = 0;
    std::string        unit, more;
    if (text == "never")
      return times;
    const bool is_number = static_cast<bool>(words >> number >> unit) &&
                           !(words >> more) && number > 0 && number < 1e9;
    const bool steps   = unit == "steps" || unit == "step";
    const bool minutes = unit == "minutes" || unit == "minute";
    if (!is_number || !(minutes || (steps && number == std::floor(number))))
      throw InputError("section 'Output', key 'Checkpoint every': found '" +
                       text +
                       "', allowed: never, a number of steps as in '10 steps', "
                       "or of minutes as in '30 minutes'");
    if (steps)
      times.steps = static_cast<unsigned int>(number);
    else
      times.minutes = number;
    return times;
  }



  bool
  OutputTimes::due(const TimeControl &time) const
  {
    if (when == "all" || time.finished())
      return true;
    return when == "steps" && time.at_step_end() &&
           time.n_completed_steps() % every == 0;
  }
} // namespace moraine
