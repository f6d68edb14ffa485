// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/output/on_root.h>

#include <moraine/core/exceptions.h>

#include <deal.II/base/mpi.h>

#include <string>
#include <utility>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    enum class Outcome
    {
      done,
      input_error,
      computation_error
    };

    std::pair<Outcome, std::string>
    outcome_of(const std::function<void()> &work)
    {
      try
        {
          work();
        }
      catch (const InputError &error)
        {
          return {Outcome::input_error, error.what()};
        }
      catch (const std::exception &error)
        {
          return {Outcome::computation_error, error.what()};
        }
      return {Outcome::done, ""};
    }
  } // namespace



  void
  on_root(const MPI_Comm &communicator, const std::function<void()> &work)
  {
    std::pair<Outcome, std::string> outcome{Outcome::done, ""};
    if (Utilities::MPI::this_mpi_process(communicator) == 0)
      outcome = outcome_of(work);

    const int kind =
      Utilities::MPI::broadcast(communicator, static_cast<int>(outcome.first));
    if (kind == static_cast<int>(Outcome::done))
      return;
    const std::string message =
      Utilities::MPI::broadcast(communicator, outcome.second);
    if (kind == static_cast<int>(Outcome::input_error))
      throw InputError(message);
    throw ComputationError(message);
  }
} // namespace moraine
