// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/core/archive.h>
#include <moraine/core/exceptions.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>

#include "message.h"

using namespace moraine;

namespace
{
  const MPI_Comm comm = MPI_COMM_WORLD;

  unsigned int
  own_rank()
  {
    return dealii::Utilities::MPI::this_mpi_process(comm);
  }

  unsigned int
  rank_count()
  {
    return dealii::Utilities::MPI::n_mpi_processes(comm);
  }

  /** The value of row @p id, component @p c. */
  double
  value(const unsigned int id, const unsigned int c)
  {
    return std::sin(1. + id) + c;
  }

  constexpr unsigned int n_rows = 23;

  /** Rows dealt to the ranks in turn, last first. */
  Archive
  make_archive()
  {
    Archive                   archive;
    std::vector<unsigned int> ids;
    std::vector<double>       stress;
    for (unsigned int id = n_rows; id-- > 0;)
      if (id % rank_count() == own_rank())
        {
          ids.push_back(7 * id);
          for (unsigned int c = 0; c < 4; ++c)
            stress.push_back(value(id, c));
        }
    archive.distribute("points", ids);
    archive.write("points/stress", stress, 4);
    archive.write("time/current", 0.1);
    archive.write("time/accepted", 3u);
    archive.write_text("history/columns", "t, \u03c3 [kPa]\nline 2");
    archive.write_text("history/empty", "");
    archive.write("history/rows", std::vector<double>());
    archive.write("odd",
                  std::vector<double>{-0.,
                                      std::numeric_limits<double>::quiet_NaN(),
                                      5e-324});
    return archive;
  }

  struct TemporaryFile
  {
    TemporaryFile()
    {
      path = "archive_test_" + std::to_string(rank_count()) + ".h5";
    }

    ~TemporaryFile()
    {
      MPI_Barrier(comm);
      if (own_rank() == 0)
        std::remove(path.c_str());
    }

    std::string path;
  };
} // namespace



TEST(Archive, GivesBackWhatWasWritten)
{
  const Archive archive = make_archive();
  EXPECT_EQ(archive.number("time/current"), 0.1);
  EXPECT_EQ(archive.integer("time/accepted"), 3u);
  EXPECT_EQ(archive.text("history/columns"), "t, \u03c3 [kPa]\nline 2");
  EXPECT_EQ(archive.numbers("points/stress", 4).size(),
            4 * archive.integers("points/id").size());
  EXPECT_TRUE(archive.is_distributed("points/stress"));
  EXPECT_FALSE(archive.is_distributed("odd"));
  EXPECT_TRUE(archive == make_archive());
}



TEST(Archive, LinesComeBackAsTheyWere)
{
  const std::vector<std::string> lines = {"a b", "", "c"};
  Archive                        archive;
  archive.write_lines("names", lines);
  archive.write_lines("no names", {});
  EXPECT_EQ(archive.lines("names"), lines);
  EXPECT_TRUE(archive.lines("no names").empty());
}



TEST(Archive, SaysWhatIsMissing)
{
  const Archive archive = make_archive();
  EXPECT_EQ(message_of<InputError>([&]() { archive.numbers("points/F"); }),
            "archive: it has no data set 'points/F'");
  EXPECT_EQ(message_of<InputError>([&]() { archive.text("odd"); }),
            "archive: the data set 'odd' holds another kind of values");
  EXPECT_EQ(message_of<InputError>(
              [&]() { archive.numbers("points/stress", 6); }),
            "archive: the data set 'points/stress' has 4 components, expected: "
            "6");
  EXPECT_EQ(message_of<InputError>([&]() { archive.number("odd"); }),
            "archive: the data set 'odd' is not one number");
}



TEST(Archive, EqualityIsThatOfBits)
{
  Archive plus, minus;
  plus.write("a", 0.);
  minus.write("a", -0.);
  EXPECT_TRUE(plus != minus);
  EXPECT_TRUE(plus != Archive());
}



TEST(Archive, GatheredRowsAreInTheOrderOfIds)
{
  const Archive whole = make_archive().gathered(comm);
  if (own_rank() > 0)
    {
      EXPECT_TRUE(whole.data_sets().empty());
      return;
    }
  const auto &ids    = whole.integers("points/id");
  const auto &stress = whole.numbers("points/stress", 4);
  ASSERT_EQ(ids.size(), n_rows);
  for (unsigned int row = 0; row < n_rows; ++row)
    {
      EXPECT_EQ(ids[row], 7 * row);
      for (unsigned int c = 0; c < 4; ++c)
        EXPECT_EQ(stress[4 * row + c], value(row, c));
    }
}



