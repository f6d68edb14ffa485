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
        x(dof) =
          conditions[entry.condition].increment(state.grid().node_position(
                                                  entry.node),
                                                t_start,
                                                t_target)[entry.component];
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
      reports.push_back({condition.name, {}, 0., 0., 0., 0.});
    if (conditions.empty())
      return reports;

    // The residual at x is known, unless x is not where Newton ended.
    LA::Vector difference(x);
    difference -= assembled_at;
    if (!assembled || difference.linfty_norm() > 0)
      assemble(x, false);

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
            const auto dof =
              state.grid().node_dof(node) + entries[last].component;
            if (state.grid().locally_owned().is_element(dof))
              force[entries[last].component] = -unbalanced(dof);
          }
        auto &report = reports[entries[first].condition];
        report.reaction += force;
        report.force_magnitude += force.norm();
        report.moment += conditions[entries[first].condition].motion.moment(
          state.grid().node_position(node) + state.nodal_increments()[node],
          force,
          t_target);
      }
    for (auto &report : reports)
      sum_over_ranks(report, state.grid().communicator());
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
