// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/run/initial_stress.h>

#include <moraine/core/exceptions.h>
#include <moraine/core/expression.h>
#include <moraine/core/ranges.h>
#include <moraine/core/words.h>
#include <moraine/geometry/overburden.h>
#include <moraine/scene/scene_bodies.h>
#include <moraine/scene/scene_conditions.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/parameter_handler.h>

#include <deal.II/grid/grid_tools.h>

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

namespace moraine
{
  using namespace dealii;

  void
  InitialStressParameters::add_parameters(ParameterHandler  &prm,
                                          const unsigned int dim)
  {
    prm.add_parameter(
      "Initial stress",
      stress,
      std::string(
        "Stress before the first step, at displacements of zero: geostatic, or "
        "expressions '") +
        (dim == 2 ?
           "sigma_xx; sigma_yy; sigma_zz; sigma_xy' in x, y" :
           "sigma_xx; sigma_yy; sigma_zz; sigma_xy; sigma_xz; sigma_yz' in x, "
           "y, z") +
        " [stress, tension positive]. geostatic: along gravity the weight of "
        "all bodies straight above up to the surface, by their densities and "
        "the loads of type gravity; across it, out of the plane too, K0 times "
        "as much, with section 'Water' of effective stress. None if left out.");
    prm.add_parameter(
      "K0",
      K0,
      "Of geostatic stress: horizontal over vertical stress, a "
      "number or an expression of place. If left out, that of the "
      "material: nu/(1-nu), as elastic ground that cannot widen has "
      "it, or of Cam-clay 'Normal K0' times OCR^sin(phi).");
    prm.add_parameter("Surcharge",
                      surcharge,
                      "Of geostatic stress: vertical pressure on the surface "
                      "where this body is the uppermost, a number or an "
                      "expression of place [stress]; what presses is a load of "
                      "its own. 0 if left out.");
  }



  void
  InitialStressParameters::check(const std::string &section) const
  {
    for (const auto &[key, value] :
         {std::make_pair("K0", K0), std::make_pair("Surcharge", surcharge)})
      if (!value.empty() && !geostatic())
        reject(section,
               key,
               value,
               "nothing; key 'Initial stress' is not 'geostatic'");
  }



  namespace
  {
    template <int dim>
    const BodyParameters<dim> &
    parameters_of(const Scene<dim> &scene, const std::string &body)
    {
      for (const auto &[name, parameters] : scene.bodies)
        if (name == body)
          return parameters;
      throw InputError("no body '" + body + "'");
    }



    /** The surface of a mesh that is no box; quadrilaterals as two triangles.
     */
    template <int dim>
    std::vector<typename Overburden<dim>::Facet>
    surface_of(const BackgroundMesh<dim> &mesh)
    {
      std::vector<typename Overburden<dim>::Facet> facets;
      if (mesh.box_grid())
        return facets;
      for (const auto &cell : mesh.triangulation().active_cell_iterators())
        for (const auto &face : cell->face_iterators())
          if (face->at_boundary())
            {
              if constexpr (dim == 2)
                facets.push_back({{face->vertex(0), face->vertex(1)}});
              else
                for (const unsigned int v : {0, 3})
                  facets.push_back(
                    {{face->vertex(v), face->vertex(1), face->vertex(2)}});
            }
      return facets;
    }



    /** The geostatic stress in one body. */
    template <int dim>
    class GeostaticStress
    {
    public:
      GeostaticStress(const Scene<dim>      &scene,
                      const Model<dim>      &model,
                      const unsigned int     body,
                      const StageParameters &stage)
        : model(model)
        , section("Bodies/" + model.body_names[body])
        , body(body)
        , start_time(stage.time.start_time)
        , n_bodies(model.body_names.size())
      {
        const NamedShapes<dim> shapes = body_shapes(scene);
        for (unsigned int b = 0; b < n_bodies; ++b)
          {
            const std::string &name = model.body_names[b];
            ShapePointer<dim>  shape;
            if (contains(stage.bodies, name))
              {
                shape = shapes.at(name);
                if (!shape)
                  throw InputError(place(section, "Initial stress") +
                                   ": found 'geostatic' beside the body '" +
                                   name +
                                   "' of a point file, allowed: bodies with a "
                                   "shape");
              }
            active.push_back(shape);
            surcharge.push_back(
              expression(parameters_of(scene, name).initial_stress.surcharge,
                         "Bodies/" + name,
                         "Surcharge"));
          }
        overburden =
          std::make_unique<Overburden<dim>>(active,
                                            GridTools::compute_bounding_box(
                                              model.mesh->triangulation()),
                                            model.mesh->cell_size(),
                                            surface_of(*model.mesh));
        K0 = expression(
          parameters_of(scene, model.body_names[body]).initial_stress.K0,
          section,
          "K0");
        for (const auto &force : model.loads.body_forces)
          if (force.times_density && contains(stage.loads, force.name))
            gravities.push_back(&force);
        water = make_water(scene, stage);
      }

