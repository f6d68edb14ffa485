// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/assembly/aggregation.h>

#include <deal.II/base/mpi.h>

#include <cmath>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  std::vector<Effect>
  Aggregation<dim>::effects(const StepContext<dim> &context) const
  {
    const GridSpace<dim> &space      = context.state.grid();
    const auto           &aggregates = *context.state.aggregates();
    unsigned int          n[]        = {0, 0};
    for (const auto &tie : aggregates.ties())
      n[0] += space.locally_owned().is_element(space.node_dof(tie.node));
    n[1] = aggregates.nodes_without_root().size();
    Utilities::MPI::sum(n, space.communicator(), n);
    std::string text = std::to_string(n[0]) + " nodes follow filled cells";
    if (n[1] > 0)
      text += ", " + std::to_string(n[1]) + " have none near";
    return {{"aggregation", n[0] + n[1] > 0 ? "cuts" : "", text}};
  }



  template <int dim>
  void
  Aggregation<dim>::constrain(const StepContext<dim>    &context,
                              AffineConstraints<double> &lines) const
  {
    constexpr double      round_off = 1e-12;
    const GridSpace<dim> &space     = context.state.grid();
    for (const auto &tie : context.state.aggregates()->ties())
      for (unsigned int c = 0; c < dim; ++c)
        {
          const auto dof = space.node_dof(tie.node) + c;
          if (lines.is_constrained(dof))
            continue;
          lines.add_line(dof);
          const unsigned int *nodes = space.cell_nodes(tie.root);
          for (unsigned int a = 0; a < tie.weights.size(); ++a)
            if (std::abs(tie.weights[a]) > round_off)
              lines.add_entry(dof,
                              space.node_dof(nodes[a]) + c,
                              tie.weights[a]);
        }
  }



  template class Aggregation<2>;
  template class Aggregation<3>;
} // namespace moraine
