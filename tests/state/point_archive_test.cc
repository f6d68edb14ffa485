// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/core/exceptions.h>
#include <moraine/state/state.h>

#include <gtest/gtest.h>

#include <cstdio>

#include "../core/message.h"
#include "../small_scene.h"

namespace
{
  using namespace dealii;
  using namespace moraine;

  /** Numbers of their own in every field. */
  template <int dim>
  void
  fill(PointSet<dim> &points)
  {
    for (unsigned int p = 0; p < points.n_local(); ++p)
      {
        double *values = points.values(p);
        for (const auto &field : points.fields().fields())
          for (unsigned int c = 0; c < field.n_components; ++c)
            if (field.name != "body")
              values[field.offset + c] =
                1 + std::sin(points.id(p) + 0.1 * field.offset + 0.01 * c);
      }
  }

  template <int dim>
  Archive
  archive_of(const PointSet<dim> &points)
  {
    Archive archive;
    points.write(archive);
    return archive;
  }

  template <int dim>
  void
  check_undo()
  {
    SmallScene<dim> scene(true, 2, StrainMeasure::finite);
    fill(scene.points);
    const Archive before = archive_of(scene.points);
    for (unsigned int p = 0; p < scene.points.n_local(); ++p)
      {
        scene.points.set_volume(p, 7.);
        Point<dim> x = scene.points.position(p);
        x[0]         = 3.9 - x[0];
        scene.points.set_position(p, x);
      }
    scene.points.find_cells();
    EXPECT_TRUE(archive_of(scene.points) != before);
    scene.points.read(before);
    // The order in memory too.
    EXPECT_TRUE(archive_of(scene.points) == before);
    EXPECT_EQ(scene.points.n_local(), before.integers("points/id").size());
    for (const auto &in_cell : scene.points.cells())
      for (unsigned int p = in_cell.first; p < in_cell.last; ++p)
        EXPECT_TRUE(in_cell.cell->point_inside(scene.points.position(p)));
  }

  /** Through a file, into a set without these values. */
  template <int dim>
  void
  check_file()
  {
    SmallScene<dim> scene(true, 2, StrainMeasure::finite);
    SmallScene<dim> other(true, 2, StrainMeasure::finite);
    fill(scene.points);
    const std::string path =
      "points_" +
      std::to_string(Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD)) + ".h5";
    write_file(archive_of(scene.points), path, MPI_COMM_WORLD);
    other.points.read(read_file(path, MPI_COMM_WORLD));
    EXPECT_EQ(other.points.n_global(), scene.points.n_global());
    EXPECT_EQ(other.points.n_local(), scene.points.n_local());
    EXPECT_TRUE(archive_of(other.points).gathered(MPI_COMM_WORLD) ==
                archive_of(scene.points).gathered(MPI_COMM_WORLD));
    MPI_Barrier(MPI_COMM_WORLD);
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::remove(path.c_str());
  }
} // namespace



TEST(PointArchive, GivesBackEveryBitAndTheOrder)
{
  check_undo<2>();
  check_undo<3>();
}



TEST(PointArchive, RowsFindTheirRank)
{
  check_file<2>();
  check_file<3>();
}



TEST(PointArchive, AMissingFieldIsSaid)
{
  SmallScene<2> small, finite(false, 2, StrainMeasure::finite);
  const Archive archive = archive_of(small.points);
  EXPECT_EQ(message_of<InputError>([&]() { finite.points.read(archive); }),
            "archive: it has no data set 'points/deformation_gradient'");
}
