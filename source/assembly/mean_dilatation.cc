// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/assembly/mean_dilatation.h>

#include <array>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** Add @f$c\, x y^T@f$, and if there is z @f$y z^T@f$, of vectors of nodes
     * to the upper triangle of node pairs or to @p all_pairs. */
    template <int dim, bool has_z>
    void
    add_pairs(const double                       c,
              const std::vector<Tensor<1, dim>> &x,
              const std::vector<Tensor<1, dim>> &y,
              const Tensor<1, dim>              *z,
              const bool                         all_pairs,
              FullMatrix<double>                &matrix)
    {
      const unsigned int n = x.size();
      for (unsigned int a = 0; a < n; ++a)
        {
          // A node of other points of the block only.
          if (!has_z && x[a].norm_square() == 0.)
            continue;
          const std::size_t first = all_pairs ? 0 : a;
          for (unsigned int i = 0; i < dim; ++i)
            {
              const double             x_ai = c * x[a][i], y_ai = y[a][i];
              double *DEAL_II_RESTRICT row = &matrix(dim * a + i, dim * first);
              for (std::size_t b = first; b < n; ++b, row += dim)
                for (unsigned int j = 0; j < dim; ++j)
                  row[j] += x_ai * y[b][j] + (has_z ? y_ai * z[b][j] : 0.);
            }
        }
    }



    /** Add @f$-\frac{2a}n (s \otimes 1 + 1 \otimes s
     * + (2 - a)\, p\, 1 \otimes 1) + 2 a p\, I@f$ of a stress s + p 1. */
    template <int dim>
    void
    add_stress_part(const SymmetricTensor<2, 3> &s,
                    const double                 p,
                    const double                 a,
                    VoigtMatrix<dim>            &c)
    {
      constexpr unsigned int n_v   = n_voigt<dim>;
      constexpr auto         pairs = voigt_pairs<dim>();
      for (unsigned int I = 0; I < n_v; ++I)
        {
          c[I][I] += (I < dim ? 2. : 1.) * a * p;
          const double s_I = s[pairs[I][0]][pairs[I][1]];
          for (unsigned int J = 0; J < dim; ++J)
            {
              c[I][J] -= 2. * a / dim * (s_I + (I < dim ? (2. - a) * p : 0.));
              c[J][I] -= 2. * a / dim * s_I;
            }
        }
    }
  } // namespace



  template <int dim>
  void
  MeanDilatation<dim>::begin(const TrialPoints<dim> &trial_,
                             const unsigned int      n_nodes_,
                             const bool              all_pairs_)
  {
    trial                = &trial_;
    n_nodes              = n_nodes_;
    all_pairs            = all_pairs_;
    finite               = trial_.is_finite();
    const unsigned int m = trial_.n_means();
    // A point of its own costs a product of nodes, a cell two.
    by_points = m > 1 && trial_.n_points() <= 2 * m;
    P.assign(m, 0.);
    Q.clear();
    Q_left.clear();
    k.assign(by_points ? 0 : m * m, 0.);
  }



  template <int dim>
  SymmetricTensor<2, 3>
  MeanDilatation<dim>::take_pressure(const unsigned int i)
  {
    SymmetricTensor<2, 3> stress = trial->stress(i);
    const double          w_p =
      trial->weight(i) * take_mean<dim>(stress, trial->mean_part(i));
    for (unsigned int c = 0; c < P.size(); ++c)
      P[c] += w_p * trial->mean_weight(i, c);
    return stress;
  }



  template <int dim>
  void
  MeanDilatation<dim>::find_mean_gradients(const unsigned int i)
  {
    constexpr unsigned int n_corners = CellMeanBlock<dim>::n_corners;
    mean_gradients.assign(n_nodes, Tensor<1, dim>());
    for (unsigned int c = 0; c < P.size(); ++c)
      {
        const double omega = trial->mean_weight(i, c);
        if (omega == 0.)
          continue;
        const Tensor<1, dim> *g      = trial->mean_gradients(c);
        const unsigned int   *places = trial->mean_places(c);
        for (unsigned int a = 0; a < n_corners; ++a)
          mean_gradients[places[a]] += omega * g[a];
      }
  }



  template <int dim>
  void
  MeanDilatation<dim>::sum_moduli(const unsigned int i, const double modulus)
  {
    const unsigned int m = P.size();
    for (unsigned int c = 0; c < m; ++c)
      for (unsigned int d = 0; d < m; ++d)
        k[c * m + d] +=
          modulus * trial->mean_weight(i, c) * trial->mean_weight(i, d);
  }



  template <int dim>
  VoigtMatrix<dim>
  MeanDilatation<dim>::take_volumetric(const unsigned int      i,
                                       const VoigtMatrix<dim> &c)
  {
    constexpr unsigned int  n_v = n_voigt<dim>;
    const double            a   = trial->mean_part(i);
    std::array<double, n_v> t{}, t_left{}; // a c : 1, a 1 : c
    double                  k_1 = 0;
    for (unsigned int I = 0; I < n_v; ++I)
      for (unsigned int J = 0; J < dim; ++J)
        {
          t[I] += a * c[I][J];
          t_left[I] += a * c[J][I];
        }
    for (unsigned int I = 0; I < dim; ++I)
      k_1 += a * t[I];
    VoigtMatrix<dim> rest = c;
    for (unsigned int I = 0; I < n_v; ++I)
      for (unsigned int J = 0; J < n_v; ++J)
        rest[I][J] += (I < dim && J < dim ? k_1 / (dim * dim) : 0.) -
                      (J < dim ? t[I] / dim : 0.) -
                      (I < dim ? t_left[J] / dim : 0.);

    constexpr auto           pairs = voigt_pairs<dim>();
    SymmetricTensor<2, dim> &T = of_point.T, &T_left = of_point.T_left;
    for (unsigned int I = 0; I < n_v; ++I)
      {
        const double part                = I < dim ? k_1 / dim : 0.;
        T[pairs[I][0]][pairs[I][1]]      = t[I] - part;
        T_left[pairs[I][0]][pairs[I][1]] = t_left[I] - part;
      }
    double modulus = k_1 / (dim * dim);
    if (finite)
      {
        SymmetricTensor<2, 3> stress = trial->stress(i);
        const double          p      = take_mean<dim>(stress);
        modulus += (2. * a / dim - 1.) * a * p;
        add_stress_part<dim>(stress, p, a, rest);
        for (unsigned int d = 0; d < dim; ++d)
          for (unsigned int e = d; e < dim; ++e)
            {
              const double part =
                2. * a * (stress[d][e] + (d == e ? (1. - a) * p : 0.));
              T[d][e] += part;
              T_left[d][e] += part;
            }
      }
    const double w = trial->weight(i);
    T *= w / dim;
    T_left *= w / dim;
    of_point.modulus = w * modulus;
    if (by_points)
      {
        find_mean_gradients(i);
        of_point.mean_gradients = mean_gradients.data();
        return rest;
      }
    add_to_cells(i, T, Q);
    if (all_pairs)
      add_to_cells(i, T_left, Q_left);
    sum_moduli(i, of_point.modulus);
    return rest;
  }



  template <int dim>
  void
  MeanDilatation<dim>::add_to_cells(
    const unsigned int             i,
    const SymmetricTensor<2, dim> &T,
    std::vector<Tensor<1, dim>>   &of_cells) const
  {
    const Tensor<1, dim> *g = trial->grad_N(i);
    const unsigned int    m = P.size();
    if (of_cells.empty())
      of_cells.assign(m * n_nodes, Tensor<1, dim>());
    for (unsigned int a = 0; a < n_nodes; ++a)
      {
        const Tensor<1, dim> T_g = T * g[a];
        for (unsigned int c = 0; c < m; ++c)
          of_cells[c * n_nodes + a] += trial->mean_weight(i, c) * T_g;
      }
  }



  template <int dim>
  void
  MeanDilatation<dim>::add_modulus(const double        modulus,
                                   FullMatrix<double> &matrix)
  {
    for (unsigned int i = 0; i < trial->n_points(); ++i)
      {
        const double w_k = trial->weight(i) * modulus;
        if (!by_points)
          {
            sum_moduli(i, w_k);
            continue;
          }
        find_mean_gradients(i);
        add_pairs<dim, false>(
          w_k, mean_gradients, mean_gradients, nullptr, all_pairs, matrix);
      }
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
      }
    if (tangent && finite)
      add_pressures(matrix);
    if (tangent && !by_points)
      add_products(matrix);
  }



  template <int dim>
  void
  MeanDilatation<dim>::add_pressures(FullMatrix<double> &matrix) const
  {
    constexpr unsigned int n_corners = CellMeanBlock<dim>::n_corners;
    const unsigned int     n         = dim * n_nodes;
    for (unsigned int c = 0; c < P.size(); ++c)
      {
        const Tensor<1, dim> *g      = trial->mean_gradients(c);
        const unsigned int   *places = trial->mean_places(c);
        for (unsigned int a = 0; a < n_corners; ++a)
          for (unsigned int b = 0; b < n_corners; ++b)
            if (all_pairs || places[a] < places[b])
              {
                double *K = &matrix(dim * places[a], dim * places[b]);
                for (unsigned int i = 0; i < dim; ++i)
                  for (unsigned int j = i + 1; j < dim; ++j)
                    {
                      const double v =
                        P[c] * (g[a][i] * g[b][j] - g[a][j] * g[b][i]);
                      K[i * n + j] += v;
                      K[j * n + i] -= v;
                    }
              }
      }
  }



  template <int dim>
  void
  MeanDilatation<dim>::add_products(FullMatrix<double> &matrix)
  {
    constexpr unsigned int n_corners = CellMeanBlock<dim>::n_corners;
    const unsigned int     m         = P.size();
    for (unsigned int c = 0; c < m; ++c)
      {
        // Q_c + sum_c' k_cc' g_c'
        if (Q.empty())
          factors.assign(n_nodes, Tensor<1, dim>());
        else
          factors.assign(&Q[c * n_nodes], &Q[c * n_nodes] + n_nodes);
        mean_gradients.assign(n_nodes, Tensor<1, dim>());
        for (unsigned int d = 0; d < m; ++d)
          for (unsigned int b = 0; b < n_corners; ++b)
            {
              const Tensor<1, dim> &g = trial->mean_gradients(d)[b];
              factors[trial->mean_places(d)[b]] += k[c * m + d] * g;
              if (d == c)
                mean_gradients[trial->mean_places(c)[b]] = g;
            }
        if (Q.empty())
          add_pairs<dim, false>(
            1., factors, mean_gradients, nullptr, all_pairs, matrix);
        else
          add_pairs<dim, true>(1.,
                               factors,
                               mean_gradients,
                               &(all_pairs ? Q_left : Q)[c * n_nodes],
                               all_pairs,
                               matrix);
      }
  }



  template class MeanDilatation<2>;
  template class MeanDilatation<3>;
} // namespace moraine
