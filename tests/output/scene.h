// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_tests_output_scene_h
#define moraine_tests_output_scene_h

#include <moraine/mesh/background_mesh.h>
#include <moraine/points/point_set.h>

#include <deal.II/base/mpi.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace moraine
{
  /** 4 x 2 (x 1) cells of size 1 from the origin. */
  template <int dim>
  MeshParameters<dim>
  mesh_parameters()
  {
    MeshParameters<dim> parameters;
    parameters.cells = {4, 2};
    parameters.cells.resize(dim, 1);
    for (unsigned int d = 0; d < dim; ++d)
      parameters.upper_corner[d] = parameters.cells[d];
    return parameters;
  }

  /** Two points in each cell, numbered the same on any number of ranks. */
  template <int dim>
  void
  fill(PointSet<dim> &points)
  {
    for (const auto &cell :
         points.mesh().triangulation().active_cell_iterators())
      if (cell->is_locally_owned())
        for (unsigned int i = 0; i < 2; ++i)
          {
            dealii::Point<dim> unit;
            for (unsigned int d = 0; d < dim; ++d)
              unit[d] = 0.25 + 0.5 * i;
            points.insert(cell,
                          cell->vertex(0) + unit,
                          unit,
                          100 - 2 * cell->active_cell_index() - i,
                          0,
                          0.5);
          }
    points.finish_insertion();
  }

  /** A folder that every rank knows and that is gone in the end. */
  class Folder
  {
  public:
    Folder()
      : path(std::filesystem::temp_directory_path() /
             ("moraine-output-" +
              std::to_string(
                dealii::Utilities::MPI::broadcast(MPI_COMM_WORLD, getpid()))))
    {
      std::filesystem::create_directories(path);
      MPI_Barrier(MPI_COMM_WORLD);
    }

    ~Folder()
    {
      MPI_Barrier(MPI_COMM_WORLD);
      std::error_code ignored;
      std::filesystem::remove_all(path, ignored);
      MPI_Barrier(MPI_COMM_WORLD);
    }

    std::string
    file(const std::string &name) const
    {
      return (path / name).string();
    }

  private:
    std::filesystem::path path;
  };

  inline std::string
  content(const std::string &path)
  {
    std::ifstream      file(path);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
  }
} // namespace moraine

#endif
