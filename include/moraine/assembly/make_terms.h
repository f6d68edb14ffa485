// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_assembly_make_terms_h
#define moraine_assembly_make_terms_h

#include <moraine/assembly/boundary_term.h>
#include <moraine/assembly/term.h>
#include <moraine/boundary/grid_condition.h>
#include <moraine/load/load.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace moraine
{
  /** Whether what has this name, in this section of a scene ("Boundaries",
   * "Grid conditions" or "Loads"), acts. */
  using IsActive =
    std::function<bool(const std::string &section, const std::string &name)>;

  template <int dim>
  using Terms = std::vector<std::unique_ptr<Term<dim>>>;

  /**
   * The terms of a solid body with what holds and loads it, all of which must
   * live longer than the terms. @p fictitious_stiffness is the fraction of
   * FictitiousStiffness, or 0 for none. With @p inertia points have mass, with
   * @p conserving internal forces are in the middle of the step. The
   * @p internal_force is theirs unless a method has its own. Those that are not
   * @p active, if that is given, get no term. Implicit boundaries end where
   * bodies of these @p shapes do; see BoundaryTerm.
   */
  template <int dim>
  Terms<dim>
  make_terms(std::vector<ImplicitBoundary<dim>>    &boundaries,
             const std::vector<GridCondition<dim>> &conditions,
             Loads<dim>                            &loads,
             const double                           fictitious_stiffness = 0.,
             const bool                             inertia        = false,
             const bool                             conserving     = false,
             std::unique_ptr<Term<dim>>             internal_force = {},
             const IsActive                        &active         = {},
             const ShapesOfBodies<dim>             &shapes         = {});
} // namespace moraine

#endif
