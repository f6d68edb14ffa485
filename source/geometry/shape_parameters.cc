// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/geometry/shape_library.h>

#include <moraine/core/exceptions.h>
#include <moraine/core/patterns.h>
#include <moraine/core/words.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <memory>
#include <sstream>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /**
     * All kinds of bodies and surfaces: uses (b, s) and dimensions, name,
     * description, keys they need, keys they may have. Keys that are not there
     * for a use or dimension do not count.
     */
    const char *const kind_table = R"(
  s 23 | rim of a body | | Body | Part
b   23 | box | between two corners | Lower corner, Upper corner |
b   23 | polygon | a polygon in the x-y plane; in 3D the prism over it | Vertices, Extent |
b   2  | disc | (2D) | Centre, Radius |
  s 2  | polyline | straight segments | Points | Flip
  s 2  | circle | the rim of a disc | Centre, Radius, Body side |
  s 2  | arc | a part of it | Centre, Radius, Start angle, End angle, Body side |
b   2  | ring | (2D) | Centre, Radius, Inner radius |
  s 3  | plane patch | a plane polygon | Points | Flip
b s 3  | sphere | (3D) | Centre, Radius, Body side | Inner radius
b s 3  | cylinder | (3D) solid or hollow (a surface: its side) | Axis start, Axis end, Radius, Body side | Inner radius
b   23 | half-space | all behind a plane | Point, Normal |
  s 23 | plane | without ends | Point, Normal | Flip
b s 23 | expression | where it is positive (a surface: zero) | Expression | Extent lower corner, Extent upper corner
b   23 | mesh | the cells of the mesh, or those of groups | | Group
b   23 | union | in any operand | Operands |
b   23 | intersection | in all operands | Operands |
b   23 | difference | in the first operand only | Operands |
b   23 | points-from-file | no shape: its points | Point file |)";

    /** All keys but that of the kind: uses and dimensions, name, what it holds,
     * text. */
    const char *const key_table = R"(
  s 23 | Body | text | Name of a body: the surface is its rim, and no other key describes it but 'Part'
  s 23 | Part | text | Of 'Body', the part of its rim; all if left out. A box has left, right, bottom, top, in 3D front (smallest y) and back; a polygon its edges, 1 from the first vertex to the second and so on, in 3D bottom and top; a ring or hollow sphere inner, outer; a cylinder side, or inner and outer, and bottom and top, where its axis starts and ends; a union, intersection or difference the names of its operands
b   23 | Lower corner | point | Smallest coordinates of a box [length]
b   23 | Upper corner | point | Largest coordinates of a box [length]
b   23 | Vertices | points | Corners of a polygon in order, 'x y; x y; ...' [length]. It may be non-convex but must not touch itself
b   3  | Extent | interval | Lower and upper z of the prism over a polygon [length]
  s 2  | Points | points | Points x, y; x, y; ... of a polyline [length]. The body is on the left when walking along them; the first point repeated at the end closes the line
  s 3  | Points | points | Vertices x, y, z; x, y, z; ... of a plane patch [length], counter-clockwise when seen from outside the body
b s 23 | Centre | point | Centre of a round shape [length]
b s 23 | Radius | radius | (Outer) radius of a round shape [length]
b   23 | Inner radius | radius | Radius of the hole in a round shape [length]
b s 3  | Axis start | point | Centre of one end of a cylinder [length]
b s 3  | Axis end | point | Centre of the other end of a cylinder [length]
  s 2  | Start angle | number | Angle from the x axis where an arc starts [degrees]
  s 2  | End angle | number | Angle where an arc ends, counter-clockwise from its start [degrees]
b s 23 | Point | point | A point on a plane, or on the one that bounds a half-space [length]
b s 23 | Normal | point | Normal of this plane, pointing out of the body; any length
  s 23 | Flip | flag | Put the body on the other side of a polyline, plane or plane patch
  s 23 | Body side | side | Whether the body is inside or outside of a circle, arc, sphere or cylinder
