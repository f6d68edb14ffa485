// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_points_point_fields_h
#define moraine_points_point_fields_h

#include <deal.II/base/exceptions.h>

#include <string>
#include <vector>

namespace moraine
{
  /**
   * Number of stored components of a symmetric stress: in plane strain
   * xx, yy, zz, xy; in 3D xx, yy, zz, xy, xz, yz.
   */
  template <int dim>
  inline constexpr unsigned int n_stress_components = (dim == 2 ? 4 : 6);

  /**
   * The layout of the numbers a point carries. A basis, a material or an output
   * asks for a field by name and gets the offset of its first component; nobody
   * numbers fields by hand, and a field that nobody asks for does not exist.
   */
  class PointFields
  {
  public:
    struct Field
    {
      std::string  name;
      std::string  unit;
      unsigned int offset;
      unsigned int n_components;
    };

    /**
     * Offset of the field @p name; added to the layout if it is not there.
     */
    unsigned int
    request(const std::string &name,
            const unsigned int n_components,
            const std::string &unit)
    {
      for (const Field &field : list)
        if (field.name == name)
          {
            AssertThrow(field.n_components == n_components,
                        dealii::ExcInternalError());
            return field.offset;
          }
      list.push_back({name, unit, total, n_components});
      total += n_components;
      return list.back().offset;
    }

    const std::vector<Field> &
    fields() const
    {
      return list;
    }

    /** Number of doubles a point carries beside its location. */
    unsigned int
    n_values() const
    {
      return total;
    }

  private:
    std::vector<Field> list;
    unsigned int       total = 0;
  };
} // namespace moraine

#endif
