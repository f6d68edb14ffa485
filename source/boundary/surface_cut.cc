// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/boundary/surface_cut.h>

#include <moraine/geometry/covered_pieces.h>
#include <moraine/material/spectral.h>
#include <moraine/mesh/active_search.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>

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



    /** The share of its area that a place without a body counts with. */
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



    /** Finds the places of a surface in cells. */
    template <int dim>
    class CutFinder
    {
    public:
      using Cell  = typename GridSpace<dim>::CellIterator;
      using Piece = SurfacePoint<dim>;
      using Ask   = std::function<bool(const Piece &)>;
      /** The active cell whose functions hold a place of a cell, or none. */
      using Owner = std::function<Cell(const Cell &, const Point<dim> &)>;

      CutFinder(const GridSpace<dim>       &space,
                const MovedSurface<dim>    &surface,
                const double                search_tolerance,
                BodyBehind<dim>            &body,
                const bool                  holds_beyond_bodies,
                const bool                  of_means,
                std::vector<CutPoint<dim>> &points)
        : space(space)
        , surface(surface)
        , search_tolerance(search_tolerance)
        , body(body)
        , holds_beyond(holds_beyond_bodies)
        , of_means(of_means)
        , points(points)
      {}

      void
      find()
      {
        const Owner nearest = [this](const auto &cell, const auto &x) {
          return nearest_active_cell(space, cell, x, search_tolerance);
        };
        for (const auto &cell :
             space.mesh().triangulation().active_cell_iterators())
          if (space.nodes_moved())
            {
              if (cell->is_locally_owned() && space.is_active(cell))
                add_in_moved_cell(cell);
            }
          else if (!space.is_active(cell))
            for (const Cell &owner : owners_in(cell, nearest))
              add(cell, vertices_of<dim>(cell), owner, nearest);
          else if (cell->is_locally_owned())
            add(cell, vertices_of<dim>(cell), cell, itself);
        std::stable_sort(points.begin(),
                         points.end(),
                         [](const auto &a, const auto &b) {
                           return a.cell < b.cell;
                         });
      }

    private:
      static Cell
      itself(const Cell &cell, const Point<dim> &)
      {
        return cell;
      }

      /** Cells without material stay where material once was: here those beside
       * it end a little beyond it. */
      void
      add_in_moved_cell(const Cell &cell)
      {
        const CellVertices<dim> vertices =
          present_vertices(space, cell->active_cell_index());
        add(cell, vertices, cell, itself);
        for (const unsigned int f : cell->face_indices())
          if (cell->at_boundary(f) || !space.is_active(cell->neighbor(f)))
            add(cell,
                layer_beyond(f, vertices, search_tolerance),
                cell,
                itself);
      }

      /** The cells of this rank that own places of the surface in @p cell. */
      std::vector<Cell>
      owners_in(const Cell &cell, const Owner &owner_of) const
      {
        std::vector<Cell>       owners;
        const CellVertices<dim> vertices = vertices_of<dim>(cell);
        if (!surface.may_touch(vertices))
          return owners;
        std::vector<Piece> pieces;
        surface.pieces(vertices, n_gauss_points_in<dim>(vertices), pieces);
        for (const Piece &piece : pieces)
          {
            const Cell owner = owner_of(cell, piece.x);
            if (owner.state() == IteratorState::valid &&
                owner->is_locally_owned() &&
                std::find(owners.begin(), owners.end(), owner) == owners.end())
              owners.push_back(owner);
          }
        return owners;
      }

      /** Whether a piece in a cell holds also where no body is. */
      bool
      holds_beyond_bodies(const CellVertices<dim> &vertices,
                          const Tensor<1, dim>    &normal) const
      {
        return holds_beyond && (!of_means || is_along_faces(vertices, normal));
      }

      /**
       * Add places inside of @p vertices, @p cell or a layer at it, that are
       * those of @p owner, and have a body. It alone decides, for its rank
       * knows nothing of the bodies at other owners.
       */
      void
      add(const Cell              &cell,
          const CellVertices<dim> &vertices,
          const Cell              &owner,
          const Owner             &owner_of)
      {
        if (!surface.may_touch(vertices))
          return;
        const double h      = edge_of_cell(owner);
        const auto   index  = owner->active_cell_index();
        const auto   is_own = [&](const Piece &piece) {
          return owner_of(cell, piece.x) == owner;
        };
        const auto is_at_body = [&](const Piece &piece) {
          return body.at(index, piece.x, piece.normal, h);
        };
        const auto is_near_body = [&](const Piece &piece) {
          return body.near(index, piece.x, piece.normal, h);
        };
        const auto is_held = [&](const Piece &piece) {
          return holds_beyond_bodies(vertices, piece.normal) ||
                 !is_own(piece) || is_at_body(piece);
        };
        // The mesh as it was built decides, so that the points stay the same
        // ones.
        const unsigned int n = n_gauss_points_in<dim>(vertices_of<dim>(cell));
        std::vector<Piece> pieces;
        add_kept_pieces<dim>(surface, vertices, n, is_held, pieces);
        if (std::none_of(pieces.begin(), pieces.end(), is_own))
          {
            pieces.clear();
            surface.pieces(vertices, n, pieces);
            if (std::none_of(pieces.begin(),
                             pieces.end(),
                             [&](const auto &piece) {
                               return is_own(piece) && is_near_body(piece);
                             }))
              return;
          }
        const std::vector<double> of_bodies = areas_at_bodies(
          vertices, n, pieces, is_own, is_at_body, is_near_body);
        for (unsigned int k = 0; k < pieces.size(); ++k)
          // Where a cell has folded it has no material, and areas can be
          // negative.
          if (is_own(pieces[k]) && pieces[k].JxW > 0)
            points.push_back({pieces[k].x,
                              pieces[k].normal,
                              pieces[k].JxW,
                              of_bodies[k],
                              index,
                              0,
                              h});
      }

      /** The parts of the areas of @p pieces in a cell that a body is at, by
       * what @p is_at_body says of places; or behind as @p is_near_body says,
       * if none is at any of them. Never quite zero, so that what such places
       * alone hold has a place. */
      std::vector<double>
      areas_at_bodies(const CellVertices<dim>  &vertices,
                      const unsigned int        n_gauss,
                      const std::vector<Piece> &pieces,
                      const Ask                &is_own,
                      const Ask                &is_at_body,
                      const Ask                &is_near_body) const
      {
        std::vector<double> areas;
        for (const auto &piece : pieces)
          areas.push_back(piece.JxW);
        if (std::none_of(pieces.begin(), pieces.end(), [&](const auto &piece) {
              return holds_beyond_bodies(vertices, piece.normal);
            }))
          return areas;
        const auto is_kept = [&](const auto &piece) {
          return !is_own(piece) || is_at_body(piece);
        };
        std::vector<Piece> cut;
        add_kept_pieces<dim>(surface, vertices, n_gauss, is_kept, cut);
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
          of_places == 0 &&
          std::any_of(pieces.begin(), pieces.end(), is_near_body);
        for (unsigned int k = 0; k < areas.size(); ++k)
          if (!is_gap)
            areas[k] *= has_body[k] ? at_bodies / of_places : area_without_body;
        return areas;
      }

      const GridSpace<dim>       &space;
      const MovedSurface<dim>    &surface;
      const double                search_tolerance;
      BodyBehind<dim>            &body;
      const bool                  holds_beyond;
      const bool                  of_means;
      std::vector<CutPoint<dim>> &points;
    };
  } // namespace



  template <int dim>
  SurfaceCut<dim>::SurfaceCut(const GridSpace<dim>    &space,
                              const MovedSurface<dim> &surface,
                              const double             search_tolerance,
                              BodyBehind<dim>         &body,
                              const bool               holds_beyond_bodies,
                              const bool               of_means)
  {
    CutFinder<dim> finder(space,
                          surface,
                          search_tolerance,
                          body,
                          holds_beyond_bodies,
                          of_means,
                          points);
    finder.find();
    body.stop_asking();
    // A surface away from all bodies holds the material in its cells.
    if (!Utilities::MPI::logical_or(!points.empty(), space.communicator()))
      finder.find();
    const unsigned int n = functions.n_nodes = space.nodes_per_cell();
    functions.values.resize(points.size() * n);
    functions.gradients.resize(points.size() * n);
    for (unsigned int q = 0; q < points.size(); ++q)
      evaluate_shapes(space,
                      points[q].cell,
                      points[q].x,
                      &functions.values[q * n],
                      &functions.gradients[q * n]);
    number_points();
  }



  template <int dim>
  void
  SurfaceCut<dim>::number_points()
  {
    for (unsigned int q = 0; q < points.size(); ++q)
      points[q].number = q > 0 && points[q - 1].cell == points[q].cell ?
                           points[q - 1].number + 1 :
                           0;
  }



  template <int dim>
  void
  SurfaceCut<dim>::take_means(const GridSpace<dim> &space,
                              const Slopes          of_pieces)
  {
    const unsigned int         n = functions.n_nodes;
    std::vector<CutPoint<dim>> means;
    std::vector<unsigned int>  mean_of;
    CutFunctions<dim>          of_means;
    CellVertices<dim>          vertices;
    unsigned int               first = 0; // of the cell
    of_means.n_nodes                 = n;
    for (unsigned int q = 0; q < points.size(); ++q)
      {
        const CutPoint<dim> &point = points[q];
        if (means.empty() || means.back().cell != point.cell)
          {
            first    = means.size();
            vertices = present_vertices(space, point.cell);
          }
        const auto is_same_side = [&](const auto &m) {
          return m.normal * point.normal > cosine_of_corner * m.normal.norm() &&
                 !is_along_faces(vertices, m.normal);
        };
        const auto same =
          is_along_faces(vertices, point.normal) ?
            means.end() :
            std::find_if(means.begin() + first, means.end(), is_same_side);
        const unsigned int m = same - means.begin();
        mean_of.push_back(m);
        const double         *N      = &functions.values[q * n];
        const Tensor<1, dim> *grad_N = &functions.gradients[q * n];
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
        for (unsigned int a = 0; a < n; ++a)
          {
            double         &of_N      = of_means.values[m * n + a];
            Tensor<1, dim> &of_grad_N = of_means.gradients[m * n + a];
            of_N += share * (N[a] - of_N);
            of_grad_N += share * (grad_N[a] - of_grad_N);
          }
      }
    for (CutPoint<dim> &mean : means)
      mean.normal /= mean.normal.norm();
    if (of_pieces != Slopes::none)
      find_slopes(means, mean_of, of_pieces);
    points    = std::move(means);
    functions = std::move(of_means);
    number_points();
  }



  template <int dim>
  void
  SurfaceCut<dim>::find_slopes(const std::vector<CutPoint<dim>> &means,
                               const std::vector<unsigned int>  &mean_of,
                               const Slopes                      of_pieces)
  {
    const unsigned int                   n = functions.n_nodes;
    std::vector<SymmetricTensor<2, dim>> spreads(means.size());
    std::vector<bool>                    is_left_out(means.size(), false);
    for (unsigned int q = 0; q < points.size(); ++q)
      {
        const CutPoint<dim> &mean     = means[mean_of[q]];
        const Tensor<1, dim> distance = points[q].x - mean.x;
        spreads[mean_of[q]] += points[q].JxW / mean.JxW *
                               symmetrize(outer_product(distance, distance));
        if (of_pieces == Slopes::straight &&
            (points[q].normal - mean.normal).norm() > same_normal)
          is_left_out[mean_of[q]] = true;
      }
    std::vector<unsigned int> first_of = {0};
    for (unsigned int m = 0; m < means.size(); ++m)
      {
        const auto axes = eigenvectors(spreads[m]);
        for (unsigned int k = 0; k + 1 < dim && !is_left_out[m]; ++k)
          if (axes[k].first > spread_of_a_place * means[m].h * means[m].h)
            slopes.push_back({m, std::sqrt(axes[k].first) * axes[k].second});
        first_of.push_back(slopes.size());
      }
    slopes_of_N.assign(slopes.size() * n, 0.);
    for (unsigned int q = 0; q < points.size(); ++q)
      for (unsigned int k = first_of[mean_of[q]]; k < first_of[mean_of[q] + 1];
           ++k)
        {
          const CutPoint<dim>  &mean   = means[mean_of[q]];
          const Tensor<1, dim> &offset = slopes[k].offset;
          const double          share  = points[q].JxW / mean.JxW *
                               ((points[q].x - mean.x) * offset) /
                               offset.norm_square();
          for (unsigned int a = 0; a < n; ++a)
            slopes_of_N[k * n + a] += share * functions.values[q * n + a];
        }
  }



  template <int dim>
  bool
  cuts_across(const MovedSurface<dim>                     &surface,
              const typename GridSpace<dim>::CellIterator &cell)
  {
    const CellVertices<dim> vertices = vertices_of<dim>(cell);
    if (!surface.may_touch(vertices))
      return false;
    std::vector<SurfacePoint<dim>> pieces;
    surface.pieces(vertices, n_gauss_points_in<dim>(vertices), pieces);
    return std::any_of(pieces.begin(), pieces.end(), [&](const auto &piece) {
      return !is_along_faces(vertices, piece.normal);
    });
  }



#define INSTANTIATE(dim)                               \
  template struct SurfaceCut<dim>;                     \
  template bool cuts_across(const MovedSurface<dim> &, \
                            const typename GridSpace<dim>::CellIterator &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
