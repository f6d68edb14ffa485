// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_geometry_carried_places_h
#define moraine_geometry_carried_places_h

#include <moraine/core/archive.h>
#include <moraine/geometry/covered_pieces.h>
#include <moraine/mesh/grid_space.h>

#include <deal.II/base/quadrature_lib.h>

#include <string>
#include <utility>
#include <vector>

namespace moraine
{
  /** Functions of the nodes of cells at places: for one place those of its
   * cell, or parts of those of several. */
  template <int dim>
  struct PlaceFunctions
  {
    std::vector<unsigned int> places; ///< numbers, ascending
    std::vector<unsigned int> cells;  ///< by active_cell_index()
    std::vector<double>       N;      ///< nodes_per_cell() for each of cells
    std::vector<dealii::Tensor<1, dim>> grad_N; ///< by the present position

    /** Add the functions of a cell at the place number @p k.
     * @return where to write @p n values, and as many gradients. */
    std::pair<double *, dealii::Tensor<1, dim> *>
    add(const unsigned int k, const unsigned int cell, const unsigned int n)
    {
      places.push_back(k);
      cells.push_back(cell);
      N.resize(N.size() + n);
      grad_N.resize(N.size());
      return {&N[N.size() - n], &grad_N[N.size() - n]};
    }
  };

  /**
   * Single places or those of a surface, on the material, which carries them
   * along: they move with the displacement increment of the grid. They are few
   * and known to all ranks.
   */
  template <int dim>
  class CarriedPlaces
  {
  public:
    struct Place
    {
      dealii::Point<dim>     x;
      double                 weight; ///< area it stands for; 1 for a single one
      dealii::Tensor<1, dim> normal = {}; ///< outward; none for a single one
      /** Cell whose functions it sees, if this rank owns it. */
      unsigned int active_cell_index = GridSpace<dim>::no_cell;
      /** Where it is in the mesh as the search knows it. */
      dealii::Point<dim> in_mesh = {};
    };

    /** How a place moves in a step. */
    struct Increment
    {
      dealii::Tensor<1, dim> u;
      dealii::Tensor<2, dim> gradient; ///< @f$\partial u_i/\partial x_j@f$
    };

    /** Add up what the ranks know of @p increments. */
    static void
    sum_over_ranks(std::vector<Increment> &increments,
                   const MPI_Comm         &communicator);

    explicit CarriedPlaces(std::vector<Place> places);

    /**
     * Find the cells of the places.
     * @return the numbers of those that are on no material, the same on all
     * ranks.
     */
    std::vector<unsigned int>
    find_cells(const GridSpace<dim> &space,
               const double          search_tolerance,
               const double          inward = 0.);

    /** Let places with cells, which are where they were in the mesh as it was
     * built, be where its nodes carried them so far; @p turn as in
     * prepare_move(). Collective. */
    void
    catch_up(const GridSpace<dim> &space, const bool turn = false);

    /** Leave out places by their numbers, ascending. */
    void
    remove(const std::vector<unsigned int> &numbers)
    {
      for (auto number = numbers.rbegin(); number != numbers.rend(); ++number)
        now.erase(now.begin() + *number);
    }

    void
    add(const CarriedPlaces &others)
    {
      now.insert(now.end(), others.now.begin(), others.now.end());
    }

    /** Of a line, let each half of the place @p k be one: k and k + 1. */
    void
    halve(const unsigned int k)
    {
      Place                       &place = now[k];
      const dealii::Tensor<1, dim> along =
        dealii::cross_product_2d(place.normal);
      const dealii::Tensor<1, dim> quarter = 0.25 * place.weight * along;
      place.weight *= 0.5;
      Place other = place;
      place.x -= quarter;
      place.in_mesh -= quarter;
      other.x += quarter;
      other.in_mesh += quarter;
      now.insert(now.begin() + k + 1, other);
    }

    /** Trial increments of all places. Collective. */
    std::vector<Increment>
    increments(
      const GridSpace<dim>                      &space,
      const std::vector<dealii::Tensor<1, dim>> &nodal_increments) const;

    /**
     * Find where the increments carry the places; through a mesh that stays,
     * if @p through_mesh. If they @p turn, areas and normals follow by Nanson's
     * formula, @f$n\,da = \det F\, F^{-T} n_0\,da_0@f$ with @f$F = 1 +
     * \nabla u@f$.
     */
    void
    prepare_move(const std::vector<Increment> &increments,
                 const bool                    through_mesh,
                 const bool                    turn);

    /** Let the places be where prepare_move() found them, if it was called. */
    void
    move() noexcept;

    /** The places, in @p group. */
    void
    write(Archive &archive, const std::string &group) const;

    void
    read(const Archive &archive, const std::string &group);

    void
    undo()
    {
      next.clear();
    }

    const std::vector<Place> &
    places() const
    {
      return now;
    }

  private:
    std::vector<Place> now;
    std::vector<Place> next; ///< if the trial is accepted
  };

  /** How densely the places of a surface lie. */
  enum class Spacing
  {
    for_cells,   ///< Gauss points of the parts in cells, exact for Q1 and Q2
    through_mesh ///< so that functions with kinks at any place are integrated
  };

  /**
   * The places of a surface in a mesh, the same on all ranks. What runs along a
   * side of the mesh, and beyond it by no more than a tenth of a cell, is in
   * it. If @p body is given, what is further from it than half a cell is left
   * out; see beside().
   *
   * @param surface any
   * @param mesh the whole of it
   * @param body the union of all; null if nothing is known of one
   * @param spacing for places that stay in their cells or leave them
   */
  template <int dim>
  std::vector<typename CarriedPlaces<dim>::Place>
  places_on(const Surface<dim>        &surface,
            const BackgroundMesh<dim> &mesh,
            const ShapePointer<dim>   &body    = nullptr,
            const Spacing              spacing = Spacing::for_cells);

  /**
   * The part of the area of a surface that is outside of a mesh by more than a
   * tenth of a cell, or beside no body, roughly; 0 for one without ends, or if
   * it is too thin for its length to say.
   *
   * @param surface any
   * @param mesh the whole of it
   * @param body the union of all; null if nothing is known of one
   */
  template <int dim>
  double
  share_outside(const Surface<dim>        &surface,
                const BackgroundMesh<dim> &mesh,
                const ShapePointer<dim>   &body = nullptr);

  /** The places of a side of a mesh, the same on all ranks: those of
   * @p of_whole_face, or finer ones on a face on which a body ends. Where
   * @p covers is given, those at a body. */
  template <int dim>
  std::vector<typename CarriedPlaces<dim>::Place>
  places_on_side(const BackgroundMesh<dim>         &mesh,
                 const dealii::types::boundary_id   side,
                 const Covers<dim>                 &covers = {},
                 const dealii::Quadrature<dim - 1> &of_whole_face =
                   dealii::QGauss<dim - 1>(3));
} // namespace moraine

#endif
