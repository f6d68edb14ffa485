// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_basis_gimp_basis_h
#define moraine_basis_gimp_basis_h

#include <moraine/basis/basis.h>
#include <moraine/basis/cell_patch.h>
#include <moraine/basis/local_functions.h>

#include <moraine/points/seeding.h>

#include <string>
#include <vector>

namespace moraine
{
  /** How the boxes of GIMP follow a finite deformation. */
  enum class DomainUpdate
  {
    /** Not at all. */
    frozen,
    /**
     * @f$l_i = l_{0,i} U_{ii}@f$, @f$U = \sqrt{F^T F}@f$ (Charlton, Coombs and
     * Augarde 2017).
     */
    stretch,
    /**
     * The corners move with the grid; @f$l_i@f$ is half the distance in
     * direction i of the middles of two faces, and all are scaled so that the
     * volume of the box changes as the point's,
     * @f$\prod l_i = \det\Delta F \prod l_{n,i}@f$ (as the program cl-mpm
     * does).
     */
    corners
  };

  /**
   * Generalised interpolation (GIMP): the point is a box with half lengths
   * @f$l_p@f$, and its functions are the averages of the Q1 functions over the
   * box, @f$S_{ip} = \frac{1}{V_p}\int_{\Omega_p} N_i \,dx@f$ (Bardenhagen and
   * Kober 2004). Needs a mesh of equal boxes. At small strain boxes keep their
   * size. A half length may be one cell size at most, so that a box stays in
   * the cells that touch the point's; the part of a box outside the mesh is
   * cut off.
   */
  template <int dim>
  class GimpBasis : public Basis<dim>
  {
  public:
    inline static const typename FieldNames<dim>::Vector half_length_name{
      "half_length",
      "length"};

    /** Ask for what the basis stores with a point: `half_length`, and
     * `initial_half_length` if boxes are stretched. */
    static void
    request_fields(PointFields       &fields,
                   const DomainUpdate update = DomainUpdate::frozen)
    {
      fields.request(half_length_name);
      if (update == DomainUpdate::stretch)
        fields.request(initial_half_length_name);
    }

    /**
     * The sub-cells of @p seeder give the boxes of the points that it made
     * their shape. @p is_seeded says which bodies were seeded that way; the
     * others, all if left out, have points of their own (a file). With
     * @p split, boxes that grow too long are halved, see split_domains(); all
     * points are there, as they are at the start. Collective then.
     * @p name is the method's in messages. @p half_edges, as columns, of the
     * parts that such points of each body stand for, 0 where not known.
     * @throws InputError if the mesh is not a box of equal cells.
     */
    GimpBasis(const GridSpace<dim>    &space,
              const PointSet<dim>     &points,
              const CellSeeder<dim>   &seeder,
              const std::vector<bool> &is_seeded = {},
              const DomainUpdate       update    = DomainUpdate::frozen,
              const bool               split     = false,
              const std::string       &name      = "GIMP",
              const std::vector<dealii::Tensor<2, dim>> &half_edges = {});

    /**
     * Half lengths. Of a seeded point: its distance to the nearer face of its
     * sub-cell, so that the box never leaves the sub-cell and boxes of equally
     * spaced points tile a body whose faces follow the mesh; averages over a
     * box within one cell are the values at its centre, so at the start GIMP
     * integrates what points do. Of other points: a box of the point's volume,
     * with the proportions of the box around the part that it stands for, else
     * of a cell; at most half a cell.
     */
    void
    initialise_points(PointSet<dim> &points) const override;

    /**
     * @throws ComputationError if a box is longer than the limit.
     * @throws InputError if the mesh is no box of equal cells any more.
     */
    void
    mark_cells(std::vector<unsigned char> &active) override;

    bool
    batch_points() override;

    void
    evaluate(const unsigned int batch, StencilBlock<dim> &block) const override;

    void
    evaluate_parts(const unsigned int       batch,
                   const StencilBlock<dim> &block,
                   CellParts<dim>          &parts) const override;

    /** If corners are tracked: a half length would not be positive. */
    std::string
    failure_of(const std::vector<dealii::Tensor<1, dim>> &nodal_increments)
      const override;

    void
    move_domains(
      PointSet<dim>                             &points,
      const std::vector<dealii::Tensor<1, dim>> &nodal_increments,
      const std::vector<dealii::Tensor<2, dim>> &gradients) const override;

    /**
     * Halve boxes that grew longer than DomainTools::longest_edge and than
     * those of their body at the start, along the edge that is longest in cell
     * sizes of those whose halves have their middles in the mesh.
     */
    bool
    split_domains(PointSet<dim> &points) override;

    bool
    has_domains() const override
    {
      return true;
    }

    CellVertices<dim>
    domain_corners(const unsigned int p) const override;

  private:
    using HalfLength = PointField<dim, dealii::Tensor<1, dim>>;
    /** The cells that a box overlaps. */
    using Window = CellWindow<dim>;

    inline static const typename FieldNames<dim>::Vector
      initial_half_length_name{"initial_half_length", "length"};

    const BoxGrid<dim> &
    grid() const
    {
      return *this->space.mesh().box_grid();
    }

    /** Whether the cells gave a body its points. */
    bool
    is_of_cells(const unsigned int body) const
    {
      return body < is_seeded.size() && is_seeded[body];
    }

    /** The half lengths that initialise_points() gives a point. */
    dealii::Tensor<1, dim>
    first_half_length(const unsigned int point) const;

    /** The half lengths in cell sizes from which on split_domains() halves the
     * boxes of a body, by the points as they are at the start. Collective. */
    std::vector<double>
    limits_of_bodies() const;

    /** The edge that is longest in cell sizes, dim if no half length is above
     * @p limit of them; if one is sought @p to_halve, of those that may be. */
    unsigned int
    too_long_edge(const unsigned int point,
                  const double       limit,
                  const bool         to_halve = false) const;

    /** Whether the middle of a half of the box, cut across direction @p d, is
     * outside the mesh, or on its edge. */
    bool
    half_is_outside(const unsigned int point, const unsigned int d) const;

    /** Half lengths between middles of faces that moved with the grid. */
    dealii::Tensor<1, dim>
    tracked_half_length(
      const unsigned int                         point,
      const std::vector<dealii::Tensor<1, dim>> &nodal_increments) const;

    Window
    window_of(const unsigned int point) const;

    void
    append_batch(const Window &window);

    const std::string                         name;
    const CellNeighbours<dim>                 neighbours;
    const CellSeeder<dim>                     seeder;
    const std::vector<bool>                   is_seeded;
    const std::vector<dealii::Tensor<2, dim>> half_edges_of_body;
    const DomainUpdate                        update;
    const bool                                split;
    const HalfLength                          half_length_field;
    const HalfLength                          initial_half_length_field;
    const unsigned int                        half_length_offset;
    const std::vector<double>                 limits; ///< of limits_of_bodies()
    const LocalFunctions<dim>                 local_functions;
    std::vector<Window>                       windows;
  };
} // namespace moraine

#endif