TEST(Archive, IdsOfTwoNumbersAreOrderedByTheFirst)
{
  Archive archive;
  archive.distribute("surface", {own_rank(), 1u, own_rank(), 0u}, 2);
  archive.write("surface/violation",
                std::vector<double>{10. * own_rank() + 1, 10. * own_rank()});
  const Archive whole = archive.gathered(comm);
  for (unsigned int i = 0; own_rank() == 0 && i < 2 * rank_count(); ++i)
    EXPECT_EQ(whole.numbers("surface/violation")[i], 10. * (i / 2) + i % 2);
}



TEST(ArchiveFile, RoundTripKeepsEveryBit)
{
  const TemporaryFile file;
  const Archive       archive = make_archive();
  write_file(archive, file.path, comm);
  const Archive read = read_file(file.path, comm);
  EXPECT_TRUE(read.gathered(comm) == archive.gathered(comm));
  // Every rank has the rest, and its share of the rows.
  EXPECT_EQ(read.number("time/current"), 0.1);
  EXPECT_EQ(read.text("history/empty"), "");
  EXPECT_LE(read.integers("points/id").size(), n_rows / rank_count() + 1);
}



TEST(ArchiveFile, FailuresAreSaid)
{
  EXPECT_EQ(
    message_of<InputError>(
      [&]() { write_file(Archive(), "no/such/folder/a.h5", comm); }),
    "no/such/folder/a.h5: cannot be written: No such file or directory");
  EXPECT_EQ(message_of<InputError>([&]() { read_file("nothing.h5", comm); }),
            "cannot read 'nothing.h5': No such file or directory");

  const TemporaryFile file;
  if (own_rank() == 0)
    std::ofstream(file.path) << "no HDF5";
  MPI_Barrier(comm);
  EXPECT_EQ(message_of<InputError>([&]() { read_file(file.path, comm); }),
            "cannot read '" + file.path +
              "': it is no HDF5 file or not all of it");
}



TEST(ArchiveFile, DamageIsFoundAndNamed)
{
  const TemporaryFile file;
  Archive             archive;
  archive.write("a/b", std::vector<double>(100, 0.1), 4, "length");
  write_file(archive, file.path, comm);
  EXPECT_EQ(read_file(file.path, comm).data_sets().at("a/b").unit, "length");
  if (own_rank() == 0)
    {
      std::string bytes;
      {
        std::ifstream in(file.path, std::ios::binary);
        bytes.assign(std::istreambuf_iterator<char>(in), {});
      }
      // One bit of one number.
      const double      value = 0.1;
      const std::string number(reinterpret_cast<const char *>(&value),
                               sizeof(value));
      const auto        place = bytes.find(number + number);
      ASSERT_NE(place, std::string::npos);
      bytes[place] = static_cast<char>(bytes[place] ^ 1);
      std::ofstream(file.path, std::ios::binary) << bytes;
    }
  MPI_Barrier(comm);
  EXPECT_EQ(message_of<InputError>([&]() { read_file(file.path, comm); }),
            "cannot read '" + file.path +
              "': the data set 'a/b' is damaged: its checksum is another");
}



TEST(ArchiveFile, ATruncatedFileIsRefused)
{
  const TemporaryFile file;
  write_file(make_archive(), file.path, comm);
  if (own_rank() == 0)
    std::filesystem::resize_file(file.path,
                                 std::filesystem::file_size(file.path) - 100);
  MPI_Barrier(comm);
  EXPECT_EQ(message_of<InputError>([&]() { read_file(file.path, comm); }),
            "cannot read '" + file.path +
              "': it is no HDF5 file or not all of it");
}



TEST(ArchiveFile, AGroupCanBeReadAlone)
{
  const TemporaryFile file;
  write_file(make_archive(), file.path, comm);
  const Archive group = read_group(file.path, "time");
  EXPECT_TRUE(group.contains("time/current"));
  EXPECT_FALSE(group.contains("points/id"));
  MPI_Barrier(comm);
}



TEST(ArchiveFile, AFullDiskLeavesTheOldFile)
{
  const TemporaryFile file;
  write_file(make_archive(), file.path, comm);
  const std::string part = file.path + ".part";
  if (own_rank() == 0)
    std::filesystem::create_symlink("/dev/full", part);
  MPI_Barrier(comm);
  Archive large;
  large.write("a", std::vector<double>(100000, 1.));
  EXPECT_NE(
    message_of<InputError>([&]() { write_file(large, file.path, comm); }), "");
  EXPECT_TRUE(read_file(file.path, comm).gathered(comm) ==
              make_archive().gathered(comm));
}
