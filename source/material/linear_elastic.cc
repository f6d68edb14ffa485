// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/material/linear_elastic.h>

namespace moraine
{
  using namespace dealii;

  void
  LinearElastic::respond(const StepTime &,
                         const ArrayView<PrincipalState> &points) const
  {
    Tensor<2, 3> D;
    for (unsigned int A = 0; A < 3; ++A)
      for (unsigned int B = 0; B < 3; ++B)
        D[A][B] = stiffness.lambda + (A == B ? 2 * stiffness.mu : 0.);
    for (PrincipalState &point : points)
      {
        point.tangent = D;
        point.stress  = D * point.strain;
      }
  }
} // namespace moraine
