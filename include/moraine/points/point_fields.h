// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_points_point_fields_h
#define moraine_points_point_fields_h

#include <deal.II/base/exceptions.h>
#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

#include <algorithm>
#include <string>
#include <vector>

namespace moraine
{
  /** Number of stored components of a symmetric stress: in plane strain xx, yy,
   * zz, xy; in 3D xx, yy, zz, xy, xz, yz. */
  template <int dim>
  inline constexpr unsigned int n_stress_components = (dim == 2 ? 4 : 6);

  /** What the numbers of a field make up together. */
  enum class FieldKind
  {
    number,
    vector,
    symmetric_tensor,
    tensor
  };

  template <class T>
  inline constexpr FieldKind kind_of_field = FieldKind::number;

  template <int dim>
  inline constexpr FieldKind kind_of_field<dealii::Tensor<1, dim>> =
    FieldKind::vector;

  template <>
  inline constexpr FieldKind kind_of_field<dealii::SymmetricTensor<2, 3>> =
    FieldKind::symmetric_tensor;

  template <int dim>
  inline constexpr FieldKind kind_of_field<dealii::Tensor<2, dim>> =
    FieldKind::tensor;

  /** How a value of type T is stored at a point: its components in deal.II's
   * order, row by row or xx, yy, zz, xy[, xz, yz]; of a symmetric tensor in
   * plane strain the others are 0. */
  template <int dim, class T>
  struct FieldStorage
  {
    static constexpr FieldKind    kind = kind_of_field<T>;
    static constexpr unsigned int n_components =
      kind == FieldKind::symmetric_tensor ? n_stress_components<dim> :
                                            T::n_independent_components;

    static T
    load(const double *components)
    {
      T value;
      std::copy_n(components, n_components, value.begin_raw());
      return value;
    }

    static void
    store(const T &value, double *components)
    {
      std::copy_n(value.begin_raw(), n_components, components);
    }
  };

  template <int dim>
  struct FieldStorage<dim, double>
  {
    static constexpr FieldKind    kind         = FieldKind::number;
    static constexpr unsigned int n_components = 1;

    static double
    load(const double *components)
    {
      return *components;
    }

    static void
    store(const double value, double *components)
    {
      *components = value;
    }
  };

  /** The name of a field of values of type T, and their unit. */
  template <int dim, class T>
  struct FieldName
  {
    std::string name;
    std::string unit;
  };

  /** Where the values of points have a field of type T, if they have it. */
  template <int dim, class T>
  class PointField
  {
  public:
    /** No such field. */
    PointField() = default;

    explicit PointField(const unsigned int offset)
      : first(offset)
    {}

    bool
    exists() const
    {
      return first != none;
    }

    /** Of its first component in the values of a point. */
    unsigned int
    offset() const
    {
      return first;
    }

    /** Of a point with these @p values. */
    T
    operator()(const double *values) const
    {
      return FieldStorage<dim, T>::load(values + first);
    }

    void
    store(const T &value, double *values) const
    {
      FieldStorage<dim, T>::store(value, values + first);
    }

  private:
    static constexpr unsigned int none = -1;

    unsigned int first = none;
  };

  /**
   * The layout of the numbers a point carries. A basis, a material or an output
   * asks for a field and gets a handle of its type; nobody numbers fields by
   * hand, and a field that nobody asks for does not exist.
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
      FieldKind    kind;
    };

    /** The field, added to the layout if it is not there. */
    template <int dim, class T>
    PointField<dim, T>
    request(const FieldName<dim, T> &asked)
    {
      const PointField<dim, T> known = find(asked);
      if (known.exists())
        return known;
      constexpr unsigned int n = FieldStorage<dim, T>::n_components;
      list.push_back(
        {asked.name, asked.unit, total, n, FieldStorage<dim, T>::kind});
      total += n;
      return PointField<dim, T>(list.back().offset);
    }

    /** The field, which need not exist. */
    template <int dim, class T>
    PointField<dim, T>
    find(const FieldName<dim, T> &asked) const
    {
      for (const Field &field : list)
        if (field.name == asked.name)
          {
            AssertThrow(field.kind == (FieldStorage<dim, T>::kind),
                        dealii::ExcMessage("Two kinds of the field " +
                                           asked.name));
            return PointField<dim, T>(field.offset);
          }
      return {};
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

  /** The fields that several rooms know. */
  template <int dim>
  struct FieldNames
  {
    using Number          = FieldName<dim, double>;
    using Vector          = FieldName<dim, dealii::Tensor<1, dim>>;
    using SymmetricTensor = FieldName<dim, dealii::SymmetricTensor<2, 3>>;
    using Tensor          = FieldName<dim, dealii::Tensor<2, dim>>;

    inline static const Number volume{"volume",
                                      dim == 2 ? "length^2" : "length^3"};
    inline static const Number body{"body", "-"};
    inline static const Vector displacement{"displacement", "length"};
    /** In dynamics, where points carry them. */
    inline static const Vector velocity{"velocity", "length/time"};
    inline static const Vector acceleration{"acceleration", "length/time^2"};
    inline static const Vector acceleration_before{"acceleration before",
                                                   "length/time^2"};
    /** Where it goes back to nodes, see Motion. */
    inline static const Tensor velocity_gradient{"velocity_gradient", "1/time"};
    inline static const SymmetricTensor stress{"stress", "stress"};
    /** Where there is water: @f$p_w@f$, compression positive, and
     * @f$\sigma' - p_w 1@f$. */
    inline static const Number pore_pressure{"pore_pressure", "stress"};
    inline static const SymmetricTensor total_stress{"total_stress", "stress"};
    /** Of undrained materials, compression positive; J times as much at finite
     * strain. */
    inline static const Number excess_pressure{"excess_pressure", "stress"};
    /** In dynamics at small strain, what recovered strains add to the stress;
     * see DoubleMapping. */
    inline static const SymmetricTensor stress_of_recovery{"stress_of_recovery",
                                                           "stress"};
    /** @f$F@f$, at finite strain. */
    inline static const Tensor deformation_gradient{"deformation_gradient",
                                                    "-"};
    /** What @f$F@f$ was when displacements became zero again; zero before. */
    inline static const Tensor deformation_gradient_then{
      "deformation_gradient_then",
      "-"};
    /** @f$b^e@f$, at finite strain. */
    inline static const SymmetricTensor elastic_left_cauchy_green{
      "elastic_left_cauchy_green",
      "-"};
    /** @f$v_0@f$, at finite strain. */
    inline static const Number initial_volume{"initial_volume",
                                              dim == 2 ? "length^2" :
                                                         "length^3"};
  };
} // namespace moraine

#endif
