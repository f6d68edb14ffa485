// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/assembly/grid_condition_term.h>
#include <moraine/state/motion.h>

#include <deal.II/base/mpi.h>


namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** The force on a node over what is unbalanced there. */
    template <int dim>
    double
    force_over_unbalanced(const StepContext<dim> &context)
    {
      return context.motion ? -context.motion->integrator().divisor() : -1.;
    }
  } // namespace



  template <int dim>
  GridConditionTerm<dim>::GridConditionTerm(
    const std::vector<GridCondition<dim>> &conditions)
    : conditions(conditions)
  {}



  template <int dim>
  std::vector<Effect>
  GridConditionTerm<dim>::effects(const StepContext<dim> &context) const
  {
    const GridSpace<dim>     &space = context.state.grid();
    std::vector<unsigned int> n(conditions.size(), 0);
    const auto               *before = prescribed.entries.data();
    for (const auto &entry : prescribed.entries)
      {
        // The components of a node follow each other.
        if (space.locally_owned().is_element(space.node_dof(entry.node)) &&
            (&entry == before || entry.node != before->node ||
             entry.condition != before->condition))
          ++n[entry.condition];
        before = &entry;
      }
    Utilities::MPI::sum(n, space.communicator(), n);
    std::vector<Effect> effects;
    for (unsigned int c = 0; c < conditions.size(); ++c)
      effects.push_back(
        {"grid condition " + conditions[c].name,
         "grid",
         conditions[c].name + ", holds " + std::to_string(n[c]) + " nodes"});
    return effects;
  }



  template <int dim>
  bool
  GridConditionTerm<dim>::begin_step(const StepContext<dim> &context)
  {
    if (!context.couplings_changed)
      return false;
    const GridSpace<dim> &space = context.state.grid();
    prescribed = find_prescribed_nodes(conditions, space, context.t_start);
    shared     = SharedNodes<dim>(prescribed, conditions.size(), space);
    return true;
  }



  template <int dim>
  void
  GridConditionTerm<dim>::constrain(
    const StepContext<dim>    &context,
    AffineConstraints<double> &constraints) const
  {
    const GridSpace<dim> &space = context.state.grid();
    for (const auto &entry : prescribed.entries)
      {
        const auto dof = space.node_dof(entry.node) + entry.component;
        if (constraints.is_constrained(dof))
          continue;
        constraints.add_line(dof);
        constraints.set_inhomogeneity(dof,
                                      conditions[entry.condition].increment(
                                        space.node_position(entry.node),
                                        space.built_position(entry.node),
                                        context.t_start,
                                        context.t_end)[entry.component]);
      }
  }



  template <int dim>
  void
  GridConditionTerm<dim>::check_values(const StepContext<dim> &context)
  {
    std::vector<bool> checked(conditions.size(), false);
    std::size_t       n_checked = 0;
    for (const auto &entry : prescribed.entries)
      if (!checked[entry.condition])
        {
          const GridSpace<dim> &space     = context.state.grid();
          const auto           &condition = conditions[entry.condition];
          condition.increment(space.node_position(entry.node),
                              space.built_position(entry.node),
                              condition.start,
                              context.t_end);
          checked[entry.condition] = true;
          if (++n_checked == conditions.size())
            break;
        }
  }



  template <int dim>
  void
  GridConditionTerm<dim>::add_constraint_forces(const StepContext<dim> &context,
                                                const std::string      &name,
                                                const LA::Vector  &unbalanced,
                                                GlobalSystem<dim> &system) const
  {
    const GridSpace<dim> &space = context.state.grid();
    const double          share = force_over_unbalanced(context);
    for (const auto &entry : prescribed.entries)
      {
        const auto dof = space.node_dof(entry.node) + entry.component;
        if (conditions[entry.condition].name != name ||
            !space.locally_owned().is_element(dof))
          continue;
        Tensor<1, dim> force;
        force[entry.component] = share * unbalanced(dof);
        system.add(entry.node, force);
      }
  }



  template <int dim>
  void
  GridConditionTerm<dim>::prepare(const StepContext<dim> &context,
                                  const LA::Vector       &unbalanced)
  {
    const GridSpace<dim> &space = context.state.grid();
    const double          share = force_over_unbalanced(context);
    prepared.clear();
    for (const auto &condition : conditions)
      prepared.push_back({condition.name, {}, 0., 0., 0., 0.});

    // Entries of a node that one condition prescribes follow each other.
    const auto &entries = prescribed.entries;
    for (unsigned int first = 0, last = 0; first < entries.size(); first = last)
      {
        const unsigned int node = entries[first].node;
        Tensor<1, dim>     force;
        for (last = first;
             last < entries.size() && entries[last].node == node &&
             entries[last].condition == entries[first].condition;
             ++last)
          {
            const auto dof = space.node_dof(node) + entries[last].component;
            if (space.locally_owned().is_element(dof))
              force[entries[last].component] = share * unbalanced(dof);
          }
        auto &report = prepared[entries[first].condition];
        report.reaction += force;
        report.force_magnitude += force.norm();
        report.moment += moment_on_nodes(conditions[entries[first].condition],
                                         context,
                                         place_in_balance(context, node),
                                         force);
      }
    for (auto &report : prepared)
      sum_over_ranks(report, space.communicator());
    shared.keep(context, unbalanced, share);
  }



  template <int dim>
  void
  GridConditionTerm<dim>::report(
    const StepContext<dim>           &context,
    std::vector<BoundaryReport<dim>> &reports) const
  {
    std::vector<BoundaryReport<dim>> all = prepared;
    shared.share_out(context, conditions, all);
    reports.insert(reports.end(), all.begin(), all.end());
  }



  template class GridConditionTerm<2>;
  template class GridConditionTerm<3>;
} // namespace moraine
