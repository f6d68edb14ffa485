// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/geometry/shape_library.h>

#include <moraine/core/exceptions.h>
#include <moraine/core/nearest.h>
#include <moraine/geometry/combined_shapes.h>
#include <moraine/geometry/curved_shapes.h>
#include <moraine/geometry/polygon.h>
#include <moraine/geometry/straight_shapes.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <sstream>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    std::string
    text(const std::vector<double> &list)
    {
      std::ostringstream out;
      out.precision(12);
      for (unsigned int i = 0; i < list.size(); ++i)
        out << (i == 0 ? "" : ", ") << list[i];
      return out.str();
    }
  } // namespace

  template <int dim>
  Point<dim>
  to_point(const std::vector<double> &list,
           const std::string         &section,
           const std::string         &key)
  {
    if (list.size() != dim)
      reject(section, key, text(list), std::to_string(dim) + " numbers");
    Point<dim> p;
    std::copy(list.begin(), list.end(), p.begin_raw());
    return p;
  }

  namespace
  {
    std::vector<Point<2>>
    to_vertices(const std::string &list, const std::string &section)
    {
      const std::string     allowed = "at least three 'x y' separated by ';'";
      std::vector<Point<2>> vertices;
      for (const auto &vertex : Utilities::split_string_list(list, ';'))
        {
          std::string spaced = vertex;
          std::replace(spaced.begin(), spaced.end(), ',', ' ');
          std::istringstream in(spaced);
          Point<2>           x;
          std::string        rest;
          if (!(in >> x[0] >> x[1]) || in >> rest || !std::isfinite(x.norm()))
            reject(section, "Vertices", vertex, allowed);
          vertices.push_back(x);
        }
      if (vertices.size() < 3)
        reject(section, "Vertices", list, allowed);
      const auto [i, j]    = first_crossing(vertices);
      const unsigned int n = vertices.size();
      if (i == n)
        return vertices;
      const auto edge = [n](const unsigned int k) {
        return std::to_string(k + 1) + "-" + std::to_string((k + 1) % n + 1);
      };
      throw InputError(
        place(section, "Vertices") + ": " +
        (i == j ?
           "vertex " + std::to_string(i + 1) + " is repeated by vertex " +
             std::to_string((i + 1) % n + 1) :
           "the edges between vertices " + edge(i) + " and " + edge(j) +
             " meet") +
        ". Allowed: a polygon that does not touch itself, without the first "
        "vertex repeated at the end");
    }

    template <int dim>
    std::shared_ptr<const Shape<dim>>
    make_polygon(const ShapeParameters<dim> &p, const std::string &section)
    {
      const auto vertices = to_vertices(p.vertices, section);
      if constexpr (dim == 3)
        {
          if (p.extent.size() != 2 || !(p.extent[0] < p.extent[1]))
            reject(section, "Extent", text(p.extent), "lower z, upper z");
          return std::make_shared<PolygonShape<3>>(vertices,
                                                   std::make_pair(p.extent[0],
                                                                  p.extent[1]));
        }
      else
        return std::make_shared<PolygonShape<2>>(vertices);
    }

    template <int dim>
    void
    check_radii(const ShapeParameters<dim> &p, const std::string &section)
    {
      if (!(p.radius > 0.))
        reject(section, "Radius", text({p.radius}), "a number > 0");
      if (!(p.inner_radius >= 0. && p.inner_radius < p.radius))
        reject(section,
               "Inner radius",
               text({p.inner_radius}),
               "from 0 to less than Radius (" + text({p.radius}) + ")");
    }

    template <int dim>
    std::shared_ptr<const Shape<dim>>
    make_ball(const ShapeParameters<dim> &p, const std::string &section)
    {
      check_radii(p, section);
      const auto centre = to_point<dim>(p.centre, section, "Centre");
      const auto outer  = std::make_shared<RoundShape<dim>>(centre, p.radius);
      if (p.inner_radius == 0.)
        return outer;
      return std::make_shared<CombinedShape<dim>>(
        CombinedShape<dim>::Operation::hollow_out,
        outer,
        std::make_shared<RoundShape<dim>>(centre, p.inner_radius),
        std::array<std::string, 2>{{"outer", "inner"}});
    }

    template <int dim>
    std::shared_ptr<const Shape<dim>>
    make_box(const ShapeParameters<dim> &p, const std::string &section)
    {
      const auto lower = to_point<dim>(p.lower_corner, section, "Lower corner");
      const auto upper = to_point<dim>(p.upper_corner, section, "Upper corner");
      for (unsigned int d = 0; d < dim; ++d)
        if (!(lower[d] < upper[d]))
          reject(section,
                 "Upper corner",
                 text(p.upper_corner),
                 "more than Lower corner (" + text(p.lower_corner) +
                   ") in each coordinate");
      return std::make_shared<ConvexShape<dim>>(
        ConvexShape<dim>::box(lower, upper));
    }

    template <int dim>
    std::shared_ptr<const Shape<dim>>
    make_cylinder(const ShapeParameters<dim> &p, const std::string &section)
    {
      const auto start = to_point<dim>(p.axis_start, section, "Axis start");
      const auto end   = to_point<dim>(p.axis_end, section, "Axis end");
      if (start == end)
        reject(section,
               "Axis end",
               text(p.axis_end),
               "another point than Axis "
               "start");
      check_radii(p, section);
      if constexpr (dim == 3)
        return std::make_shared<CylinderShape>(start,
                                               end,
                                               p.radius,
                                               p.inner_radius);
      Assert(false, ExcInternalError());
      return nullptr;
    }

    /** That an operand is in a map of bodies. */
    template <typename Bodies>
    void
    check_operand(const std::string &name,
                  const Bodies      &bodies,
                  const std::string &section)
    {
      if (bodies.count(name) > 0)
        return;
      std::vector<std::string> names;
      for (const auto &body : bodies)
        names.push_back(body.first);
      throw InputError(place(section, "Operands") + ": found '" + name +
                       "', which is not the name of a body" +
                       suggest(name, names));
    }

    template <int dim>
    std::shared_ptr<const Shape<dim>>
    combine(const ShapeParameters<dim> &p,
            const NamedShapes<dim>     &known,
            const std::string          &section)
    {
      using Operation = typename CombinedShape<dim>::Operation;
      if (p.operands.size() < 2)
        reject(section, "Operands", p.operands[0], "two or more names");
      std::vector<std::shared_ptr<const Shape<dim>>> shapes;
      for (const auto &name : p.operands)
        {
          check_operand(name, known, section);
          if (known.at(name) == nullptr)
            reject(section,
                   "Operands",
                   name,
                   "bodies with a shape; the points of this one come from a "
                   "file");
          shapes.push_back(known.at(name));
        }
      using Names = std::array<std::string, 2>;
      // a - b - c = a - (b + c); what is joined has the parts of its operands
      const unsigned int first  = p.shape == "difference" ? 1 : 0;
      auto               result = shapes[first];
      std::string        name   = p.operands[first];
      for (unsigned int i = first + 1; i < shapes.size(); ++i)
        {
          result =
            std::make_shared<CombinedShape<dim>>(p.shape == "intersection" ?
                                                   Operation::intersect :
                                                   Operation::unite,
                                                 result,
                                                 shapes[i],
                                                 Names{{name, p.operands[i]}});
          name = "";
        }
      if (first == 1)
        result = std::make_shared<CombinedShape<dim>>(
          Operation::subtract, shapes[0], result, Names{{p.operands[0], name}});
      return result;
    }

    template <int dim>
    std::shared_ptr<const Shape<dim>>
    make_unplaced(const ShapeParameters<dim> &p,
                  const NamedShapes<dim>     &known,
                  const std::string          &section)
    {
      if (p.shape == "box")
        return make_box(p, section);
      if (p.shape == "polygon")
        return make_polygon(p, section);
      if (p.shape == "disc" || p.shape == "ring" || p.shape == "sphere")
        return make_ball(p, section);
      if (p.shape == "cylinder")
        return make_cylinder(p, section);
      if (p.shape == "half-space")
        {
          const auto normal = to_point<dim>(p.normal, section, "Normal");
          if (normal.norm() == 0.)
            reject(section, "Normal", text(p.normal), "a vector that is not 0");
          return std::make_shared<ConvexShape<dim>>(
            ConvexShape<dim>::half_space(
              to_point<dim>(p.point, section, "Point"), normal));
        }
      if (p.shape == "expression")
        return std::make_shared<ExpressionShape<dim>>(p.expression,
                                                      place(section,
                                                            "Expression"));
      if (p.shape == "mesh")
        return std::make_shared<ConvexShape<dim>>(ConvexShape<dim>::space());
      return combine(p, known, section);
    }
  } // namespace

  template <int dim>
  Placement<dim>
  make_placement(const ShapeParameters<dim> &p, const std::string &section)
  {
    Point<dim>     centre;
    Tensor<1, dim> axis, translation;
    if (!p.rotation_centre.empty())
      centre = to_point<dim>(p.rotation_centre, section, "Rotation centre");
    if (!p.translation.empty())
      translation = to_point<dim>(p.translation, section, "Translation");
    if constexpr (dim == 3)
      {
        if (p.rotation_angle == 0.)
          return {0., centre, Point<3>::unit_vector(0), translation};
        if (p.rotation_axis.empty())
          throw InputError(place(section, "Rotation axis") +
                           ": not set. A rotation in 3D needs it");
        axis = to_point<dim>(p.rotation_axis, section, "Rotation axis");
        if (axis.norm() == 0.)
          reject(section,
                 "Rotation axis",
                 text(p.rotation_axis),
                 "a vector that is not 0");
      }
    return {p.rotation_angle, centre, axis, translation};
  }

  template <int dim>
  std::shared_ptr<const Shape<dim>>
  make_shape(const ShapeParameters<dim> &p,
             const NamedShapes<dim>     &known,
             const std::string          &section)
  {
    check_keys(p, section);
    const Placement<dim> placement = make_placement(p, section);
    if (p.shape == "mesh" && (p.rotation_angle != 0. || !p.translation.empty()))
      throw InputError(
        place(section,
              p.rotation_angle != 0. ? "Rotation angle" : "Translation") +
        ": set, but the shape 'mesh' is all of the mesh and cannot move in it");
    if (p.is_point_file())
      return nullptr;
    const auto shape = make_unplaced(p, known, section);
    if (p.rotation_angle == 0. && p.translation.empty())
      return shape;
    return std::make_shared<MovedShape<dim>>(shape, placement);
  }

  template <int dim>
  NamedShapes<dim>
  make_shapes(const std::map<std::string, ShapeParameters<dim>> &bodies,
              const std::string                                 &section)
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
        for (const auto &operand : bodies.at(name).operands)
          {
            check_operand(operand, bodies, here);
            make(operand, here);
          }
        made[name] = make_shape(bodies.at(name), made, here);
        under_way.erase(name);
      };
    for (const auto &body : bodies)
      make(body.first, section);
    return made;
  }

#define INSTANTIATE(dim)                                               \
  template Point<dim>     to_point(const std::vector<double> &,        \
                                   const std::string &,                \
                                   const std::string &);               \
  template Placement<dim> make_placement(const ShapeParameters<dim> &, \
                                         const std::string &);         \
  template std::shared_ptr<const Shape<dim>> make_shape(               \
    const ShapeParameters<dim> &,                                      \
    const NamedShapes<dim> &,                                          \
    const std::string &);                                              \
  template NamedShapes<dim> make_shapes(                               \
    const std::map<std::string, ShapeParameters<dim>> &, const std::string &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
