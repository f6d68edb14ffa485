// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_basis_cpdi2_basis_h
#define moraine_basis_cpdi2_basis_h

#include <moraine/basis/cpdi_basis.h>

#include <algorithm>

namespace moraine
{
  /**
   * CPDI2 (Sadeghirad, Brannon and Guilkey 2013): the domain is a quadrilateral
   * or hexahedron whose corners move with the grid at finite strain,
   * @f$x_c \leftarrow x_c + \sum_i N_i(x_c) \Delta u_i@f$, and the volume of a
   * point changes as that of its domain. Corners that two domains share stay
   * together, inside the mesh. At small strain, where volumes and domains do
   * not change, they are shifted with their point.
   * @f[ w_c = \frac{1}{V} \int M_c \, dV, \qquad
   *     g_c = \frac{1}{V} \int \nabla M_c \, dV , @f]
   * with the multilinear functions @f$M_c@f$ of the corners. The place of a
   * point is moved by the average displacement and differs from the centroid
   * of its domain by the change of the weights in a step.
   */
  template <int dim>
  class Cpdi2Basis : public CpdiBasis<dim>
  {
  public:
    using CpdiBasis<dim>::CpdiBasis;
    using CpdiBasis<dim>::n_corners;

    /** Ask for `corner_1`, ..., the vectors @f$x_c@f$, lexicographic. */
    static void
    request_fields(PointFields &fields)
    {
      DomainTools::request_vectors<dim, n_corners>(fields, "corner");
    }

    /**
     * DomainTools::initial_domains(). Volumes become those of the domains
     * (they differ for Gauss points of full cells that are skewed; the sum over
     * a cell is the same), but for sub-cells that a body cuts.
     */
    void
    initialise_points(PointSet<dim> &points) const override;

    /** A domain would turn inside out: its volume would not be positive. */
    std::string
    failure_of(const std::vector<dealii::Tensor<1, dim>> &nodal_increments)
      const override;

    void
    move_domains(
      PointSet<dim>                             &points,
      const std::vector<dealii::Tensor<1, dim>> &nodal_increments,
      const std::vector<dealii::Tensor<2, dim>> &gradients) const override;

    CellVertices<dim>
    domain_corners(const unsigned int p) const override;

  private:
    void
    weights(const unsigned int      p,
            double                 *w,
            dealii::Tensor<1, dim> *g) const override
    {
      DomainTools::average_weights<dim>(domain_corners(p), w, g);
    }

    /** At the middles of edges: neighbours that are both halved stay together;
     * beside one that is not, corners hang on its edge and leave it by what the
     * grid's increments differ from linear along it. */
    DomainTools::Halves<dim>
    halve(PointSet<dim>     &points,
          const unsigned int lower,
          const unsigned int upper,
          const unsigned int d) const override;

    /** The corners at the end of a step. */
    CellVertices<dim>
    moved_corners(
      const unsigned int                         p,
      const std::vector<dealii::Tensor<1, dim>> &nodal_increments) const;

    void
    store_corners(PointSet<dim>           &points,
                  const unsigned int       p,
                  const CellVertices<dim> &corners) const
    {
      for (unsigned int c = 0; c < n_corners; ++c)
        std::copy_n(corners[c].begin_raw(), dim, points.values(p) + offsets[c]);
    }

    const bool finite_strain = DomainTools::finite_strain(this->points);
    const std::array<unsigned int, n_corners> offsets =
      DomainTools::offsets_of_vectors<dim, n_corners>(this->points.fields(),
                                                      "corner");
  };
} // namespace moraine

#endif
