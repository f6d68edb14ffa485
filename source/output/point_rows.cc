// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/output/point_rows.h>

#include <moraine/output/stress_rows.h>

#include <algorithm>
#include <numeric>

namespace moraine
{
  using namespace dealii;

  template <int patch_dim, int dim>
  void
  declare_point_rows(const PointFields &fields, VtuFile<patch_dim, dim> &file)
  {
    for (const auto &field : fields.fields())
      switch (field.kind)
        {
          case FieldKind::vector:
            file.add_vector(field.name, field.unit);
            break;
          case FieldKind::symmetric_tensor:
          case FieldKind::tensor:
            file.add_tensor(field.name, field.unit);
            break;
          case FieldKind::number:
            file.add_scalar(field.name, field.unit);
        }
    file.add_scalar("id", "-");
    file.add_scalar("von_mises_stress", "stress");
    file.add_scalar("mean_stress", "stress");
    file.add_scalar("smoothed_mean_stress", "stress");
  }



  template <int dim>
  std::vector<double>
  point_rows(const PointSet<dim>       &points,
             const std::vector<double> &smoothed_mean_stress,
             const unsigned int         p)
  {
    const double       *values = points.values(p);
    const double       *sigma  = values + points.stress_offset();
    std::vector<double> rows;
    for (const auto &field : points.fields().fields())
      {
        const double *field_values = values + field.offset;
        if (field.kind == FieldKind::symmetric_tensor)
          for (const unsigned int c : tensor_components<dim>)
            rows.push_back(c < field.n_components ? field_values[c] : 0.);
        else if (field.kind == FieldKind::tensor)
          {
            const double out_of_plane =
              field.name == FieldNames<dim>::deformation_gradient.name ? 1. :
                                                                         0.;
            for (unsigned int i = 0; i < 3; ++i)
              for (unsigned int j = 0; j < 3; ++j)
                rows.push_back(i < dim && j < dim ?
                                 field_values[i * dim + j] :
                                 (i == j ? out_of_plane : 0.));
          }
        else
          rows.insert(rows.end(),
                      field_values,
                      field_values + field.n_components);
      }
    rows.push_back(points.id(p));
    rows.push_back(von_mises_stress<dim>(sigma));
    rows.push_back(mean_stress(sigma));
    rows.push_back(smoothed_mean_stress[p]);
    return rows;
  }



  template <int dim>
  std::vector<unsigned int>
  points_by_id(const PointSet<dim> &points)
  {
    std::vector<unsigned int> order(points.n_local());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(),
              order.end(),
              [&](const unsigned int p, const unsigned int q) {
                return points.id(p) < points.id(q);
              });
    return order;
  }



#define INSTANTIATE(dim)                                                      \
  template void declare_point_rows(const PointFields &, VtuFile<0, dim> &);   \
  template void declare_point_rows(const PointFields &, VtuFile<dim, dim> &); \
  template std::vector<double>       point_rows(const PointSet<dim> &,        \
                                                const std::vector<double> &,  \
                                                const unsigned int);          \
  template std::vector<unsigned int> points_by_id(const PointSet<dim> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
