// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_basis_composite_functions_h
#define moraine_basis_composite_functions_h

#include <moraine/basis/basis.h>
#include <moraine/basis/local_functions.h>

#include <vector>

namespace moraine
{
  /**
   * The composite functions of one direction: Lagrange's polynomials of the
   * nodes of a cell, at @f$\xi = \pm 1@f$, and of the neighbours it has, at
   * @f$-3@f$ and @f$3@f$: cubic, quadratic with one neighbour, linear without.
   *
   * @param xi @f$\xi@f$ in the cell
   * @param below whether the node at -3 is there, @param above that at 3
   * @param N values of the nodes that are there, from the lowest
   * @param dN derivatives by @f$\xi@f$
   * @return the number of nodes, 2 to 4.
   */
  inline unsigned int
  composite_functions(const double xi,
                      const bool   below,
                      const bool   above,
                      double      *N,
                      double      *dN)
  {
    constexpr double   at[]  = {-3, -1, 1, 3};
    const unsigned int first = below ? 0 : 1, last = above ? 3 : 2;
    for (unsigned int a = first; a <= last; ++a)
      {
        double value = 1, slope = 0;
        for (unsigned int b = first; b <= last; ++b)
          if (b != a)
            {
              const double per_distance = 1 / (at[a] - at[b]);
              slope = (slope * (xi - at[b]) + value) * per_distance;
              value *= (xi - at[b]) * per_distance;
            }
        N[a - first]  = value;
        dN[a - first] = slope;
      }
    return last - first + 1;
  }

  /**
   * Composite (compound) functions on the patch of a cell and its neighbours,
   * products of composite_functions() for each direction (González Acosta et
   * al. 2017). The strain of points is recovered with their gradients; their
   * negative values are not for mass or forces.
   *
   * A neighbour belongs to the patch if it holds points. If a cell at a corner
   * or an edge of the patch holds none, the sides that meet there get the lower
   * function, so that all nodes of a patch belong to cells with points. Those
   * cells touch the point's, so that its rank knows their nodes.
   */
  template <int dim>
  class CompositeBasis : public Basis<dim>
  {
  public:
    /** Needs a mesh of equal boxes. */
    CompositeBasis(const GridSpace<dim> &space, const PointSet<dim> &points)
      : Basis<dim>(space, points)
      , neighbours(space.mesh())
    {}

    /** @throws InputError if the mesh was moved. Collective. */
    bool
    batch_points() override;

    void
    evaluate(const unsigned int batch, StencilBlock<dim> &block) const override;

  private:
    /** A cell and its patch. */
    struct Patch
    {
      std::array<unsigned int, dim> cell;
      CellWindow<dim>               window;
    };

    Patch
    patch_of(const std::array<unsigned int, dim> &cell) const;

    const CellNeighbours<dim>  neighbours;
    std::vector<unsigned char> holds_points; ///< by active_cell_index()
    std::vector<Patch>         patches;      ///< of batches
  };

  /** A @p PointBasis whose points recover their strain by composite functions:
   * DM-C with CellBasis, DM-GC with GimpBasis. */
  template <int dim, class PointBasis>
  class WithCompositeStrain : public PointBasis
  {
  public:
    template <typename... Arguments>
    WithCompositeStrain(const GridSpace<dim> &space,
                        const PointSet<dim>  &points,
                        Arguments &&...arguments)
      : PointBasis(space, points, std::forward<Arguments>(arguments)...)
      , composite(space, points)
    {}

    /** Collective. */
    bool
    batch_points() override
    {
      const bool changed = PointBasis::batch_points();
      composite.batch_points();
      return changed;
    }

    const Basis<dim> &
    strain_basis() const override
    {
      return composite;
    }

  private:
    CompositeBasis<dim> composite;
  };
} // namespace moraine

#endif
