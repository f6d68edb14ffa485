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
   * The exact derivative has what InternalForce adds for the stress
   * @f$\mathrm{dev}\,\tau@f$ and, with @f$c_d@f$ the deviatoric part of the
   * tangent c and I the identity of symmetric tensors,
   * @f[ c_d - \tfrac2n (\mathrm{dev}\,\tau \otimes 1
   *     + 1 \otimes \mathrm{dev}\,\tau + p\, 1 \otimes 1) + 2 p\, I @f]
   * for the tangent, and, with @f$t = c : 1@f$ and @f$k = 1 : c : 1@f$,
   * @f[ \sum_c \tfrac1n (Q_{ca} \otimes \bar g_{cb} + \bar g_{ca} \otimes
   *       Q_{cb})
   *     + \sum_{cc'} k_{cc'}\, \bar g_{ca} \otimes \bar g_{c'b}
   *     + \sum_c P_c\, (\bar g_{ca} \otimes \bar g_{cb}
   *       - \bar g_{cb} \otimes \bar g_{ca}) @f]
   * @f[ Q_{ca} = \sum_p w\, \omega_{pc} (\mathrm{dev}\,t\, g_a
   *       + 2\, \mathrm{dev}\,\tau\, g_a), \qquad
   *     k_{cc'} = \sum_p w\, \omega_{pc} \omega_{pc'}
   *       \left(\tfrac{k}{n^2} + (\tfrac2n - 1)\, p\right), @f]
   * terms of @f$\tau@f$ and p at finite strain only. It is symmetric if c
   * is. Otherwise @f$t' = 1 : c@f$ stands for t where Q comes second.
   *
   * Sums over cells are for many points in few cells. Where that is less work,
   * a point takes @f$\hat g_a = \sum_c \omega_{pc}\, \bar g_{ca}@f$ itself
   * (Coupling), by which the terms of Q and k are
   * @f[ T g_a \otimes \hat g_b + \hat g_a \otimes T g_b
   *     + \kappa\, \hat g_a \otimes \hat g_b, \qquad
   *     T = \tfrac{w}{n} (\mathrm{dev}\,t + 2\, \mathrm{dev}\,\tau), \quad
   *     \kappa = w \left(\tfrac{k}{n^2} + (\tfrac2n - 1)\, p\right). @f]
   *
   * The matrix is filled for pairs a <= b of nodes, or for all pairs.
   *
   * Where the means are the part a of the change of volume of a point,
   * TrialPoints::mean_part(), a p is what works on their gradients,
   * @f$\tau - a p\, 1@f$ stands for @f$\mathrm{dev}\,\tau@f$ in the force
   * and in what InternalForce adds, @f$P_a^T c\, P_a@f$ with
   * @f$P_a = I - \frac an 1 \otimes 1@f$ for @f$c_d@f$, with
   * @f$-\frac{2a}n (\mathrm{dev}\,\tau \otimes 1 + 1 \otimes
   * \mathrm{dev}\,\tau + (2 - a)\, p\, 1 \otimes 1) + 2 a p\, I@f$, and
   * @f$a\, (P_a^T t + 2\, \mathrm{dev}\,\tau + 2 (1 - a)\, p\, 1)@f$ and
   * @f$a^2 k/n^2 + (2 a/n - 1)\, a p@f$ for what Q and k sum.
   */
  template <int dim>
  class MeanDilatation
  {
  public:
    /** What a point adds to the tangent by its own mean gradients. */
    struct Coupling
    {
      dealii::SymmetricTensor<2, dim> T;
      dealii::SymmetricTensor<2, dim> T_left;         ///< T of @f$1 : c@f$
      double                          modulus;        ///< @f$\kappa@f$
      const dealii::Tensor<1, dim>   *mean_gradients; ///< @f$\hat g@f$
    };

    /** For a run of points that @p trial has evaluated, until it evaluates
     * others; their block has @p n_nodes. */
    void
    begin(const TrialPoints<dim> &trial,
          const unsigned int      n_nodes,
          const bool              all_pairs);

    /** Take the pressure of the i-th point.
     * @return what is left of its stress. */
    dealii::SymmetricTensor<2, 3>
    take_pressure(const unsigned int i);

    /** Take the part of @p c, the tangent of the i-th point, that changes with
     * the volume. @return what InternalForce is to take for it. */
    VoigtMatrix<dim>
    take_volumetric(const unsigned int i, const VoigtMatrix<dim> &c);

    /** What the point taken last has to add itself; none if cells do. */
    const Coupling *
    coupling() const
    {
      return by_points ? &of_point : nullptr;
    }

    /** A modulus of all points, @f$\lambda + 2\mu/n@f$ [stress]. */
    void
    add_modulus(const double modulus, dealii::FullMatrix<double> &matrix);

    /** Add to the forces, and if asked to the matrix. */
    void
    end(const bool                  tangent,
        dealii::Vector<double>     &force,
        dealii::FullMatrix<double> &matrix);

  private:
    /** Find @f$\hat g@f$ of the i-th point. */
    void
    find_mean_gradients(const unsigned int i);

    /** Sum k of the i-th point, whose @f$\kappa@f$ is @p modulus. */
    void
    sum_moduli(const unsigned int i, const double modulus);

    /** Add @f$\omega_{pc} T g_a@f$ of the i-th point. */
    void
    add_to_cells(const unsigned int                     i,
                 const dealii::SymmetricTensor<2, dim> &T,
                 std::vector<dealii::Tensor<1, dim>>   &of_cells) const;

    /** The terms of P. */
    void
    add_pressures(dealii::FullMatrix<double> &matrix) const;

    /** The terms of Q and k, summed over cells. */
    void
    add_products(dealii::FullMatrix<double> &matrix);

    const TrialPoints<dim> *trial     = nullptr;
    unsigned int            n_nodes   = 0;
    bool                    finite    = false;
    bool                    by_points = false;
    bool                    all_pairs = false;
    Coupling                of_point;
    std::vector<double>     P;
    std::vector<double>     k; ///< of pairs of cells
    /** Of cells and nodes, over n; Q_left of @f$1 : c@f$, for all pairs. */
    std::vector<dealii::Tensor<1, dim>> Q, Q_left;
    /** Scratch of nodes: @f$\hat g@f$ or @f$\bar g_c@f$, and what it is
     * multiplied by. */
    std::vector<dealii::Tensor<1, dim>> mean_gradients, factors;
  };



  /** Of a stress, the part a of p = tr/n in dim directions, taken off. */
  template <int dim>
  inline double
  take_mean(dealii::SymmetricTensor<2, 3> &stress, const double a = 1.)
  {
    double p = 0;
    for (unsigned int d = 0; d < dim; ++d)
      p += a * stress[d][d] / dim;
    for (unsigned int d = 0; d < dim; ++d)
      stress[d][d] -= p;
    return p;
  }
} // namespace moraine

#endif
