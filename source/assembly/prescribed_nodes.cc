// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// The part of MechanicsSystem that knows prescribed nodes.

#include <moraine/assembly/mechanics_system.h>

#include <deal.II/base/mpi.h>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  void
  MechanicsSystem<dim>::make_constraints()
  {
    constraints.clear();
    constraints.reinit(state.grid().locally_relevant());
    for (const auto &entry : prescribed.entries)
      constraints.add_line(state.grid().node_dof(entry.node) + entry.component);
    constraints.close();
  }



  template <int dim>
  void
  MechanicsSystem<dim>::initial_guess(LA::Vector &x) const
  {
    x.reinit(state.grid().locally_owned(), state.grid().communicator());
    for (const auto &entry : prescribed.entries)
      {
        const auto dof = state.grid().node_dof(entry.node) + entry.component;
        if (!state.grid().locally_owned().is_element(dof))
          continue;
        const Point<dim> &X     = state.grid().node_position(entry.node);
        const auto       &value = conditions[entry.condition].value;
        x(dof)                  = value(X, t_target)[entry.component] -
                 value(X, t_start)[entry.component];
      }
    x.compress(VectorOperation::insert);
  }



  template <int dim>
  void
  MechanicsSystem<dim>::apply_constraints(LA::Vector &dx) const
  {
    constraints.set_zero(dx);
  }



  template <int dim>
  std::vector<BoundaryReport<dim>>
  MechanicsSystem<dim>::report_grid_conditions(const LA::Vector &x)
  {
    std::vector<BoundaryReport<dim>> reports;
    for (const auto &condition : conditions)
      reports.push_back({condition.name, {}, 0., 0.});
    if (conditions.empty())
      return reports;

    // The residual at x is known, unless x is not where Newton ended.
    LA::Vector difference(x);
    difference -= assembled_at;
    if (!assembled || difference.linfty_norm() > 0)
      assemble(x, false);

    for (const auto &entry : prescribed.entries)
      {
        const auto dof = state.grid().node_dof(entry.node) + entry.component;
        if (state.grid().locally_owned().is_element(dof))
          reports[entry.condition].reaction[entry.component] -= unbalanced(dof);
      }
    for (auto &report : reports)
      report.reaction =
        Utilities::MPI::sum(report.reaction, state.grid().communicator());
    return reports;
  }



  template <int dim>
  std::vector<unsigned int>
  MechanicsSystem<dim>::n_prescribed_nodes() const
  {
    std::vector<unsigned int> n(conditions.size(), 0);
    const auto               *before = prescribed.entries.data();
    for (const auto &entry : prescribed.entries)
      {
        // The components of a node follow each other.
        if (state.grid().locally_owned().is_element(
              state.grid().node_dof(entry.node)) &&
            (&entry == before || entry.node != before->node ||
             entry.condition != before->condition))
          ++n[entry.condition];
        before = &entry;
      }
    Utilities::MPI::sum(n, state.grid().communicator(), n);
    return n;
  }



  template <int dim>
  void
  MechanicsSystem<dim>::check_prescribed_values(const double t) const
  {
    std::vector<bool> checked(conditions.size(), false);
    std::size_t       n_checked = 0;
    for (const auto &entry : prescribed.entries)
      if (!checked[entry.condition])
        {
          conditions[entry.condition].value(
            state.grid().node_position(entry.node), t);
          checked[entry.condition] = true;
          if (++n_checked == conditions.size())
            break;
        }
  }



#define INSTANTIATE(dim)                                                     \
  template void MechanicsSystem<dim>::make_constraints();                    \
  template void MechanicsSystem<dim>::initial_guess(LA::Vector &) const;     \
  template void MechanicsSystem<dim>::apply_constraints(LA::Vector &) const; \
  template std::vector<BoundaryReport<dim>>                                  \
  MechanicsSystem<dim>::report_grid_conditions(const LA::Vector &);          \
  template std::vector<unsigned int>                                         \
                MechanicsSystem<dim>::n_prescribed_nodes() const;            \
  template void MechanicsSystem<dim>::check_prescribed_values(const double)  \
    const;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
