// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/core/atomic_file.h>
#include <moraine/core/console.h>
#include <moraine/core/exceptions.h>
#include <moraine/core/interrupt.h>
#include <moraine/core/json.h>
#include <moraine/core/memory.h>
#include <moraine/core/words.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

#include <sys/mman.h>

#include "message.h"

using namespace moraine;

namespace
{
  unsigned int
  rank()
  {
    return dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
  }

  /** A directory for this rank and process, removed at the end. */
  struct Directory
  {
    Directory()
      : path(std::filesystem::temp_directory_path() /
             ("moraine-" + std::to_string(getpid())))
    {
      std::filesystem::create_directories(path);
    }

    ~Directory()
    {
      std::filesystem::remove_all(path);
    }

    std::string
    operator/(const std::string &name) const
    {
      return path / name;
    }

    std::filesystem::path path;
  };

  std::string
  content(const std::string &path)
  {
    std::ifstream      file(path);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
  }
} // namespace

TEST(Json, CanAlwaysBeRead)
{
  const Directory directory;
  Json            json;
  json["b"] = 1. / 3.;
  json["a"] = {std::nan(""), -std::numeric_limits<double>::infinity()};
  json["c"] = "no UTF-8: \xff";
  save(json, directory / "a.json");
  const Json read = Json::parse(content(directory / "a.json"));
  EXPECT_EQ(read.dump(),
            "{\"b\":0.3333333333333333,\"a\":[null,null],"
            "\"c\":\"no UTF-8: \uFFFD\"}");
  EXPECT_EQ(read["b"], 1. / 3.);
}

TEST(AtomicFile, AppearsCompleteOrNotAtAll)
{
  const Directory   directory;
  const std::string path = directory / "a.json";
  {
    AtomicFile file(path);
    file.stream() << "half";
    EXPECT_FALSE(std::filesystem::exists(path));
  }
  EXPECT_TRUE(std::filesystem::is_empty(directory.path));

  save("one", path);
  EXPECT_EQ(content(path), "\"one\"\n");
  {
    AtomicFile file(path);
    file.stream() << "two" << std::flush;
    EXPECT_EQ(content(path), "\"one\"\n");
    file.commit();
  }
  EXPECT_EQ(content(path), "two");
  EXPECT_FALSE(std::filesystem::exists(path + ".part"));
}

TEST(AtomicFile, NamesTheFileThatCannotBeWritten)
{
  EXPECT_EQ(message_of<InputError>([] { AtomicFile("/no/dir/a.csv"); }),
            "/no/dir/a.csv: cannot be written: No such file or directory");

  // /dev/full refuses every write, as a full disk does.
  const Directory   directory;
  const std::string path = directory / "a.csv";
  std::filesystem::create_symlink("/dev/full", path + ".part");
  EXPECT_EQ(message_of<InputError>([&] {
              AtomicFile file(path);
              file.stream() << "x";
              file.commit();
            }),
            path + ": cannot be written: No space left on device");
  EXPECT_FALSE(std::filesystem::exists(path));
}

TEST(Console, RankZeroSpeaksAndLogs)
{
  const Directory    directory;
  const std::string  path = directory / "log.txt";
  std::ostringstream screen;
  {
    Console console(MPI_COMM_WORLD, screen);
    console << "head " << 1 << std::endl;
    console.open_log(path);
    console.progress("step 1 of 9");
    console << "tail" << '\n';
    console.close_log();
  }
  const std::string expected = rank() == 0 ? "head 1\ntail\n" : "";
  EXPECT_EQ(screen.str(), expected);
  EXPECT_EQ(content(path), expected);
}

TEST(Console, ReportsALogThatCannotBeWritten)
{
  std::ostringstream screen;
  Console            console(MPI_COMM_WORLD, screen);
  const auto         message = message_of<InputError>([&] {
    console.open_log("/dev/full");
    console << "x" << std::endl;
    console.close_log();
  });
  EXPECT_EQ(message,
            rank() == 0 ? "/dev/full: cannot be written (is the disk full?)" :
                          "");
}

TEST(Interrupt, OneRankIsEnough)
{
  const auto action = [](const int signal) {
    struct sigaction now = {};
    sigaction(signal, nullptr, &now);
    return now.sa_handler;
  };
  const auto before = action(SIGTERM);
  {
    const InterruptHandler handler(false);
    EXPECT_FALSE(interrupted(MPI_COMM_WORLD));
    EXPECT_NE(action(SIGTERM), before);
    if (rank() == 0)
      std::raise(SIGINT);
    EXPECT_TRUE(interrupted(MPI_COMM_WORLD));

    // The next one has its default action again: the program ends.
    EXPECT_EQ(action(SIGINT) == SIG_DFL, rank() == 0);
  }
  // A launcher that ends the ranks of a program that failed asks for no step.
  EXPECT_EQ(action(SIGTERM), before);
  EXPECT_EQ(action(SIGINT), SIG_DFL);
}

TEST(Memory, SeesABigBlock)
{
  const Memory before = memory_in_use(MPI_COMM_WORLD);
  EXPECT_GT(before.current_mib, 1);
  EXPECT_GE(before.peak_mib, before.current_mib);
  {
    // Straight from the system: an allocator may keep what is freed.
    const std::size_t size  = 200u << 20;
    void *const       block = mmap(nullptr,
                             size,
                             PROT_READ | PROT_WRITE,
                             MAP_PRIVATE | MAP_ANONYMOUS,
                             -1,
                             0);
    ASSERT_NE(block, MAP_FAILED);
    std::memset(block, 1, size);
    EXPECT_GT(memory_in_use(MPI_COMM_WORLD).current_mib,
              before.current_mib + 150);
    munmap(block, size);
  }
  EXPECT_GT(memory_in_use(MPI_COMM_WORLD).peak_mib, before.current_mib + 150);
  const int resets =
    dealii::Utilities::MPI::min(int(reset_peak_memory()), MPI_COMM_WORLD);
  const double peak = memory_in_use(MPI_COMM_WORLD).peak_mib;
  EXPECT_EQ(peak < before.current_mib + 150, resets == 1) << peak;
}

TEST(Nearest, FindsMisspeltWords)
{
  const std::vector<std::string> known{"Cell size", "Count", "Lower corner"};
  EXPECT_EQ(nearest("cell Size", known), "Cell size");
  EXPECT_EQ(nearest("Cel size", known), "Cell size");
  EXPECT_EQ(nearest("Lower corners", known), "Lower corner");
  EXPECT_EQ(nearest("Quark", known), "");
  EXPECT_EQ(nearest("x", {}), "");
}
