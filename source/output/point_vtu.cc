// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/output/point_vtu.h>

#include <moraine/output/point_rows.h>
#include <moraine/output/smoothed_stress.h>
#include <moraine/output/vtu_file.h>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  void
  write_point_vtu(const PointSet<dim> &points,
                  const std::string   &path,
                  const double         time,
                  const unsigned int   step,
                  const Units       &units)
  {
    const auto      order = points_by_id(points);
    VtuFile<0, dim> file(units);
    declare_point_rows(points.fields(), file);
    const auto smoothed   = smoothed_mean_stress(points);
    const auto make_patch = [&](const unsigned int i) {
      const auto rows = point_rows(points, smoothed, order[i]);
      typename VtuFile<0, dim>::Patch patch;
      patch.vertices[0] = points.position(order[i]);
      patch.data.reinit(file.n_rows(), 1);
      for (unsigned int row = 0; row < rows.size(); ++row)
        patch.data(row, 0) = rows[row];
      return patch;
    };
    file.write(path,
               time,
               step,
               points.mesh().triangulation().get_communicator(),
               order.size(),
               make_patch);
  }



  template void
  write_point_vtu(const PointSet<2> &,
                  const std::string &,
                  const double,
                  const unsigned int,
                  const Units &);
  template void
  write_point_vtu(const PointSet<3> &,
                  const std::string &,
                  const double,
                  const unsigned int,
                  const Units &);
} // namespace moraine
