// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_assembly_mean_dilatation_h
#define moraine_assembly_mean_dilatation_h

#include <moraine/material/spectral.h>
#include <moraine/state/trial_points.h>

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

#include <vector>

namespace moraine
{
  /**
   * What the means of cells do to forces and tangent, cell by cell: the
   * pressure p = tr(stress)/n of points, n = dim, works on the gradients of the
   * means,
   * @f[ f_a = -\sum_p w\, \mathrm{dev}\,\tau\, g_a
   *           - \sum_c P_c\, \bar g_{ca}, \qquad
   *     P_c = \sum_p w\, p\, \omega_{pc} . @f]
   * The exact derivative, with @f$c_d@f$ the deviatoric part of the tangent c
   * (InternalForce adds @f$g_a c_d\, g_b@f$ and what has no @f$\bar g@f$ in
   * it), @f$t = c : 1@f$ and @f$k = 1 : c : 1@f$, has in addition
   * @f[ \sum_c \tfrac1n (Q_{ca} \otimes \bar g_{cb} + \bar g_{ca} \otimes
   *       Q_{cb})
   *     + \sum_{cc'} k_{cc'}\, \bar g_{ca} \otimes \bar g_{c'b}
   *     + \sum_c P_c\, (\bar g_{ca} \otimes \bar g_{cb}
   *       - \bar g_{cb} \otimes \bar g_{ca}) @f]
   * @f[ Q_{ca} = \sum_p w\, \omega_{pc} (\mathrm{dev}\,t\, g_a
   *       + 2\, \mathrm{dev}\,\tau\, g_a), \qquad
   *     k_{cc'} = \sum_p w\, \omega_{pc} \omega_{pc'}
   *       \left(\tfrac{k}{n^2} + (\tfrac2n - 1)\, p\right), @f]
   * terms of @f$\tau@f$ and p at finite strain only. It is symmetric.
   */
  template <int dim>
  class MeanDilatation
  {
  public:
    /** For a run of points that @p trial has evaluated, until it evaluates
     * others; their block has @p n_nodes. */
    void
    begin(const TrialPoints<dim> &trial, const unsigned int n_nodes);

    /** Take the pressure of the i-th point.
     * @return what is left of its stress. */
    dealii::SymmetricTensor<2, 3>
    take_pressure(const unsigned int i);

    /** Take the part of @p c, the tangent of the i-th point, that changes with
     * the volume. @return what is left of it. */
    VoigtMatrix<dim>
    take_volumetric(const unsigned int i, const VoigtMatrix<dim> &c);

    /** A modulus of all points, @f$\lambda + 2\mu/n@f$ [stress]. */
    void
    add_modulus(const double modulus);

    /** Add to the forces, and if asked to the matrix. */
    void
    end(const bool                  tangent,
        dealii::Vector<double>     &force,
        dealii::FullMatrix<double> &matrix);

  private:
    /** The terms of Q and k. Changes Q. */
    void
    add_products(dealii::FullMatrix<double> &matrix);

    const TrialPoints<dim>             *trial   = nullptr;
    unsigned int                        n_nodes = 0;
    bool                                finite  = false;
    std::vector<double>                 P;
    std::vector<double>                 k; ///< of pairs of cells
    std::vector<dealii::Tensor<1, dim>> Q; ///< of cells and nodes
    std::vector<double>                 half;
  };



  /** Of a stress, p = tr/n in dim directions, taken off. */
  template <int dim>
  inline double
  take_mean(dealii::SymmetricTensor<2, 3> &stress)
  {
    double p = 0;
    for (unsigned int d = 0; d < dim; ++d)
      p += stress[d][d] / dim;
    for (unsigned int d = 0; d < dim; ++d)
      stress[d][d] -= p;
    return p;
  }
} // namespace moraine

#endif