      SymmetricTensor<2, 3>
      operator()(const Point<dim> &x) const
      {
        const Tensor<1, dim> g = direction(x);
        std::vector<double>  weights;
        bool                 any = false;
        for (unsigned int b = 0; b < n_bodies; ++b)
          {
            weights.push_back(g * gravity(b, x) *
                              model.materials[b]->density());
            any = any || (active[b] && (weights[b] != 0 || surcharge[b]));
          }
        if (!any || !(g.norm() > 0))
          throw InputError(
            place(section, "Initial stress") +
            ": found 'geostatic' where no body has weight at t = " +
            text_of(start_time) +
            ", allowed: a load of type gravity that acts then, and a material "
            "with a 'Density' in a body it acts on");
        const Tensor<1, dim> up       = -g;
        const auto           columns  = overburden->above(x, body, up, weights);
        double               vertical = 0;
        for (const auto &column : columns)
          {
            const auto &load = surcharge[column.top];
            vertical +=
              (column.pressure + (load ? load->value(column.surface) : 0.) +
               (water ? of_water(x, up, column) : 0.)) /
              columns.size();
          }
        const double          share = horizontal_share(x, vertical);
        SymmetricTensor<2, 3> stress;
        for (unsigned int d = 0; d < 3; ++d)
          stress[d][d] = -share * vertical;
        for (unsigned int d = 0; d < dim; ++d)
          for (unsigned int e = d; e < dim; ++e)
            stress[d][e] -= (1 - share) * vertical * up[d] * up[e];
        return stress;
      }

    private:
      using Number = std::unique_ptr<Expression<dim>>;

      static Number
      expression(const std::string &text,
                 const std::string &section,
                 const std::string &key)
      {
        if (text.empty())
          return {};
        return std::make_unique<Expression<dim>>(
          text, place(section, key), 1, std::map<std::string, double>(), false);
      }

      /** The share of water in the effective overburden of a column: its weight
       * in the pores and above the surface, less the pore pressure. */
      double
      of_water(const Point<dim>                       &x,
               const Tensor<1, dim>                   &up,
               const typename Overburden<dim>::Column &column) const
      {
        double pressure = water->outer_pressure(column.surface, start_time) -
                          water->pore_pressure(x, start_time);
        for (const auto &part : column.parts)
          if (const double extra = model.loads.water->extra_density[part.body];
              extra > 0)
            pressure -= extra * (up * gravity(part.body, x)) *
                        wet_length(x + part.begin * up, x + part.end * up);
        return pressure;
      }

      /** Of a line, as far as it crosses the phreatic line once. */
      double
      wet_length(const Point<dim> &lower, const Point<dim> &upper) const
      {
        const auto is_wet = [&](const Point<dim> &at) {
          return water->uncut_pressure(at, start_time) > 0;
        };
        const double length    = lower.distance(upper);
        const bool   wet_below = is_wet(lower);
        if (wet_below == is_wet(upper))
          return wet_below ? length : 0.;
        double begin = 0, end = 1;
        for (unsigned int halving = 0; halving < 60; ++halving)
          {
            const double middle = 0.5 * (begin + end);
            (is_wet(lower + middle * (upper - lower)) == wet_below ? begin :
                                                                     end) =
              middle;
          }
        return length * (wet_below ? end : 1 - end);
      }

      Tensor<1, dim>
      gravity(const unsigned int b, const Point<dim> &x) const
      {
        Tensor<1, dim> g;
        for (const BodyForce<dim> *force : gravities)
          if (force->acts_on[b])
            g += force->value(x, start_time);
        return g;
      }

      /** Of gravity, of unit length: that of this body or, if it acts only on
       * others, that of all loads; zero if there is none. */
      Tensor<1, dim>
      direction(const Point<dim> &x) const
      {
        Tensor<1, dim> g = gravity(body, x);
        if (!(g.norm() > 0))
          for (const BodyForce<dim> *force : gravities)
            g += force->value(x, start_time);
        return g.norm() > 0 ? g / g.norm() : g;
      }

      double
      horizontal_share(const Point<dim> &x, const double vertical) const
      {
        if (!K0)
          {
            const Material &material = *model.materials[body];
            const auto      internal = material.internal_at(point_in_space(x));
            return material.K0(vertical, internal.data());
          }
        const double share = K0->value(x);
        if (share < 0)
          throw InputError(place(section, "K0") + ": found " +
                           std::to_string(share) + ", allowed: >= 0");
        return share;
      }

      const Model<dim>                   &model;
      const std::string                   section;
      const unsigned int                  body;
      const double                        start_time;
      const unsigned int                  n_bodies;
      std::vector<ShapePointer<dim>>      active; ///< null if not there
      std::unique_ptr<Overburden<dim>>    overburden;
      std::vector<Number>                 surcharge; ///< of bodies
      Number                              K0;
      std::vector<const BodyForce<dim> *> gravities;
      std::optional<Water<dim>>           water;
    };



