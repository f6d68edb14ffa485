// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/assembly/contact_term.h>
#include <moraine/core/words.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** Of the size of a cell: how much of a gap, or of a slip where it sticks,
     * passes may leave. */
    constexpr double largest_gap_left = 1e-6;

    /** Of the size of a cell: a step in which a place of the rim ends deeper
     * behind the surface is rejected. */
    constexpr double deepest_place = 0.5;

    /** Of c_n h: a tension that is round-off. */
    constexpr double no_tension = 1e-12;

    /** How often full corrections may return to the same statuses before the
     * line search decides. */
    constexpr int most_returns = 2;
  } // namespace



  template <int dim>
  ContactTerm<dim>::ContactTerm(ContactBoundary<dim>    &boundary,
                                const std::vector<bool> &bodies_present,
                                const bool               acts)
    : boundary(boundary)
    , bodies_present(bodies_present)
    , acts(acts)
  {}



  template <int dim>
  std::vector<Effect>
  ContactTerm<dim>::effects(const StepContext<dim> &) const
  {
    if (!acts)
      return {};
    const std::string &name = boundary.name();
    const ContactLaw  &law  = boundary.law();
    std::string        text = name + ", contact, ";
    if (law.friction > 0)
      text += "friction " + text_of(law.friction, 3) + ", ";
    if (law.adhesion > 0)
      text += "adhesion " + text_of(law.adhesion, 3) + ", ";
    return {{"contact with " + name,
             "boundary",
             text + boundary.enforcement().name + ", " +
               std::to_string(boundary.units().size()) + " pieces of rims"}};
  }



  template <int dim>
  bool
  ContactTerm<dim>::begin_step(const StepContext<dim> &context)
  {
    const GridSpace<dim> &space = context.state.grid();
    boundary.find_cells(space,
                        context.search_tolerance,
                        context.t_start,
                        acts,
                        context.state.strain_measure() == StrainMeasure::finite,
                        bodies_present);
    if (!acts)
      {
        local_units.clear();
        return false;
      }
    boundary.find_units(space);
    const CellFluxes<dim> fluxes = find_fluxes(context);
    if (boundary.enforcement().has_flux())
      start_from(fluxes, context);
    find_local_units(context, fluxes);
    find_stiffness(context);
    std::vector<std::vector<unsigned int>> coupled;
    for (const LocalUnit &unit : local_units)
      if (!is_in_its_cell(space, unit))
        coupled.push_back(unit.nodes);
    const bool changed = coupled != coupled_before;
    coupled_before     = std::move(coupled);
    return changed;
  }



  template <int dim>
  void
  ContactTerm<dim>::couple(const StepContext<dim> &,
                           const typename Term<dim>::Couple &couple) const
  {
    for (const auto &nodes : coupled_before)
      couple(nodes.data(), nodes.size());
  }



  template <int dim>
  void
  ContactTerm<dim>::begin_trial(const StepContext<dim> &context)
  {
    boundary.set_target(context.t_end, /* anew = */ true);
    nothing_moved = true;
    touched.clear();
  }



  template <int dim>
  void
  ContactTerm<dim>::move_trial(const StepContext<dim> &context)
  {
    boundary.set_target(context.t_end, /* anew = */ false);
  }



  template <int dim>
  typename ContactTerm<dim>::Trial
  ContactTerm<dim>::trial(const StepContext<dim> &context,
                          const LocalUnit        &local) const
  {
    const ContactUnit<dim> &unit = boundary.units()[local.number];
    Trial                   trial;
    for (unsigned int a = 0; a < local.nodes.size(); ++a)
      trial.du += local.N[a] * context.increments()[local.nodes[a]];
    for (unsigned int a = 0; a < local.fluxes.size(); ++a)
      trial.flux += local.fluxes[a] * context.increments()[local.nodes[a]];
    trial.gap = boundary.gap(unit, trial.du);
    trial.multiplier =
      turned<dim>(unit.multiplier, unit.normal, trial.gap.normal);
    const Tensor<1, dim> traction =
      trial.multiplier + trial.flux +
      local.c_n * trial.gap.gap * trial.gap.normal - local.c_t * trial.gap.slip;
    trial.response = boundary.law().response(traction,
                                             trial.gap.normal,
                                             unit.was_open,
                                             no_tension * local.c_n * unit.h);
    if (trial.du.norm_square() > 0.)
      return trial;
    if (nothing_moved)
      linearise(traction, local, trial);
    // A surface that has not moved yet changes no traction.
    if (context.t_end == context.t_start)
      trial.response.traction = context.motion ?
                                  trial.multiplier :
                                  response_at_start(local, trial).traction;
    return trial;
  }



  template <int dim>
  ContactResponse<dim>
  ContactTerm<dim>::response_at_start(const LocalUnit &local,
                                      const Trial     &trial) const
  {
    const ContactUnit<dim> &unit     = boundary.units()[local.number];
    Tensor<1, dim>          traction = trial.multiplier;
    // Nitsche's method holds by a part of the gap, which is no force to come.
    if (boundary.enforcement().has_flux())
      traction += local.c_n * std::min(unit.gap, 0.) * trial.gap.normal;
    return boundary.law().response(traction,
                                   trial.gap.normal,
                                   unit.was_open,
                                   no_tension * local.c_n * unit.h);
  }



  template <int dim>
  void
  ContactTerm<dim>::linearise(const Tensor<1, dim> &traction,
                              const LocalUnit      &local,
                              Trial                &trial) const
  {
    const ContactUnit<dim> &unit     = boundary.units()[local.number];
    ContactResponse<dim>   &response = trial.response;
    if (unit.touches_first)
      {
        response = {traction,
                    unit_symmetric_tensor<dim>(),
                    ContactStatus::stick};
        return;
      }
    if (unit.was_open)
      return;
    const Tensor<1, dim> &n     = trial.gap.normal;
    response                    = response_at_start(local, trial);
    const Tensor<1, dim> start  = response.traction;
    const Tensor<1, dim> change = traction - start;
    if (boundary.law().rubs() && response.status == ContactStatus::slip &&
        (start - (start * n) * n) * change < 0.)
      response = {start, unit_symmetric_tensor<dim>(), ContactStatus::stick};
    response.traction += response.derivative * change;
  }



  template <int dim>
  void
  ContactTerm<dim>::add(const StepContext<dim> &context,
                        const bool              tangent,
                        GlobalSystem<dim>      &system) const
  {
    LocalSystem<dim>     local;
    const Tensor<2, dim> one    = unit_symmetric_tensor<dim>();
    const double         weight = 1. + this->share_of_start(context);
    if (tangent)
      touched.emplace_back();
    for (const LocalUnit &unit : local_units)
      {
        const Trial           now = trial(context, unit);
        const Tensor<1, dim> &n   = now.gap.normal;
        const Tensor<1, dim> &t   = now.response.traction;
        local.reinit(context.state,
                     unit.nodes.data(),
                     unit.nodes.size(),
                     tangent);
        Tensor<2, dim> stiffness;
        if (tangent)
          {
            touched.back().push_back(now.response.status !=
                                     ContactStatus::open);
            const Tensor<2, dim> nn = outer_product(n, n);
            stiffness =
              now.response.derivative * (unit.c_n * nn + unit.c_t * (one - nn));
            const ContactUnit<dim>  &at      = boundary.units()[unit.number];
            const MovedSurface<dim> &surface = boundary.surface_at_end();
            if (surface.curved())
              {
                const Tensor<2, dim> turn =
                  surface.normal_gradient(at.x + now.du, at.h);
                stiffness -= (t * n) * turn;
                stiffness += outer_product(n, (t - (t * n) * n) * turn);
              }
          }
        local.add_force(unit.N.data(), weight * unit.area * t);
        if (tangent)
          {
            local.add_stiffness(unit.N.data(), weight * unit.area * stiffness);
            add_stiffness_of_flux(unit,
                                  weight * now.response.derivative,
                                  local);
          }
        system.add(local, tangent);
      }
    if (tangent && nothing_moved)
      touched.clear();
    nothing_moved = nothing_moved && !tangent;
  }



  template <int dim>
  void
  ContactTerm<dim>::add_stiffness_of_flux(const LocalUnit      &unit,
                                          const Tensor<2, dim> &derivative,
                                          LocalSystem<dim>     &local)
  {
    for (unsigned int b = 0; b < unit.fluxes.size(); ++b)
      {
        const Tensor<2, dim> K = -unit.area * derivative * unit.fluxes[b];
        for (unsigned int a = 0; a < unit.fluxes.size(); ++a)
          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int j = 0; j < dim; ++j)
              local.matrix(dim * a + i, dim * b + j) += unit.N[a] * K[i][j];
      }
  }



  template <int dim>
  bool
  ContactTerm<dim>::symmetric(const StepContext<dim> &) const
  {
    return boundary.law().friction == 0. && !boundary.enforcement().has_flux();
  }



  template <int dim>
  double
  ContactTerm<dim>::violation(const StepContext<dim> &context) const
  {
    if (!boundary.enforcement().augments)
      return 0.;
    double largest = 0;
    for (const LocalUnit &unit : local_units)
      {
        const Trial          now    = trial(context, unit);
        const Tensor<1, dim> change = now.response.traction - now.multiplier;
        const double         normal = change * now.gap.normal;
        largest =
          std::max({largest,
                    std::abs(normal) / unit.c_n,
                    (change - normal * now.gap.normal).norm() / unit.c_t});
      }
    return largest;
  }



  template <int dim>
  double
  ContactTerm<dim>::rounded_length() const
  {
    double largest = 0;
    if (acts)
      for (const ContactUnit<dim> &unit : boundary.units())
        largest = std::max(largest, coordinate_magnitude(unit.x));
    return largest;
  }



  template <int dim>
  bool
  ContactTerm<dim>::acts_otherwise(const StepContext<dim> &context) const
  {
    if (local_units.empty())
      return false;
    // The first tangent uses linearised forces: there is nothing to compare.
    if (touched.empty())
      return true;
    std::vector<bool> now;
    for (const LocalUnit &unit : local_units)
      now.push_back(trial(context, unit).response.status !=
                    ContactStatus::open);
    // Statuses that alternate must not bypass the line search for ever.
    return now != touched.back() &&
           std::count(touched.begin(), touched.end(), now) < most_returns;
  }



  template <int dim>
  bool
  ContactTerm<dim>::is_settled(const StepContext<dim> &context,
                               const double            tolerance) const
  {
    if (!boundary.enforcement().augments)
      return true;
    double change = 0, largest = 0;
    for (const LocalUnit &unit : local_units)
      {
        const Trial           now = trial(context, unit);
        const Tensor<1, dim> &t   = now.response.traction;
        change  = std::max(change, (t - now.multiplier).norm());
        largest = std::max(largest, t.norm());
      }
    const MPI_Comm communicator = context.state.grid().communicator();
    return Utilities::MPI::max(change, communicator) <=
           tolerance * Utilities::MPI::max(largest, communicator);
  }



  template <int dim>
  double
  ContactTerm<dim>::largest_violation_left(
    const StepContext<dim> &context) const
  {
    return boundary.enforcement().augments ?
             largest_gap_left * context.state.grid().mesh().cell_size() :
             std::numeric_limits<double>::max();
  }



  template <int dim>
  void
  ContactTerm<dim>::augment(const StepContext<dim> &context)
  {
    if (!boundary.enforcement().augments)
      return;
    const unsigned int  n_units = boundary.units().size();
    std::vector<double> sums((dim + 1) * n_units, 0.);
    for (const LocalUnit &unit : local_units)
      {
        const Trial          now = trial(context, unit);
        const Tensor<1, dim> t =
          turned<dim>(now.response.traction,
                      now.gap.normal,
                      boundary.units()[unit.number].normal);
        for (unsigned int d = 0; d < dim; ++d)
          sums[(dim + 1) * unit.number + d] += unit.area * t[d];
        sums[(dim + 1) * unit.number + dim] += unit.area;
      }
    Utilities::MPI::sum(sums, context.state.grid().communicator(), sums);
    std::vector<Tensor<1, dim>> multipliers(n_units);
    for (unsigned int u = 0; u < n_units; ++u)
      for (unsigned int d = 0; d < dim; ++d)
        multipliers[u][d] = sums[(dim + 1) * u + d] / sums[(dim + 1) * u + dim];
    boundary.set_multipliers(multipliers);
    touched.clear();
  }



  template <int dim>
  std::string
  ContactTerm<dim>::failure(const StepContext<dim> &context,
                            const std::vector<Tensor<1, dim>> &) const
  {
    if (!acts)
      return "";
    const GridSpace<dim> &space = context.state.grid();
    const auto            moves =
      boundary.places_of_rim().increments(space, context.increments());
    for (unsigned int k = 0; k < moves.size(); ++k)
      if (boundary.depth(k, moves[k].u) >
          deepest_place * space.mesh().cell_size())
        return "a rim would end behind the surface '" + boundary.name() + "'";
    return "";
  }



  template <int dim>
  std::vector<typename ContactBoundary<dim>::OfUnit>
  ContactTerm<dim>::sum_units(const StepContext<dim> &context)
  {
    const auto            &motion       = boundary.rigid_motion();
    const Placement<dim>   pose         = motion.pose(context.t_end);
    const MPI_Comm         communicator = context.state.grid().communicator();
    constexpr unsigned int n            = 2 * dim + 5;
    std::vector<double>    sums(n * boundary.units().size(), 0.);
    prepared = {boundary.name(), {}, 0., 0., 0., 0.};
    for (const LocalUnit &unit : local_units)
      {
        const Trial           now  = trial(context, unit);
        const Tensor<1, dim> &t    = now.response.traction;
        const auto           &of   = boundary.units()[unit.number];
        const bool            slid = now.response.status == ContactStatus::slip;
        const Tensor<1, dim>  excess =
          t - now.multiplier - now.flux +
          turned<dim>(of.excess, of.normal, now.gap.normal);
        double *sum = &sums[n * unit.number];
        for (unsigned int d = 0; d < dim; ++d)
          {
            sum[d] += unit.area * t[d];
            sum[dim + d] += unit.area * excess[d];
          }
        sum[2 * dim + unsigned(now.response.status)] += unit.area;
        sum[2 * dim + 3] += slid ? unit.area * now.gap.slip.norm() : 0.;
        sum[2 * dim + 4] += slid ? unit.area * (t * now.gap.slip) : 0.;
        prepared.reaction += unit.area * t;
        prepared.force_magnitude += unit.area * t.norm();
        prepared.moment += motion.moment(of.x + now.du, unit.area * t, pose);
        prepared.work_of_motion += unit.area * (t * now.gap.of_surface);
      }
    sum_over_ranks(prepared, communicator);
    prepared.violation = Utilities::MPI::max(violation(context), communicator);
    Utilities::MPI::sum(sums, communicator, sums);
    prepared.contact.emplace();
    std::vector<typename ContactBoundary<dim>::OfUnit> of_units(
      boundary.units().size());
    for (unsigned int u = 0; u < of_units.size(); ++u)
      {
        const double *sum    = &sums[n * u];
        const double *status = sum + 2 * dim;
        const double  area   = status[0] + status[1] + status[2];
        for (unsigned int d = 0; d < dim; ++d)
          {
            of_units[u].traction[d] = sum[d] / area;
            of_units[u].excess[d]   = sum[dim + d] / area;
          }
        of_units[u].status = static_cast<ContactStatus>(
          std::max_element(status, status + 3) - status);
        of_units[u].slip = status[3] / area;
        of_units[u].work = status[4] / area;
        prepared.contact->area += status[1] + status[2];
        prepared.contact->slipping_area += status[2];
      }
    return of_units;
  }



  template <int dim>
  void
  ContactTerm<dim>::prepare(const StepContext<dim> &context, const LA::Vector &)
  {
    const State<dim> &state    = context.state;
    const auto        of_units = sum_units(context);
    const auto        moves =
      boundary.places_of_rim().increments(state.grid(), context.increments());
    for (unsigned int k = 0; k < moves.size(); ++k)
      prepared.penetration =
        std::max(prepared.penetration, boundary.depth(k, moves[k].u));
    boundary.prepare(of_units,
                     moves,
                     state.mesh_after_step() != MeshAfterStep::keep,
                     state.mesh_after_step() == MeshAfterStep::reset,
                     state.strain_measure() == StrainMeasure::finite);
    prepared.contact->slip             = boundary.largest_slip();
    prepared.contact->work_of_friction = boundary.work_of_friction();
  }



  template <int dim>
  void
  ContactTerm<dim>::keep() noexcept
  {
    boundary.keep();
  }



  template <int dim>
  void
  ContactTerm<dim>::report(const StepContext<dim> &,
                           std::vector<BoundaryReport<dim>> &reports) const
  {
    if (acts)
      reports.push_back(prepared);
  }



  template class ContactTerm<2>;
  template class ContactTerm<3>;
} // namespace moraine
