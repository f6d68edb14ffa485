// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_basis_cpdi_basis_h
#define moraine_basis_cpdi_basis_h

#include <moraine/basis/basis.h>
#include <moraine/basis/cell_patch.h>
#include <moraine/basis/domain_tools.h>
#include <moraine/points/bodies.h>

#include <algorithm>
#include <limits>
#include <string>
#include <tuple>
#include <vector>

namespace moraine
{
  /**
   * Convected particle domain interpolation (Sadeghirad, Brannon and Burghardt
   * 2011): the point is a quadrilateral or hexahedron, and its functions are
   * averages over it of the Q1 functions' interpolants between its corners
   * @f$x_c@f$,
   * @f[ S_{ip} = \sum_c w_c N_i(x_c), \qquad
   *     \nabla S_{ip} = \sum_c g_c N_i(x_c) . @f]
   * Works on any mesh of quadrilaterals or hexahedra with functions of
   * degree 1. Corners are looked for in the point's cell and the cells that
   * touch it first; a domain that reaches further samples the mesh too coarsely
   * and is counted, n_far_domains(). Where a corner is outside the mesh, the
   * functions of the nearest cell are continued linearly (CellPatch::locate()),
   * so that @f$\sum_i S_{ip} x_i@f$ is the centroid and @f$\sum_i x_i \otimes
   * \nabla S_{ip} = 1@f$ whatever the domain.
   *
   * Corners are searched once per step, in mark_cells(). The stencils combine
   * stored numbers: no search, no memory is asked for between two steps.
   */
  template <int dim>
  class CpdiBasis : public Basis<dim>
  {
  public:
    static constexpr unsigned int n_corners = 1u << dim;

    /**
     * @p seeder made the points of those @p bodies that have a shape; @p split
     * says whether split_domains() does anything; all points are there, as they
     * are at the start. Collective then. @p gradients_of_mesh : gradients are
     * means of the mesh's over the domains, those of evaluate_parts(), and not
     * interpolated between their corners; but where more than
     * most_left_out of a domain is in cells without a corner. The name of the
     * method, its value of the key 'Method', is for messages.
     * @throws InputError if the functions are not of degree 1.
     */
    CpdiBasis(const GridSpace<dim>         &space,
              const PointSet<dim>          &points,
              const CellSeeder<dim>        &seeder,
              const std::vector<Body<dim>> &bodies,
              const bool                    split             = false,
              const bool                    gradients_of_mesh = false,
              const std::string            &name              = "CPDI");

    void
    mark_cells(std::vector<unsigned char> &active) override;

    bool
    batch_points() override;

    void
    evaluate(const unsigned int batch, StencilBlock<dim> &block) const override;

    /** The mesh's gradients at places spread over each domain. What lies in
     * cells without a corner is left out, and the rest stands for it. */
    void
    evaluate_parts(const unsigned int       batch,
                   const StencilBlock<dim> &block,
                   CellParts<dim>          &parts) const override;

    /**
     * A place on the rim of a domain, or in it, sees the interpolants between
     * the corners of that domain, @f$\sum_c M_c(x) N_i(x_c)@f$; so do
     * tractions of Sadeghirad et al. (2011). With the functions of the cell
     * itself forces near faces of cells are not in balance with a uniform
     * stress. A place that is further from all domains than a tenth of their
     * length has the functions of its cell; so have all with the gradients of
     * the mesh, whose stresses are in balance with those.
     */
    PlaceFunctions<dim>
    functions_at(const std::vector<typename CarriedPlaces<dim>::Place> &places)
      const override;

    /**
     * Domains with an edge longer than DomainTools::longest_edge, but not
     * before they are longer than those of a full cell at the start or than all
     * that were listed with their body, or with a corner beyond the cells that
     * touch the point's are halved through their longest edge, unless they are
     * distorted or reach out of the mesh.
     */
    bool
    split_domains(PointSet<dim> &points) override;

    bool
    has_domains() const override
    {
      return true;
    }

    unsigned int
    n_far_domains() const override
    {
      return n_far;
    }

  protected:
    /** A domain that is no longer than a cell has no more of itself in a cell
     * that it reaches into across a vertex. */
    static constexpr double most_left_out = 0.25;

    /** @f$w_c@f$ and @f$g_c@f$ of a point. */
    virtual void
    weights(const unsigned int      p,
            double                 *w,
            dealii::Tensor<1, dim> *g) const = 0;

    /** What DomainTools::split_points() wants of a method. */
    virtual DomainTools::Halves<dim>
    halve(PointSet<dim>     &points,
          const unsigned int lower,
          const unsigned int upper,
          const unsigned int d) const = 0;

    /** DomainTools::initial_domains() of the points. */
    std::vector<DomainTools::InitialDomain<dim>>
    initial_domains(const PointSet<dim> &points) const;

