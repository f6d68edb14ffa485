// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/core/exceptions.h>
#include <moraine/output/history.h>
#include <moraine/output/output_directory.h>
#include <moraine/output/pvd_history.h>
#include <moraine/output/summary.h>

#include <gtest/gtest.h>

#include "scene.h"

namespace moraine
{
  namespace
  {
    /** Touch a file from rank 0, for all to see. */
    void
    touch(const std::string &path)
    {
      if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
        std::ofstream(path) << "old";
      MPI_Barrier(MPI_COMM_WORLD);
    }

    std::string
    refusal(const std::string &path)
    {
      try
        {
          const OutputDirectory directory(path, false, MPI_COMM_WORLD);
        }
      catch (const InputError &error)
        {
          return error.what();
        }
      return "not refused";
    }
  } // namespace



  TEST(History, header_and_rows)
  {
    const Folder      folder;
    const std::string path = folder.file("history.csv");
    History           history(path, MPI_COMM_WORLD);
    history.add_row({{"t", "-", 0.}, {"u_y at A, top", "length", 1. / 3.}});
    EXPECT_EQ(content(path),
              "t,\"u_y at A, top [length]\"\n0,0.333333333333333\n");
    MPI_Barrier(MPI_COMM_WORLD);
    history.add_row({{"t", "-", 0.5}, {"u_y at A, top", "length", -1e-20}});
    EXPECT_EQ(
      content(path),
      "t,\"u_y at A, top [length]\"\n0,0.333333333333333\n0.5,-1e-20\n");
    EXPECT_THROW(history.add_row({{"t", "-", 1.}}), dealii::ExceptionBase);
  }



  TEST(History, goes_on_from_an_archive)
  {
    const Folder folder;
    History      history(folder.file("a.csv"), MPI_COMM_WORLD);
    History      resumed(folder.file("b.csv"), MPI_COMM_WORLD);
    history.add_row({{"t", "-", 0.}, {"u, x", "length", 1. / 3.}});
    Archive archive;
    history.write(archive);
    history.add_row({{"t", "-", 0.5}, {"u, x", "length", 2.}});
    resumed.read(archive);
    MPI_Barrier(MPI_COMM_WORLD);
    EXPECT_EQ(content(folder.file("b.csv")),
              "t,\"u, x [length]\"\n0,0.333333333333333\n");
    MPI_Barrier(MPI_COMM_WORLD);
    resumed.add_row({{"t", "-", 0.5}, {"u, x", "length", 2.}});
    EXPECT_EQ(content(folder.file("b.csv")), content(folder.file("a.csv")));
    // A row that is taken back disappears from the file.
    MPI_Barrier(MPI_COMM_WORLD);
    history.read(archive);
    MPI_Barrier(MPI_COMM_WORLD);
    EXPECT_EQ(content(folder.file("a.csv")),
              "t,\"u, x [length]\"\n0,0.333333333333333\n");
  }



  TEST(PvdHistory, goes_on_from_an_archive)
  {
    const Folder folder, other;
    PvdHistory   pvd(folder.file("points.pvd"), MPI_COMM_WORLD);
    PvdHistory   resumed(other.file("points.pvd"), MPI_COMM_WORLD);
    pvd.add(0., "points/0 a.vtu");
    pvd.add(0.1, "points/1.vtu");
    Archive archive;
    pvd.write(archive);
    resumed.read(archive);
    MPI_Barrier(MPI_COMM_WORLD);
    EXPECT_EQ(content(other.file("points.pvd")),
              content(folder.file("points.pvd")));
    MPI_Barrier(MPI_COMM_WORLD);
    pvd.add(0.2, "points/2.vtu");
    resumed.add(0.2, "points/2.vtu");
    EXPECT_EQ(content(other.file("points.pvd")),
              content(folder.file("points.pvd")));
    EXPECT_NE(content(folder.file("points.pvd")).find("0 a.vtu"),
              std::string::npos);
  }



  TEST(History, failed_write_names_the_file)
  {
    History history("/dev/full", MPI_COMM_WORLD);
    try
      {
        history.add_row({{"t", "-", 0.}});
        FAIL() << "nothing thrown";
      }
    catch (const InputError &error)
      {
        EXPECT_NE(std::string(error.what()).find("/dev/full"),
                  std::string::npos);
      }
  }



  TEST(OutputDirectory, refuses_results_and_overwrites_only_them)
  {
    const Folder      folder;
    const std::string path = folder.file("a/b");
    {
      const OutputDirectory directory(path, false, MPI_COMM_WORLD);
      EXPECT_EQ(directory.file("log.txt"), path + "/log.txt");
      EXPECT_EQ(OutputDirectory::vtu_name("points", 12), "points/00012.vtu");
    }
    for (const char *name : {"/mine.txt", "/points/mine.vtu", "/mesh/1.vtu"})
      touch(path + name);
    EXPECT_EQ(refusal(path), "not refused");
    const auto written = {"/history.csv",
                          "/points/00000.vtu",
                          "/mesh/00003.vtu",
                          "/mesh.pvd",
                          "/contact/00002.vtu"};
    std::filesystem::create_directories(path + "/contact");
    for (const char *name : written)
      touch(path + name);

    EXPECT_EQ(refusal(path),
              "the output directory '" + path +
                "' holds results of an earlier run (history.csv); choose "
                "another one with --output, or replace them with --overwrite");
    EXPECT_EQ(content(path + "/history.csv"), "old");
    MPI_Barrier(MPI_COMM_WORLD);

    const OutputDirectory directory(path, true, MPI_COMM_WORLD);
    for (const char *name : written)
      EXPECT_FALSE(std::filesystem::exists(path + name)) << name;
    for (const char *name : {"/mine.txt", "/points/mine.vtu", "/mesh/1.vtu"})
      EXPECT_EQ(content(path + name), "old") << name;
  }



