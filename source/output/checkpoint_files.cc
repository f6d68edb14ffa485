// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/output/checkpoint_files.h>

#include <moraine/core/atomic_file.h>
#include <moraine/core/exceptions.h>
#include <moraine/core/version.h>
#include <moraine/core/words.h>
#include <moraine/output/on_root.h>

#include <deal.II/base/mpi.h>

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** Of the data sets of a checkpoint and what they mean. */
    constexpr unsigned int format_number = 12;

    constexpr std::array<const char *, 2> slots{{"a", "b"}};



    /** "step 5 (t = 0.25)". */
    std::string
    in_words(const CheckpointLabel &label)
    {
      return fmt::format("step {} (t = {:.8g})", label.step, label.t);
    }



    CheckpointLabel
    label_of(const std::string &path)
    {
      return CheckpointLabel::read(read_group(path, "checkpoint"), path);
    }



    bool
    is_asked_for(const CheckpointLabel &label, const std::string &from)
    {
      if (from.find_first_not_of("0123456789") == std::string::npos)
        return std::to_string(label.step) == from;
      std::istringstream text(from);
      double             t;
      return text >> t && text.eof() &&
             std::abs(label.t - t) <= 1e-7 * std::abs(t);
    }
  } // namespace



  void
  CheckpointLabel::write(Archive &archive) const
  {
    archive.write("checkpoint/format", format_number);
    archive.write_text("checkpoint/version", version);
    archive.write_text("checkpoint/revision", revision);
    archive.write_text("checkpoint/scene", scene);
    archive.write("checkpoint/dimension", dimension);
    archive.write("checkpoint/step", step);
    archive.write("checkpoint/t", t, "time");
    archive.write("checkpoint/ranks", ranks);
    archive.write_text("checkpoint/parameters", parameters);
  }



  CheckpointLabel
  CheckpointLabel::read(const Archive &archive, const std::string &path)
  {
    if (!archive.contains("checkpoint/format"))
      throw InputError("cannot read '" + path +
                       "': it is no checkpoint of Moraine");
    const unsigned int format = archive.integer("checkpoint/format");
    CheckpointLabel    label;
    label.version = archive.text("checkpoint/version");
    if (format != format_number)
      throw InputError("cannot read '" + path + "': it has format " +
                       std::to_string(format) + ", written by Moraine " +
                       label.version + "; Moraine " +
                       std::string(moraine::version) + " reads format " +
                       std::to_string(format_number) + " only");
    label.revision   = archive.text("checkpoint/revision");
    label.scene      = archive.text("checkpoint/scene");
    label.dimension  = archive.integer("checkpoint/dimension");
    label.step       = archive.integer("checkpoint/step");
    label.t          = archive.number("checkpoint/t");
    label.ranks      = archive.integer("checkpoint/ranks");
    label.parameters = archive.text("checkpoint/parameters");
    return label;
  }



  CheckpointFiles::CheckpointFiles(const std::string &folder,
                                   const MPI_Comm    &communicator)
    : folder((std::filesystem::path(folder) / "checkpoints").string())
    , communicator(communicator)
  {}



  std::string
  CheckpointFiles::path_of(const std::string &name) const
  {
    return (std::filesystem::path(folder) / name).string();
  }



  std::string
  CheckpointFiles::last() const
  {
    std::ifstream file(path_of("last"));
    std::string   name;
    file >> name;
    return name;
  }



  void
  CheckpointFiles::write(const Archive &archive) const
  {
    std::string slot;
    on_root(communicator, [&]() {
      std::error_code ignored; // opening a file will tell
      std::filesystem::create_directory(folder, ignored);
      slot = last() == "a.h5" ? "b" : "a";
    });
    slot                   = Utilities::MPI::broadcast(communicator, slot);
    const std::string name = slot + ".h5";
    write_file(archive, path_of(name), communicator);
    make_last(name);
  }



  void
  CheckpointFiles::make_last(const std::string &path) const
  {
    on_root(communicator, [&]() {
      AtomicFile pointer(path_of("last"));
      pointer.stream() << std::filesystem::path(path).filename().string()
                       << '\n';
      pointer.commit();
    });
  }



  std::string
  CheckpointFiles::find(const std::string &from) const
  {
    std::string path;
    on_root(communicator, [&]() { path = find_on_root(from); });
    return Utilities::MPI::broadcast(communicator, path);
  }



  std::string
  CheckpointFiles::find_on_root(const std::string &from) const
  {
    if (last().empty())
      throw InputError("there is no checkpoint: '" + path_of("last") +
                       "' is missing, which a run leaves with 'Checkpoint "
                       "every' in section 'Output', and after Ctrl-C or "
                       "SIGTERM once a step was accepted");
    if (from.empty())
      return path_of(last());
    std::string known;
    for (const char *slot : slots)
      try
        {
          const std::string path  = path_of(slot + std::string(".h5"));
          const auto        label = label_of(path);
          if (is_asked_for(label, from))
            return path;
          known += (known.empty() ? "" : ", ") + in_words(label);
        }
      catch (const InputError &)
        {
          // That one cannot be asked for.
        }
    throw InputError("option '--from': found '" + from + "', allowed: " +
                     (known.empty() ? "nothing that can be read" : known));
  }



  std::string
  CheckpointFiles::others(const std::string &path) const
  {
    for (const char *slot : slots)
      try
        {
          const std::string other = path_of(slot + std::string(".h5"));
          if (other == path)
            continue;
          const auto label = label_of(other);
          return "; the other one, of " + in_words(label) +
                 ", may be good: --from " + std::to_string(label.step);
        }
      catch (const InputError &)
        {
          // There is none.
        }
    return "";
  }
} // namespace moraine
