// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/basis/cpdi1_basis.h>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  void
  Cpdi1Basis<dim>::initialise_points(PointSet<dim> &points) const
  {
    const auto domains = this->initial_domains(points);
    for (unsigned int p = 0; p < points.n_local(); ++p)
      {
        const auto    &corners = domains[p].corners;
        Tensor<2, dim> R; // rows: r_i
        for (unsigned int d = 0; d < dim; ++d)
          for (unsigned int c = 0; c < n_corners; ++c)
            R[d] += ((c >> d) & 1 ? 1. : -1.) / n_corners * corners[c];
        const double volume = domains[p].is_cut ?
                                DomainTools::volume<dim>(corners) :
                                points.volume(p);
        const double factor =
          std::pow(volume / (n_corners * determinant(R)), 1. / dim);
        for (unsigned int d = 0; d < dim; ++d)
          for (unsigned int i = 0; i < dim; ++i)
            points.values(p)[offsets[d] + i] = factor * R[d][i];
      }
  }



  template <int dim>
  Tensor<2, dim>
  Cpdi1Basis<dim>::half_edges(const unsigned int p) const
  {
    Tensor<2, dim> R;
    for (unsigned int d = 0; d < dim; ++d)
      for (unsigned int i = 0; i < dim; ++i)
        R[i][d] = this->points.values(p)[offsets[d] + i];
    return R;
  }



  template <int dim>
  void
  Cpdi1Basis<dim>::weights(const unsigned int p,
                           double            *w,
                           Tensor<1, dim>    *g) const
  {
    const Tensor<2, dim> inverse_R = invert(half_edges(p));
    for (unsigned int c = 0; c < n_corners; ++c)
      {
        Tensor<1, dim> signs;
        for (unsigned int d = 0; d < dim; ++d)
          signs[d] = (c >> d) & 1 ? 1 : -1;
        w[c] = 1. / n_corners;
        g[c] = (signs * inverse_R) / n_corners;
      }
  }



  template <int dim>
  void
  Cpdi1Basis<dim>::move_domains(
    PointSet<dim> &points,
    const std::vector<Tensor<1, dim>> &,
    const std::vector<Tensor<2, dim>> &gradients) const
  {
    if (!DomainTools::finite_strain(points))
      return;
    for (unsigned int p = 0; p < points.n_local(); ++p)
      {
        const Tensor<2, dim> R         = half_edges(p);
        const Tensor<2, dim> increment = gradients[p] * R;
        for (unsigned int d = 0; d < dim; ++d)
          for (unsigned int i = 0; i < dim; ++i)
            points.values(p)[offsets[d] + i] += increment[i][d];
      }
  }



  template <int dim>
  DomainTools::Halves<dim>
  Cpdi1Basis<dim>::halve(PointSet<dim>     &points,
                         const unsigned int lower,
                         const unsigned int upper,
                         const unsigned int d) const
  {
    DomainTools::Halves<dim> halves;
    for (unsigned int i = 0; i < dim; ++i)
      {
        for (const unsigned int p : {lower, upper})
          points.values(p)[offsets[d] + i] *= 0.5;
        halves.upper[i] = points.values(upper)[offsets[d] + i];
      }
    halves.lower = -halves.upper;
    return halves;
  }



  template class Cpdi1Basis<2>;
  template class Cpdi1Basis<3>;
} // namespace moraine
