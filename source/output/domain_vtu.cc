// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/output/domain_vtu.h>

#include <moraine/output/point_rows.h>
#include <moraine/output/smoothed_stress.h>
#include <moraine/output/vtu_file.h>

#include <deal.II/grid/reference_cell.h>

#include <algorithm>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  void
  write_domain_vtu(const Basis<dim>    &basis,
                   const PointSet<dim> &points,
                   const std::string   &path,
                   const double         time,
                   const unsigned int   step,
                   const Units         &units)
  {
    Assert(basis.has_domains(), ExcInternalError());
    constexpr unsigned int n_corners = 1 << dim;
    const auto             order     = points_by_id(points);
    VtuFile<dim, dim>      file(units);
    declare_point_rows(points.fields(), file);
    const auto smoothed   = smoothed_mean_stress(points);
    const auto make_patch = [&](const unsigned int i) {
      const auto rows    = point_rows(points, smoothed, order[i]);
      const auto corners = basis.domain_corners(order[i]);
      typename VtuFile<dim, dim>::Patch patch;
      std::copy(corners.begin(), corners.end(), patch.vertices);
      patch.reference_cell = ReferenceCells::get_hypercube<dim>();
      patch.n_subdivisions = 1;
      patch.data.reinit(file.n_rows(), n_corners);
      for (unsigned int row = 0; row < rows.size(); ++row)
        for (unsigned int c = 0; c < n_corners; ++c)
          patch.data(row, c) = rows[row];
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
  write_domain_vtu(const Basis<2> &,
                   const PointSet<2> &,
                   const std::string &,
                   const double,
                   const unsigned int,
                   const Units &);
  template void
  write_domain_vtu(const Basis<3> &,
                   const PointSet<3> &,
                   const std::string &,
                   const double,
                   const unsigned int,
                   const Units &);
} // namespace moraine
