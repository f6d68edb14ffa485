// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/solver/solver_choice.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace moraine
{
  namespace
  {
    /** Of a matrix that multigrid suits, with its hierarchy. */
    constexpr double ordinary_cost = SolverChoice::hierarchy_cost + 20;

    /** Too few iterations say nothing. */
    constexpr double least_allowed = 50;
  } // namespace



  SolverChoice::SolverChoice(const unsigned int direct_limit,
                             const unsigned int dim)
    : direct_limit(direct_limit)
    , dim(dim)
  {}



  double
  SolverChoice::factorisation_cost(const unsigned int n, const unsigned int dim)
  {
    return dim == 2 ? 0.35 * std::sqrt(1. * n) : 0.03 * n;
  }



  bool
  SolverChoice::directly(const unsigned int n)
  {
    if (!stays_direct && spent > 0)
      {
        usual  = spent;
        failed = false;
        // The last matrix would have been factorised at a lower cost.
        stays_direct = too_expensive();
        patience     = 0;
      }
    factorisation = factorisation_cost(n, dim);
    spent         = 0;
    if (n <= direct_limit)
      return true;
    if (stays_direct)
      {
        const double expected = usual > 0 ? usual : ordinary_cost;
        wasted += std::max(0., factorisation - expected);
        // After a failure the next matrix may be better; else it is worth
        // another attempt where a factorisation became the dearer one.
        if (failed ? wasted > patience : factorisation > expected)
          {
            stays_direct = false;
            wasted       = 0;
          }
      }
    return stays_direct;
  }



  unsigned int
  SolverChoice::allowed_iterations() const
  {
    return std::max(0., std::max(least_allowed, 2 * factorisation) - spent);
  }



  bool
  SolverChoice::too_expensive() const
  {
    return spent > std::max(least_allowed, factorisation);
  }



  void
  SolverChoice::give_up()
  {
    // Each time in vain it waits twice as long.
    patience     = std::max(2 * patience, spent);
    stays_direct = true;
    failed       = true;
    usual        = 0;
    wasted       = 0;
    spent        = 0;
  }



  void
  SolverChoice::write(Archive &archive) const
  {
    archive.write("solver/choice",
                  std::vector<double>{factorisation,
                                      spent,
                                      usual,
                                      stays_direct ? 1. : 0.,
                                      failed ? 1. : 0.,
                                      patience,
                                      wasted});
  }



  void
  SolverChoice::read(const Archive &archive)
  {
    const std::vector<double> &values = archive.numbers("solver/choice");
    factorisation                     = values.at(0);
    spent                             = values.at(1);
    usual                             = values.at(2);
    stays_direct                      = values.at(3) != 0;
    failed                            = values.at(4) != 0;
    patience                          = values.at(5);
    wasted                            = values.at(6);
  }
} // namespace moraine
