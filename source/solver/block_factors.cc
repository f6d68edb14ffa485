// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/solver/block_factors.h>

#include <umfpack.h>

namespace moraine
{
  namespace
  {
    /** The smallest pivot over the largest, of scaled rows: what rounding
     * leaves of 0. */
    constexpr double no_pivot = 1e-13;



    struct Control
    {
      double values[UMFPACK_CONTROL];

      Control()
      {
        umfpack_di_defaults(values);
        values[UMFPACK_IRSTEP]   = 0;
        values[UMFPACK_ORDERING] = UMFPACK_ORDERING_METIS;
      }
    };
  } // namespace



  BlockFactors::BlockFactors(const Rows &rows)
    : indices(rows.begins.size() - 1)
    , values(indices.size())
  {
    // UMFPACK has columns: it factorises the transpose.
    const int     n = indices.size();
    const Control control;
    double        info[UMFPACK_INFO];
    void         *symbolic = nullptr, *numeric = nullptr;
    const int    *begins = rows.begins.data(), *columns = rows.columns.data();
    const double *entries = rows.values.data();
    int           status  = umfpack_di_symbolic(
      n, n, begins, columns, entries, &symbolic, control.values, nullptr);
    if (status == UMFPACK_OK)
      status = umfpack_di_numeric(
        begins, columns, entries, symbolic, &numeric, control.values, info);
    umfpack_di_free_symbolic(&symbolic);
    if (status == UMFPACK_OK && info[UMFPACK_RCOND] > no_pivot)
      factors.reset(numeric, [](void *f) { umfpack_di_free_numeric(&f); });
    else
      umfpack_di_free_numeric(&numeric);
  }



  void
  BlockFactors::solve(std::vector<double>       &x,
                      const std::vector<double> &b) const
  {
    const Control control;
    x.resize(b.size());
    umfpack_di_wsolve(UMFPACK_Aat,
                      nullptr,
                      nullptr,
                      nullptr,
                      x.data(),
                      b.data(),
                      factors.get(),
                      control.values,
                      nullptr,
                      indices.data(),
                      values.data());
  }
} // namespace moraine