    template <int dim>
    using StressFunction =
      std::function<SymmetricTensor<2, 3>(const Point<dim> &)>;

    /** Of a body; empty if it is free of stress. */
    template <int dim>
    StressFunction<dim>
    initial_stress_of(const Scene<dim>  &scene,
                      const Model<dim>  &model,
                      const unsigned int body)
    {
      const std::string &name = model.body_names[body];
      const auto        &text = parameters_of(scene, name).initial_stress;
      if (text.stress.empty())
        return {};
      if (text.geostatic())
        return [stress = std::make_shared<GeostaticStress<dim>>(
                  scene,
                  model,
                  body,
                  scene.stages[scene.first_stage_with(name)].second)](
                 const Point<dim> &x) { return (*stress)(x); };
      return
        [stress = Expression<dim>(text.stress,
                                  place("Bodies/" + name, "Initial stress"),
                                  n_stress_components<dim>,
                                  {},
                                  false)](const Point<dim> &x) {
          SymmetricTensor<2, 3> sigma;
          for (unsigned int c = 0; c < n_stress_components<dim>; ++c)
            sigma.access_raw_entry(c) = stress.value(x, 0., c);
          return sigma;
        };
    }



    /** A stress that a material cannot have. */
    template <int dim>
    struct MissedStress
    {
      double                share = 0; ///< how far it is off
      Point<dim>            x;
      SymmetricTensor<2, 3> wanted, possible;

      std::string
      text(const std::string &body) const
      {
        const auto principal = [](const SymmetricTensor<2, 3> &stress) {
          return fmt::format("{:.4g}", fmt::join(eigenvalues(stress), ", "));
        };
        return place("Bodies/" + body, "Initial stress") +
               ": found the principal stresses " + principal(wanted) + " at (" +
               coordinates(x) + "), " +
               (numbers::is_finite(possible.norm()) ?
                  text_of(100 * share, 3) +
                    " % beyond what the material can bear, allowed: stress "
                    "within its yield surface, as " +
                    principal(possible) :
                  "for which the material has no strain, allowed: stress that "
                  "it can bear");
      }
    };



    /** The worst of this rank in the points of @p body. */
    template <int dim>
    MissedStress<dim>
    set_in_body(const StressFunction<dim> &stress,
                const unsigned int         body,
                const PointSet<dim>       &points,
                State<dim>                &state)
    {
      MissedStress<dim> worst;
      for (unsigned int p = 0; p < points.n_local(); ++p)
        {
          if (points.body(p) != body)
            continue;
          const Point<dim>            x = points.position(p);
          const SymmetricTensor<2, 3> wanted =
            stress ? stress(x) : SymmetricTensor<2, 3>();
          const SymmetricTensor<2, 3> possible =
            state.set_initial_stress(p, wanted);
          double error = (possible - wanted).norm() / wanted.norm();
          if (!numbers::is_finite(error))
            error = std::numeric_limits<double>::max();
          if (wanted.norm() > 0 && error > std::max(1e-9, worst.share))
            worst = {error, x, wanted, possible};
        }
      return worst;
    }
  } // namespace



  template <int dim>
  void
  set_initial_stress(const Scene<dim> &scene, Model<dim> &model)
  {
    const MPI_Comm communicator = model.space->communicator();
    for (unsigned int body = 0; body < model.body_names.size(); ++body)
      {
        MissedStress<dim> worst;
        std::string       mistake;
        try
          {
            const auto stress = initial_stress_of(scene, model, body);
            if (!stress && model.materials[body]->has_linear_elasticity())
              continue;
            worst = set_in_body(stress, body, *model.points, *model.state);
          }
        catch (const InputError &error)
          {
            mistake = error.what();
          }
        if (worst.share > 0)
          mistake = worst.text(model.body_names[body]);
        const double largest = Utilities::MPI::max(worst.share, communicator);
        // That of the rank with the worst place, which need not be this one.
        std::string found;
        for (const auto &[share, text] :
             Utilities::MPI::all_gather(communicator,
                                        std::make_pair(worst.share, mistake)))
          if (!text.empty() && (found.empty() || !(share < largest)))
            found = text;
        if (!found.empty())
          throw InputError(found);
      }
  }



  template <int dim>
  bool
  begins_with_stress(const Scene<dim> &scene, const unsigned int k)
  {
    const auto is_new = [&](const std::string &name) {
      return contains(scene.stages[k].second.bodies, name) &&
             (k == 0 || !contains(scene.stages[k - 1].second.bodies, name));
    };
    return any_of(scene.bodies, [&](const auto &body) {
      return !body.second.initial_stress.stress.empty() && is_new(body.first);
    });
  }



#define INSTANTIATE(dim)                                              \
  template void set_initial_stress(const Scene<dim> &, Model<dim> &); \
  template decltype(begins_with_stress<dim>) begins_with_stress<dim>;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