    /** @f$\sum_i N_i(x_c) \Delta u_i@f$ of a corner, as found last. */
    dealii::Tensor<1, dim>
    corner_increment(
      const unsigned int                         p,
      const unsigned int                         c,
      const std::vector<dealii::Tensor<1, dim>> &nodal_increments) const;

    double
    function_weight(const unsigned int p, const unsigned int c) const
    {
      return function_weights[p * n_corners + c];
    }

  private:
    /** Cells of the corners of a point, sorted, each once. */
    struct CornerCells
    {
      std::array<unsigned int, n_corners> cells; ///< the rest is no_cell
      unsigned int                        n;

      unsigned int
      n_cells() const
      {
        return n;
      }

      bool
      operator<(const CornerCells &other) const
      {
        return cells < other.cells;
      }

      bool
      contains(const CornerCells &other) const
      {
        return std::includes(cells.begin(),
                             cells.begin() + n,
                             other.cells.begin(),
                             other.cells.begin() + other.n);
      }
    };

    /** The domain of this rank that is nearest to a place. */
    struct PlaceInDomain
    {
      double             distance = std::numeric_limits<double>::max();
      unsigned int       id       = dealii::numbers::invalid_unsigned_int;
      unsigned int       point    = dealii::numbers::invalid_unsigned_int;
      dealii::Point<dim> xi; ///< of the place, maybe beyond the domain

      bool
      operator<(const PlaceInDomain &other) const
      {
        return std::tie(distance, id) < std::tie(other.distance, other.id);
      }
    };

    std::vector<PlaceInDomain>
    nearest_domains(
      const std::vector<typename CarriedPlaces<dim>::Place> &places) const;

    /** The edges in cell sizes from which on split_domains() halves the domains
     * of a body, by the points as they are at the start. Collective. */
    std::vector<double>
    limits_of_bodies() const;

    /** Whether a domain with a point at @p x, in or near the @p cell, may be
     * halved through its edges in direction @p d: not if it is distorted, which
     * halves would inherit, or reaches out of the mesh. */
    bool
    can_be_halved(const CellVertices<dim>                     &corners,
                  const unsigned int                           d,
                  const dealii::Point<dim>                    &x,
                  const typename CellPatch<dim>::CellIterator &cell) const;

    /** The edge that has to be halved, dim if none.
     * @p patch is that of a cell that may be given anew. */
    unsigned int
    too_long_edge(const unsigned int                     p,
                  typename CellPatch<dim>::CellIterator &cell_of_patch,
                  CellPatch<dim>                        &patch) const;

    CornerCells
    cells_of(const unsigned int p) const;

    void
    append_batch(const CornerCells &cells);

    /** The cells of a batch, without parts of points. */
    void
    begin_parts(const unsigned int batch, CellParts<dim> &parts) const;

    /** Add the parts of a point, the i-th of its batch.
     * @return the part of its domain that is left out. */
    double
    add_parts_of(const unsigned int    point,
                 const unsigned int    i,
                 const CellPatch<dim> &patch,
                 CellParts<dim>       &parts) const;

    /** Gradients of all points, as evaluate() gives them. */
    void
    find_mesh_gradients();

    /** Add a place in a cell with a weight. */
    void
    add_part(const unsigned int i,
             const unsigned int cell,
             dealii::Point<dim> xi,
             const double       weight,
             CellParts<dim>    &parts) const;

    const CellSeeder<dim>               seeder;
    const bool                          split;
    const bool                          gradients_of_mesh;
    const std::string                   name;
    std::vector<bool>                   is_seeded;
    std::vector<dealii::Tensor<2, dim>> half_edges_of_body;
    std::vector<double>                 limits; ///< of limits_of_bodies()
    CellNeighbours<dim>                 neighbours;

    unsigned int n_far = 0;

    // Of corner c of point p, at p * n_corners + c.
    std::vector<unsigned int>           corner_cells;
    std::vector<double>                 corner_values; ///< n_corners for each
    std::vector<double>                 function_weights;
    std::vector<dealii::Tensor<1, dim>> gradient_weights;
    /** Place of the corner's cell among those of the batch. */
    std::vector<unsigned char> cell_in_batch;
    /** Where the nodes of the cells of a batch stand among its nodes. */
    std::vector<unsigned char> places_of_nodes;
    std::vector<unsigned int>  first_place; ///< of a batch
    std::vector<CornerCells>   cells_of_batches;
    /** That of the points, by active_cell_index(). */
    std::vector<unsigned int> cell_of_batch;
    /** Of batches, point major; none if they are interpolated. */
    std::vector<dealii::Tensor<1, dim>> mesh_gradients;
    std::vector<std::size_t>            first_gradient; ///< of a batch
  };
} // namespace moraine

#endif
