// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/output/pvd_history.h>

#include <moraine/core/atomic_file.h>
#include <moraine/output/on_root.h>

#include <deal.II/base/data_out_base.h>

namespace moraine
{
  PvdHistory::PvdHistory(const std::string &path, const MPI_Comm &communicator)
    : path(path)
    , communicator(communicator)
  {}



  void
  PvdHistory::add(const double time, const std::string &file)
  {
    times_and_names.emplace_back(time, file);
    on_root(communicator, [&]() {
      AtomicFile out(path);
      dealii::DataOutBase::write_pvd_record(out.stream(), times_and_names);
      out.commit();
    });
  }
} // namespace moraine
