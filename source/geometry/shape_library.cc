// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/geometry/shape_library.h>

#include <moraine/core/exceptions.h>
#include <moraine/core/words.h>
#include <moraine/geometry/shapes.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** The names in a map of bodies. */
    template <typename Bodies>
    std::vector<std::string>
    names_in(const Bodies &bodies)
    {
      std::vector<std::string> names;
      for (const auto &body : bodies)
        names.push_back(body.first);
      return names;
    }



    /** That an operand is in a map of bodies. */
    template <typename Bodies>
    void
    check_operand(const std::string &name,
                  const Bodies      &bodies,
                  const std::string &section)
    {
      if (bodies.count(name) == 0)
        throw InputError(place(section, "Operands") + ": found '" + name +
                         "', which is not the name of a body" +
                         suggest(name, names_in(bodies)));
    }



    /** Makes one shape or surface. */
    template <int dim>
    class ShapeMaker
    {
    public:
      ShapeMaker(const ShapeParameters<dim> &parameters,
                 const NamedShapes<dim>     &bodies,
                 const std::string          &section)
        : p(parameters)
        , bodies(bodies)
        , section(section)
        , kind(parameters.kind())
      {
        p.check_keys(section);
      }

      ShapePointer<dim>
      shape() const
      {
        if (kind == "box")
          return box();
        if (kind == "polygon")
          return polygon();
        if (kind == "disc" || kind == "ring" || kind == "sphere" ||
            kind == "circle")
          return ball();
        if constexpr (dim == 3)
          if (kind == "cylinder")
            {
              if (point("Axis start") == point("Axis end"))
                wrong("Axis end", "another point than Axis start");
              return make_cylinder(point("Axis start"),
                                   point("Axis end"),
                                   radius("Radius"),
                                   inner_radius());
            }
        if (kind == "half-space" || kind == "plane")
          {
            if (point("Normal").norm() == 0.)
              wrong("Normal", "a vector that is not 0");
            return make_half_space<dim>(point("Point"), point("Normal"));
          }
        if (kind == "expression")
          return make_expression<dim>(p.text("Expression"),
                                      place(section, "Expression"));
        if (kind == "mesh")
          return make_space<dim>();
        return combination();
      }

      SurfacePointer<dim>
      surface() const
      {
        if (p.given("Body") || p.given("Part"))
          return rim_of_body();
        const bool flip    = p.text("Flip") == "true";
        const bool outside = p.text("Body side") == "outside";
        if (kind == "polyline" || kind == "plane patch")
          return make_flat_face<dim>(p.template points<dim>("Points", section),
                                     flip);
        if constexpr (dim == 2)
          if (kind == "arc")
            return make_arc(point("Centre"),
                            radius("Radius"),
                            !outside,
                            p.number("Start angle", section),
                            p.number("End angle", section));
        return shape()->rim(kind == "cylinder" ? "side" : "",
                            !flip && !outside,
                            extent());
      }

    private:
      [[noreturn]] void
      wrong(const std::string &key, const std::string &allowed) const
      {
        reject(section, key, p.text(key), allowed);
      }

      Point<dim>
      point(const std::string &key) const
      {
        return p.point(key, section);
      }

      double
      radius(const std::string &key) const
      {
        const double value = p.number(key, section);
        if (!(value > 0.))
          wrong(key, "a number > 0");
        return value;
      }

      /** Zero if there is none. */
      double
      inner_radius() const
      {
        if (!p.given("Inner radius"))
          return 0.;
        const double value = p.number("Inner radius", section);
        if (!(value >= 0. && value < radius("Radius")))
          wrong("Inner radius",
                "from 0 to less than Radius (" + p.text("Radius") + ")");
        return value;
      }

      ShapePointer<dim>
      box() const
      {
        const Point<dim> lower = point("Lower corner"),
                         upper = point("Upper corner");
        for (unsigned int d = 0; d < dim; ++d)
          if (!(lower[d] < upper[d]))
            wrong("Upper corner",
                  "more than Lower corner (" + p.text("Lower corner") +
                    ") in each coordinate");
        return make_box(lower, upper);
      }

      ShapePointer<dim>
      polygon() const
      {
        const auto vertices = p.template points<2>("Vertices", section);
        if (vertices.size() < 3)
          wrong("Vertices", "at least three 'x y' separated by ';'");
        const auto [i, j]       = first_crossing(vertices);
        const unsigned int n    = vertices.size();
        const auto         edge = [n](const unsigned int k) {
          return std::to_string(k + 1) + "-" + std::to_string((k + 1) % n + 1);
        };
        if (i < n)
          throw InputError(
            place(section, "Vertices") + ": " +
            (i == j ?
               "vertex " + std::to_string(i + 1) + " is repeated by vertex " +
                 std::to_string((i + 1) % n + 1) :
               "the edges between vertices " + edge(i) + " and " + edge(j) +
                 " meet") +
            ". Allowed: a polygon that does not touch itself, without the "
            "first vertex repeated at the end");
        if (dim == 2)
          return make_polygon<dim>(vertices);
        const auto heights = p.template points<2>("Extent", section);
        if (heights.size() != 1 || !(heights[0][0] < heights[0][1]))
          wrong("Extent", "lower z, upper z");
        return make_polygon<dim>(vertices, {heights[0][0], heights[0][1]});
      }

      ShapePointer<dim>
      ball() const
      {
        const auto outer = make_ball<dim>(point("Centre"), radius("Radius"));
        if (inner_radius() == 0.)
          return outer;
        return combine<dim>(Operation::hollow_out,
                            outer,
                            make_ball<dim>(point("Centre"), inner_radius()),
                            {{"outer", "inner"}});
      }

      ShapePointer<dim>
      combination() const
      {
        const std::vector<std::string> names = p.words("Operands");
        if (names.size() < 2)
          wrong("Operands", "two or more names");
        for (const auto &name : names)
          {
            check_operand(name, bodies, section);
            if (bodies.at(name) == nullptr)
              reject(section,
                     "Operands",
                     name,
                     "bodies with a shape; the points of this one come from a "
                     "file");
          }
        // a - b - c = a - (b + c); what is joined has the parts of its operands
        const unsigned int first  = kind == "difference" ? 1 : 0;
        auto               result = bodies.at(names[first]);
        std::string        name   = names[first];
        for (unsigned int i = first + 1; i < names.size(); ++i)
          {
            result =
              combine<dim>(kind == "intersection" ? Operation::intersect :
                                                    Operation::unite,
                           result,
                           bodies.at(names[i]),
                           {{name, names[i]}});
            name = "";
          }
        if (first == 0)
          return result;
        return combine<dim>(Operation::subtract,
                            bodies.at(names[0]),
                            result,
                            {{names[0], name}});
      }

      SurfacePointer<dim>
      rim_of_body() const
      {
        const std::string &body = p.text("Body"), &part = p.text("Part");
        const auto         found = bodies.find(body);
        if (found == bodies.end())
          wrong("Body", "names of bodies" + suggest(body, names_in(bodies)));
        const auto parts =
          found->second ? found->second->parts() : std::vector<std::string>();
        if (!part.empty() &&
            std::find(parts.begin(), parts.end(), part) == parts.end())
          wrong("Part",
                parts.empty() ?
                  "nothing, the rim of '" + body + "' is one whole" :
                  "parts of the rim of '" + body + "'" + suggest(part, parts));
        const auto surface = found->second ? found->second->rim(part) : nullptr;
        if (!surface)
          wrong("Body",
                "a body with a rim; points of a file and cells of the mesh "
                "have none");
        return surface;
      }

      /** The one the user gives to the surface of an expression. */
      Extent<dim>
      extent() const
      {
        Extent<dim> extent;
        auto        corners = extent.box.get_boundary_points();
        for (const bool upper : {false, true})
          {
            const std::string key =
              upper ? "Extent upper corner" : "Extent lower corner";
            if (!p.given(key))
              continue;
            (upper ? corners.second : corners.first) = point(key);
            for (unsigned int d = 0; d < dim; ++d)
              extent.limits.push_back(
                {make_half_space<dim>(
                   point(key), (upper ? 1. : -1.) * Point<dim>::unit_vector(d)),
                 true,
                 Extent<dim>::Along::inner});
          }
        for (unsigned int d = 0; d < dim; ++d)
          if (!(corners.first[d] < corners.second[d]))
            wrong("Extent upper corner",
                  "above the lower corner in every direction");
        extent.box = BoundingBox<dim>(corners);
        return extent;
      }

      const ShapeParameters<dim> &p;
      const NamedShapes<dim>     &bodies;
      const std::string          &section;
      const std::string           kind;
    };
  } // namespace



  template <int dim>
  Placement<dim>
  make_placement(const ShapeParameters<dim> &p, const std::string &section)
  {
    const auto given_or_zero = [&](const std::string &key) {
      return p.given(key) ? p.point(key, section) : Point<dim>();
    };
    const Point<dim>     centre      = given_or_zero("Rotation centre");
    const Tensor<1, dim> translation = given_or_zero("Translation");
    Tensor<1, dim>       axis        = Point<dim>::unit_vector(0);
    if (dim == 3 && p.given("Rotation angle"))
      {
        if (!p.given("Rotation axis"))
          throw InputError(place(section, "Rotation axis") +
                           ": not set. A rotation in 3D needs it");
        axis = p.point("Rotation axis", section);
        if (axis.norm() == 0.)
          reject(section,
                 "Rotation axis",
                 p.text("Rotation axis"),
                 "a vector that is not 0");
      }
    return {p.number("Rotation angle", section), centre, axis, translation};
  }



  template <int dim>
  ShapePointer<dim>
  make_shape(const ShapeParameters<dim> &p,
             const NamedShapes<dim>     &known,
             const std::string          &section,
             const ShapeOfGroups<dim>   &of_groups)
  {
    const ShapeMaker<dim> maker(p, known, section);
    const Placement<dim>  placement = make_placement(p, section);
    const bool            turns     = p.given("Rotation angle"),
               moves                = p.given("Translation");
    const auto refuse_placement     = [&](const std::string &why) {
      if (turns || moves)
        throw InputError(
          place(section, turns ? "Rotation angle" : "Translation") +
          ": set, but the " + why);
    };
    if (p.kind() == "mesh")
      refuse_placement(
        "shape 'mesh' is cells of the mesh and cannot move in it");
    if (p.is_point_file())
      {
        refuse_placement("points are where 'Point file' says");
        return nullptr;
      }
    if (p.given("Group"))
      return of_groups(p.words("Group"), section);
    const auto shape = maker.shape();
    return turns || moves ? make_moved(shape, placement) : shape;
  }



  template <int dim>
  NamedShapes<dim>
  make_shapes(const std::map<std::string, ShapeParameters<dim>> &bodies,
              const std::string                                 &section,
              const ShapeOfGroups<dim>                          &of_groups)
  {
    NamedShapes<dim>      made;
    std::set<std::string> under_way;
    // in the order their operands ask for
    const std::function<void(const std::string &, const std::string &)> make =
      [&](const std::string &name, const std::string &asked_in) {
        if (made.count(name) > 0)
          return;
        if (!under_way.insert(name).second)
          reject(asked_in,
                 "Operands",
                 name,
                 "bodies that are not themselves made from this one");
        const std::string here = section + "/" + name;
        for (const auto &operand : bodies.at(name).words("Operands"))
          {
            check_operand(operand, bodies, here);
            make(operand, here);
          }
        made[name] = make_shape(bodies.at(name), made, here, of_groups);
        under_way.erase(name);
      };
    for (const auto &body : bodies)
      make(body.first, section);
    return made;
  }



  template <int dim>
  SurfacePointer<dim>
  make_surface(const ShapeParameters<dim> &parameters,
               const NamedShapes<dim>     &bodies,
               const std::string          &section)
  {
    try
      {
        return ShapeMaker<dim>(parameters, bodies, section).surface();
      }
    catch (const InputError &error)
      {
        // the surfaces themselves do not know the section
        const std::string message = error.what();
        if (message.rfind("section '", 0) == 0)
          throw;
        throw InputError("section '" + section + "', " + message);
      }
  }



#define INSTANTIATE(dim)                                      \
  template decltype(make_placement<dim>) make_placement<dim>; \
  template decltype(make_shape<dim>)     make_shape<dim>;     \
  template decltype(make_shapes<dim>)    make_shapes<dim>;    \
  template decltype(make_surface<dim>)   make_surface<dim>;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