  /** A run that failed before its first step has no results. */
  TEST(OutputDirectory, a_summary_alone_is_no_result)
  {
    const Folder      folder;
    const std::string path = folder.file("out");
    EXPECT_FALSE(OutputDirectory::holds_results(path, MPI_COMM_WORLD));
    {
      const OutputDirectory directory(path, false, MPI_COMM_WORLD);
    }
    for (const char *name : {"/summary.json", "/log.txt", "/original.prm"})
      touch(path + name);
    EXPECT_FALSE(OutputDirectory::holds_results(path, MPI_COMM_WORLD));
    {
      const OutputDirectory directory(path, false, MPI_COMM_WORLD);
    }
    for (const char *name : {"/summary.json", "/log.txt", "/original.prm"})
      EXPECT_FALSE(std::filesystem::exists(path + name)) << name;
    touch(path + "/mesh/00003.vtu");
    EXPECT_TRUE(OutputDirectory::holds_results(path, MPI_COMM_WORLD));
  }



  TEST(OutputDirectory, has_one_run_at_a_time)
  {
    const Folder      folder;
    const std::string path  = folder.file("out");
    const auto        taken = [&](const bool goes_on) {
      try
        {
          if (goes_on)
            OutputDirectory(path, MPI_COMM_WORLD);
          else
            OutputDirectory(path, true, MPI_COMM_WORLD);
        }
      catch (const InputError &error)
        {
          return std::string(error.what());
        }
      return std::string("not refused");
    };
    const std::string refused =
      "another run writes into the output directory '" + path +
      "' and has not ended";
    {
      const OutputDirectory directory(path, false, MPI_COMM_WORLD);
      touch(path + "/history.csv");
      EXPECT_EQ(taken(true), refused);
      EXPECT_EQ(taken(false), refused);
      EXPECT_EQ(content(path + "/history.csv"), "old");
      MPI_Barrier(MPI_COMM_WORLD);
    }
    EXPECT_EQ(taken(true), "not refused");
    EXPECT_EQ(taken(false), "not refused");
  }



  TEST(OutputDirectory, that_cannot_be_made)
  {
    const Folder      folder;
    const std::string file = folder.file("file");
    touch(file);
    EXPECT_EQ(refusal(file + "/results"),
              "cannot make the output directory '" + file +
                "/results': Not a directory; choose another one with --output");
    EXPECT_EQ(content(file), "old");
  }



  TEST(OutputDirectory, keeps_the_input)
  {
    const Folder          folder;
    const OutputDirectory directory(folder.file("out"), false, MPI_COMM_WORLD);
    dealii::ParameterHandler prm;
    double                   size = 2.;
    prm.add_parameter("Size", size, "How long [length].");
    directory.write_parameter_files("set Size = 2 # mine\n", prm);
    EXPECT_EQ(content(directory.file("original.prm")), "set Size = 2 # mine\n");
    const std::string all = content(directory.file("parameters.prm"));
    EXPECT_NE(all.find("# How long [length]."), std::string::npos) << all;
    EXPECT_NE(all.find("set Size = 2"), std::string::npos) << all;
  }



  TEST(Summary, members_in_order)
  {
    const Folder folder;
    Summary      summary;
    summary.version         = "1.0";
    summary.sizes.dimension = 2;
    summary.sizes.points    = 5000000000;
    summary.timings         = {{"solve", 0.5}, {"assembly", 0.25}};
    summary.effects         = {"internal force"};
    summary.linear.solvers  = {"direct"};
    summary.errors          = {{"r_u", 1e-10}, {"r_sigma_xy", std::nullopt}};
    summary.last.probes     = {{"u_x at A", 0.125}};
    summary.last.reactions  = {{"left", {1., -2.}}};
    const std::string path  = folder.file("summary.json");
    summary.write(path, MPI_COMM_WORLD);
    EXPECT_EQ(content(path), R"({
  "status": "ok",
  "version": "1.0",
  "dimension": 2,
  "ranks": 1,
  "cells": 0,
  "active_cells": 0,
  "unknowns": 0,
  "points": 5000000000,
  "time": 0.0,
  "steps": 0,
  "rejected_steps": 0,
  "pseudo_transient_steps": 0,
  "newton_iterations": 0,
  "linear_iterations": 0,
  "largest_displacement": 0.0,
  "bytes_per_point": 0,
  "peak_memory_mib": 0.0,
  "wall_seconds": 0.0,
  "timings": {
    "solve": 0.5,
    "assembly": 0.25
  },
  "effects": [
    "internal force"
  ],
  "linear_solvers": [
    "direct"
  ],
  "errors": {
    "r_u": 1e-10,
    "r_sigma_xy": null
  },
  "probes": {
    "u_x at A": 0.125
  },
  "reactions": {
    "left": [
      1.0,
      -2.0
    ]
  }
}
)");
    EXPECT_THROW(summary.write(folder.file("none/summary.json"),
                               MPI_COMM_WORLD),
                 InputError);
  }
} // namespace moraine
