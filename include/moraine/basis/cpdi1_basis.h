// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_basis_cpdi1_basis_h
#define moraine_basis_cpdi1_basis_h

#include <moraine/basis/cpdi_basis.h>

namespace moraine
{
  /**
   * CPDI1: the domain is a parallelogram or parallelepiped
   * @f$x_p + \sum_i \pm r_i@f$ whose half edges follow the deformation,
   * @f$r_i \leftarrow \Delta F r_i@f$, at finite strain; at small strain they
   * stay as they are. With @f$R = (r_1, r_2[, r_3])@f$ and the signs
   * @f$s_c = \pm 1@f$ of a corner
   * @f[ w_c = 2^{-dim}, \qquad g_c = 2^{-dim} R^{-T} s_c . @f]
   * The domains of neighbours do not stay conforming: there are gaps and
   * overlaps.
   */
  template <int dim>
  class Cpdi1Basis : public CpdiBasis<dim>
  {
  public:
    using CpdiBasis<dim>::CpdiBasis;
    using CpdiBasis<dim>::n_corners;

    /** Ask for `half_edge_1`, ..., the vectors @f$r_i@f$. */
    static void
    request_fields(PointFields &fields)
    {
      DomainTools::request_vectors<dim, dim>(fields, "half_edge");
    }

    /**
     * Of DomainTools::initial_domains(): vectors from the point to the middles
     * of its sides, scaled so that the volume is the point's, in a sub-cell
     * that a body cuts that of the domain.
     */
    void
    initialise_points(PointSet<dim> &points) const override;

    void
    move_domains(
      PointSet<dim>                             &points,
      const std::vector<dealii::Tensor<1, dim>> &nodal_increments,
      const std::vector<dealii::Tensor<2, dim>> &gradients) const override;

    CellVertices<dim>
    domain_corners(const unsigned int p) const override
    {
      return DomainTools::parallelepiped(this->points.position(p),
                                         half_edges(p));
    }

  private:
    void
    weights(const unsigned int      p,
            double                 *w,
            dealii::Tensor<1, dim> *g) const override;

    DomainTools::Halves<dim>
    halve(PointSet<dim>     &points,
          const unsigned int lower,
          const unsigned int upper,
          const unsigned int d) const override;

    /** @f$R@f$ */
    dealii::Tensor<2, dim>
    half_edges(const unsigned int p) const;

    const std::array<unsigned int, dim> offsets =
      DomainTools::offsets_of_vectors<dim, dim>(this->points.fields(),
                                                "half_edge");
  };
} // namespace moraine

#endif
