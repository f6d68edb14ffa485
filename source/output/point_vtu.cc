// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/output/point_vtu.h>

#include <moraine/output/vtu_file.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** Where the nine components of a tensor are stored; one past the end: 0.
     */
    template <int dim>
    constexpr std::array<unsigned int, 9>
    tensor_components()
    {
      if constexpr (dim == 2)
        return {{0, 3, 4, 3, 1, 4, 4, 4, 2}};
      else
        return {{0, 3, 4, 3, 1, 5, 4, 5, 2}};
    }

    enum class Kind
    {
      scalars,
      vector,
      tensor
    };

    template <int dim>
    Kind
    kind_of(const PointFields::Field &field)
    {
      if (field.n_components == dim)
        return Kind::vector;
      if (field.n_components == n_stress_components<dim>)
        return Kind::tensor;
      return Kind::scalars;
    }

    template <int dim>
    double
    mean_stress(const double *sigma)
    {
      return (sigma[0] + sigma[1] + sigma[2]) / 3.;
    }

    template <int dim>
    double
    von_mises_stress(const double *sigma)
    {
      const double mean   = mean_stress<dim>(sigma);
      double       square = 0;
      for (unsigned int c = 0; c < 3; ++c)
        square += (sigma[c] - mean) * (sigma[c] - mean);
      for (unsigned int c = 3; c < n_stress_components<dim>; ++c)
        square += 2. * sigma[c] * sigma[c];
      return std::sqrt(1.5 * square);
    }

    template <int dim>
    void
    declare_fields(const PointFields &fields, VtuFile<0, dim> &file)
    {
      for (const auto &field : fields.fields())
        switch (kind_of<dim>(field))
          {
            case Kind::vector:
              file.add_vector(field.name, field.unit);
              break;
            case Kind::tensor:
              file.add_tensor(field.name, field.unit);
              break;
            case Kind::scalars:
              for (unsigned int c = 0; c < field.n_components; ++c)
                file.add_scalar(field.n_components == 1 ?
                                  field.name :
                                  field.name + "_" + std::to_string(c),
                                field.unit);
          }
      file.add_scalar("id", "-");
      file.add_scalar("von_mises_stress", "stress");
      file.add_scalar("mean_stress", "stress");
    }

    /** The numbers of a point in the order of declare_fields(). */
    template <int dim>
    void
    fill_patch(const PointSet<dim>        &points,
               const unsigned int          p,
               DataOutBase::Patch<0, dim> &patch)
    {
      const double *values = points.values(p);
      const double *sigma  = values + points.stress_offset();
      unsigned int  row    = 0;
      const auto    add    = [&](const double value) {
        patch.data(row++, 0) = value;
      };
      for (const auto &field : points.fields().fields())
        {
          const double *field_values = values + field.offset;
          if (kind_of<dim>(field) == Kind::tensor)
            for (const unsigned int c : tensor_components<dim>())
              add(c < field.n_components ? field_values[c] : 0.);
          else
            for (unsigned int c = 0; c < field.n_components; ++c)
              add(field_values[c]);
        }
      add(points.id(p));
      add(von_mises_stress<dim>(sigma));
      add(mean_stress<dim>(sigma));
    }
  } // namespace



  template <int dim>
  void
  write_point_vtu(const PointSet<dim> &points,
                  const std::string   &path,
                  const double         time,
                  const unsigned int   step)
  {
    std::vector<unsigned int> order(points.n_local());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(),
              order.end(),
              [&](const unsigned int p, const unsigned int q) {
                return points.id(p) < points.id(q);
              });

    VtuFile<0, dim> file;
    declare_fields<dim>(points.fields(), file);
    file.patches.resize(order.size());
    for (unsigned int i = 0; i < order.size(); ++i)
      {
        auto &patch       = file.patches[i];
        patch.vertices[0] = points.position(order[i]);
        patch.patch_index = i;
        patch.data.reinit(file.n_rows(), 1);
        fill_patch<dim>(points, order[i], patch);
      }
    file.write(path,
               time,
               step,
               points.mesh().triangulation().get_communicator());
  }



  template void
  write_point_vtu(const PointSet<2> &,
                  const std::string &,
                  const double,
                  const unsigned int);
  template void
  write_point_vtu(const PointSet<3> &,
                  const std::string &,
                  const double,
                  const unsigned int);
} // namespace moraine
