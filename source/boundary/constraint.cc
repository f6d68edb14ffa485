// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/boundary/constraint.h>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  SymmetricTensor<2, dim>
  Constraint<dim>::projection(const Tensor<1, dim> &normal) const
  {
    SymmetricTensor<2, dim> M;
    if (kind == roller)
      M = symmetrize(outer_product(normal, normal));
    else
      for (unsigned int d = 0; d < dim; ++d)
        M[d][d] = (kind == fixed || component[d]) ? 1. : 0.;
    return M;
  }



  template <int dim>
  std::string
  Constraint<dim>::name() const
  {
    if (kind != components)
      return kind == fixed ? "fixed" : "roller";
    std::string names;
    for (unsigned int d = 0; d < dim; ++d)
      if (component[d])
        names += (names.empty() ? "" : ", ") + std::string(1, "xyz"[d]);
    return names;
  }



  template struct Constraint<2>;
  template struct Constraint<3>;
} // namespace moraine
