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
    for (PrincipalState &point : points)
      {
        const auto [lambda, mu] = stiffness_at(point.internal);
        for (unsigned int A = 0; A < 3; ++A)
          for (unsigned int B = 0; B < 3; ++B)
            point.tangent[A][B] = lambda + (A == B ? 2 * mu : 0.);
        point.stress = point.tangent * point.strain;
      }
  }



  MaterialModel
  linear_elastic_model()
  {
    return {"linear elastic",
            "stress linear in strain; at finite strain Kirchhoff stress in "
            "logarithmic strain (Hencky)",
            elastic_keys(),
            [](MaterialInput &input) {
              return std::make_shared<LinearElastic>(read_elasticity(input));
            }};
  }
} // namespace moraine
