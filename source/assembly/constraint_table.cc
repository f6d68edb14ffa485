// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/assembly/constraint_table.h>

#include <deal.II/base/mpi.h>

namespace moraine
{
  using namespace dealii;

  void
  ConstraintTable::reinit(const IndexSet &relevant,
                          const MPI_Comm &communicator,
                          const AddLines &add_lines)
  {
    lines.clear();
    lines.reinit(relevant);
    set_values(add_lines);
    lines.copy_from(lines_with_values);
    bool ties = false;
    for (const auto &line : lines_with_values.get_lines())
      {
        lines.set_inhomogeneity(line.index, 0.);
        ties = ties || !line.entries.empty();
      }
    has_lines =
      Utilities::MPI::logical_or(lines.n_constraints() > 0, communicator);
    has_ties = Utilities::MPI::logical_or(ties, communicator);
  }



  void
  ConstraintTable::set_values(const AddLines &add_lines)
  {
    const IndexSet relevant = lines.get_local_lines();
    lines_with_values.clear();
    lines_with_values.reinit(relevant);
    add_lines(lines_with_values);
    lines_with_values.close();
  }



  bool
  ConstraintTable::any_values(const MPI_Comm &communicator) const
  {
    bool any = false;
    for (const auto &line : lines_with_values.get_lines())
      any = any || line.inhomogeneity != 0.;
    return Utilities::MPI::logical_or(any, communicator);
  }



  bool
  ConstraintTable::prescribes(const types::global_dof_index dof) const
  {
    return lines.is_constrained(dof) &&
           lines.get_constraint_entries(dof)->empty();
  }



  void
  ConstraintTable::condense(LA::Vector &force) const
  {
    if (has_ties)
      {
        const LA::Vector uncondensed(force);
        for (const auto &line : lines.get_lines())
          if (uncondensed.in_local_range(line.index))
            for (const auto &[dof, weight] : line.entries)
              {
                const double f = weight * uncondensed(line.index);
                force.add(1, &dof, &f);
              }
        force.compress(VectorOperation::add);
      }
    lines.set_zero(force);
  }
} // namespace moraine
