// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_study_buckling_study_h
#define moraine_study_buckling_study_h

#include <moraine/study/study.h>

namespace moraine
{
  /**
   * Linear buckling of a scene, and of each case if it has choices `{{a|b}}`.
   * A run of small strain gives the stresses @f$\sigma@f$ at its end, and
   * ARPACK the smallest positive factors @f$\lambda@f$ (at most three) with
   *
   * @f[ K \varphi = -\lambda K_g \varphi, \qquad w^T K_g v =
   *   \int \sigma_{jk} (v_{i,j} w_{i,k} - 2 d_{ij} d'_{ik}) \,dV @f]
   *
   * and @f$d = \mathrm{sym}(\nabla v)@f$, @f$d' = \mathrm{sym}(\nabla w)@f$.
   * @f$K_g@f$ is what Jaumann's rate of Kirchhoff's stress adds to the tangent
   * (McMeeking and Rice 1975). K is the tangent at the end for an increment of
   * zero: material that yields unloads. Factors near the modulus over the
   * stress are of the material, not of the shape of a body. Points stay where
   * they are unless `Mesh after step` says otherwise.
   *
   * Keeps, in the output folder, study.csv with a row for each case and
   * summary.json, both rewritten after each.
   *
   * @return an exit code: done if no case failed.
   * @throw InputError for a mistake in the text of any case, for finite strain
   * or inertia, or if the folder holds results that may not be replaced.
   */
  int
  find_buckling_loads(const StudySetting &setting);
} // namespace moraine

#endif
