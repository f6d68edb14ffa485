// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_assembly_bodies_of_nodes_h
#define moraine_assembly_bodies_of_nodes_h

#include <moraine/state/state.h>

#include <vector>

namespace moraine
{
  /** The body that each node and each unknown belongs to: of those that touch
   * it, the stiffest. */
  struct BodiesOfNodes
  {
    std::vector<unsigned int> of_node;
    /** Of the owned unknowns, in order; empty if there is one body. */
    std::vector<unsigned int> of_unknown;
  };

  /** Collective. */
  template <int dim>
  BodiesOfNodes
  find_bodies_of_nodes(const State<dim> &state, const unsigned int n_bodies);
} // namespace moraine

#endif
