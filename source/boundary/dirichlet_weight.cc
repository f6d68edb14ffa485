// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/boundary/dirichlet_weight.h>
#include <moraine/core/exceptions.h>

#include <deal.II/base/exceptions.h>

namespace moraine
{
  using namespace dealii;

  DirichletWeight::DirichletWeight(const double delta)
    : delta(delta)
  {
    Assert(delta > 0., ExcMessage("The band width must be positive."));
  }

  double
  DirichletWeight::width() const
  {
    return delta;
  }

  double
  DirichletWeight::value(const double phi) const
  {
    if (phi < 0.)
      return 0.;
    if (phi > delta)
      return 1.;
    const double s = 1. - phi / delta;
    return 1. - s * s;
  }

  double
  DirichletWeight::derivative(const double phi) const
  {
    return phi < 0. || phi > delta ? 0. : 2. / delta * (1. - phi / delta);
  }

  double
  DirichletWeight::integral_value() const
  {
    return 2. * delta / 3.;
  }

  double
  DirichletWeight::integral_value_squared() const
  {
    return 8. * delta / 15.;
  }

  double
  DirichletWeight::integral_derivative_squared() const
  {
    return 4. / (3. * delta);
  }

  template <int dim>
  SymmetricTensor<2, dim>
  fixed_projection()
  {
    return unit_symmetric_tensor<dim>();
  }

  template <int dim>
  SymmetricTensor<2, dim>
  direction_projection(const Tensor<1, dim> &direction)
  {
    Assert(direction.norm() > 0., ExcMessage("A direction must not be zero."));
    return symmetrize(outer_product(direction, direction)) /
           direction.norm_square();
  }

  template <int dim>
  SymmetricTensor<2, dim>
  normal_stiffness(const SymmetricTensor<4, dim> &C, const Tensor<1, dim> &n)
  {
    SymmetricTensor<2, dim> Q;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = i; j < dim; ++j)
        for (unsigned int k = 0; k < dim; ++k)
          for (unsigned int l = 0; l < dim; ++l)
            Q[i][j] += n[k] * C[k][i][j][l] * n[l];
    return Q;
  }

  template <int dim>
  void
  WeightedValues<dim>::reinit(
    const std::vector<double>               &values,
    const std::vector<Tensor<1, dim>>       &gradients,
    const std::vector<BoundaryAtPoint<dim>> &boundaries)
  {
    AssertDimension(values.size(), gradients.size());
    N      = values;
    grad_N = gradients;
    D      = unit_symmetric_tensor<dim>();
    for (auto &derivative : grad_D)
      derivative.clear();
    for (const auto &boundary : boundaries)
      {
        const Tensor<2, dim> M       = boundary.M;
        const double         d       = boundary.weight.value(boundary.phi);
        const double         d_prime = boundary.weight.derivative(boundary.phi);
        const Tensor<2, dim> factor =
          static_cast<Tensor<2, dim>>(unit_symmetric_tensor<dim>()) -
          (1. - d) * M;
        for (unsigned int l = 0; l < dim; ++l)
          grad_D[l] =
            grad_D[l] * factor + d_prime * boundary.grad_phi[l] * (D * M);
        D = D * factor;
      }
  }

  template <int dim>
  unsigned int
  WeightedValues<dim>::n_shape_functions() const
  {
    return N.size();
  }

  template <int dim>
  const Tensor<2, dim> &
  WeightedValues<dim>::weight() const
  {
    return D;
  }

  template <int dim>
  const Tensor<2, dim> &
  WeightedValues<dim>::weight_derivative(const unsigned int l) const
  {
    return grad_D[l];
  }

  template <int dim>
  Tensor<2, dim>
  WeightedValues<dim>::value(const unsigned int i) const
  {
    return N[i] * D;
  }

  template <int dim>
  SymmetricTensor<2, dim>
  WeightedValues<dim>::B1(const unsigned int i, const unsigned int k) const
  {
    return symmetrize(outer_product(D * Point<dim>::unit_vector(k), grad_N[i]));
  }

  template <int dim>
  SymmetricTensor<2, dim>
  WeightedValues<dim>::B2(const unsigned int i, const unsigned int k) const
  {
    Tensor<2, dim> gradient;
    for (unsigned int a = 0; a < dim; ++a)
      for (unsigned int l = 0; l < dim; ++l)
        gradient[a][l] = N[i] * grad_D[l][a][k];
    return symmetrize(gradient);
  }

  template class WeightedValues<2>;
  template class WeightedValues<3>;
#define INSTANTIATE(dim)                                                  \
  template SymmetricTensor<2, dim>             fixed_projection<dim>();   \
  template decltype(direction_projection<dim>) direction_projection<dim>; \
  template decltype(normal_stiffness<dim>)     normal_stiffness<dim>;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
