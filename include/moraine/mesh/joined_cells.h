// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_mesh_joined_cells_h
#define moraine_mesh_joined_cells_h

#include <deal.II/grid/tria.h>

#include <optional>
#include <utility>
#include <vector>

namespace moraine
{
  /**
   * Pairs of vertices on the boundary of the coarse cells that are the same
   * place: nearer than 1e-6 of the shortest edge that ends in either. The first
   * of a pair is the smallest index at that place.
   */
  template <int dim>
  std::vector<std::pair<unsigned int, unsigned int>>
  coincident_vertices(const dealii::Triangulation<dim> &cells);

  /**
   * Make one vertex of each pair of coincident_vertices() of @p cells, which
   * joins the cells there. Faces between cells have no boundary id any more;
   * the rest of the boundary keeps its ids, and curved cells stay curved.
   */
  template <int dim>
  void
  join_cells(const std::vector<std::pair<unsigned int, unsigned int>> &pairs,
             dealii::Triangulation<dim>                               &cells);

  /** The middle of a face without a boundary id (0) that lies, by the @p pairs
   * of coincident_vertices(), on another one without. */
  template <int dim>
  std::optional<dealii::Point<dim>>
  find_torn_face(
    const std::vector<std::pair<unsigned int, unsigned int>> &pairs,
    const dealii::Triangulation<dim>                         &cells);

  /** A vertex on the boundary that lies on a face with the boundary id 0, but
   * not at one of its vertices, so that two cells touch but share no face. */
  template <int dim>
  std::optional<dealii::Point<dim>>
  find_unmatched_vertex(const dealii::Triangulation<dim> &cells);
} // namespace moraine

#endif
