// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_basis_domain_tools_h
#define moraine_basis_domain_tools_h

#include <moraine/points/bodies.h>
#include <moraine/points/point_set.h>

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace moraine
{
  /** Tools shared by bases whose points have domains. */
  namespace DomainTools
  {
    /**
     * In cell sizes: longer edges are split where that is asked for. One point
     * for each cell, with domains that all reach equally far into two, would
     * not feel displacements that alternate from node to node; such modes grow
     * before domains are that long.
     */
    inline constexpr double longest_edge = 0.75;

    /** "point 7 at (1.5, 2)". */
    template <int dim>
    std::string
    name_of(const PointSet<dim> &points, const unsigned int p);

    /** Whether deformations are finite: a point carries its gradient. */
    template <int dim>
    bool
    finite_strain(const PointSet<dim> &points)
    {
      return points.fields()
        .find(FieldNames<dim>::deformation_gradient)
        .exists();
    }

    /**
     * Throw the @p message of the first rank that has one. Collective.
     * @throws ComputationError
     */
    void
    throw_first(const std::string &message, const MPI_Comm &communicator);

    /**
     * What the corners of a quadrilateral or hexahedron contribute to averages
     * over it, with its multilinear functions @f$M_c@f$,
     * @f[ w_c = \frac{1}{V} \int M_c \, dV, \qquad
     *     g_c = \frac{1}{V} \int \nabla M_c \, dV
     *         = \frac{1}{V} \frac{\partial V}{\partial x_c} , @f]
     * exactly by @f$2^{dim}@f$ Gauss points. Arrays hold 2^dim entries.
     * @return the volume @f$V@f$.
     */
    template <int dim>
    double
    average_weights(const CellVertices<dim> &corners,
                    double                  *w,
                    dealii::Tensor<1, dim>  *g);

    template <int dim>
    struct Region
    {
      double             volume;
      dealii::Point<dim> centroid;
    };

    /** Volume and centroid of a quadrilateral or hexahedron. */
    template <int dim>
    Region<dim>
    region_of(const CellVertices<dim> &corners)
    {
      double                 w[1 << dim];
      dealii::Tensor<1, dim> g[1 << dim];
      Region<dim>            region{average_weights<dim>(corners, w, g), {}};
      for (unsigned int c = 0; c < corners.size(); ++c)
        region.centroid += w[c] * corners[c];
      return region;
    }

    template <int dim>
    double
    volume(const CellVertices<dim> &corners)
    {
      return region_of<dim>(corners).volume;
    }

    /** Ask for n vectors "name_1", ..., lengths each.
     * @return where they stand among the values of a point. */
    template <int dim, std::size_t n>
    std::array<unsigned int, n>
    request_vectors(PointFields &fields, const std::string &name)
    {
      std::array<unsigned int, n> offsets;
      for (unsigned int i = 0; i < n; ++i)
        offsets[i] = fields
                       .request(typename FieldNames<dim>::Vector{
                         name + "_" + std::to_string(i + 1), "length"})
                       .offset();
      return offsets;
    }

    /** Where the vectors of request_vectors() stand in fields that have them.
     */
    template <int dim, std::size_t n>
    std::array<unsigned int, n>
    offsets_of_vectors(PointFields fields, const std::string &name)
    {
      return request_vectors<dim, n>(fields, name);
    }

    /** The corners @f$x + \sum_i \pm r_i@f$, @f$r_i@f$ the columns. */
    template <int dim>
    CellVertices<dim>
    parallelepiped(const dealii::Point<dim>     &x,
                   const dealii::Tensor<2, dim> &half_edges);

    /** The domain of a point that was just made. */
    template <int dim>
    struct InitialDomain
    {
      CellVertices<dim> corners;
      /** Whether it stands for what a body cuts from a sub-cell; its volume is
       * about that of the point, or less. */
      bool is_cut;
    };

    /**
     * The domains of points that were just made, in the order of the flat
     * numbering. A seeded point has the sub-cell of the cell it was made for.
     * Where the body cuts that, it is a box of the sub-cell's reference
     * coordinates around the point, with the point's volume or, if there is no
     * room for that, less: it stays in the sub-cell, because domains that
     * reach over the edge of their cell integrate no gradient exactly. Listed
     * points have the parallelepiped of PointList::half_edges or, if that is
     * zero, a square or cube along the axes with the volume of the point.
     */
    template <int dim>
    std::vector<InitialDomain<dim>>
    initial_domains(const PointSet<dim>                       &points,
                    const CellSeeder<dim>                     &seeder,
                    const std::vector<bool>                   &is_seeded,
                    const std::vector<dealii::Tensor<2, dim>> &half_edges);

    /** The halves of a quadrilateral or hexahedron, cut through the middles of
     * its edges in direction d; the lower one first. */
    template <int dim>
    std::array<CellVertices<dim>, 2>
    halves_of(const CellVertices<dim> &corners, const unsigned int d);

    /** Where the halves of a point are. */
    template <int dim>
    struct Halves
    {
      dealii::Tensor<1, dim> lower;             ///< from the whole's place
      dealii::Tensor<1, dim> upper;             ///< from the whole's place
      double                 upper_share = 0.5; ///< of the volume
    };

    /**
     * Split points in halves until none is too large. Halves share `volume` and
     * `initial_volume`; at finite strain they have the displacement
     * @f$u + (1 - F^{-1}) o@f$ of their place at the offset @f$o@f$ (off by
     * what @f$F@f$ was when displacements were reset), and the other values of
     * the whole. The lower half keeps the id; ids of the others begin at
     * PointSet::next_id(), in the order of the ids of the wholes over all
     * ranks, so they do not depend on the number of ranks.
     *
     * @param points to split; their numbering is void until the next search
     * @param split_direction the edge of point p that has to be halved, dim if
     * none
     * @param halve gives the points lower and upper, which are alike, the
     * domains of their halves, cut through edge d
     * @return whether any rank split a point. Collective.
     */
    template <int dim>
    bool
    split_points(
      PointSet<dim>                                           &points,
      const std::function<unsigned int(const unsigned int p)> &split_direction,
      const std::function<Halves<dim>(const unsigned int lower,
                                      const unsigned int upper,
                                      const unsigned int d)>  &halve);
  } // namespace DomainTools
} // namespace moraine

#endif
