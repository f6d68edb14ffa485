// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_output_point_rows_h
#define moraine_output_point_rows_h

#include <moraine/output/vtu_file.h>
#include <moraine/points/point_set.h>

#include <vector>

namespace moraine
{
  /**
   * Declare what write_point_vtu() says about a point: its fields, and what is
   * added to them.
   */
  template <int patch_dim, int dim>
  void
  declare_point_rows(const PointFields &fields, VtuFile<patch_dim, dim> &file);

  /** The numbers of point @p p in the order of declare_point_rows();
   * @p smoothed_mean_stress has one for each point. */
  template <int dim>
  std::vector<double>
  point_rows(const PointSet<dim>       &points,
             const std::vector<double> &smoothed_mean_stress,
             const unsigned int         p);

  /** The numbers of the local points, ordered by id. */
  template <int dim>
  std::vector<unsigned int>
  points_by_id(const PointSet<dim> &points);
} // namespace moraine

#endif
