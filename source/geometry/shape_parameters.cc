// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/geometry/shape_parameters.h>

#include <moraine/core/exceptions.h>
#include <moraine/core/nearest.h>
#include <moraine/core/patterns.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    // For what and in which dimensions kinds and keys are.
    enum : unsigned int
    {
      body    = 1,
      surface = 2,
      both    = 3,
      flat    = 4, // 2D only
      solid   = 8  // 3D only
    };

    /** Whether something marked with @p flags is there. */
    template <int dim>
    bool
    is_here(const unsigned int flags, const ShapeUse use)
    {
      return (flags & (use == ShapeUse::body ? body : surface)) != 0 &&
             (flags & (dim == 2 ? solid : flat)) == 0;
    }

    /** Keys that are not there for a use or dimension do not count. */
    struct Kind
    {
      unsigned int             flags;
      std::string              name, description;
      std::vector<std::string> needs, may_have;
    };

    const std::string rim = "rim of a body";

    const std::vector<Kind> &
    all_kinds()
    {
      static const std::vector<Kind> kinds{
        {surface, rim, "", {"Body"}, {"Part"}},
        {body,
         "box",
         "between two corners",
         {"Lower corner", "Upper corner"},
         {}},
        {body,
         "polygon",
         "a polygon in the x-y plane; in 3D the prism over it",
         {"Vertices", "Extent"},
         {}},
        {body | flat, "disc", "(2D)", {"Centre", "Radius"}, {}},
        {body | flat, "ring", "(2D)", {"Centre", "Radius", "Inner radius"}, {}},
        {surface | flat, "polyline", "straight segments", {"Points"}, {"Flip"}},
        {surface | flat,
         "circle",
         "the rim of a disc",
         {"Centre", "Radius", "Body side"},
         {}},
        {surface | flat,
         "arc",
         "a part of it",
         {"Centre", "Radius", "Start angle", "End angle", "Body side"},
         {}},
        {surface | solid,
         "plane patch",
         "a plane polygon",
         {"Points"},
         {"Flip"}},
        {both | solid,
         "sphere",
         "(3D)",
         {"Centre", "Radius", "Body side"},
         {"Inner radius"}},
        {both | solid,
         "cylinder",
         "(3D) solid or hollow (a surface: its side)",
         {"Axis start", "Axis end", "Radius", "Body side"},
         {"Inner radius"}},
        {body, "half-space", "all behind a plane", {"Point", "Normal"}, {}},
        {surface, "plane", "without ends", {"Point", "Normal"}, {"Flip"}},
        {both,
         "expression",
         "where it is positive (a surface: zero)",
         {"Expression"},
         {"Extent lower corner", "Extent upper corner"}},
        {body, "mesh", "all cells of the mesh", {}, {}},
        {body, "union", "in any operand", {"Operands"}, {}},
        {body, "intersection", "in all operands", {"Operands"}, {}},
        {body, "difference", "in the first operand only", {"Operands"}, {}},
        {body, "points-from-file", "no shape: its points", {"Point file"}, {}}};
      return kinds;
    }

    enum Value
    {
      any_text,
      radius,
      number,
      point,
      interval,
      name_list,
      number_text,
      yes_or_no,
      side
    };

    /** The key of a section; the one of the kind is not among them. */
    struct Key
    {
      unsigned int flags;
      std::string  name;
      Value        value;
      std::string  text;
    };

    const std::vector<Key> &
    all_keys()
    {
      static const std::vector<Key> keys{
        {surface,
         "Body",
         any_text,
         "Name of a body: the surface is its rim, and no other key describes "
         "it but 'Part'"},
        {surface,
         "Part",
         any_text,
         "Of 'Body', the part of its rim; all if left out. A box has left, "
         "right, bottom, top, in 3D front (smallest y) and back; a polygon its "
         "edges, 1 from the first vertex to the second and so on, in 3D bottom "
         "and top; a ring or hollow sphere inner, outer; a cylinder side, or "
         "inner and outer, and bottom and top, where its axis starts and ends; "
         "a union, intersection or difference the names of its operands"},
        {body, "Lower corner", point, "Smallest coordinates of a box [length]"},
        {body, "Upper corner", point, "Largest coordinates of a box [length]"},
        {body,
         "Vertices",
         number_text,
         "Corners of a polygon in order, 'x y; x y; ...' [length]. It may be "
         "non-convex but must not touch itself"},
        {body | solid,
         "Extent",
         interval,
         "Lower and upper z of the prism over a polygon [length]"},
        {surface | flat,
         "Points",
         number_text,
         "Points x, y; x, y; ... of a polyline [length]. The body is on the "
         "left when walking along them; the first point repeated at the end "
         "closes the line"},
        {surface | solid,
         "Points",
         number_text,
         "Vertices x, y, z; x, y, z; ... of a plane patch [length], "
         "counter-clockwise when seen from outside the body"},
        {both, "Centre", point, "Centre of a round shape [length]"},
        {both, "Radius", radius, "(Outer) radius of a round shape [length]"},
        {body,
         "Inner radius",
         radius,
         "Radius of the hole in a round shape [length]"},
        {both | solid,
         "Axis start",
         point,
         "Centre of one end of a cylinder [length]"},
        {both | solid,
         "Axis end",
         point,
         "Centre of the other end of a cylinder [length]"},
        {surface | flat,
         "Start angle",
         number,
         "Angle from the x axis where an arc starts [degrees]"},
        {surface | flat,
         "End angle",
         number,
         "Angle where an arc ends, counter-clockwise from its start "
         "[degrees]"},
        {both,
         "Point",
         point,
         "A point on a plane or on that which bounds a half-space [length]"},
        {both,
         "Normal",
         point,
         "Normal of this plane, pointing out of the body; any length"},
        {surface,
         "Flip",
         yes_or_no,
         "Put the body on the other side of a polyline, plane or plane patch"},
        {surface,
         "Body side",
         side,
         "Whether the body is inside or outside of a circle, arc, sphere or "
         "cylinder"},
        {both,
         "Expression",
         any_text,
         "Positive inside the body; in x, y (and z), muParser syntax. A number "
         "wherever there are bodies. Details smaller than a point's share of "
         "its cell may be missed"},
        {surface,
         "Extent lower corner",
         point,
         "Lower corner of the box that limits the surface of an expression "
         "[length]; no limit if left out"},
        {surface,
         "Extent upper corner",
         point,
         "Upper corner of this box [length]"},
        {body,
         "Operands",
         name_list,
         "Names of the bodies that a union, intersection or difference is made "
         "from, as they are placed. These bodies are not simulated "
         "themselves"},
        {body,
         "Point file",
         any_text,
         "CSV file with columns x, y (, z), volume and, if wanted, more; its "
         "path is seen from the folder of the scene"},
        {body,
         "Rotation angle",
         number,
         "Turns the body counter-clockwise [degrees]"},
        {body,
         "Rotation centre",
         point,
         "A point that the rotation leaves in place; the origin if not set "
         "[length]"},
        {body | solid,
         "Rotation axis",
         point,
         "Direction of the axis of rotation; any length"},
        {body,
         "Translation",
         point,
         "Moves the body after the rotation [length]"}};
      return keys;
    }

    /** Bodies have lists with commas; surfaces blanks or commas. */
    template <int dim>
    std::unique_ptr<Patterns::PatternBase>
    pattern_of(const Value value, const ShapeUse use)
    {
      const bool numeric = value == radius || value == number || value == point;
      if (value == number_text || (numeric && use == ShapeUse::surface))
        return patterns::NumberText().clone();
      switch (value)
        {
          case radius:
            return patterns::non_negative().clone();
          case number:
            return patterns::number().clone();
          case point:
            return patterns::numbers(0, dim).clone();
          case interval:
            return patterns::numbers(0, 2).clone();
          case name_list:
            return Patterns::List(Patterns::Anything()).clone();
          case yes_or_no:
            return Patterns::Bool().clone();
          case side:
            return Patterns::Selection("|inside|outside").clone();
          default:
            return Patterns::Anything().clone();
        }
    }

    std::string
    default_of(const Value value, const ShapeUse use)
    {
      if (value == yes_or_no)
        return "false";
      return use == ShapeUse::body && (value == radius || value == number) ?
               "0" :
               "";
    }

    const char *
    kind_key(const ShapeUse use)
    {
      return use == ShapeUse::body ? "Shape" : "Surface";
    }

    const char *
    default_kind(const ShapeUse use, const int dim)
    {
      return use == ShapeUse::body ? "box" :
             dim == 2              ? "polyline" :
                                     "plane patch";
    }

    bool
    has(const std::vector<std::string> &list, const std::string &word)
    {
      return std::find(list.begin(), list.end(), word) != list.end();
    }

    /** Finite numbers separated by commas or blanks. */
    std::vector<double>
    numbers_in(std::string        text,
               const unsigned int n,
               const std::string &section,
               const std::string &key,
               const std::string &allowed)
    {
      const std::string   found = text;
      std::vector<double> result;
      std::replace(text.begin(), text.end(), ',', ' ');
      for (const auto &word : Utilities::break_text_into_lines(text, 1))
        try
          {
            result.push_back(Utilities::string_to_double(word));
          }
        catch (const ExceptionBase &)
          {
            reject(section, key, found, allowed);
          }
      if (result.size() != n ||
          !std::all_of(result.begin(), result.end(), [](const double x) {
            return std::isfinite(x);
          }))
        reject(section, key, found, allowed);
      return result;
    }

    template <int n>
    Point<n>
    point_in(const std::string &text,
             const std::string &section,
             const std::string &key,
             const std::string &allowed)
    {
      const auto numbers = numbers_in(text, n, section, key, allowed);
      Point<n>   x;
      std::copy(numbers.begin(), numbers.end(), x.begin_raw());
      return x;
    }
  } // namespace

  template <int dim>
  ShapeParameters<dim>::ShapeParameters(const ShapeUse use)
    : use(use)
  {
    texts[kind_key(use)] = default_kind(use, dim);
    for (const Key &key : all_keys())
      if (is_here<dim>(key.flags, use))
        texts[key.name] = default_of(key.value, use);
  }

  template <int dim>
  void
  ShapeParameters<dim>::add_parameters(ParameterHandler &prm)
  {
    std::string text =
      use == ShapeUse::body ? "The region the body fills:" : "Kind of surface:";
    for (const Kind &kind : all_kinds())
      if (is_here<dim>(kind.flags, use) && kind.name != rim)
        text += " " + kind.name + " = " + kind.description + ";";
    text.back() = '.';
    prm.add_parameter(kind_key(use),
                      texts[kind_key(use)],
                      text,
                      patterns::selection(kinds()));
    for (const Key &key : all_keys())
      if (is_here<dim>(key.flags, use))
        prm.add_parameter(key.name,
                          texts[key.name],
                          key.text,
                          *pattern_of<dim>(key.value, use));
  }

  template <int dim>
  std::vector<std::string>
  ShapeParameters<dim>::kinds() const
  {
    std::vector<std::string> names;
    for (const Kind &kind : all_kinds())
      if (is_here<dim>(kind.flags, use) && kind.name != rim)
        names.push_back(kind.name);
    return names;
  }

  template <int dim>
  std::string
  ShapeParameters<dim>::kind() const
  {
    const bool is_rim =
      use == ShapeUse::surface && (given("Body") || given("Part"));
    return is_rim ? rim : text(kind_key(use));
  }

  template <int dim>
  bool
  ShapeParameters<dim>::is_point_file() const
  {
    return kind() == "points-from-file";
  }

  template <int dim>
  bool
  ShapeParameters<dim>::given(const std::string &key) const
  {
    for (const Key &known : all_keys())
      if (known.name == key && is_here<dim>(known.flags, use))
        {
          const std::string usual = default_of(known.value, use);
          return text(key) != usual &&
                 (usual != "0" || Utilities::string_to_double(text(key)) != 0.);
        }
    return false;
  }

  template <int dim>
  void
  ShapeParameters<dim>::check_keys(const std::string &section) const
  {
    const std::string name = kind(), of = kind_key(use);
    const auto        found =
      std::find_if(all_kinds().begin(), all_kinds().end(), [&](const Kind &k) {
        return k.name == name && is_here<dim>(k.flags, use);
      });
    if (found == all_kinds().end())
      throw InputError(place(section, of) + ": found '" + name +
                       "', not known in " + std::to_string(dim) + "D" +
                       suggest(name, kinds()));
    const auto here = [&](std::vector<std::string> keys) {
      keys.erase(std::remove_if(keys.begin(),
                                keys.end(),
                                [&](const auto &key) {
                                  return texts.count(key) == 0;
                                }),
                 keys.end());
      return keys;
    };
    const auto needs = here(found->needs), may_have = here(found->may_have);
    const std::string what =
      std::string(use == ShapeUse::body ? "shape" : "surface") + " '" + name +
      "'";
    for (const Key &key : all_keys())
      {
        if (!is_here<dim>(key.flags, use))
          continue;
        const bool is_given = given(key.name);
        if (!is_given && has(needs, key.name))
          throw InputError(
            place(section, key.name) + ": not set" +
            (default_of(key.value, use).empty() ? "" : ", or zero") + ". The " +
            what + " needs: " + list_of(needs));
        const bool places =
          key.name == "Translation" || key.name.rfind("Rotation", 0) == 0;
        if (is_given && !places && !has(needs, key.name) &&
            !has(may_have, key.name))
          throw InputError(
            place(section, key.name) + ": set, but the " + what +
            " does not use it. It uses: " + list_of(needs) +
            (may_have.empty() ? "" : " and, if wanted, " + list_of(may_have)));
      }
    if (name == rim && text(of) != default_kind(use, dim))
      reject(section, of, text(of), "nothing, a " + rim + " is no other kind");
  }

  template <int dim>
  double
  ShapeParameters<dim>::number(const std::string &key,
                               const std::string &section) const
  {
    return numbers_in(text(key), 1, section, key, "one number")[0];
  }

  template <int dim>
  Point<dim>
  ShapeParameters<dim>::point(const std::string &key,
                              const std::string &section) const
  {
    return point_in<dim>(text(key),
                         section,
                         key,
                         std::to_string(dim) + " numbers");
  }

  template <int dim>
  template <int n>
  std::vector<Point<n>>
  ShapeParameters<dim>::points(const std::string &key,
                               const std::string &section) const
  {
    std::vector<Point<n>> result;
    for (const auto &part : Utilities::split_string_list(text(key), ';'))
      if (!part.empty())
        result.push_back(point_in<n>(
          part, section, key, std::to_string(n) + " numbers for each point"));
    return result;
  }

  template <int dim>
  std::vector<std::string>
  ShapeParameters<dim>::words(const std::string &key) const
  {
    return Utilities::split_string_list(text(key), ',');
  }

  template struct ShapeParameters<2>;
  template struct ShapeParameters<3>;
  template std::vector<Point<2>>
  ShapeParameters<2>::points<2>(const std::string &, const std::string &) const;
  template std::vector<Point<2>>
  ShapeParameters<3>::points<2>(const std::string &, const std::string &) const;
  template std::vector<Point<3>>
  ShapeParameters<3>::points<3>(const std::string &, const std::string &) const;
} // namespace moraine