b s 23 | Expression | text | Positive inside the body; in x, y (and z), muParser syntax. A number wherever there are bodies. Details smaller than a point's share of its cell may be missed
  s 23 | Extent lower corner | point | Lower corner of the box that limits the surface of an expression [length]; no limit if left out
  s 23 | Extent upper corner | point | Upper corner of this box [length]
b   23 | Group | words | Names of physical groups of cells (gmsh) of a mesh file: those that the body fills. A group without a name is called by its number. Needed if the file has several groups; what no body names stays empty
b   23 | Operands | words | Names of the bodies that a union, intersection or difference is made from, as they are placed. These bodies are not simulated themselves
b   23 | Point file | text | CSV file with columns x, y (, z), volume and, if wanted, more; its path is seen from the folder of the scene
b   23 | Rotation angle | number | Turns the body counter-clockwise [degrees]
b   23 | Rotation centre | point | A point that the rotation leaves in place; the origin if not set [length]
b   3  | Rotation axis | point | Direction of the axis of rotation; any length
b   23 | Translation | point | Moves the body after the rotation [length])";

    /** The lines of a table for a use in a dimension. */
    std::vector<std::vector<std::string>>
    lines_of(const char *const table, const ShapeUse use, const int dim)
    {
      std::vector<std::vector<std::string>> lines;
      for (const auto &line : Utilities::split_string_list(table, '\n'))
        {
          auto cells = Utilities::split_string_list(line, '|');
          if (cells.size() > 1 &&
              cells[0].find(use == ShapeUse::body ? 'b' : 's') !=
                std::string::npos &&
              cells[0].find(std::to_string(dim)) != std::string::npos)
            lines.push_back(cells);
        }
      return lines;
    }



    struct Kind
    {
      std::string              name, description;
      std::vector<std::string> needs, may_have;
    };

    struct Key
    {
      std::string name, holds, text;

      /** What it says if it is left out. */
      std::string usual;
    };



    /** What there is for a use in a dimension. */
    struct Tables
    {
      Tables(const ShapeUse use, const int dim)
      {
        for (const auto &line : lines_of(key_table, use, dim))
          {
            const bool zero = use == ShapeUse::body &&
                              (line[2] == "radius" || line[2] == "number");
            keys.push_back({line[1],
                            line[2],
                            line[3],
                            line[2] == "flag" ? "false" : (zero ? "0" : "")});
          }
        for (auto &line : lines_of(kind_table, use, dim))
          {
            line.resize(5);
            kinds.push_back(
              {line[1], line[2], known_in(line[3]), known_in(line[4])});
          }
      }

      std::vector<Kind> kinds;
      std::vector<Key>  keys;

    private:
      std::vector<std::string>
      known_in(const std::string &list) const
      {
        std::vector<std::string> result;
        for (const auto &name : Utilities::split_string_list(list, ','))
          for (const Key &key : keys)
            if (key.name == name)
              result.push_back(name);
        return result;
      }
    };



    template <int dim>
    const Tables &
    tables(const ShapeUse use)
    {
      static const Tables bodies(ShapeUse::body, dim),
        surfaces(ShapeUse::surface, dim);
      return use == ShapeUse::body ? bodies : surfaces;
    }

    const std::string rim = "rim of a body";

    /** Bodies have lists with commas; surfaces blanks or commas. */
    std::unique_ptr<Patterns::PatternBase>
    pattern_of(const std::string &holds, const ShapeUse use, const int dim)
    {
      const bool numeric =
        holds == "radius" || holds == "number" || holds == "point";
      if (holds == "points" || (numeric && use == ShapeUse::surface))
        return patterns::NumberText().clone();
      if (holds == "radius")
        return patterns::non_negative().clone();
      if (holds == "number")
        return patterns::number().clone();
      if (holds == "point" || holds == "interval")
        return patterns::numbers(0, holds == "point" ? dim : 2).clone();
      if (holds == "words")
        return Patterns::List(Patterns::Anything()).clone();
      if (holds == "flag")
        return Patterns::Bool().clone();
      if (holds == "side")
        return Patterns::Selection("|inside|outside").clone();
      return Patterns::Anything().clone();
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



    /** Finite numbers separated by commas or blanks. */
    template <int n>
    Point<n>
    point_in(std::string        text,
             const std::string &section,
             const std::string &key,
             const std::string &allowed)
    {
      const std::string found = text;
      std::replace(text.begin(), text.end(), ',', ' ');
      std::istringstream stream(text);
      Point<n>           x;
      for (unsigned int d = 0; d < n; ++d)
        stream >> x[d];
      if (stream.fail() || !(stream >> std::ws).eof())
        reject(section, key, found, allowed);
      return x;
    }
  } // namespace



  template <int dim>
  ShapeParameters<dim>::ShapeParameters(const ShapeUse use)
    : use(use)
  {
    texts[kind_key(use)] = default_kind(use, dim);
    for (const Key &key : tables<dim>(use).keys)
      texts[key.name] = key.usual;
  }



  template <int dim>
  void
  ShapeParameters<dim>::add_parameters(ParameterHandler &prm)
  {
    std::string text =
      use == ShapeUse::body ? "The region the body fills:" : "Kind of surface:";
    for (const Kind &kind : tables<dim>(use).kinds)
      if (kind.name != rim)
        text += " " + kind.name + " = " + kind.description + ";";
    text.back() = '.';
    prm.add_parameter(kind_key(use),
                      texts[kind_key(use)],
                      text,
                      patterns::selection(kinds()));
    for (const Key &key : tables<dim>(use).keys)
      prm.add_parameter(key.name,
                        texts[key.name],
                        key.text,
                        *pattern_of(key.holds, use, dim));
  }



  template <int dim>
  std::vector<std::string>
  ShapeParameters<dim>::kinds() const
  {
    std::vector<std::string> names;
    for (const Kind &kind : tables<dim>(use).kinds)
      if (kind.name != rim)
        names.push_back(kind.name);
    return names;
  }



  template <int dim>
  std::string
  ShapeParameters<dim>::kind() const
  {
    return given("Body") || given("Part") ? rim : text(kind_key(use));
  }



  template <int dim>
  bool
  ShapeParameters<dim>::given(const std::string &name) const
  {
    for (const Key &key : tables<dim>(use).keys)
      if (key.name == name)
        return text(name) != key.usual &&
               (key.usual != "0" ||
                Utilities::string_to_double(text(name)) != 0.);
    return false;
  }



  template <int dim>
  void
  ShapeParameters<dim>::check_keys(const std::string &section) const
  {
    const std::string name = kind(), of = kind_key(use);
    const auto       &known = tables<dim>(use).kinds;
    const auto        found =
      std::find_if(known.begin(), known.end(), [&](const Kind &k) {
        return k.name == name;
      });
    if (found == known.end())
      throw InputError(place(section, of) + ": found '" + name +
                       "', not known in " + std::to_string(dim) + "D" +
                       suggest(name, kinds()));
    const auto       &needs = found->needs, &may_have = found->may_have;
    const std::string what =
      (use == ShapeUse::body ? "shape '" : "surface '") + name + "'";
    for (const Key &key : tables<dim>(use).keys)
      {
        const bool is_given  = given(key.name),
                   is_needed = contains(needs, key.name);
        if (!is_given && is_needed)
          throw InputError(place(section, key.name) + ": not set" +
                           (key.usual.empty() ? "" : ", or zero") + ". The " +
                           what + " needs: " + list_of(needs));
        const bool places =
          key.name == "Translation" || key.name.rfind("Rotation", 0) == 0;
        if (is_given && !places && !is_needed && !contains(may_have, key.name))
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
    return point_in<1>(text(key), section, key, "one number")[0];
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
