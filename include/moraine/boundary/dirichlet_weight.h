// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_boundary_dirichlet_weight_h
#define moraine_boundary_dirichlet_weight_h

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <vector>

namespace moraine
{
  /**
   * The Dirichlet function of an implicit boundary with band width δ (length),
   *
   *   d(φ) = 0 for φ < 0,  1 − (1 − φ/δ)² for 0 ≤ φ ≤ δ,  1 for φ > δ,
   *
   * and its integrals across the band, n = φ from 0 to δ
   * (Cortis et al. 2017, eq. 16).
   */
  class DirichletWeight
  {
  public:
    explicit DirichletWeight(const double delta);

    double
    width() const;

    double
    value(const double phi) const;

    /** d'(φ) (1/length); 0 outside the band, the limit from inside at φ = 0. */
    double
    derivative(const double phi) const;

    /** ∫ d dn = 2δ/3 */
    double
    integral_value() const;

    /** ∫ d² dn = 8δ/15 */
    double
    integral_value_squared() const;

    /** ∫ d' dn = 1 */
    static constexpr double
    integral_derivative()
    {
      return 1.;
    }

    /** ∫ d d' dn = 1/2 */
    static constexpr double
    integral_value_derivative()
    {
      return 0.5;
    }

    /** ∫ d'² dn = 4/(3δ) (1/length) */
    double
    integral_derivative_squared() const;

  private:
    double delta;
  };

  /** The constraint projection of a boundary that fixes everything: M = 1. */
  template <int dim>
  dealii::SymmetricTensor<2, dim>
  fixed_projection();

  /** One direction held: M = e⊗e with e = @p direction made unit. */
  template <int dim>
  dealii::SymmetricTensor<2, dim>
  direction_projection(const dealii::Tensor<1, dim> &direction);

  /** Q = n·C·n, the acoustic tensor: Q_ij = n_k C_kijl n_l. */
  template <int dim>
  dealii::SymmetricTensor<2, dim>
  normal_stiffness(const dealii::SymmetricTensor<4, dim> &C,
                   const dealii::Tensor<1, dim>          &n);

  /** One boundary as seen from a point. */
  template <int dim>
  struct BoundaryAtPoint
  {
    DirichletWeight                 weight;
    double                          phi;
    dealii::Tensor<1, dim>          grad_phi;
    dealii::SymmetricTensor<2, dim> M;
  };

  /**
   * The weighted basis D N_i at one point, in the manner of FEValues
   * (Cortis et al. 2017, eqs. 13–18):
   *
   *   D = Π_j [ 1 − (1 − d_j(φ_j)) M_j ]        (one factor for each boundary)
   *   ε(D N_i e_k) = B1_ik + B2_ik
   *   B1_ik = sym( D e_k ⊗ ∇N_i )               (the paper's D̄1 B̄1)
   *   B2_ik = sym( (∂_l D) e_k ⊗ e_l ) N_i      (D̄2 N); d' sym(M e_k ⊗ ∇φ) N_i
   *                                             for a single boundary
   *
   * M is taken as constant near the point. Factors of boundaries whose M do not
   * commute are multiplied in the order given.
   */
  template <int dim>
  class WeightedValues
  {
  public:
    /** Shape values and gradients (1/length) of the nodes of one stencil. */
    void
    reinit(const std::vector<double>                 &values,
           const std::vector<dealii::Tensor<1, dim>> &gradients,
           const std::vector<BoundaryAtPoint<dim>>   &boundaries);

    unsigned int
    n_shape_functions() const;

    /** D */
    const dealii::Tensor<2, dim> &
    weight() const;

    /** ∂D/∂x_l */
    const dealii::Tensor<2, dim> &
    weight_derivative(const unsigned int l) const;

    /** D N_i: column k is the displacement field of node i, component k. */
    dealii::Tensor<2, dim>
    value(const unsigned int i) const;

    dealii::SymmetricTensor<2, dim>
    B1(const unsigned int i, const unsigned int k) const;

    dealii::SymmetricTensor<2, dim>
    B2(const unsigned int i, const unsigned int k) const;

  private:
    std::vector<double>                     N;
    std::vector<dealii::Tensor<1, dim>>     grad_N;
    dealii::Tensor<2, dim>                  D;
    std::array<dealii::Tensor<2, dim>, dim> grad_D;
  };
} // namespace moraine

#endif
