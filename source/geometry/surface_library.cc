// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/geometry/surface_library.h>

#include <moraine/geometry/arc.h>
#include <moraine/geometry/curved_surfaces.h>
#include <moraine/geometry/straight_surfaces.h>
#include <moraine/core/exceptions.h>

#include <deal.II/base/patterns.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** Each kind with the keys it uses; those it cannot do without come first.
     */
    struct Kind
    {
      std::vector<std::string> needed, optional;
    };

    template <int dim>
    const std::map<std::string, Kind> &
    kinds()
    {
      static const std::map<std::string, Kind> result =
        dim == 2 ?
          std::map<std::string, Kind>{
            {"polyline", {{"Points"}, {"Flip"}}},
            {"circle", {{"Centre", "Radius", "Body side"}, {}}},
            {"arc",
             {{"Centre", "Radius", "Start angle", "End angle", "Body side"},
              {}}},
            {"plane", {{"Point", "Normal"}, {"Flip"}}},
            {"expression",
             {{"Expression"},
              {"Extent lower corner", "Extent upper corner"}}}} :
          std::map<std::string, Kind>{
            {"plane patch", {{"Points"}, {"Flip"}}},
            {"plane", {{"Point", "Normal"}, {"Flip"}}},
            {"sphere", {{"Centre", "Radius", "Body side"}, {}}},
            {"cylinder",
             {{"Axis start", "Axis end", "Radius", "Body side"}, {}}},
            {"expression",
             {{"Expression"}, {"Extent lower corner", "Extent upper corner"}}}};
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

    /** The keys the user gave, with errors that name section and key. */
    template <int dim>
    class Entries
    {
    public:
      Entries(const SurfaceParameters<dim> &p, const std::string &section)
        : section(section)
        , kind(p.surface)
        , texts{{"Points", p.points},
                {"Centre", p.centre},
                {"Radius", p.radius},
                {"Start angle", p.start_angle},
                {"End angle", p.end_angle},
                {"Point", p.point},
                {"Normal", p.normal},
                {"Axis start", p.axis_start},
                {"Axis end", p.axis_end},
                {"Body side", p.body_side},
                {"Expression", p.expression},
                {"Extent lower corner", p.lower_corner},
                {"Extent upper corner", p.upper_corner},
                {"Flip", p.flip ? "true" : ""}}
      {}

      [[noreturn]] void
      reject(const std::string &key,
             const std::string &found,
             const std::string &allowed) const
      {
        throw InputError("section '" + section + "', key '" + key +
                         "': found " + found + ", allowed: " + allowed);
      }

      /** Every needed key is there and no key that means nothing here. */
      void
      check_keys() const
      {
        const auto found = kinds<dim>().find(kind);
        if (found == kinds<dim>().end())
          reject("Surface",
                 "'" + kind + "'",
                 Utilities::int_to_string(dim) + "D surfaces " +
                   kind_names<dim>());
        const auto &needed   = found->second.needed;
        const auto &optional = found->second.optional;
        for (const auto &key : needed)
          if (!given(key))
            reject(key, "nothing", "a value, needed by a " + kind);
        for (const auto &entry : texts)
          if (!entry.second.empty() &&
              std::find(needed.begin(), needed.end(), entry.first) ==
                needed.end() &&
              std::find(optional.begin(), optional.end(), entry.first) ==
                optional.end())
            reject(entry.first,
                   "'" + entry.second + "'",
                   "nothing, a " + kind + " has no such entry");
      }

      bool
      given(const std::string &key) const
      {
        return !texts.at(key).empty();
      }

      const std::string &
      text(const std::string &key) const
      {
        return texts.at(key);
      }

      double
      number(const std::string &key) const
      {
        return numbers(key, texts.at(key), 1)[0];
      }

      double
      positive_number(const std::string &key) const
      {
        const double value = number(key);
        if (!(value > 0.))
          reject(key, "'" + texts.at(key) + "'", "a number > 0");
        return value;
      }

      Point<dim>
      place(const std::string &key) const
      {
        return place(key, texts.at(key));
      }

      std::vector<Point<dim>>
      places(const std::string &key) const
      {
        std::vector<Point<dim>> result;
        for (const auto &part :
             Utilities::split_string_list(texts.at(key), ';'))
          if (!part.empty())
            result.push_back(place(key, part));
        return result;
      }

      bool
      body_inside() const
      {
        const auto &side = texts.at("Body side");
        if (side != "inside" && side != "outside")
          reject("Body side", "'" + side + "'", "inside|outside");
        return side == "inside";
      }

    private:
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
          reject(key,
                 "'" + text + "'",
                 n == 1 ?
                   "one number" :
                   Utilities::int_to_string(n) + " numbers for each point");
        return result;
      }

      Point<dim>
      place(const std::string &key, const std::string &text) const
      {
        const auto values = numbers(key, text, dim);
        Point<dim> x;
        for (unsigned int d = 0; d < dim; ++d)
          x[d] = values[d];
        return x;
      }

      std::string                        section, kind;
      std::map<std::string, std::string> texts;
    };

    template <int dim>
    BoundingBox<dim>
    extent(const Entries<dim> &entries)
    {
      auto [lower, upper] = unlimited_box<dim>().get_boundary_points();
      if (entries.given("Extent lower corner"))
        lower = entries.place("Extent lower corner");
      if (entries.given("Extent upper corner"))
        upper = entries.place("Extent upper corner");
      for (unsigned int d = 0; d < dim; ++d)
        if (!(lower[d] < upper[d]))
          entries.reject("Extent upper corner",
                         "'" + entries.text("Extent upper corner") + "'",
                         "above the lower corner in every direction");
      return BoundingBox<dim>({lower, upper});
    }

    template <int dim>
    std::unique_ptr<Surface<dim>>
    make(const SurfaceParameters<dim> &parameters,
         const std::string            &section,
         const Entries<dim>           &entries)
    {
      const std::string &kind = parameters.surface;
      const bool         flip = parameters.flip;
      if (kind == "plane")
        return std::make_unique<Plane<dim>>(entries.place("Point"),
                                            (flip ? -1. : 1.) *
                                              entries.place("Normal"));
      if (kind == "expression")
        return std::make_unique<ExpressionSurface<dim>>(
          entries.text("Expression"),
          moraine::place(section, "Expression"),
          extent<dim>(entries));
      if constexpr (dim == 2)
        {
          if (kind == "polyline")
            return std::make_unique<Polyline>(entries.places("Points"), flip);
          const bool is_arc = kind == "arc";
          return std::make_unique<Arc>(entries.place("Centre"),
                                       entries.positive_number("Radius"),
                                       entries.body_inside(),
                                       is_arc ? entries.number("Start angle") :
                                                0.,
                                       is_arc ? entries.number("End angle") :
                                                360.);
        }
      else
        {
          if (kind == "plane patch")
            return std::make_unique<PlanePatch>(entries.places("Points"), flip);
          if (kind == "sphere")
            return std::make_unique<Sphere>(entries.place("Centre"),
                                            entries.positive_number("Radius"),
                                            entries.body_inside());
          return std::make_unique<Cylinder>(entries.place("Axis start"),
                                            entries.place("Axis end"),
                                            entries.positive_number("Radius"),
                                            entries.body_inside());
        }
    }
  } // namespace

  template <int dim>
  void
  SurfaceParameters<dim>::add_parameters(ParameterHandler &prm)
  {
    prm.add_parameter("Surface",
                      surface,
                      "Kind of surface.",
                      Patterns::Selection(kind_names<dim>()));
    prm.add_parameter("Points",
                      points,
                      dim == 2 ?
                        "Points x, y; x, y; ... of a polyline (length). The "
                        "body is on the left when walking along them; the "
                        "first point repeated at the end closes the line." :
                        "Vertices x, y, z; x, y, z; ... of a plane patch "
                        "(length), counter-clockwise when seen from outside "
                        "the body.");
    prm.add_parameter("Flip",
                      flip,
                      "Put the body on the other side of a polyline, plane or "
                      "plane patch.");
    prm.add_parameter("Point", point, "A point of a plane (length).");
    prm.add_parameter("Normal",
                      normal,
                      "Normal of a plane, pointing out of the body, of any "
                      "length.");
    prm.add_parameter("Radius",
                      radius,
                      "Radius of a circle, arc, sphere or cylinder (length).");
    prm.add_parameter("Body side",
                      body_side,
                      "Whether the body is inside or outside of a circle, arc, "
                      "sphere or cylinder.",
                      Patterns::Selection("|inside|outside"));
    prm.add_parameter("Centre",
                      centre,
                      "Centre of a circle, arc or sphere (length).");
    prm.add_parameter("Expression",
                      expression,
                      "A function of x, y and z in muParser syntax, zero on "
                      "the surface and positive on the body's side. It must be "
                      "a number wherever there are bodies.");
    prm.add_parameter("Extent lower corner",
                      lower_corner,
                      "Lower corner of the box that limits an expression "
                      "(length). Empty: no limit.");
    prm.add_parameter("Extent upper corner",
                      upper_corner,
                      "Upper corner of the box that limits an expression "
                      "(length). Empty: no limit.");
    if (dim == 2)
      {
        prm.add_parameter("Start angle",
                          start_angle,
                          "Angle from the x axis where an arc starts "
                          "(degrees).");
        prm.add_parameter("End angle",
                          end_angle,
                          "Angle where an arc ends, counter-clockwise from its "
                          "start (degrees).");
      }
    else
      {
        prm.add_parameter("Axis start",
                          axis_start,
                          "Start of the axis of a cylinder (length).");
        prm.add_parameter("Axis end",
                          axis_end,
                          "End of the axis of a cylinder (length).");
      }
  }

  template <int dim>
  std::unique_ptr<Surface<dim>>
  make_surface(const SurfaceParameters<dim> &parameters,
               const std::string            &section)
  {
    const Entries<dim> entries(parameters, section);
    entries.check_keys();
    try
      {
        return make<dim>(parameters, section, entries);
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
  template std::unique_ptr<Surface<2>>
  make_surface<2>(const SurfaceParameters<2> &, const std::string &);
  template std::unique_ptr<Surface<3>>
  make_surface<3>(const SurfaceParameters<3> &, const std::string &);
} // namespace moraine
