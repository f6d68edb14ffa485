// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_geometry_shape_library_h
#define moraine_geometry_shape_library_h

#include <moraine/geometry/shape.h>

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace dealii
{
  class ParameterHandler;
}

namespace moraine
{
  /** What a user makes of the shapes. */
  enum class ShapeUse
  {
    body,   ///< what is inside
    surface ///< the rim or a part of it
  };

  /** A body or a surface as the user gives it: one table of kinds and one of
   * keys serve both. A key that the kind does not use must not be given. */
  template <int dim>
  struct ShapeParameters
  {
    explicit ShapeParameters(const ShapeUse use = ShapeUse::body);

    void
    add_parameters(dealii::ParameterHandler &prm);

    /** The names of the kinds there are for this use. */
    std::vector<std::string>
    kinds() const;

    /** The kind of shape, or that of the rim of a body. */
    std::string
    kind() const;

    /** Throws InputError unless the keys given are those of the kind; @p
     * section is named in messages. */
    void
    check_keys(const std::string &section) const;

    /** Whether the body's points come from a file; it has no shape then. */
    bool
    is_point_file() const
    {
      return kind() == "points-from-file";
    }

    /** Whether a key says anything: not empty, nor zero where that is the
     * default. */
    bool
    given(const std::string &key) const;

    // What a key says; errors name section and key.

    const std::string &
    text(const std::string &key) const
    {
      return texts.at(key);
    }

    double
    number(const std::string &key, const std::string &section) const;

    dealii::Point<dim>
    point(const std::string &key, const std::string &section) const;

    /** Points separated by ';', of n coordinates each. */
    template <int n>
    std::vector<dealii::Point<n>>
    points(const std::string &key, const std::string &section) const;

    /** Words separated by commas. */
    std::vector<std::string>
    words(const std::string &key) const;

    ShapeUse use;

    /** The text of each key. */
    std::map<std::string, std::string> texts;
  };

  template <int dim>
  using NamedShapes = std::map<std::string, ShapePointer<dim>>;

  /** Makes the shape of groups of cells; the section is for messages. */
  template <int dim>
  using ShapeOfGroups =
    std::function<ShapePointer<dim>(const std::vector<std::string> &groups,
                                    const std::string              &section)>;

  /**
   * The shape described by @p parameters, with its rotation and translation;
   * null for a point file. Operands are looked up in @p known. Throws
   * InputError for missing, superfluous and impossible values.
   */
  template <int dim>
  ShapePointer<dim>
  make_shape(const ShapeParameters<dim> &parameters,
             const NamedShapes<dim>     &known,
             const std::string          &section,
             const ShapeOfGroups<dim>   &of_groups = {});

  /**
   * The shapes of all bodies, by name. An operand is the name of another body
   * of the list, before or after; it is used as placed there. Section names in
   * messages are @p section, a slash and the name.
   */
  template <int dim>
  NamedShapes<dim>
  make_shapes(const std::map<std::string, ShapeParameters<dim>> &bodies,
              const std::string                                 &section,
              const ShapeOfGroups<dim> &of_groups = {});

  /**
   * The rim of one of @p bodies, of a shape of its own, or a part of it. Throws
   * InputError for entries that are missing, wrong, or that this kind of
   * surface does not use.
   */
  template <int dim>
  SurfacePointer<dim>
  make_surface(const ShapeParameters<dim> &parameters,
               const NamedShapes<dim>     &bodies,
               const std::string          &section);

  /** Rotation and translation of a body. */
  template <int dim>
  Placement<dim>
  make_placement(const ShapeParameters<dim> &parameters,
                 const std::string          &section);
} // namespace moraine

#endif
