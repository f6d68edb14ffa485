// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/output/pvd_history.h>

#include <moraine/core/atomic_file.h>
#include <moraine/output/on_root.h>

#include <deal.II/base/data_out_base.h>

#include <filesystem>

namespace moraine
{
  PvdHistory::PvdHistory(const std::string &path, const MPI_Comm &communicator)
    : path(path)
    , communicator(communicator)
  {}



  void
  PvdHistory::add(const double time, const std::string &file)
  {
    auto entries = times_and_names;
    entries.emplace_back(time, file);
    write_file(entries);
    times_and_names = std::move(entries);
  }



  void
  PvdHistory::write_file(
    const std::vector<std::pair<double, std::string>> &entries) const
  {
    on_root(communicator, [&]() {
      AtomicFile out(path);
      dealii::DataOutBase::write_pvd_record(out.stream(), entries);
      out.commit();
    });
  }



  void
  PvdHistory::write(Archive &archive) const
  {
    std::vector<double>      times;
    std::vector<std::string> names;
    for (const auto &[time, name] : times_and_names)
      {
        times.push_back(time);
        names.push_back(name);
      }
    const std::string group =
      "output/" + std::filesystem::path(path).filename().string();
    archive.write(group + "/time", std::move(times));
    archive.write_lines(group + "/file", names);
  }



  void
  PvdHistory::read(const Archive &archive)
  {
    const std::string group =
      "output/" + std::filesystem::path(path).filename().string();
    const auto &times = archive.numbers(group + "/time");
    const auto  names = archive.lines(group + "/file");
    std::vector<std::pair<double, std::string>> entries;
    for (std::size_t k = 0; k < times.size(); ++k)
      entries.emplace_back(times[k], names.at(k));
    if (entries == times_and_names)
      return;
    write_file(entries);
    times_and_names = std::move(entries);
  }
} // namespace moraine
