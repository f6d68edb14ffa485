// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_study_buckling_study_h
#define moraine_study_buckling_study_h

#include <moraine/core/console.h>
#include <moraine/core/input_file.h>
#include <moraine/output/summary.h>
#include <moraine/study/study_report.h>

#include <mpi.h>

#include <string>
#include <vector>

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
   */
  class BucklingStudy
  {
  public:
    /**
     * Read all cases and make the folder.
     * @throw InputError for a mistake in the text of any of them, for finite
     * strain or inertia, or if the folder holds results and @p overwrite is not
     * set.
     */
    BucklingStudy(const InputFile   &input,
                  const std::string &folder,
                  const bool         overwrite,
                  const MPI_Comm    &communicator,
                  Console           &console);

    /** @return an exit code: done if no case failed. */
    int
    run();

  private:
    /** Run one case, keep its row and print its factors. */
    void
    add(const StudyCase &study_case);

    void
    write() const;

    const std::string                folder;
    const MPI_Comm                   communicator;
    Console                         &console;
    std::vector<StudyCase>           cases;
    std::vector<StudyResult>         rows;
    std::vector<std::vector<double>> factors; ///< of each row
  };
} // namespace moraine

#endif
