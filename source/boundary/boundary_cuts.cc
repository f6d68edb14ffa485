// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// Where a surface cuts the cells, and what of it they hold.

#include <moraine/boundary/implicit_boundary.h>

#include <moraine/geometry/covered_pieces.h>
#include <moraine/mesh/active_search.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /**
     * Segments are cut exactly; this many points integrate products of Q2. On a
     * line through a quadrilateral that is no parallelogram functions are no
     * polynomials; there twice as many are exact to about round-off.
     */
    constexpr unsigned int n_gauss_points = 4;



    /** Pieces whose normals differ by more than 45 degrees meet in a corner. */
    constexpr double cosine_of_corner = 0.7071;



    /** Of the spread of a piece over the square of the size of its cell: below,
     * it is a place. */
    constexpr double spread_of_a_place = 1e-12;



    /** What counts of a place that no body is at. */
    constexpr double area_without_body = 1e-6;



    /** How far normals of one plane are apart at most. */
    constexpr double same_normal = 1e-6;



    template <int dim>
    unsigned int
    n_gauss_points_in(const CellVertices<dim> &cell)
    {
      const bool is_skewed =
        dim == 2 && (cell[0] - cell[1] - (cell[2] - cell[3])).norm() >
                      1e-12 * cell[0].distance(cell[3]);
      return is_skewed ? 2 * n_gauss_points : n_gauss_points;
    }



    /** Whether a plane with this @p normal is parallel to opposite faces of a
     * cell, on which its functions are those of a face. */
    template <int dim>
    bool
    is_along_faces(const CellVertices<dim> &cell, const Tensor<1, dim> &normal)
    {
      std::array<bool, dim> holds_edges; ///< that run along an axis
      for (unsigned int d = 0; d < dim; ++d)
        {
          holds_edges[d] = true;
          for (unsigned int v = 0; v < cell.size(); ++v)
            if (!((v >> d) & 1))
              {
                const Tensor<1, dim> edge = cell[v | (1 << d)] - cell[v];
                holds_edges[d]            = holds_edges[d] &&
                                 std::abs(edge * normal) <= 1e-8 * edge.norm();
              }
        }
      return std::count(holds_edges.begin(), holds_edges.end(), true) ==
             dim - 1;
    }



    /** The vertices of an active cell where its nodes are now. */
    template <int dim>
    CellVertices<dim>
    present_vertices(const GridSpace<dim> &space, const unsigned int cell)
    {
      const unsigned int *nodes = space.cell_nodes(cell);
      const unsigned int  k     = space.degree();
      CellVertices<dim>   vertices;
      for (unsigned int v = 0; v < vertices.size(); ++v)
        {
          unsigned int node = 0, stride = 1;
          for (unsigned int d = 0; d < dim; ++d, stride *= k + 1)
            node += ((v >> d) & 1) * k * stride;
          vertices[v] = space.node_position(nodes[node]);
        }
      return vertices;
    }
  } // namespace



  template <int dim>
  void
  ImplicitBoundary<dim>::find_pieces(const GridSpace<dim> &space,
                                     const double          search_tolerance)
  {
    const auto &tria    = space.mesh().triangulation();
    const Owner itself  = [](const auto &cell, const auto &) { return cell; };
    const Owner nearest = [&](const auto &cell, const auto &x) {
      return nearest_active_cell(space, cell, x, search_tolerance);
    };
    if (!space.nodes_moved())
      {
        for (const auto &cell : tria.active_cell_iterators())
          if (!space.is_active(cell))
            for (const CellIterator &owner : owners_in(cell, nearest))
              add_pieces(cell, vertices_of<dim>(cell), owner, nearest);
          else if (cell->is_locally_owned())
            add_pieces(cell, vertices_of<dim>(cell), cell, itself);
      }
    else
      // Cells without material stay where material once was: here those beside
      // it end a little beyond it.
      for (const auto &cell : tria.active_cell_iterators())
        if (cell->is_locally_owned() && space.is_active(cell))
          {
            const CellVertices<dim> vertices =
              present_vertices(space, cell->active_cell_index());
            add_pieces(cell, vertices, cell, itself);
            for (const unsigned int f : cell->face_indices())
              if (cell->at_boundary(f) || !space.is_active(cell->neighbor(f)))
                add_pieces(cell,
                           layer_beyond(f, vertices, search_tolerance),
                           cell,
                           itself);
          }
    std::stable_sort(boundary_points.begin(),
                     boundary_points.end(),
                     [](const auto &a, const auto &b) {
                       return a.cell < b.cell;
                     });
  }



  template <int dim>
  void
  ImplicitBoundary<dim>::number_points()
  {
    for (unsigned int q = 0; q < boundary_points.size(); ++q)
      boundary_points[q].number =
        q > 0 && boundary_points[q - 1].cell == boundary_points[q].cell ?
          boundary_points[q - 1].number + 1 :
          0;
  }



  template <int dim>
  void
  ImplicitBoundary<dim>::take_means(const GridSpace<dim> &space)
  {
    const unsigned int              n = shapes.n_nodes;
    std::vector<BoundaryPoint<dim>> means;
    std::vector<unsigned int>       mean_of;
    Shapes                          of_means;
    CellVertices<dim>               vertices;
    unsigned int                    first = 0; ///< of the cell
    of_means.n_nodes                      = n;
    for (unsigned int q = 0; q < boundary_points.size(); ++q)
      {
        const BoundaryPoint<dim> &point = boundary_points[q];
        if (means.empty() || means.back().cell != point.cell)
          {
            first    = means.size();
            vertices = present_vertices(space, point.cell);
          }
        const bool along = is_along_faces(vertices, point.normal);
        const auto same =
          along ? means.end() :
                  std::find_if(means.begin() + first,
                               means.end(),
                               [&](const auto &m) {
                                 return m.normal * point.normal >
                                          cosine_of_corner * m.normal.norm() &&
                                        !is_along_faces(vertices, m.normal);
                               });
        mean_of.push_back(same - means.begin());
        const double         *N      = &shapes.values[q * n];
        const Tensor<1, dim> *grad_N = &shapes.gradients[q * n];
        if (same == means.end())
          {
            means.push_back(point);
            of_means.values.insert(of_means.values.end(), N, N + n);
            of_means.gradients.insert(of_means.gradients.end(),
                                      grad_N,
                                      grad_N + n);
            continue;
          }
        same->JxW += point.JxW;
        same->body_area += point.body_area;
        const double share = point.JxW / same->JxW;
        same->x += share * (point.x - same->x);
        same->normal += share * (point.normal - same->normal);
        const std::size_t m = (same - means.begin()) * n;
        for (unsigned int a = 0; a < n; ++a)
          {
            of_means.values[m + a] += share * (N[a] - of_means.values[m + a]);
            of_means.gradients[m + a] +=
              share * (grad_N[a] - of_means.gradients[m + a]);
          }
      }
    for (BoundaryPoint<dim> &mean : means)
      mean.normal /= mean.normal.norm();
    if (kind.holds_slopes)
      find_slopes(means, mean_of);
    boundary_points = std::move(means);
    shapes          = std::move(of_means);
  }



  template <int dim>
  void
  ImplicitBoundary<dim>::find_slopes(
    const std::vector<BoundaryPoint<dim>> &means,
    const std::vector<unsigned int>       &mean_of)
  {
    const unsigned int                   n = shapes.n_nodes;
    std::vector<SymmetricTensor<2, dim>> spreads(means.size());
    for (unsigned int q = 0; q < boundary_points.size(); ++q)
      {
        const BoundaryPoint<dim> &mean     = means[mean_of[q]];
        const Tensor<1, dim>      distance = boundary_points[q].x - mean.x;
        spreads[mean_of[q]] += boundary_points[q].JxW / mean.JxW *
                               symmetrize(outer_product(distance, distance));
      }
    // What slides around a bend has a slope along the mean of its normals.
    std::vector<bool> is_bent(means.size(), false);
    if (is_roller())
      for (unsigned int q = 0; q < boundary_points.size(); ++q)
        if ((boundary_points[q].normal - means[mean_of[q]].normal).norm() >
            same_normal)
          is_bent[mean_of[q]] = true;
    std::vector<unsigned int> first_of = {0};
    for (unsigned int m = 0; m < means.size(); ++m)
      {
        const auto axes = eigenvectors(spreads[m]);
        for (unsigned int k = 0; k + 1 < dim && !is_bent[m]; ++k)
          if (axes[k].first > spread_of_a_place * means[m].h * means[m].h)
            held_slopes.all.push_back(
              {m, true, std::sqrt(axes[k].first) * axes[k].second, {}, {}, {}});
        first_of.push_back(held_slopes.all.size());
      }
    held_slopes.values.assign(held_slopes.all.size() * n, 0.);
    for (unsigned int q = 0; q < boundary_points.size(); ++q)
      {
        const BoundaryPoint<dim> &mean = means[mean_of[q]];
        for (unsigned int k = first_of[mean_of[q]];
             k < first_of[mean_of[q] + 1];
             ++k)
          {
            const Tensor<1, dim> &offset = held_slopes.all[k].offset;
            const double          share  = boundary_points[q].JxW / mean.JxW *
                                 ((boundary_points[q].x - mean.x) * offset) /
                                 offset.norm_square();
            for (unsigned int a = 0; a < n; ++a)
              held_slopes.values[k * n + a] += share * shapes.values[q * n + a];
          }
      }
  }



  template <int dim>
  bool
  ImplicitBoundary<dim>::holds_mean_in(
    const GridSpace<dim>                        &space,
    const typename GridSpace<dim>::CellIterator &cell,
    const double                                 t)
  {
    if (!how.augments ||
        !how.holds_means(space.degree(), is_curved_roller(), false))
      return false;
    if (!placed_at || (motion.moves() && *placed_at != t))
      place_at(t);
    const CellVertices<dim> vertices = vertices_of<dim>(cell);
    if (!at_start.may_touch(vertices))
      return false;
    std::vector<SurfacePoint<dim>> pieces;
    at_start.pieces(vertices, n_gauss_points_in<dim>(vertices), pieces);
    return std::any_of(pieces.begin(), pieces.end(), [&](const auto &piece) {
      return !is_along_faces(vertices, piece.normal);
    });
  }



  template <int dim>
  std::vector<typename ImplicitBoundary<dim>::CellIterator>
  ImplicitBoundary<dim>::owners_in(const CellIterator &cell,
                                   const Owner        &owner_of) const
  {
    std::vector<CellIterator> owners;
    const CellVertices<dim>   vertices = vertices_of<dim>(cell);
    if (!at_start.may_touch(vertices))
      return owners;
    std::vector<SurfacePoint<dim>> pieces;
    at_start.pieces(vertices, n_gauss_points_in<dim>(vertices), pieces);
    for (const SurfacePoint<dim> &piece : pieces)
      {
        const CellIterator owner = owner_of(cell, piece.x);
        if (owner.state() == IteratorState::valid &&
            owner->is_locally_owned() &&
            std::find(owners.begin(), owners.end(), owner) == owners.end())
          owners.push_back(owner);
      }
    return owners;
  }



  template <int dim>
  bool
  ImplicitBoundary<dim>::holds_beyond_bodies(const CellVertices<dim> &vertices,
                                             const Tensor<1, dim> &normal) const
  {
    return how.w_free == 0. && motion.moves() &&
           (!kind.holds_means || is_along_faces(vertices, normal));
  }



  template <int dim>
  std::vector<double>
  ImplicitBoundary<dim>::areas_at_bodies(
    const CellVertices<dim>                              &vertices,
    const unsigned int                                    n_gauss,
    const std::vector<SurfacePoint<dim>>                 &pieces,
    const std::function<bool(const SurfacePoint<dim> &)> &is_own,
    const std::function<bool(const SurfacePoint<dim> &)> &is_at_body,
    const std::function<bool(const SurfacePoint<dim> &)> &is_near_body) const
  {
    std::vector<double> areas;
    for (const auto &piece : pieces)
      areas.push_back(piece.JxW);
    if (std::none_of(pieces.begin(), pieces.end(), [&](const auto &piece) {
          return holds_beyond_bodies(vertices, piece.normal);
        }))
      return areas;
    std::vector<SurfacePoint<dim>> cut;
    add_kept_pieces<dim>(
      at_start,
      vertices,
      n_gauss,
      [&](const auto &piece) { return !is_own(piece) || is_at_body(piece); },
      cut);
    double at_bodies = 0, of_places = 0;
    for (const auto &piece : cut)
      if (is_own(piece))
        at_bodies += piece.JxW;
    std::vector<bool> has_body;
    for (const auto &piece : pieces)
      {
        has_body.push_back(is_own(piece) && is_at_body(piece));
        if (has_body.back())
          of_places += piece.JxW;
      }
    const bool is_gap =
      of_places == 0 && std::any_of(pieces.begin(), pieces.end(), is_near_body);
    for (unsigned int k = 0; k < areas.size(); ++k)
      if (!is_gap)
        areas[k] *= has_body[k] ? at_bodies / of_places : area_without_body;
    return areas;
  }



  template <int dim>
  void
  ImplicitBoundary<dim>::add_pieces(const CellIterator      &cell,
                                    const CellVertices<dim> &vertices,
                                    const CellIterator      &owner,
                                    const Owner             &owner_of)
  {
    if (!at_start.may_touch(vertices))
      return;
    const double h      = edge_of_cell(owner);
    const auto   is_own = [&](const SurfacePoint<dim> &piece) {
      return owner_of(cell, piece.x) == owner;
    };
    const auto is_at_body = [&](const SurfacePoint<dim> &piece) {
      return body.at(owner->active_cell_index(), piece.x, piece.normal, h);
    };
    const auto is_near_body = [&](const SurfacePoint<dim> &piece) {
      return body.near(owner->active_cell_index(), piece.x, piece.normal, h);
    };
    const auto is_held = [&](const SurfacePoint<dim> &piece) {
      return holds_beyond_bodies(vertices, piece.normal) || !is_own(piece) ||
             is_at_body(piece);
    };
    // The mesh as it was built decides, so that the points stay the same ones.
    const unsigned int n = n_gauss_points_in<dim>(vertices_of<dim>(cell));
    std::vector<SurfacePoint<dim>> pieces;
    add_kept_pieces<dim>(at_start, vertices, n, is_held, pieces);
    if (std::none_of(pieces.begin(), pieces.end(), is_own))
      {
        pieces.clear();
        at_start.pieces(vertices, n, pieces);
        if (std::none_of(pieces.begin(), pieces.end(), [&](const auto &piece) {
              return is_own(piece) && is_near_body(piece);
            }))
          return;
      }
    const std::vector<double> of_bodies =
      areas_at_bodies(vertices, n, pieces, is_own, is_at_body, is_near_body);
    for (unsigned int k = 0; k < pieces.size(); ++k)
      {
        const SurfacePoint<dim> &piece = pieces[k];
        // Where a cell has folded it has no material, and areas can be
        // negative.
        if (!is_own(piece) || piece.JxW <= 0)
          continue;
        BoundaryPoint<dim> point;
        point.x         = piece.x;
        point.normal    = piece.normal;
        point.JxW       = piece.JxW;
        point.body_area = of_bodies[k];
        point.cell      = owner->active_cell_index();
        point.h         = h;
        point.depth     = h;
        boundary_points.push_back(point);
      }
  }



  template <int dim>
  void
  ImplicitBoundary<dim>::evaluate_shapes(const GridSpace<dim> &space)
  {
    shapes.n_nodes = space.nodes_per_cell();
    shapes.values.resize(boundary_points.size() * shapes.n_nodes);
    shapes.gradients.resize(boundary_points.size() * shapes.n_nodes);
    for (unsigned int q = 0; q < boundary_points.size(); ++q)
      {
        const auto &point = boundary_points[q];
        moraine::evaluate_shapes(space,
                                 point.cell,
                                 point.x,
                                 &shapes.values[q * shapes.n_nodes],
                                 &shapes.gradients[q * shapes.n_nodes]);
      }
  }



#define INSTANTIATE(dim)                                                   \
  template void ImplicitBoundary<dim>::find_pieces(const GridSpace<dim> &, \
                                                   const double);          \
  template void ImplicitBoundary<dim>::number_points();                    \
  template void ImplicitBoundary<dim>::take_means(const GridSpace<dim> &); \
  template bool ImplicitBoundary<dim>::holds_mean_in(                      \
    const GridSpace<dim> &,                                                \
    const GridSpace<dim>::CellIterator &,                                  \
    const double);                                                         \
  template void ImplicitBoundary<dim>::evaluate_shapes(const GridSpace<dim> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
