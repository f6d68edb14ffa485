// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_material_mohr_coulomb_return_h
#define moraine_material_mohr_coulomb_return_h

#include <moraine/material/soil_strength.h>

#include <algorithm>
#include <array>

namespace moraine
{
  /**
   * The exact return to Mohr and Coulomb's surface of one strength, in sorted
   * principal stresses @f$\sigma_1 \ge \sigma_2 \ge \sigma_3@f$. The surface
   * consists of the planes
   * @f[
   *   f_{ij} = (1+\sin\varphi)\,\sigma_i - (1-\sin\varphi)\,\sigma_j
   *            - 2c\cos\varphi \le 0, \quad i \ne j, \qquad
   *   r_i = \sigma_i - \sigma_t \le 0,
   * @f]
   * with flow along @f$b_{ij} = (1+\sin\psi)\, e_i - (1-\sin\psi)\, e_j@f$ and
   * @f$e_i@f$. With the normals of the active planes as rows of F, their flow
   * as rows of G and their strengths h, multipliers, stress and tangent are
   * @f[
   *   \Delta\lambda = (F D G^T)^{-1} (F\sigma^{tr} - h), \quad
   *   \sigma = \sigma^{tr} - D G^T \Delta\lambda, \quad
   *   \frac{\partial\sigma}{\partial\varepsilon} =
   *     D - D G^T (F D G^T)^{-1} F D .
   * @f]
   * A region is a set of active planes for sorted stresses. Its return is the
   * answer if no function and no multiplier has the wrong sign; there is one
   * answer. At points where more than three planes meet the multipliers are
   * not unique; there the plastic strain lies in the cone of all their flows,
   * bounded by the flows of two planes each: the same as a triple of planes
   * with the right signs.
   *
   * The apex @f$\sigma_i = c\cot\varphi@f$ is the answer in that cone too if
   * @f$\psi = 0@f$, where without a cut-off there is no other beyond it: so a
   * cut-off at the apex is none.
   */
  class MohrCoulombReturn
  {
  public:
    /** Regions, but for the first as they follow one another around it. */
    enum Region : unsigned int
    {
      plane,         ///< @f$f_{13}@f$
      edge_12,       ///< @f$f_{13}, f_{23}@f$: @f$\sigma_1 = \sigma_2@f$
      corner_12,     ///< @f$r_1, r_2, f_{13}, f_{23}@f$
      tension_edge,  ///< @f$r_1, r_2@f$
      vertex,        ///< @f$r_1, r_2, r_3@f$, or the apex: all
      tension,       ///< @f$r_1@f$
      tension_plane, ///< @f$r_1, f_{13}@f$
      corner_23,     ///< @f$r_1, f_{13}, f_{12}@f$
      edge_23,       ///< @f$f_{13}, f_{12}@f$: @f$\sigma_2 = \sigma_3@f$
      n_regions
    };

    MohrCoulombReturn() = default;

    MohrCoulombReturn(const SoilStrength &strength, const LameConstants &C);

    /** yield_function() before there is a return: the apex is in f. */
    static double
    yield_function(const SoilStrength &strength,
                   const double        largest,
                   const double        least)
    {
      return std::max((1 + strength.sin_phi) * largest -
                        (1 - strength.sin_phi) * least -
                        2 * strength.cohesion * strength.cos_phi,
                      largest - strength.tension);
    }

    /** The largest of all functions, of the largest and the least stress. */
    double
    yield_function(const double largest, const double least) const
    {
      return std::max(along_plane[0] * largest - along_plane[1] * least -
                        cohesion,
                      largest - limit);
    }

    /** -f at no stress, @f$2c\cos\varphi@f$. */
    double
    cohesion_term() const
    {
      return cohesion;
    }

    /** Return sorted @p stress. */
    Region
    project(dealii::Tensor<1, 3> &stress) const;

    const dealii::Tensor<2, 3> &
    tangent(const Region region) const
    {
      return tangents[region];
    }

    /** The elastic tangent, D. */
    const dealii::Tensor<2, 3> &
    elastic_tangent() const
    {
      return tangents[n_regions];
    }

    /** The derivative of the stress that is returned, where the trial stress is
     * kept and strength changes at the rate @p change. */
    dealii::Tensor<1, 3>
    derivative(const Region                region,
               const dealii::Tensor<1, 3> &trial,
               const dealii::Tensor<1, 3> &stress,
               const SoilStrength         &change) const;

  private:
    /** The normal, D times the flow, and the strength h of f and r. */
    struct Plane
    {
      dealii::Tensor<1, 3> normal, stress;
      double               strength;
    };

    /** One or two active planes; none: a point. */
    struct ActivePlanes
    {
      unsigned int                n_planes;
      std::array<unsigned int, 2> planes;
      dealii::Tensor<2, 2>        inverse; ///< of F D G^T
    };

    /** Return to a region. @return by how much that is not the answer, as a
     * stress. */
    double
    violation(const Region                region,
              const dealii::Tensor<1, 3> &trial,
              dealii::Tensor<1, 3>       &stress) const;

    double
    violation_at_point(const Region                region,
                       const dealii::Tensor<1, 3> &trial,
                       const dealii::Tensor<1, 3> &stress) const;

    /** Return to active planes. @return the multipliers */
    dealii::Tensor<1, 2>
    subtract(const ActivePlanes &active, dealii::Tensor<1, 3> &stress) const;

    LameConstants                                   C;
    SoilStrength                                    strength;
    std::array<double, 2>                           along_plane;
    double                                          cohesion; ///< 2c cos(phi)
    double                                          limit;    ///< of tension
    bool                                            cut_off;
    double                                          corner; ///< least stress
    std::array<Plane, 5>                            planes;
    std::array<ActivePlanes, n_regions>             active;
    std::array<dealii::Tensor<2, 3>, n_regions + 1> tangents;
  };
} // namespace moraine

#endif
