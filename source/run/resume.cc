// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/run/resume.h>

#include <moraine/core/exceptions.h>
#include <moraine/core/words.h>
#include <moraine/output/on_root.h>

#include <deal.II/base/mpi.h>

#include <map>
#include <utility>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** Of a section "Time", beside all of 'Output' and 'Solver'. */
    const std::vector<std::string> keys_of_time{"End time",
                                                "Steps",
                                                "Smallest step",
                                                "Largest step",
                                                "Growth",
                                                "Cut",
                                                "Easy iterations",
                                                "Error tolerance"};

    using Values = std::map<std::pair<std::string, std::string>, std::string>;

    Values
    values_of(const std::string &name, const std::string &parameters)
    {
      const InputFile file = InputFile::from_text(name, parameters);
      Values          values;
      for (const auto &entry : file.entries())
        values[{entry.section, entry.key}] = entry.value;
      return values;
    }



    /** @p over: sections of the times of stages that are over. */
    bool
    may_change(const std::string              &section,
               const std::string              &key,
               const std::vector<std::string> &over)
    {
      const auto is_in = [&](const std::string &whole) {
        return section == whole || section.rfind(whole + "/", 0) == 0;
      };
      const bool of_time =
        section == "Time" ||
        (is_in("Stages") && section.size() > 5 &&
         section.compare(section.size() - 5, 5, "/Time") == 0);
      // Results go on where they are.
      return (is_in("Output") && key != "Directory") || is_in("Solver") ||
             is_in("Study") || (section.empty() && key == "Title") ||
             (of_time && contains(keys_of_time, key) &&
              !contains(over, section));
    }



    /** What @p before has with another value, or does not have although @p
     * input sets it. */
    std::string
    forbidden_changes(const Values                   &before,
                      const Values                   &now,
                      const InputFile                &input,
                      const std::vector<std::string> &over)
    {
      std::string text;
      const auto  name = [&](const auto        &place,
                            const std::string &found,
                            const std::string &was) {
        if (may_change(place.first, place.second, over))
          return;
        text += (text.empty() ? "" : "\n  ") +
                moraine::place(place.first, place.second) + ": found '" +
                found + "', allowed: " + was;
      };
      for (const auto &[place, value] : now)
        {
          const auto was = before.find(place);
          if (was == before.end() && input.has(place.first, place.second))
            name(place, value, "nothing, as in the checkpoint");
          else if (was != before.end() && was->second != value)
            name(place, value, "'" + was->second + "', as in the checkpoint");
        }
      for (const auto &[place, value] : before)
        if (now.count(place) == 0)
          name(place, "", "'" + value + "', as in the checkpoint");
      return text;
    }



    /** Defaults of a program that is newer than that of the checkpoint. */
    std::string
    new_defaults(const Values    &before,
                 const Values    &now,
                 const InputFile &input)
    {
      std::string text;
      for (const auto &[place, value] : now)
        if (before.count(place) == 0 && !input.has(place.first, place.second))
          text += (text.empty() ? "'" : ", '") + place.first + "/" +
                  place.second + " = " + value + "'";
      return text;
    }
  } // namespace



  SavedRun
  read_checkpoint(const std::string &folder,
                  const std::string &from,
                  const MPI_Comm    &communicator)
  {
    const CheckpointFiles files(folder, communicator);
    SavedRun              saved;
    saved.path = files.find(from);
    std::string damage, others;
    try
      {
        // A file of another format need not be one of ours.
        on_root(communicator, [&]() {
          CheckpointLabel::read(read_group(saved.path, "checkpoint"),
                                saved.path);
        });
        saved.state = read_file(saved.path, communicator);
      }
    catch (const InputError &error)
      {
        damage = error.what();
      }
    if (!damage.empty())
      {
        on_root(communicator, [&]() { others = files.others(saved.path); });
        throw InputError(damage +
                         Utilities::MPI::broadcast(communicator, others));
      }
    saved.label = CheckpointLabel::read(saved.state, saved.path);
    return saved;
  }



  template <int dim>
  std::string
  check_changes(const SavedRun    &saved,
                const Scene<dim>  &scene,
                const InputFile   &input,
                const std::string &parameters)
  {
    const unsigned int       stage = saved.state.integer("run/stage");
    std::vector<std::string> over;
    for (unsigned int k = 0; k < stage; ++k)
      over.push_back(time_section(scene.stages.at(k).first));
    const Values before         = values_of(saved.path, saved.label.parameters),
                 now            = values_of(saved.path, parameters);
    const std::string forbidden = forbidden_changes(before, now, input, over);
    if (!forbidden.empty())
      throw InputError(
        forbidden +
        "\n  A run that goes on may change sections Output (but for "
        "Directory), Solver and Study, and of its times from "
        "here on " +
        list_of(keys_of_time));
    const auto &[name, parameters_of_stage] = scene.stages.at(stage);
    const double end                        = parameters_of_stage.time.end_time;
    if (end < saved.label.t)
      throw InputError(place(time_section(name), "End time") + ": found " +
                       text_of(end) + ", allowed: not before t = " +
                       text_of(saved.label.t) + " of the checkpoint");
    const std::string defaults = new_defaults(before, now, input);
    return defaults.empty() ?
             "" :
             "the program that wrote the checkpoint, revision " +
               saved.label.revision +
               ", did not have keys that now have defaults: " + defaults;
  }



#define INSTANTIATE(dim) \
  template decltype(check_changes<dim>) check_changes<dim>;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
