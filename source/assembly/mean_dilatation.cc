// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/assembly/mean_dilatation.h>

#include <array>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  void
  MeanDilatation<dim>::begin(const TrialPoints<dim> &trial_,
                             const unsigned int      n_nodes_)
  {
    trial                = &trial_;
    n_nodes              = n_nodes_;
    finite               = trial_.is_finite();
    const unsigned int m = trial_.n_means();
    P.assign(m, 0.);
    k.assign(m * m, 0.);
    Q.assign(m * n_nodes, Tensor<1, dim>());
  }



  template <int dim>
  SymmetricTensor<2, 3>
  MeanDilatation<dim>::take_pressure(const unsigned int i)
  {
    SymmetricTensor<2, 3> stress = trial->stress(i);
    const double          w_p    = trial->weight(i) * take_mean<dim>(stress);
    for (unsigned int c = 0; c < P.size(); ++c)
      P[c] += w_p * trial->mean_weight(i, c);
    return stress;
  }



  template <int dim>
  VoigtMatrix<dim>
  MeanDilatation<dim>::take_volumetric(const unsigned int      i,
                                       const VoigtMatrix<dim> &c)
  {
    constexpr unsigned int  n_v = n_voigt<dim>;
    std::array<double, n_v> t{};
    double                  k_1 = 0;
    for (unsigned int I = 0; I < n_v; ++I)
      for (unsigned int J = 0; J < dim; ++J)
        t[I] += c[I][J];
    for (unsigned int I = 0; I < dim; ++I)
      k_1 += t[I];
    VoigtMatrix<dim> rest = c;
    for (unsigned int I = 0; I < n_v; ++I)
      for (unsigned int J = 0; J < n_v; ++J)
        rest[I][J] += (I < dim && J < dim ? k_1 / (dim * dim) : 0.) -
                      (J < dim ? t[I] / dim : 0.) - (I < dim ? t[J] / dim : 0.);
    for (unsigned int I = 0; I < dim; ++I)
      t[I] -= k_1 / dim;

    constexpr auto          pairs = voigt_pairs<dim>();
    SymmetricTensor<2, dim> T;
    for (unsigned int I = 0; I < n_v; ++I)
      T[pairs[I][0]][pairs[I][1]] = t[I];
    double modulus = k_1 / (dim * dim);
    if (finite)
      {
        SymmetricTensor<2, 3> stress = trial->stress(i);
        const double          p      = take_mean<dim>(stress);
        modulus += (2. / dim - 1.) * p;
        for (unsigned int d = 0; d < dim; ++d)
          for (unsigned int e = d; e < dim; ++e)
            T[d][e] += 2. * stress[d][e];
      }
    const double          w = trial->weight(i);
    const Tensor<1, dim> *g = trial->grad_N(i);
    const unsigned int    m = P.size();
    for (unsigned int a = 0; a < n_nodes; ++a)
      {
        const Tensor<1, dim> T_g = w * (T * g[a]);
        for (unsigned int c_ = 0; c_ < m; ++c_)
          Q[c_ * n_nodes + a] += trial->mean_weight(i, c_) * T_g;
      }
    for (unsigned int c_ = 0; c_ < m; ++c_)
      for (unsigned int d = 0; d < m; ++d)
        k[c_ * m + d] +=
          w * modulus * trial->mean_weight(i, c_) * trial->mean_weight(i, d);
    return rest;
  }



  template <int dim>
  void
  MeanDilatation<dim>::add_modulus(const double modulus)
  {
    const unsigned int m = P.size();
    for (unsigned int i = 0; i < trial->n_points(); ++i)
      for (unsigned int c = 0; c < m; ++c)
        for (unsigned int d = 0; d < m; ++d)
          k[c * m + d] += trial->weight(i) * modulus *
                          trial->mean_weight(i, c) * trial->mean_weight(i, d);
  }



  template <int dim>
  void
  MeanDilatation<dim>::end(const bool          tangent,
                           Vector<double>     &force,
                           FullMatrix<double> &matrix)
  {
    constexpr unsigned int n_corners = CellMeanBlock<dim>::n_corners;
    for (unsigned int c = 0; c < P.size(); ++c)
      {
        const Tensor<1, dim> *g      = trial->mean_gradients(c);
        const unsigned int   *places = trial->mean_places(c);
        for (unsigned int a = 0; a < n_corners; ++a)
          for (unsigned int i = 0; i < dim; ++i)
            force[dim * places[a] + i] -= P[c] * g[a][i];
        for (unsigned int a = 0; tangent && finite && a < n_corners; ++a)
          for (unsigned int b = 0; b < n_corners; ++b)
            for (unsigned int i = 0; i < dim; ++i)
              for (unsigned int j = 0; j < dim; ++j)
                matrix(dim * places[a] + i, dim * places[b] + j) +=
                  P[c] * (g[a][i] * g[b][j] - g[a][j] * g[b][i]);
      }
    if (tangent)
      add_products(matrix);
  }



  template <int dim>
  void
  MeanDilatation<dim>::add_products(FullMatrix<double> &matrix)
  {
    constexpr unsigned int n_corners = CellMeanBlock<dim>::n_corners;
    const unsigned int     m = P.size(), n = dim * n_nodes;
    // Half of the matrix: Q_c / n and half of sum_c' k_cc' g_c', times g_c.
    half.assign(n * n, 0.);
    for (unsigned int c = 0; c < m; ++c)
      {
        Tensor<1, dim> *R = &Q[c * n_nodes];
        for (unsigned int a = 0; a < n_nodes; ++a)
          R[a] /= dim;
        for (unsigned int d = 0; d < m; ++d)
          for (unsigned int b = 0; b < n_corners; ++b)
            R[trial->mean_places(d)[b]] +=
              0.5 * k[c * m + d] * trial->mean_gradients(d)[b];
        const Tensor<1, dim> *g      = trial->mean_gradients(c);
        const unsigned int   *places = trial->mean_places(c);
        for (unsigned int a = 0; a < n_nodes; ++a)
          for (unsigned int i = 0; i < dim; ++i)
            {
              const double r   = R[a][i];
              double      *row = &half[(dim * a + i) * n];
              for (unsigned int b = 0; b < n_corners; ++b)
                for (unsigned int j = 0; j < dim; ++j)
                  row[dim * places[b] + j] += r * g[b][j];
            }
      }
    for (unsigned int r = 0; r < n; ++r)
      for (unsigned int s = 0; s < n; ++s)
        matrix(r, s) += half[r * n + s] + half[s * n + r];
  }



  template class MeanDilatation<2>;
  template class MeanDilatation<3>;
} // namespace moraine
