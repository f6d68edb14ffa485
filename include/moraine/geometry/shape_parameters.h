// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_geometry_shape_parameters_h
#define moraine_geometry_shape_parameters_h

#include <deal.II/base/point.h>

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

  /**
   * A body or a surface as the user gives it: one table of kinds and one of
   * keys serve both. A key that the kind does not use must not be given.
   */
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

    /**
     * Throws InputError unless the keys given are those of the kind;
     * @p section is named in messages.
     */
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

  /** What the user says about a surface. */
  template <int dim>
  struct SurfaceParameters : public ShapeParameters<dim>
  {
    SurfaceParameters()
      : ShapeParameters<dim>(ShapeUse::surface)
    {}
  };
} // namespace moraine

#endif
