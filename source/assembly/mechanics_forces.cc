// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// What dynamics and stages ask of the equations: forces at the start of a step
// and by kind, the work of a step, what constraints hold.

#include <moraine/assembly/mechanics_system.h>

#include <moraine/assembly/absorbing_term.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** The sum of scalar products. */
    template <int dim>
    double
    product(const std::vector<Tensor<1, dim>> &forces,
            const std::vector<Tensor<1, dim>> &increments)
    {
      double sum = 0;
      for (unsigned int node = 0; node < forces.size(); ++node)
        sum += forces[node] * increments[node];
      return sum;
    }



    /** The term if it adds its force of the whole step. */
    template <int dim>
    const ConstraintTerm<dim> *
    over_step(const Term<dim> &term, const StepContext<dim> &context)
    {
      const auto *one = dynamic_cast<const ConstraintTerm<dim> *>(&term);
      return one && one->acts_over_step(context) ? one : nullptr;
    }
  } // namespace



  template <int dim>
  LA::Vector
  MechanicsSystem<dim>::constraint_forces(const std::string &name,
                                          const LA::Vector  &x)
  {
    LA::Vector result = state.grid().vector();
    assemble(x, false);
    constraints.hand_over_ties(unbalanced);
    sums.begin(false);
    for (const auto &term : terms)
      term->add_constraint_forces(context, name, unbalanced, sums);
    sums.end(result);
    return result;
  }



  template <int dim>
  double
  MechanicsSystem<dim>::hold(const std::string &name, const LA::Vector &held)
  {
    double missed = 1;
    each<AbsorbingTerm<dim>>([&](auto &term) {
      missed = term.hold(context, name, held).value_or(missed);
    });
    return missed;
  }



  template <int dim>
  void
  MechanicsSystem<dim>::find_dead_forces()
  {
    TimerOutput::Scope scope(timer, "external forces");
    const auto         find = [this](const double t) {
      context.t_end = t;
      sums.begin(false);
      add_terms([](const auto &term) { return term.traits().is_dead; }, false);
      sums.end(forces.dead);
    };
    const double t_end = context.t_end;
    LA::Vector   at_start;
    if (forces_in_the_middle())
      {
        find(context.t_start);
        at_start = forces.dead;
      }
    find(t_end);
    if (forces_in_the_middle())
      forces.dead.sadd(0.5, 0.5, at_start);
    scale.dead_squares.resize(body_names.size());
    Utilities::MPI::sum(sums.squares_of_bodies(),
                        state.grid().communicator(),
                        scale.dead_squares);
  }



  template <int dim>
  void
  MechanicsSystem<dim>::set_target_of_motion()
  {
    const double t_end = context.t_end;
    const auto   set   = [this](const double t) {
      context.t_end = t;
      constraints.set_values(lines_of_terms());
    };
    context.motion->set_target(
      context.step_size(),
      !constraints.any_lines() ?
        typename Motion<dim>::Constrain() :
        [&](const std::optional<double> share, LA::Vector &x) {
          if (!share)
            return constraints.distribute_correction(x);
          if (*share == 1)
            return constraints.distribute(x);
          set(context.t_start + *share * (t_end - context.t_start));
          constraints.distribute(x);
          set(t_end);
        },
      constraints.any_lines() &&
        constraints.any_values(state.grid().communicator()));
  }



  template <int dim>
  void
  MechanicsSystem<dim>::count_work(const unsigned int i, const double work)
  {
    const WorkKind kind = terms[i]->traits().work_kind;
    if (kind != WorkKind::none)
      forces.works[unsigned(kind)] += work;
    forces.works_of_terms[i] += work;
  }



  template <int dim>
  void
  MechanicsSystem<dim>::find_forces_at_start()
  {
    TimerOutput::Scope scope(timer, "forces at start");
    context.t_end = context.t_start;
    state.set_step_time({context.t_start, context.t_end});
    state.reject();
    start_over();
    each<ConstraintTerm<dim>>([this](auto &term) { term.note_start(context); });
    add_point_forces_by_kind();
    for (unsigned int k = 0; k < Works::n_kinds; ++k)
      {
        bool any = false;
        for (const auto &term : terms)
          if (!dynamic_cast<PointTerm<dim> *>(term.get()) &&
              !term->traits().is_inertia &&
              term->traits().work_kind == WorkKind(k))
            {
              if (!any)
                sums.begin(false);
              any = true;
              term->add(context, false, sums);
            }
        for (unsigned int node = 0; any && node < forces.by_kind[k].size();
             ++node)
          forces.by_kind[k][node] += sums.forces_of_this_rank()[node];
      }
  }



  template <int dim>
  void
  MechanicsSystem<dim>::add_point_forces_by_kind()
  {
    std::array<std::vector<const PointTerm<dim> *>, Works::n_kinds> of_kinds;
    for (const auto &term : terms)
      if (const auto *of_points = dynamic_cast<PointTerm<dim> *>(term.get()))
        if (const WorkKind kind = term->traits().work_kind;
            kind != WorkKind::none)
          of_kinds[unsigned(kind)].push_back(of_points);
    for (NodeValues &of_kind : forces.by_kind)
      of_kind.assign(state.grid().n_nodes(), Tensor<1, dim>());
    StencilBlock<dim> block;
    LocalSystem<dim>  local;
    const Basis<dim> &basis = state.point_basis();
    for (unsigned int g = 0; g < basis.n_batches(); ++g)
      {
        context.state.evaluate(g, block);
        for (unsigned int k = 0; k < Works::n_kinds; ++k)
          {
            if (of_kinds[k].empty())
              continue;
            local.reinit(state, block.nodes, block.n_nodes, false);
            for (const auto *term : of_kinds[k])
              term->add_at_start(context, block, local);
            for (unsigned int a = 0; a < block.n_nodes; ++a)
              for (unsigned int d = 0; d < dim; ++d)
                forces.by_kind[k][block.nodes[a]][d] +=
                  local.force[dim * a + d];
          }
      }
  }



  template <int dim>
  LA::Vector
  MechanicsSystem<dim>::sum_of_kinds() const
  {
    NodeValues sum(state.grid().n_nodes());
    for (const NodeValues &of_kind : forces.by_kind)
      for (unsigned int node = 0; node < sum.size(); ++node)
        sum[node] += of_kind[node];
    LA::Vector result = state.grid().vector();
    state.grid().sum_node_values(sum, result);
    return result;
  }



  template <int dim>
  void
  MechanicsSystem<dim>::weigh_forces_at_start()
  {
    const double share = context.motion->integrator().start_forces();
    if (!(share > 0) || forces_in_the_middle())
      return;
    forces.at_start  = sum_of_kinds();
    const auto which = [this](const auto &term) {
      return over_step(term, context) != nullptr;
    };
    forces.over_step.clear();
    if (std::any_of(terms.begin(), terms.end(), [&](const auto &term) {
          return which(*term);
        }))
      {
        sums.begin(false);
        add_terms(which, false);
        forces.over_step     = sums.forces_of_this_rank();
        LA::Vector over_step = state.grid().vector();
        sums.end(over_step);
        forces.at_start -= over_step;
      }
    forces.at_start *= share;
  }



  template <int dim>
  void
  MechanicsSystem<dim>::count_work_over_step(
    typename Motion<dim>::StepWorks &works) const
  {
    if (forces.over_step.empty())
      return;
    // All of it counts here, and half of what is counted at either end.
    const double at_start = product(forces.over_step, state.nodal_increments());
    for (unsigned int i = 0; i < terms.size(); ++i)
      if (const auto *term = over_step(*terms[i], context))
        {
          const unsigned int kind     = unsigned(terms[i]->traits().work_kind);
          const double       of_force = forces.works_of_terms[i];
          works.at_end[kind] +=
            2 * term->work_of_step(context, of_force) - of_force;
        }
    works.at_start[unsigned(WorkKind::boundaries)] -= at_start;
    if (!context.motion->prescribed_increments().empty())
      works.on_prescribed_at_start -=
        product(forces.over_step, context.motion->prescribed_increments());
  }



  template <int dim>
  typename MechanicsSystem<dim>::Imbalance
  MechanicsSystem<dim>::imbalance_at_start()
  {
    find_forces_at_start();
    LA::Vector of_kind = state.grid().vector();
    double     largest = 0;
    for (const NodeValues &forces_of_kind : forces.by_kind)
      {
        state.grid().sum_node_values(forces_of_kind, of_kind);
        largest = std::max(largest, of_kind.l2_norm());
      }
    LA::Vector unbalanced_forces = sum_of_kinds();
    constraints.condense(unbalanced_forces);
    const double share =
      largest > 0 ? unbalanced_forces.l2_norm() / largest : 0.;
    return {std::move(unbalanced_forces), share};
  }



  template <int dim>
  LA::Vector
  MechanicsSystem<dim>::forces_and_mass()
  {
    context.motion->set_target_at_start();
    // Those of begin_step() do not know the velocities of this step.
    find_forces_at_start();
    weigh_forces_at_start();
    sums.begin(true);
    add_terms([](const auto &term) { return term.traits().is_inertia; }, true);
    LA::Vector result = state.grid().vector();
    sums.end(result);
    result += sum_of_kinds();
    constraints.condense(result);
    return result;
  }



  template <int dim>
  typename Motion<dim>::StepWorks
  MechanicsSystem<dim>::works_of_step(const LA::Vector &x)
  {
    TimerOutput::Scope scope(timer, "energy");
    assemble_forces_at(x);
    const NodeValues &increments = state.nodal_increments();
    const NodeValues &prescribed = context.motion->prescribed_increments();
    typename Motion<dim>::StepWorks works;
    const double                    of_dead = forces.dead * x;
    for (unsigned int k = 0; k < Works::n_kinds; ++k)
      {
        works.at_end[k] = forces.works[k];
        if (forces_in_the_middle())
          continue;
        works.at_start[k] = product(forces.by_kind[k], increments);
        if (!prescribed.empty())
          works.on_prescribed_at_start +=
            product(forces.by_kind[k], prescribed);
      }
    count_work_over_step(works);
    if (!prescribed.empty())
      works.on_prescribed_at_end = work_on_prescribed();
    works.sum_over_ranks(state.grid().communicator());
    works.at_end[unsigned(WorkKind::external)] += of_dead;
    return works;
  }



  template <int dim>
  double
  MechanicsSystem<dim>::work_on_prescribed()
  {
    const auto work = [this](const Which &which) {
      sums.begin(false);
      add_terms(
        [&which](const auto &term) {
          return term.traits().work_kind != WorkKind::none && which(term);
        },
        false);
      return product(sums.forces_of_this_rank(),
                     context.motion->prescribed_increments());
    };
    if (!forces_in_the_middle())
      return work([](const auto &) { return true; });
    const auto is_dead = [](const auto &term) { return term.traits().is_dead; };
    const double t_end = context.t_end;
    double sum = work([](const auto &term) { return !term.traits().is_dead; });
    sum += 0.5 * work(is_dead);
    context.t_end = context.t_start;
    sum += 0.5 * work(is_dead);
    context.t_end = t_end;
    return sum;
  }



  template <int dim>
  void
  MechanicsSystem<dim>::assemble_forces_at(const LA::Vector &x)
  {
    // They are known, unless x is not where Newton ended.
    LA::Vector difference(x);
    difference -= assembled_at;
    if (!assembled || predicting || difference.linfty_norm() > 0)
      assemble(x, false);
  }



#define INSTANTIATE(dim)                                                      \
  template double     MechanicsSystem<dim>::hold(const std::string &,         \
                                             const LA::Vector &);         \
  template LA::Vector MechanicsSystem<dim>::constraint_forces(                \
    const std::string &, const LA::Vector &);                                 \
  template void MechanicsSystem<dim>::find_dead_forces();                     \
  template void MechanicsSystem<dim>::set_target_of_motion();                 \
  template void MechanicsSystem<dim>::count_work(const unsigned int,          \
                                                 const double);               \
  template typename MechanicsSystem<dim>::Imbalance                           \
                      MechanicsSystem<dim>::imbalance_at_start();             \
  template void       MechanicsSystem<dim>::find_forces_at_start();           \
  template void       MechanicsSystem<dim>::weigh_forces_at_start();          \
  template LA::Vector MechanicsSystem<dim>::forces_and_mass();                \
  template void MechanicsSystem<dim>::assemble_forces_at(const LA::Vector &); \
  template typename Motion<dim>::StepWorks                                    \
  MechanicsSystem<dim>::works_of_step(const LA::Vector &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
