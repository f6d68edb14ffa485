// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/core/exceptions.h>
#include <moraine/core/version.h>
#include <moraine/output/checkpoint_files.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "../core/message.h"

using namespace moraine;

namespace
{
  const MPI_Comm comm = MPI_COMM_WORLD;

  /** A folder for the time of a test. */
  struct Folder
  {
    Folder()
      : path("checkpoints_of_" +
             std::to_string(dealii::Utilities::MPI::n_mpi_processes(comm)))
    {
      clear();
      if (is_root())
        std::filesystem::create_directory(path);
      MPI_Barrier(comm);
    }

    ~Folder()
    {
      clear();
    }

    static bool
    is_root()
    {
      return dealii::Utilities::MPI::this_mpi_process(comm) == 0;
    }

    void
    clear() const
    {
      MPI_Barrier(comm);
      if (is_root())
        std::filesystem::remove_all(path);
      MPI_Barrier(comm);
    }

    std::string
    text_of(const std::string &name) const
    {
      std::ifstream      file(path + "/checkpoints/" + name);
      std::ostringstream text;
      text << file.rdbuf();
      return text.str();
    }

    const std::string path;
  };

  CheckpointLabel
  label_at(const unsigned int step)
  {
    CheckpointLabel label;
    label.version    = version;
    label.revision   = "r";
    label.scene      = "scene.prm";
    label.dimension  = 2;
    label.step       = step;
    label.t          = 0.1 * step;
    label.ranks      = 1;
    label.parameters = "set Title = a\n";
    return label;
  }

  /** With one point on each rank. */
  void
  write(const Folder &folder, const unsigned int step)
  {
    const unsigned int rank = dealii::Utilities::MPI::this_mpi_process(comm);
    Archive            archive;
    label_at(step).write(archive);
    archive.distribute("points", {rank});
    archive.write("points/position", std::vector<double>{1. + rank, 2.}, 2);
    archive.write("points/stress", std::vector<double>{1, 2, 3, 4}, 4);
    CheckpointFiles(folder.path, comm).write(archive);
  }
} // namespace



TEST(CheckpointFiles, TwoTakeTurns)
{
  const Folder          folder;
  const CheckpointFiles files(folder.path, comm);
  const std::string     a = folder.path + "/checkpoints/a.h5",
                    b     = folder.path + "/checkpoints/b.h5";
  write(folder, 5);
  EXPECT_EQ(files.find(""), a);
  write(folder, 10);
  EXPECT_EQ(files.find(""), b);
  EXPECT_EQ(files.find("5"), a);
  EXPECT_EQ(files.find("1.0"), b);
  write(folder, 15);
  EXPECT_EQ(files.find(""), a);
  EXPECT_EQ(files.find("10"), b);
  EXPECT_EQ(message_of<InputError>([&]() { files.find("5"); }),
            "option '--from': found '5', allowed: step 15 (t = 1.5), step 10 "
            "(t = 1)");
  // A run that goes on from b writes over a next.
  files.make_last(b);
  write(folder, 12);
  EXPECT_EQ(files.find("12"), a);
  EXPECT_EQ(files.find("10"), b);
}



TEST(CheckpointFiles, NoneIsSaid)
{
  const Folder folder;
  EXPECT_NE(message_of<InputError>(
              [&]() { CheckpointFiles(folder.path, comm).find(""); })
              .find("there is no checkpoint: '" + folder.path +
                    "/checkpoints/last' is missing"),
            std::string::npos);
}



TEST(CheckpointFiles, AnotherFormatIsRefused)
{
  Archive older, other;
  older.write("checkpoint/format", 0u);
  older.write_text("checkpoint/version", "0.0.9");
  EXPECT_EQ(message_of<InputError>(
              [&]() { CheckpointLabel::read(older, "a.h5"); }),
            "cannot read 'a.h5': it has format 0, written by Moraine 0.0.9; "
            "Moraine " +
              std::string(version) + " reads format 12 only");
  EXPECT_EQ(message_of<InputError>(
              [&]() { CheckpointLabel::read(other, "a.h5"); }),
            "cannot read 'a.h5': it is no checkpoint of Moraine");
}



TEST(CheckpointFiles, TheLabelComesBack)
{
  Archive archive;
  label_at(7).write(archive);
  const CheckpointLabel label = CheckpointLabel::read(archive, "");
  EXPECT_EQ(label.revision, "r");
  EXPECT_EQ(label.scene, "scene.prm");
  EXPECT_EQ(label.dimension, 2u);
  EXPECT_EQ(label.step, 7u);
  EXPECT_EQ(label.t, 0.1 * 7);
  EXPECT_EQ(label.parameters, "set Title = a\n");
}
