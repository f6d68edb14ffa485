// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/geometry/surface_library.h>

#include <moraine/core/exceptions.h>
#include <moraine/core/nearest.h>
#include <moraine/core/patterns.h>

#include <moraine/geometry/curved_shapes.h>
#include <moraine/geometry/curved_surfaces.h>
#include <moraine/geometry/straight_shapes.h>
#include <moraine/geometry/straight_surfaces.h>

#include <deal.II/base/patterns.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** The keys a kind of surface uses; those it cannot do without first. */
    struct Kind
    {
      std::vector<std::string> needed, optional;
    };

    const std::string rim = "rim of a body";

    template <int dim>
    const std::map<std::string, Kind> &
    kinds()
    {
      static const std::map<std::string, Kind> result = [] {
        std::map<std::string, Kind> all{
          {"plane", {{"Point", "Normal"}, {"Flip"}}},
          {"expression",
           {{"Expression"}, {"Extent lower corner", "Extent upper corner"}}}};
        if (dim == 2)
          all.insert(
            {{"polyline", {{"Points"}, {"Flip"}}},
             {"circle", {{"Centre", "Radius", "Body side"}, {}}},
             {"arc",
              {{"Centre", "Radius", "Start angle", "End angle", "Body side"},
               {}}}});
        else
          all.insert(
            {{"plane patch", {{"Points"}, {"Flip"}}},
             {"sphere", {{"Centre", "Radius", "Body side"}, {}}},
             {"cylinder",
              {{"Axis start", "Axis end", "Radius", "Body side"}, {}}}});
        return all;
      }();
      return result;
    }

    template <int dim>
    std::string
    kind_names()
    {
      std::string names;
      for (const auto &kind : kinds<dim>())
        names += (names.empty() ? "" : "|") + kind.first;
      return names;
    }

    constexpr const char *
    default_kind(const int dim)
    {
      return dim == 2 ? "polyline" : "plane patch";
    }

    /** Makes one surface, with errors that name section and key. */
    template <int dim>
    class SurfaceMaker
    {
    public:
      SurfaceMaker(const SurfaceParameters<dim> &parameters,
                   const NamedShapes<dim>       &bodies,
                   const std::string            &section)
        : texts(parameters.texts)
        , bodies(bodies)
        , section(section)
        , kind(given("Body") || given("Part") ? rim : texts.at("Surface"))
      {}

      std::shared_ptr<const Surface<dim>>
      make() const
      {
        check_keys();
        if (kind == rim)
          return rim_of_body();
        const bool flip = texts.at("Flip") == "true";
        if (kind == "plane")
          return make_plane((flip ? -1. : 1.) * point("Normal"));
        if (kind == "expression")
          return make_expression();
        if constexpr (dim == 2)
          {
            if (kind == "polyline")
              return std::make_shared<Polyline>(points(), flip);
            const bool is_arc = kind == "arc";
            return std::make_shared<Arc>(point("Centre"),
                                         radius(),
                                         body_inside(),
                                         is_arc ? number("Start angle") : 0.,
                                         is_arc ? number("End angle") : 360.);
          }
        else if (kind == "plane patch")
          return std::make_shared<PlanePatch>(points(), flip);
        typename Shape<dim>::Faces faces;
        if constexpr (dim == 3)
          {
            if (kind == "sphere")
              RoundShape<3>(point("Centre"), radius())
                .add_faces("", body_inside(), {}, faces);
            else
              CylinderShape(point("Axis start"), point("Axis end"), radius())
                .add_faces("side", body_inside(), {}, faces);
          }
        return faces[0];
      }

    private:
      [[noreturn]] void
      refuse(const std::string &key,
             const std::string &found,
             const std::string &allowed) const
      {
        throw InputError(place(section, key) + ": found " + found +
                         ", allowed: " + allowed);
      }

      bool
      given(const std::string &key) const
      {
        return !texts.at(key).empty();
      }

      /** Every needed key is there and no key that means nothing here. */
      void
      check_keys() const
      {
        if (kind != rim && kinds<dim>().count(kind) == 0)
          reject(section,
                 "Surface",
                 kind,
                 std::to_string(dim) + "D surfaces " + kind_names<dim>());
        const Kind &keys =
          kind == rim ? Kind{{"Body"}, {"Part"}} : kinds<dim>().at(kind);
        const auto has = [](const std::vector<std::string> &list,
                            const std::string              &key) {
          return std::find(list.begin(), list.end(), key) != list.end();
        };
        for (const auto &key : keys.needed)
          if (!given(key))
            refuse(key, "nothing", "a value, needed by a " + kind);
        for (const auto &[key, text] : texts)
          if (!has(keys.needed, key) && !has(keys.optional, key) &&
              text != (key == "Flip"    ? "false" :
                       key != "Surface" ? "" :
                       kind == rim      ? default_kind(dim) :
                                          kind))
            reject(section,
                   key,
                   text,
                   "nothing, a " + kind + " has no such entry");
      }

      std::shared_ptr<const Surface<dim>>
      rim_of_body() const
      {
        const std::string &body = texts.at("Body"), &part = texts.at("Part");
        std::vector<std::string> names;
        for (const auto &entry : bodies)
          names.push_back(entry.first);
        const auto found = bodies.find(body);
        if (found == bodies.end())
          reject(section,
                 "Body",
                 body,
                 "names of bodies" + suggest(body, names));
        const auto parts =
          found->second ? found->second->parts() : std::vector<std::string>();
        if (!part.empty() &&
            std::find(parts.begin(), parts.end(), part) == parts.end())
          reject(section,
                 "Part",
                 part,
                 parts.empty() ?
                   "nothing, the rim of '" + body + "' is one whole" :
                   "parts of the rim of '" + body + "'" + suggest(part, parts));
        const auto surface = found->second ? found->second->rim(part) : nullptr;
        if (!surface)
          reject(section,
                 "Body",
                 body,
                 "a body with a rim; points of a file and the whole mesh have "
                 "none");
        return surface;
      }

      std::shared_ptr<const Surface<dim>>
      make_plane(const Tensor<1, dim> &normal) const
      {
        if (!(normal.norm() > 0.))
          throw InputError("the normal of a plane must not be zero");
        return ConvexShape<dim>::half_space(point("Point"), normal).rim();
      }

      std::shared_ptr<const Surface<dim>>
      make_expression() const
      {
        using Along         = typename Extent<dim>::Along;
        auto [lower, upper] = unlimited_box<dim>().get_boundary_points();
        const bool below    = given("Extent lower corner"),
                   above    = given("Extent upper corner");
        if (below)
          lower = point("Extent lower corner");
        if (above)
          upper = point("Extent upper corner");
        Extent<dim> extent;
        for (unsigned int d = 0; d < dim; ++d)
          {
            if (!(lower[d] < upper[d]))
              reject(section,
                     "Extent upper corner",
                     texts.at("Extent upper corner"),
                     "above the lower corner in every direction");
            for (const double side : {-1., 1.})
              if (side < 0. ? below : above)
                extent.limits.push_back(
                  {std::make_shared<ConvexShape<dim>>(
                     ConvexShape<dim>::half_space(
                       side < 0. ? lower : upper,
                       side * Point<dim>::unit_vector(d))),
                   true,
                   Along::inner});
          }
        const double width = below && above ? upper[0] - lower[0] : 0.;
        return std::make_shared<LevelSetSurface<dim>>(
          std::make_shared<ExpressionShape<dim>>(texts.at("Expression"),
                                                 place(section, "Expression"),
                                                 width),
          true,
          extent,
          BoundingBox<dim>({lower, upper}));
      }

      std::vector<Point<dim>>
      points() const
      {
        std::vector<Point<dim>> result;
        for (const auto &part :
             Utilities::split_string_list(texts.at("Points"), ';'))
          if (!part.empty())
            result.push_back(point("Points", part));
        return result;
      }

      Point<dim>
      point(const std::string &key) const
      {
        return point(key, texts.at(key));
      }

      Point<dim>
      point(const std::string &key, const std::string &text) const
      {
        const auto values = numbers(key, text, dim);
        Point<dim> x;
        std::copy(values.begin(), values.end(), x.begin_raw());
        return x;
      }

      double
      number(const std::string &key) const
      {
        return numbers(key, texts.at(key), 1)[0];
      }

      double
      radius() const
      {
        const double value = number("Radius");
        if (!(value > 0.))
          reject(section, "Radius", texts.at("Radius"), "a number > 0");
        return value;
      }

      bool
      body_inside() const
      {
        return texts.at("Body side") == "inside";
      }

      /** Exactly @p n finite numbers, separated by commas or blanks. */
      std::vector<double>
      numbers(const std::string &key,
              const std::string &text,
              const unsigned int n) const
      {
        std::string blanks = text;
        std::replace(blanks.begin(), blanks.end(), ',', ' ');
        std::vector<double> result;
        bool                good = true;
        for (const auto &word : Utilities::break_text_into_lines(blanks, 1))
          try
            {
              result.push_back(Utilities::string_to_double(word));
              good = good && std::isfinite(result.back());
            }
          catch (const ExceptionBase &)
            {
              good = false;
            }
        if (!good || result.size() != n)
          reject(section,
                 key,
                 text,
                 n == 1 ? "one number" :
                          std::to_string(n) + " numbers for each point");
        return result;
      }

      const std::map<std::string, std::string> &texts;
      const NamedShapes<dim>                   &bodies;
      const std::string                         section;
      const std::string                         kind;
    };
  } // namespace

  template <int dim>
  void
  SurfaceParameters<dim>::add_parameters(ParameterHandler &prm)
  {
    const auto add = [&](const std::string           &key,
                         const std::string           &text,
                         const Patterns::PatternBase &pattern =
                           Patterns::Anything()) {
      prm.add_parameter(key, texts[key], text, pattern);
    };
    texts["Surface"] = default_kind(dim);
    texts["Flip"]    = "false";
    add("Body",
        "Name of a body: the surface is its rim, and no other key describes it "
        "but 'Part'.");
    add("Part",
        dim == 2 ?
          "Of 'Body', the part of its rim; all if left out. A box has left, "
          "right, bottom, top; a polygon its edges, 1 from the first vertex to "
          "the second and so on; a ring inner, outer; a union, intersection or "
          "difference the names of its operands." :
          "Of 'Body', the part of its rim; all if left out. A box has left, "
          "right, front, back, bottom, top; a polygon its edges, 1 from the "
          "first vertex to the second and so on, bottom, top; a hollow sphere "
          "inner, outer; a cylinder side, or inner and outer, and bottom and "
          "top, where its axis starts and ends; a union, intersection or "
          "difference the names of its operands.");
    add("Surface", "Kind of surface.", Patterns::Selection(kind_names<dim>()));
    add("Points",
        dim == 2 ?
          "Points x, y; x, y; ... of a polyline (length). The body is on the "
          "left when walking along them; the first point repeated at the end "
          "closes the line." :
          "Vertices x, y, z; x, y, z; ... of a plane patch (length), "
          "counter-clockwise when seen from outside the body.",
        patterns::NumberText());
    add("Flip",
        "Put the body on the other side of a polyline, plane or plane patch.",
        Patterns::Bool());
    add("Point", "A point of a plane (length).", patterns::NumberText());
    add("Normal",
        "Normal of a plane, pointing out of the body, of any length.",
        patterns::NumberText());
    add("Radius",
        "Radius of a circle, arc, sphere or cylinder (length).",
        patterns::NumberText());
    add("Body side",
        "Whether the body is inside or outside of a circle, arc, sphere or "
        "cylinder.",
        Patterns::Selection("|inside|outside"));
    add("Centre",
        "Centre of a circle, arc or sphere (length).",
        patterns::NumberText());
    add("Expression",
        "A function of x, y and z in muParser syntax, zero on the surface and "
        "positive on the body's side. It must be a number wherever there are "
        "bodies.");
    add("Extent lower corner",
        "Lower corner of the box that limits an expression (length). Empty: no "
        "limit.",
        patterns::NumberText());
    add("Extent upper corner",
        "Upper corner of the box that limits an expression (length). Empty: no "
        "limit.",
        patterns::NumberText());
    if (dim == 2)
      {
        add("Start angle",
            "Angle from the x axis where an arc starts (degrees).",
            patterns::NumberText());
        add("End angle",
            "Angle where an arc ends, counter-clockwise from its start "
            "(degrees).",
            patterns::NumberText());
      }
    else
      {
        add("Axis start",
            "Start of the axis of a cylinder (length).",
            patterns::NumberText());
        add("Axis end",
            "End of the axis of a cylinder (length).",
            patterns::NumberText());
      }
  }

  template <int dim>
  std::shared_ptr<const Surface<dim>>
  make_surface(const SurfaceParameters<dim> &parameters,
               const NamedShapes<dim>       &bodies,
               const std::string            &section)
  {
    try
      {
        return SurfaceMaker<dim>(parameters, bodies, section).make();
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

  template struct SurfaceParameters<2>;
  template struct SurfaceParameters<3>;
  template std::shared_ptr<const Surface<2>>
  make_surface<2>(const SurfaceParameters<2> &,
                  const NamedShapes<2> &,
                  const std::string &);
  template std::shared_ptr<const Surface<3>>
  make_surface<3>(const SurfaceParameters<3> &,
                  const NamedShapes<3> &,
                  const std::string &);
} // namespace moraine
