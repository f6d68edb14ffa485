// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_boundary_dirichlet_weight_h
#define moraine_boundary_dirichlet_weight_h

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
    value(const double phi) const;

    /** d'(φ) (1/length); 0 outside the band, the limit from inside at φ = 0. */
    double
    derivative(const double phi) const;

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
} // namespace moraine

#endif
