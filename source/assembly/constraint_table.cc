// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/assembly/constraint_table.h>

#include <deal.II/base/mpi.h>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    using Line = AffineConstraints<double>::ConstraintLine;



    /** Keep of a tie what is prescribed, with weights of sum 1, if this is on
     * the way from the others to the tied unknown, or all.
     * @return whether it is */
    bool
    keep_prescribed(Line &tie, const AffineConstraints<double> &lines)
    {
      constexpr double round_off = 1e-9;
      Line::Entries    prescribed;
      double           sum = 0;
      for (const auto &[dof, weight] : tie.entries)
        if (lines.is_constrained(dof) &&
            lines.get_constraint_entries(dof)->empty())
          {
            prescribed.emplace_back(dof, weight);
            sum += weight;
          }
      if (sum < 1 - round_off)
        return false;
      for (auto &entry : prescribed)
        entry.second /= sum;
      tie.entries = prescribed;
      return true;
    }



    /** Add the forces of the unknowns of @p tied to those they are tied to,
     * which are @p relevant. */
    template <class Lines>
    void
    add_to_others(const Lines    &tied,
                  const IndexSet &relevant,
                  const IndexSet &left_out,
                  LA::Vector     &force)
    {
      LA::Vector sums;
      sums.reinit(force.locally_owned_elements(),
                  relevant,
                  force.get_mpi_communicator(),
                  true);
      for (const auto &line : tied)
        if (force.in_local_range(line.index) &&
            !left_out.is_element(line.index))
          for (const auto &[dof, weight] : line.entries)
            {
              const double f = weight * force(line.index);
              sums.add(1, &dof, &f);
            }
      sums.compress(VectorOperation::add);
      force += sums;
    }



    /** What distribute() of @p lines does; ranks need not be asked where no
     * unknown is tied to others. */
    void
    fill(const AffineConstraints<double> &lines,
         const bool                       has_ties,
         LA::Vector                      &x)
    {
      if (has_ties)
        return lines.distribute(x);
      const auto [begin, end] = x.local_range();
      double *values          = x.begin();
      for (const auto &line : lines.get_lines())
        if (begin <= line.index && line.index < end)
          values[line.index - begin] = line.inhomogeneity;
    }
  } // namespace



  void
  ConstraintTable::reinit(const IndexSet &relevant,
                          const MPI_Comm &communicator,
                          const AddLines &add_lines,
                          const bool      prescribed_take)
  {
    takes = prescribed_take;
    lines.clear();
    lines.reinit(relevant);
    set_values(add_lines);
    lines.copy_from(lines_with_values);
    for (const auto &line : lines_with_values.get_lines())
      lines.set_inhomogeneity(line.index, 0.);
    has_lines =
      Utilities::MPI::logical_or(lines.n_constraints() > 0, communicator);
    has_ties  = Utilities::MPI::logical_or(!ties.empty(), communicator);
    has_taken = Utilities::MPI::logical_or(taken_by_prescribed.n_elements() > 0,
                                           communicator);
  }



  void
  ConstraintTable::set_values(const AddLines &add_lines)
  {
    const IndexSet relevant = lines.get_local_lines();
    lines_with_values.clear();
    lines_with_values.reinit(relevant);
    add_lines(lines_with_values);
    ties.clear();
    taken_by_prescribed = IndexSet(relevant.size());
    for (const auto &line : lines_with_values.get_lines())
      if (!line.entries.empty())
        {
          ties.push_back(line);
          if (takes && keep_prescribed(ties.back(), lines_with_values))
            taken_by_prescribed.add_index(line.index);
        }
    taken_by_prescribed.compress();
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
  ConstraintTable::distribute(LA::Vector &x) const
  {
    fill(lines_with_values, has_ties, x);
  }



  void
  ConstraintTable::distribute_correction(LA::Vector &dx) const
  {
    fill(lines, has_ties, dx);
  }



  void
  ConstraintTable::condense(LA::Vector &force) const
  {
    if (has_ties)
      add_to_others(lines.get_lines(),
                    lines.get_local_lines(),
                    taken_by_prescribed,
                    force);
    lines.set_zero(force);
  }



  void
  ConstraintTable::hand_over_ties(LA::Vector &force) const
  {
    if (!has_ties)
      return;
    add_to_others(ties,
                  lines.get_local_lines(),
                  IndexSet(lines.get_local_lines().size()),
                  force);
    for (const auto &line : ties)
      if (force.in_local_range(line.index))
        force(line.index) = 0.;
  }
} // namespace moraine
