// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_study_material_test_command_h
#define moraine_study_material_test_command_h

#include <moraine/core/input_file.h>

#include <mpi.h>

#include <string>

namespace moraine
{
  /**
   * Do the material test of a scene, and write material-test-NAME.csv and .png.
   * Collective.
   *
   * @param input the scene file
   * @param material its name; may be empty if there is one only
   * @param folder where the files go
   * @param communicator all ranks
   * @return the exit code: done
   * @throw InputError for what is wrong in sections `Materials` and `Material
   * test`, ComputationError where the test cannot go on; the CSV file has the
   * steps before that.
   */
  int
  test_material(const InputFile   &input,
                const std::string &material,
                const std::string &folder,
                const MPI_Comm     communicator);
} // namespace moraine

#endif
