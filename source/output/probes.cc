// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/output/probes.h>

#include <moraine/core/exceptions.h>
#include <moraine/core/patterns.h>
#include <moraine/core/ranges.h>
#include <moraine/core/words.h>
#include <moraine/output/component_names.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  void
  ProbeParameters<dim>::add_parameters(ParameterHandler &prm)
  {
    prm.add_parameter("Location",
                      location,
                      "Where the probe is at the start [length].",
                      patterns::numbers(0, dim));
    prm.add_parameter(
      "Kind",
      kind,
      "'nearest point' follows the material point nearest to the location, and "
      "where that is halved ('Split domains') one half, a part of a cell away; "
      "'interpolated' follows the place itself, which the displacement of the "
      "mesh carries along (out of the cells with material: the point nearest to "
      "it there; the run says so).",
      patterns::selection({"nearest point", "interpolated"}));
    prm.add_parameter("Body",
                      body,
                      "Of 'nearest point': the body whose points it chooses "
                      "from, such as a lining that comes in a later stage. "
                      "Empty: all.",
                      Patterns::Anything());
    prm.add_parameter("Quantities",
                      quantities,
                      "What becomes columns of history.csv: displacement and "
                      "position [length], stress [stress] (of a point only); "
                      "in dynamics velocity [length/time] and acceleration "
                      "[length/time^2]; with water, of a point only, pore "
                      "pressure and total stress [stress].",
                      Patterns::List(patterns::selection({"displacement",
                                                          "position",
                                                          "stress",
                                                          "velocity",
                                                          "acceleration",
                                                          "pore pressure",
                                                          "total stress"}),
                                     1));
  }



  template <int dim>
  void
  ProbeParameters<dim>::check(const bool is_dynamic, const bool has_water) const
  {
    const std::string section = "Probes/" + name;
    const auto        wants   = [&](const std::string &quantity) {
      return std::count(quantities.begin(), quantities.end(), quantity) > 0;
    };
    if (location.size() != dim)
      throw InputError(place(section, "Location") + ": found " +
                       std::to_string(location.size()) +
                       " numbers, but a place in this scene has " +
                       std::to_string(dim));
    if (quantities.empty())
      throw InputError(place(section, "Quantities") +
                       ": found nothing; allowed are displacement, position, "
                       "stress, velocity and acceleration");
    for (const std::string &quantity : quantities)
      if (std::count(quantities.begin(), quantities.end(), quantity) > 1)
        throw InputError(place(section, "Quantities") + ": found '" + quantity +
                         "' twice, allowed: each once");
    for (const char *quantity : {"stress", "pore pressure", "total stress"})
      if (kind == "interpolated" && wants(quantity))
        throw InputError(place(section, "Quantities") + ": found '" + quantity +
                         "', but " + quantity +
                         " is known at points only; "
                         "allowed with 'Kind = interpolated' are displacement, "
                         "position, velocity and acceleration");
    for (const char *quantity : {"pore pressure", "total stress"})
      if (!has_water && wants(quantity))
        throw InputError(place(section, "Quantities") + ": found '" + quantity +
                         "' in a scene without section 'Water'; allowed are "
                         "displacement, position and stress");
    if (kind == "interpolated" && !body.empty())
      throw InputError(place(section, "Body") + ": found '" + body +
                       "', allowed with 'Kind = interpolated': nothing; it "
                       "follows its place in whatever body is there");
    for (const char *quantity : {"velocity", "acceleration"})
      if (!is_dynamic && wants(quantity))
        throw InputError(
          place(section, "Quantities") + ": found '" + quantity +
          "' in a scene without inertia; allowed are "
          "displacement, position and stress, or an 'Integrator' "
          "of section 'Time' that is not quasi-static");
  }



  template <int dim>
  bool
  Probes<dim>::Probe::follows_point() const
  {
    return parameters.kind == "nearest point" || has_left;
  }



  namespace
  {
    /** Its number; invalid if the probe names none. */
    template <int dim>
    unsigned int
    named_body(const ProbeParameters<dim>     &parameters,
               const std::vector<std::string> &body_names)
    {
      if (parameters.body.empty())
        return numbers::invalid_unsigned_int;
      const auto found =
        std::find(body_names.begin(), body_names.end(), parameters.body);
      if (found == body_names.end())
        throw InputError(place("Probes/" + parameters.name, "Body") +
                         ": found '" + parameters.body +
                         "', allowed: names of bodies" +
                         suggest(parameters.body, body_names));
      return found - body_names.begin();
    }



    /** The body of a point, known on one rank. Collective. */
    template <int dim>
    unsigned int
    body_of(const unsigned int id, const PointSet<dim> &points)
    {
      unsigned int body = numbers::invalid_unsigned_int;
      for (unsigned int p = 0; p < points.n_local(); ++p)
        if (points.id(p) == id)
          body = points.body(p);
      return Utilities::MPI::min(
        body, points.mesh().triangulation().get_communicator());
    }



    /** Whether @p body has points by now. Collective. */
    template <int dim>
    bool
    is_there(const unsigned int body, const PointSet<dim> &points)
    {
      unsigned int found = 0;
      for (unsigned int p = 0; p < points.n_local() && found == 0; ++p)
        found = points.body(p) == body;
      return Utilities::MPI::max(
               found, points.mesh().triangulation().get_communicator()) > 0;
    }



    /** The displacement of a point, known on one rank. Collective. */
    template <int dim>
    Tensor<1, dim>
    displacement_of(const unsigned int id, const PointSet<dim> &points)
    {
      Tensor<1, dim> u;
      for (unsigned int p = 0; p < points.n_local(); ++p)
        if (points.id(p) == id)
          std::copy_n(points.values(p) + points.displacement_offset(),
                      dim,
                      u.begin_raw());
      return Utilities::MPI::sum(
        u, points.mesh().triangulation().get_communicator());
    }
  } // namespace



  template <int dim>
  Probes<dim>::Probes(const std::vector<ProbeParameters<dim>> &parameters,
                      const PointSet<dim>                     &points,
                      const std::vector<std::string>          &body_names,
                      const bool moves_through_mesh)
    : cell_size(points.mesh().cell_size())
    , moves_through_mesh(moves_through_mesh)
    , v_field(points.fields().find(FieldNames<dim>::velocity))
    , a_field(points.fields().find(FieldNames<dim>::acceleration))
    , pressure_field(points.fields().find(FieldNames<dim>::pore_pressure))
  {
    for (const auto &one : parameters)
      {
        Probe probe;
        probe.parameters = one;
        std::copy(one.location.begin(),
                  one.location.end(),
                  probe.start.begin_raw());
        if (probe.follows_point())
          {
            choose_point(probe.start,
                         points,
                         named_body(one, body_names),
                         probe);
            probe.body = body_of(probe.point_id, points);
          }
        probes.push_back(std::move(probe));
      }
  }



  template <int dim>
  void
  Probes<dim>::choose_point(const Point<dim>    &place,
                            const PointSet<dim> &points,
                            const unsigned int   body,
                            Probe               &probe) const
  {
    const auto &tria         = points.mesh().triangulation();
    const auto  communicator = tria.get_communicator();

    const auto distance = [&](const unsigned int p) {
      return body == numbers::invalid_unsigned_int || points.body(p) == body ?
               points.position(p).distance(place) :
               std::numeric_limits<double>::max();
    };

    double smallest = std::numeric_limits<double>::max();
    for (unsigned int p = 0; p < points.n_local(); ++p)
      smallest = std::min(smallest, distance(p));
    smallest = Utilities::MPI::min(smallest, communicator);

    probe.distance = smallest;
    // Round-off must not choose between points that are equally near.
    const double limit = smallest + points.mesh().round_off();
    unsigned int id    = numbers::invalid_unsigned_int;
    for (unsigned int p = 0; p < points.n_local(); ++p)
      if (distance(p) <= limit)
        id = std::min(id, points.id(p));
    probe.point_id = Utilities::MPI::min(id, communicator);
  }



  template <int dim>
  void
  Probes<dim>::check_places(const PlaceFunction<dim> &on_material,
                            const bool                bodies_are_away) const
  {
    for (const Probe &probe : probes)
      {
        const std::string &body = probe.parameters.body;
        const std::string  found =
          place("Probes/" + probe.parameters.name, "Location") + ": found (" +
          coordinates(probe.start) + "), ";
        if (probe.follows_point() && probe.distance > 2. * cell_size)
          throw InputError(found + "which is " + text_of(probe.distance, 4) +
                           " from the nearest point" +
                           (body.empty() ? "" : " of '" + body + "'") +
                           ", allowed: a place on or beside " +
                           (body.empty() ? "a body" : "it") +
                           ", less than two cells away");
        Tensor<1, dim> unused;
        if (!probe.follows_point() && !on_material(probe.start, unused) &&
            !bodies_are_away)
          throw InputError(found +
                           "where there is no material, allowed with 'Kind = "
                           "interpolated': a place on a body");
      }
  }



  template <int dim>
  void
  Probes<dim>::report_absent(const PointSet<dim>            &points,
                             const std::vector<std::string> &body_names,
                             std::vector<std::string>       &notes) const
  {
    for (const Probe &probe : probes)
      if (probe.follows_point() && !is_there(probe.body, points))
        notes.push_back(
          "probe '" + probe.parameters.name + "' follows a point of body '" +
          body_names[probe.body] + "', which is not there, and shows zeros" +
          (probe.parameters.body.empty() ?
             "; key 'Body' names the body that is meant, and 'Kind = "
             "interpolated' follows what is there" :
             ""));
  }



  template <int dim>
  bool
  Probes<dim>::any_interpolated() const
  {
    return any_of(probes,
                  [](const Probe &probe) { return !probe.follows_point(); });
  }



  template <int dim>
  void
  Probes<dim>::try_step(const PlaceFunction<dim> &step_increment,
                        const PointSet<dim>      &points,
                        const PlaceFunction<dim> &velocity,
                        const PlaceFunction<dim> &acceleration,
                        const PlaceFunction<dim> &move)
  {
    for (Probe &probe : probes)
      if (!probe.follows_point())
        {
          const Point<dim> where =
            moves_through_mesh ? probe.start + probe.displacement : probe.start;
          probe.leaves_cells   = !step_increment(where, probe.increment);
          const bool with_body = is_there(probe.body, points);
          if (!probe.leaves_cells)
            {
              if (!with_body)
                {
                  choose_point(where,
                               points,
                               numbers::invalid_unsigned_int,
                               probe);
                  probe.body       = body_of(probe.point_id, points);
                  Tensor<1, dim> u = probe.displacement;
                  if (move)
                    move(where, u);
                  probe.before_reset += u - probe.displacement;
                  probe.displacement = u;
                }
              probe.v = probe.a = Tensor<1, dim>();
              if (velocity)
                velocity(where, probe.v);
              if (acceleration)
                acceleration(where, probe.a);
              continue;
            }
          if (!with_body) // it waits for one
            {
              probe.leaves_cells = false;
              probe.increment = probe.v = probe.a = Tensor<1, dim>();
              continue;
            }
          choose_point(where, points, numbers::invalid_unsigned_int, probe);
          probe.body = body_of(probe.point_id, points);
          probe.ahead =
            probe.displacement - displacement_of(probe.point_id, points);
        }
  }



  template <int dim>
  void
  Probes<dim>::keep_step()
  {
    sentences.clear();
    for (Probe &probe : probes)
      if (probe.leaves_cells)
        {
          probe.leaves_cells = false;
          probe.has_left     = true;
          sentences.push_back(
            "probe '" + probe.parameters.name +
            "' has left the cells with material; from here on it follows the "
            "point nearest to it, " +
            std::to_string(probe.point_id));
        }
      else if (!probe.follows_point())
        probe.displacement += probe.increment;
  }



  template <int dim>
  std::vector<std::vector<double>>
  Probes<dim>::gather_points(const PointSet<dim> &points) const
  {
    constexpr unsigned int n_stress = n_stress_components<dim>;
    constexpr unsigned int n        = 4 * dim + n_stress + 1;

    // The last number of each counts how often the point was found.
    std::vector<double> all(probes.size() * (n + 1), 0.);
    for (unsigned int p = 0; p < points.n_local(); ++p)
      for (unsigned int i = 0; i < probes.size(); ++i)
        // Halves of points may have numbers of those that are gone.
        if (probes[i].follows_point() && points.id(p) == probes[i].point_id &&
            points.body(p) == probes[i].body)
          {
            double       *out    = &all[i * (n + 1)];
            const double *values = points.values(p);
            out = std::copy_n(points.position(p).begin_raw(), dim, out);
            out = std::copy_n(values + points.displacement_offset(), dim, out);
            out = std::copy_n(values + points.stress_offset(), n_stress, out);
            for (const auto *field : {&v_field, &a_field})
              out = std::copy_n((field->exists() ? (*field)(values) :
                                                   Tensor<1, dim>())
                                  .begin_raw(),
                                dim,
                                out);
            *out++ = pressure_field.exists() ? pressure_field(values) : 0.;
            *out   = 1.;
          }
    Utilities::MPI::sum(all,
                        points.mesh().triangulation().get_communicator(),
                        all);

    std::vector<std::vector<double>> result;
    for (unsigned int i = 0; i < probes.size(); ++i)
      {
        const auto first = all.begin() + i * (n + 1);
        if (probes[i].follows_point() && first[n] != 1. && !points.exchanged())
          throw ComputationError(
            "probe '" + probes[i].parameters.name + "': point " +
            std::to_string(probes[i].point_id) + ", which it follows, is gone");
        result.emplace_back(first, first + n + 1);
      }
    return result;
  }



  template <int dim>
  std::vector<NamedValue>
  Probes<dim>::values(const PointSet<dim> &points) const
  {
    std::vector<NamedValue> columns;
    if (probes.empty())
      return columns;

    constexpr unsigned int first_velocity = 2 * dim + n_stress_components<dim>;
    const auto             of_points      = gather_points(points);
    for (unsigned int i = 0; i < probes.size(); ++i)
      {
        const Probe        &probe = probes[i];
        const std::string   at    = " at " + probe.parameters.name;
        std::vector<double> values(of_points[i]);
        const bool          is_gone = probe.has_left && values.back() == 0.;
        if (probe.parameters.kind == "interpolated" && !is_gone)
          for (unsigned int c = 0; c < dim; ++c)
            {
              const double u  = probe.has_left ?
                                  values[dim + c] + probe.ahead[c] :
                                  probe.displacement[c];
              values[c]       = probe.start[c] + u;
              values[dim + c] = u - probe.before_reset[c];
              if (probe.has_left)
                continue;
              values[first_velocity + c]       = probe.v[c];
              values[first_velocity + dim + c] = probe.a[c];
            }
        const auto add = [&](const std::string &name,
                             const std::string &unit,
                             const unsigned int first) {
          for (unsigned int c = 0; c < dim; ++c)
            columns.push_back(
              {name + direction_name(c) + at, unit, values[first + c]});
        };
        const double pressure = values[first_velocity + 2 * dim];
        for (const std::string &quantity : probe.parameters.quantities)
          if (quantity == "position")
            add("", "length", 0);
          else if (quantity == "displacement")
            add("u_", "length", dim);
          else if (quantity == "velocity")
            add("v_", "length/time", first_velocity);
          else if (quantity == "acceleration")
            add("a_", "length/time^2", first_velocity + dim);
          else if (quantity == "pore pressure")
            columns.push_back({"pore_pressure" + at, "stress", pressure});
          else
            for (unsigned int c = 0; c < n_stress_components<dim>; ++c)
              columns.push_back(
                {(quantity == "stress" ? "sigma_" : "total_sigma_") +
                   stress_component_name(c) + at,
                 "stress",
                 values[2 * dim + c] -
                   (quantity != "stress" && c < 3 ? pressure : 0.)});
      }
    return columns;
  }



  template <int dim>
  void
  Probes<dim>::reset_displacements(const PointSet<dim> &points)
  {
    for (Probe &probe : probes)
      if (probe.parameters.kind == "interpolated")
        {
          if (probe.has_left)
            probe.ahead += displacement_of(probe.point_id, points);
          probe.before_reset =
            probe.has_left ? probe.ahead : probe.displacement;
        }
  }



  template <int dim>
  void
  Probes<dim>::write(Archive &archive) const
  {
    std::vector<unsigned int> ids, bodies, left;
    std::vector<double>       displacements, velocities, accelerations;
    const auto add = [](const Tensor<1, dim> &u, std::vector<double> &values) {
      values.insert(values.end(), u.begin_raw(), u.end_raw());
    };
    for (const Probe &probe : probes)
      {
        ids.push_back(probe.point_id);
        bodies.push_back(probe.body);
        left.push_back(probe.has_left ? 1 : 0);
        for (const Tensor<1, dim> &u :
             {probe.displacement, probe.ahead, probe.before_reset})
          add(u, displacements);
        add(probe.v, velocities);
        add(probe.a, accelerations);
      }
    archive.write("probes/point", std::move(ids));
    archive.write("probes/body", std::move(bodies));
    archive.write("probes/has_left", std::move(left));
    archive.write("probes/displacement",
                  std::move(displacements),
                  3 * dim,
                  "length");
    archive.write("probes/velocity", std::move(velocities), dim, "length/time");
    archive.write("probes/acceleration",
                  std::move(accelerations),
                  dim,
                  "length/time^2");
  }



  template <int dim>
  void
  Probes<dim>::read(const Archive &archive)
  {
    const auto &ids           = archive.integers("probes/point");
    const auto &bodies        = archive.integers("probes/body");
    const auto &left          = archive.integers("probes/has_left");
    const auto &displacements = archive.numbers("probes/displacement", 3 * dim);
    const auto &velocities    = archive.numbers("probes/velocity", dim);
    const auto &accelerations = archive.numbers("probes/acceleration", dim);
    AssertThrow(ids.size() == probes.size(),
                ExcMessage("The archive is of other probes."));
    for (unsigned int i = 0; i < probes.size(); ++i)
      {
        Probe &probe   = probes[i];
        probe.point_id = ids[i];
        probe.body     = bodies[i];
        probe.has_left = left[i] != 0;
        auto from      = displacements.begin() + 3 * dim * i;
        for (Tensor<1, dim> *u :
             {&probe.displacement, &probe.ahead, &probe.before_reset})
          {
            std::copy_n(from, dim, u->begin_raw());
            from += dim;
          }
        std::copy_n(velocities.begin() + dim * i, dim, probe.v.begin_raw());
        std::copy_n(accelerations.begin() + dim * i, dim, probe.a.begin_raw());
      }
  }



  template struct ProbeParameters<2>;
  template struct ProbeParameters<3>;
  template class Probes<2>;
  template class Probes<3>;
} // namespace moraine
