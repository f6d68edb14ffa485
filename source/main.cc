// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/core/exit.h>
#include <moraine/core/memory.h>
#include <moraine/study/command_line.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include <unistd.h>

/**
 * A process that no launcher of MPI started has nobody to talk to. Open MPI
 * then need not look for networks nor start a daemon, which is half of the
 * program's start. Nor does it need a session directory: all such processes of
 * a user would share one, and one that ends would remove it while another
 * starts. What the user has set stays.
 */
static void
start_quickly_if_alone()
{
  const std::array<const char *, 3> launched{
    {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK"}};
  if (std::any_of(launched.begin(), launched.end(), [](const char *name) {
        return std::getenv(name) != nullptr;
      }))
    return;
  setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
  setenv("OMPI_MCA_orte_create_session_dirs", "0", 0);
  setenv("OMPI_MCA_pml", "ob1", 0);
  setenv("OMPI_MCA_btl", "self,vader", 0);
}



/**
 * `moraine plot` is a Python script: beside the installed program, or in the
 * source folder. @return the exit code if it cannot be started.
 */
static int
plot(char **arguments)
{
  namespace fs = std::filesystem;
  std::error_code ignored;
  const fs::path  folder =
    fs::read_symlink("/proc/self/exe", ignored).parent_path();
  fs::path script = folder / ".." / MORAINE_SHARE / "plot.py";
  if (!fs::exists(script))
    script = fs::path(MORAINE_SCRIPTS) / "plot.py";
  const std::string   program = "/usr/bin/python3", path = script.string();
  std::vector<char *> words{const_cast<char *>(program.c_str()),
                            const_cast<char *>(path.c_str())};
  for (; *arguments != nullptr; ++arguments)
    words.push_back(*arguments);
  words.push_back(nullptr);
  execv(program.c_str(), words.data());
  std::cerr << "moraine: 'moraine plot' needs " << program << std::endl;
  return moraine::internal_error;
}



int
main(int argc, char **argv)
{
  if (argc > 1 && std::strcmp(argv[1], "plot") == 0)
    return plot(argv + 2);
  start_quickly_if_alone();
  moraine::return_large_blocks();
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  return moraine::main_program({argv + 1, argv + argc});
}
