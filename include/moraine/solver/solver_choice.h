// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_solver_solver_choice_h
#define moraine_solver_solver_choice_h

#include <moraine/core/archive.h>

#include <string>

namespace moraine
{
  /**
   * Chooses, matrix by matrix, between a factorisation and an iterative solver
   * by what each costs. Costs are counted in multigrid iterations with the same
   * matrix, not in seconds, so that a run can be repeated.
   */
  class SolverChoice
  {
  public:
    /** A multigrid hierarchy costs about as many iterations. */
    static constexpr double hierarchy_cost = 25;

    /** Up to @p direct_limit unknowns a matrix is always factorised. */
    SolverChoice(const unsigned int direct_limit, const unsigned int dim);

    /** Whether to factorise the next matrix, of @p n unknowns. */
    bool
    directly(const unsigned int n);

    /** What a hierarchy or iterations for the matrix took. */
    void
    spend(const double iterations)
    {
      spent += iterations;
    }

    /** Iterations that the matrix may still take: until it has cost twice as
     * much as a factorisation. */
    unsigned int
    allowed_iterations() const;

    /** The iterative solver failed, or took too much: factorise. */
    void
    give_up();

    /** Of the matrix now: whether what it took is more than a factorisation
     * would have cost. */
    bool
    too_expensive() const;

    /** Data set "solver/choice". */
    void
    write(Archive &archive) const;

    void
    read(const Archive &archive);

    /** What a factorisation of @p n unknowns costs: measured, for 4000 to 80
     * 000 unknowns, see doc/topics/solvers.md. */
    static double
    factorisation_cost(const unsigned int n, const unsigned int dim);

  private:
    const unsigned int direct_limit;
    const unsigned int dim;
    double             factorisation = 0; ///< cost for the matrix now
    double             spent         = 0; ///< on the matrix now
    double             usual         = 0; ///< of a matrix solved iteratively
    bool               stays_direct  = false;
    bool               failed        = false; ///< on the last attempt
    /** What factorisations may cost too much before the next attempt. */
    double patience = 0;
    double wasted   = 0;
  };
} // namespace moraine

#endif
