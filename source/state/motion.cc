// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/state/motion.h>

#include <moraine/state/block_mass.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace moraine
{
  using namespace dealii;

  VelocityTransfer::VelocityTransfer(const IntegratorParameters &parameters)
    : scheme(parameters.transfer == "APIC" ? Scheme::apic :
             parameters.transfer == "FMPM" ? Scheme::fmpm :
                                             Scheme::flip_and_pic)
    , flip_share(parameters.transfer == "FLIP"  ? 1. :
                 parameters.transfer == "blend" ? parameters.flip_share :
                                                  0.)
    , fmpm_order(parameters.fmpm_order)
  {}



  template <int dim>
  void
  Motion<dim>::request_fields(const VelocityTransfer &transfer,
                              PointFields            &fields,
                              const bool              looks_back)
  {
    fields.request(FieldNames<dim>::velocity);
    fields.request(FieldNames<dim>::acceleration);
    if (looks_back)
      fields.request(FieldNames<dim>::acceleration_before);
    if (transfer.scheme == VelocityTransfer::Scheme::apic)
      fields.request(FieldNames<dim>::velocity_gradient);
  }



  template <int dim>
  Motion<dim>::Motion(const State<dim>       &state,
                      PointSet<dim>          &points,
                      const TimeIntegrator   &integrator,
                      const VelocityTransfer &transfer,
                      const bool              lumped_mass)
    : state(state)
    , points(points)
    , rule(integrator)
    , transfer(transfer)
    , lumped(lumped_mass)
    , v_field(points.fields().find(FieldNames<dim>::velocity))
    , a_field(points.fields().find(FieldNames<dim>::acceleration))
    , before_field(points.fields().find(FieldNames<dim>::acceleration_before))
    , gradient_field(points.fields().find(FieldNames<dim>::velocity_gradient))
  {
    AssertThrow(v_field.exists() && a_field.exists(),
                ExcMessage("Points without the fields of request_fields()"));
  }



  template <int dim>
  void
  Motion<dim>::rest()
  {
    v.assign(state.grid().n_nodes(), Tensor<1, dim>());
    a.assign(state.grid().n_nodes(), Tensor<1, dim>());
    if (before_field.exists())
      a_before = a;
    for (unsigned int p = 0; p < points.n_local(); ++p)
      {
        double *values = points.values(p);
        v_field.store(Tensor<1, dim>(), values);
        a_field.store(Tensor<1, dim>(), values);
        if (before_field.exists())
          before_field.store(Tensor<1, dim>(), values);
        if (gradient_field.exists())
          gradient_field.store(Tensor<2, dim>(), values);
      }
  }



  template <int dim>
  void
  Motion<dim>::start(
    const std::function<Tensor<1, dim>(const unsigned int, const Point<dim> &)>
      &velocity)
  {
    done = Works();
    rest();
    if (!points_carry())
      {
        v =
          mean_of_bodies([&](const unsigned int body, const unsigned int node) {
            return velocity(body, state.grid().node_position(node));
          });
        interpolate(v, v_field);
        return;
      }
    // A velocity that is linear in space has an exact difference.
    const double distance = 1e-3 * state.grid().mesh().cell_size();
    for (unsigned int p = 0; p < points.n_local(); ++p)
      {
        const auto at = [&, body = points.body(p)](const auto &x) {
          return velocity(body, x);
        };
        const Point<dim> x      = points.position(p);
        double          *values = points.values(p);
        v_field.store(at(x), values);
        if (!gradient_field.exists())
          continue;
        Tensor<2, dim> gradient;
        for (unsigned int d = 0; d < dim; ++d)
          {
            Tensor<1, dim> step;
            step[d] = distance;
            const Tensor<1, dim> difference =
              (at(x + step) - at(x - step)) / (2 * distance);
            for (unsigned int c = 0; c < dim; ++c)
              gradient[c][d] = difference[c];
          }
        gradient_field.store(gradient, values);
      }
  }



  template <int dim>
  void
  Motion<dim>::slow_down(const std::vector<bool> &come)
  {
    if (points_carry() ||
        std::find(come.begin(), come.end(), true) == come.end())
      return;
    v.resize(state.grid().n_nodes()); // there are none before the first motion
    v = mean_of_bodies([&](const unsigned int body, const unsigned int node) {
      return come[body] ? Tensor<1, dim>() : v[node];
    });
    interpolate(v, v_field);
  }



  template <int dim>
  void
  Motion<dim>::set_step_size(const double size)
  {
    step_size    = size;
    by_increment = by_start = by_before = 0;
    if (!(size > 0))
      return;
    const auto at_end =
      [&](const double du, const double a, const double before) {
        const double no_velocity = 0;
        return rule.end_inertia() *
               rule.acceleration(size, du, no_velocity, a, before);
      };
    by_increment = at_end(1, 0, 0);
    by_start     = at_end(0, 1, 0) + rule.start_inertia();
    by_before    = at_end(0, 0, 1);
  }



  template <int dim>
  void
  Motion<dim>::begin_step()
  {
    set_step_size(0);
    from_conditions = 0;
    if (!points_carry())
      {
        v.resize(state.grid().n_nodes());
        a.resize(state.grid().n_nodes());
        if (!massless_found)
          find_massless(node_masses());
        massless_found = true;
        if (before_field.exists())
          a_before.resize(state.grid().n_nodes());
        return;
      }
    Nodal nodal = map_to_nodes();
    if (transfer.scheme == VelocityTransfer::Scheme::fmpm)
      for (unsigned int order = 2; order <= transfer.fmpm_order; ++order)
        {
          const Nodal missing = map_to_nodes(&nodal);
          for (unsigned int k = 0; k < nodal.v.size(); ++k)
            {
              nodal.v[k] += missing.v[k];
              nodal.a[k] += missing.a[k];
              if (before_field.exists())
                nodal.a_before[k] += missing.a_before[k];
            }
        }
    v        = std::move(nodal.v);
    a        = std::move(nodal.a);
    a_before = std::move(nodal.a_before);
  }



  template <int dim>
  void
  Motion<dim>::set_target(const double     size,
                          const Constrain &constrain,
                          const bool       moves)
  {
    set_step_size(size);
    prescribed.clear();
    if (!constrain)
      return;
    const GridSpace<dim> &space       = state.grid();
    const auto            constrained = [&](const NodeValues           &values,
                                 const std::optional<double> share) {
      LA::Vector x = space.vector_of(values);
      constrain(share, x);
      NodeValues result;
      space.node_values(x, result);
      return result;
    };
    const NodeValues before = points_carry() || !moves ? NodeValues() : v;
    v                       = constrained(v, std::nullopt);
    a                       = constrained(a, std::nullopt);
    if (rule.looks_back())
      a_before = constrained(a_before, std::nullopt);
    if (!(size > 0) || !moves)
      return;
    const NodeValues none(space.n_nodes());
    prescribed = constrained(none, 1.);
    if (rule.forces_in_the_middle())
      {
        const NodeValues half = constrained(none, 0.5);
        for (unsigned int k = 0; k < v.size(); ++k)
          {
            v[k] += (4. * half[k] - prescribed[k]) / size;
            a[k] += 4. * (prescribed[k] - 2. * half[k]) / (size * size);
          }
        count_kinetic_change(before);
        return;
      }
    const NodeValues first  = constrained(none, 1. / 3),
                     second = constrained(none, 2. / 3);
    const double squared    = size * size / 9;
    for (unsigned int k = 0; k < v.size(); ++k)
      {
        const Tensor<1, dim> &du = prescribed[k];
        Tensor<1, dim>        at_start =
                         (-5. * first[k] + 4. * second[k] - du) / squared,
                       at_end =
                         (4. * first[k] - 5. * second[k] + 2. * du) / squared;
        const Tensor<1, dim> late =
          rule.delay_of_acceleration() * (at_end - at_start);
        at_start -= late;
        at_end -= late;
        v[k] += rule.start_velocity(size, du, at_start, at_start, at_end);
        a[k] += at_start;
        if (rule.looks_back())
          a_before[k] += at_start;
      }
    count_kinetic_change(before);
  }



  template <int dim>
  void
  Motion<dim>::set_target_at_start()
  {
    set_step_size(0);
    by_start = 1;
    prescribed.clear();
  }



  template <int dim>
  typename Motion<dim>::Nodal
  Motion<dim>::at_end() const
  {
    const NodeValues &du = state.nodal_increments();
    Nodal             end{v, a, {}};
    for (unsigned int k = 0; k < v.size(); ++k)
      std::tie(end.v[k], end.a[k]) = end_of_step(k, du[k]);
    return end;
  }



  template <int dim>
  typename Motion<dim>::KineticProducts
  Motion<dim>::map_to_points(const Nodal &end)
  {
    const double share       = points_carry() ? transfer.flip_share : 0.;
    const bool   places_move = state.mesh_after_step() != MeshAfterStep::keep;
    const Basis<dim> &basis  = state.point_basis();
    const NodeValues &increments = state.nodal_increments();
    StencilBlock<dim> block;
    BlockMass<dim>    matrix;
    NodeValues        v_0, a_0, du, v_1, a_1; // of the nodes of a block
    KineticProducts   products;
    for (unsigned int g = 0; g < basis.n_batches(); ++g)
      {
        basis.evaluate(g, block);
        matrix.find_lumped(
          block,
          [this](const unsigned int p) { return state.mass(p); },
          lumped);
        const auto gather = [&block](const NodeValues &from, NodeValues &to) {
          to.resize(block.n_nodes);
          for (unsigned int k = 0; k < block.n_nodes; ++k)
            to[k] = from[block.nodes[k]];
        };
        gather(v, v_0);
        gather(a, a_0);
        gather(increments, du);
        gather(end.v, v_1);
        gather(end.a, a_1);
        for (unsigned int p = 0; p < block.n_points; ++p)
          {
            double        *values = points.values(block.points[p]);
            const double  *N      = block.N(p);
            Tensor<1, dim> V_start, V_end, A_end;
            for (unsigned int k = 0; k < block.n_nodes; ++k)
              {
                V_start += N[k] * v_0[k];
                V_end += N[k] * v_1[k];
                A_end += N[k] * a_1[k];
              }
            v_field.store(V_end + share * (v_field(values) - V_start), values);
            a_field.store(A_end, values);
            if (before_field.exists())
              {
                Tensor<1, dim> A_start;
                for (unsigned int k = 0; k < block.n_nodes; ++k)
                  A_start += N[k] * a_0[k];
                before_field.store(A_start, values);
              }
            if (gradient_field.exists())
              {
                Tensor<2, dim> gradient, dF = unit_symmetric_tensor<dim>();
                for (unsigned int k = 0; k < block.n_nodes; ++k)
                  {
                    gradient += outer_product(v_1[k], block.grad_N(p)[k]);
                    if (places_move)
                      dF += outer_product(du[k], block.grad_N(p)[k]);
                  }
                gradient_field.store(determinant(dF) > 0. ?
                                       gradient * invert(dF) :
                                       gradient,
                                     values);
              }
            const double m = state.mass(block.points[p]);
            products.v_v += m * matrix.product(N, v_0, v_0);
            products.a_du += m * matrix.product(N, a_0, du);
            products.v_v_end += m * matrix.product(N, v_1, v_1);
          }
      }
    for (double *product : {&products.v_v, &products.a_du, &products.v_v_end})
      *product = Utilities::MPI::sum(*product, state.grid().communicator());
    return products;
  }



  template <int dim>
  void
  Motion<dim>::accept(const StepWorks &step)
  {
    Nodal      end      = at_end();
    const auto products = map_to_points(end);
    count(step, products, end);
    if (before_field.exists())
      a_before = std::move(a);
    v = std::move(end.v);
    a = std::move(end.a);
  }



  template <int dim>
  double
  Motion<dim>::error_of_increment() const
  {
    Nodal change = at_end();
    for (unsigned int k = 0; k < a.size(); ++k)
      change.a[k] -= a[k];
    Tensor<1, dim> unit;
    unit[0] = 1;
    const NodeValues ones(a.size(), unit);
    const auto [squares, mass] =
      mass_products<2>({{{&change.a, &change.a}, {&ones, &ones}}});
    return rule.error_of_increment(step_size) * std::sqrt(squares / mass);
  }



  namespace
  {
    /** Data sets of energies [force length]. */
    const std::pair<std::string, double Works::*> energies[] = {
      {"motion/work_of_prescribed", &Works::of_prescribed},
      {"motion/lost_in_transfer", &Works::lost_in_transfer},
      {"motion/lost_stored", &Works::lost_stored},
      {"motion/kinetic_at_start", &Works::kinetic_at_start},
      {"motion/kinetic", &Works::kinetic},
      {"motion/stored_at_start", &Works::stored_at_start},
      {"motion/stored", &Works::stored},
      {"motion/dissipated", &Works::dissipated}};
  } // namespace



  template <int dim>
  void
  Motion<dim>::write(Archive &archive) const
  {
    archive.write("motion/works",
                  std::vector<double>(std::begin(done.of_forces),
                                      std::end(done.of_forces)),
                  1,
                  "force length");
    for (const auto &[name, energy] : energies)
      archive.write(name, done.*energy, "force length");
    archive.write("motion/begun", done.begun ? 1u : 0u);
    if (points_carry())
      return;
    state.grid().write_node_values(v,
                                   "motion/velocity",
                                   "length/time",
                                   archive);
    state.grid().write_node_values(a,
                                   "motion/acceleration",
                                   "length/time^2",
                                   archive);
    if (before_field.exists())
      state.grid().write_node_values(a_before,
                                     "motion/acceleration_before",
                                     "length/time^2",
                                     archive);
  }



  template <int dim>
  void
  Motion<dim>::read(const Archive &archive)
  {
    const auto &works = archive.numbers("motion/works");
    massless_found    = false;
    AssertThrow(works.size() == Works::n_kinds, ExcInternalError());
    std::copy(works.begin(), works.end(), done.of_forces);
    for (const auto &[name, energy] : energies)
      done.*energy = archive.number(name);
    done.begun = archive.integer("motion/begun") != 0;
    if (points_carry())
      return;
    state.grid().read_node_values(archive, "motion/velocity", v);
    state.grid().read_node_values(archive, "motion/acceleration", a);
    if (before_field.exists())
      state.grid().read_node_values(archive,
                                    "motion/acceleration_before",
                                    a_before);
  }



  template class Motion<2>;
  template class Motion<3>;
} // namespace moraine
