// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/boundary/contact_law.h>

#include <deal.II/base/symmetric_tensor.h>

#include <algorithm>
#include <limits>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  ContactResponse<dim>
  ContactLaw::response(const Tensor<1, dim> &trial,
                       const Tensor<1, dim> &normal,
                       const bool            was_open,
                       const double          round_off) const
  {
    ContactResponse<dim> result;
    const double         tau_n = trial * normal;
    const double         p_t =
      separates ? tensile_strength : std::numeric_limits<double>::infinity();
    if (tau_n > (was_open ? 0. : p_t) + round_off)
      {
        result.status = ContactStatus::open;
        return result;
      }
    const Tensor<1, dim> tangential = trial - tau_n * normal;
    const double         size       = tangential.norm();
    const double         bound =
      std::max(0., (was_open ? 0. : adhesion) - friction * tau_n);
    const Tensor<2, dim> one = unit_symmetric_tensor<dim>();
    const Tensor<2, dim> nn  = outer_product(normal, normal);
    if (!rubs())
      {
        result = {tau_n * normal, nn, ContactStatus::slip};
        return result;
      }
    if (size <= bound)
      {
        result = {trial, one, ContactStatus::stick};
        return result;
      }
    const Tensor<1, dim> m = tangential / size;
    result.status          = ContactStatus::slip;
    result.traction        = tau_n * normal + bound * m;
    result.derivative = nn + bound / size * (one - nn - outer_product(m, m));
    if (bound > 0.)
      result.derivative -= friction * outer_product(m, normal);
    return result;
  }



#define INSTANTIATE(dim)                                                     \
  template ContactResponse<dim> ContactLaw::response(const Tensor<1, dim> &, \
                                                     const Tensor<1, dim> &, \
                                                     const bool,             \
                                                     const double) const;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
