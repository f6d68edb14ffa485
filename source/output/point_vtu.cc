// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/output/point_vtu.h>

#include <moraine/output/smoothed_stress.h>
#include <moraine/output/stress_rows.h>

#include <deal.II/grid/reference_cell.h>

#include <algorithm>
#include <numeric>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** Fields of a point, and what is added to them. */
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
      if (has_excess_pressure<dim>(fields))
        file.add_tensor("effective_stress", "stress");
    }



    /** The numbers of point @p p in the order of declare_point_rows();
     * @p smoothed_mean_stress has one for each point. */
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
      if (has_excess_pressure<dim>(points.fields()))
        {
          const auto effective = effective_stress(points, p);
          for (const unsigned int c : tensor_components<dim>)
            rows.push_back(c < effective.size() ? effective[c] : 0.);
        }
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



    /** Write a patch for each point, with its numbers at all corners.
     * @param set_corners gives a patch those of point p */
    template <int patch_dim, int dim, typename SetCorners>
    void
    write_patches(const PointSet<dim> &points,
                  const VtuTarget     &target,
                  const SetCorners    &set_corners)
    {
      constexpr unsigned int  n_corners = 1 << patch_dim;
      const auto              order     = points_by_id(points);
      VtuFile<patch_dim, dim> file(target);
      declare_point_rows(points.fields(), file);
      const auto smoothed   = smoothed_mean_stress(points);
      const auto make_patch = [&](const unsigned int i) {
        const auto rows = point_rows(points, smoothed, order[i]);
        typename VtuFile<patch_dim, dim>::Patch patch;
        set_corners(order[i], patch);
        patch.data.reinit(file.n_rows(), n_corners);
        for (unsigned int row = 0; row < rows.size(); ++row)
          for (unsigned int c = 0; c < n_corners; ++c)
            patch.data(row, c) = rows[row];
        return patch;
      };
      file.write(points.mesh().triangulation().get_communicator(),
                 order.size(),
                 make_patch);
    }
  } // namespace



  template <int dim>
  void
  write_point_vtu(const PointSet<dim> &points, const VtuTarget &target)
  {
    write_patches<0>(points, target, [&](const unsigned int p, auto &patch) {
      patch.vertices[0] = points.position(p);
    });
  }



  template <int dim>
  void
  write_domain_vtu(const Basis<dim>    &basis,
                   const PointSet<dim> &points,
                   const VtuTarget     &target)
  {
    Assert(basis.has_domains(), ExcInternalError());
    write_patches<dim>(points, target, [&](const unsigned int p, auto &patch) {
      const auto corners = basis.domain_corners(p);
      std::copy(corners.begin(), corners.end(), patch.vertices);
      patch.reference_cell = ReferenceCells::get_hypercube<dim>();
      patch.n_subdivisions = 1;
    });
  }



#define INSTANTIATE(dim)                                         \
  template decltype(write_point_vtu<dim>)  write_point_vtu<dim>; \
  template decltype(write_domain_vtu<dim>) write_domain_vtu<dim>;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
