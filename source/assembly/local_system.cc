// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/assembly/local_system.h>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  void
  LocalSystem<dim>::reinit(const State<dim>   &state,
                           const unsigned int *nodes,
                           const unsigned int  n_nodes,
                           const bool          tangent)
  {
    const unsigned int n = dim * n_nodes;
    this->nodes          = nodes;
    if (dofs.size() != n)
      {
        dofs.resize(n);
        nodal_increments.resize(n_nodes);
        force.reinit(n);
        matrix.reinit(n, n);
      }
    else
      {
        force = 0;
        if (tangent)
          matrix = 0;
      }
    for (unsigned int a = 0; a < n_nodes; ++a)
      {
        nodal_increments[a] = state.nodal_increments()[nodes[a]];
        const auto first    = state.grid().node_dof(nodes[a]);
        for (unsigned int c = 0; c < dim; ++c)
          dofs[dim * a + c] = first + c;
      }
  }



  template struct LocalSystem<2>;
  template struct LocalSystem<3>;
} // namespace moraine
