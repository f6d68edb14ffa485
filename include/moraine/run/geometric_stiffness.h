// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_run_geometric_stiffness_h
#define moraine_run_geometric_stiffness_h

#include <moraine/run/model.h>

namespace moraine
{
  /**
   * The largest @f$|\mu|@f$ of
   *
   * @f[ K_g v = \mu K v, \qquad
   *   w^T K_g v = \int \sigma_{jk} (v_{i,j} w_{i,k} - 2 d_{ij} d'_{ik}) \,dV
   * @f]
   *
   * with K of the step and @f$d = \mathrm{sym}(\nabla v)@f$,
   * @f$d' = \mathrm{sym}(\nabla w)@f$: @f$K_g@f$ is what stress that turns with
   * the material (Jaumann's rate of Kirchhoff's stress) adds to the tangent
   * (McMeeking and Rice 1975). Of a strut under the force N it is
   * @f$N / N_{cr}@f$. The second part takes away what stress does to strain; it
   * leaves nothing of uniform pressure within a body that keeps its volume.
   *
   * Found by power iterations, from below. The residual at @p x is assembled
   * anew where the material is not linear.
   *
   * @param model in a step that is solved
   * @param x its increment
   * @param solver for K if the one of the model is not set up with it: the
   * material is not linear, or nothing was solved
   * @return 0 too if strain is finite or nothing moves, if there is no stress
   * or if K cannot be solved with. Collective.
   */
  template <int dim>
  double
  geometric_share(const Model<dim>             &model,
                  const LA::Vector             &x,
                  const LinearSolverParameters &solver);
} // namespace moraine

#endif
