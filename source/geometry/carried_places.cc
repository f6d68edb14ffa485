// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/geometry/carried_places.h>

#include <moraine/core/archive_components.h>
#include <moraine/core/exceptions.h>
#include <moraine/mesh/active_search.h>
#include <moraine/mesh/straight_mapping.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

#include <deal.II/fe/fe_nothing.h>
#include <deal.II/fe/fe_values.h>

#include <deal.II/grid/grid_generator.h>

#include <deal.II/numerics/rtree.h>

#include <deal.II/physics/elasticity/kinematics.h>

#include <algorithm>
#include <cmath>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** In each direction of a piece or a face: products of Q2. */
    constexpr unsigned int n_gauss_points_of_pieces = 3;



    /** The same of a piece that will straddle faces of cells: with 3 points
     * forces of a cell are then wrong by up to 6 %. */
    template <int dim>
    constexpr unsigned int n_points_through_mesh = dim == 2 ? 16 : 7;



    /** In each direction of a face of a side. */
    constexpr unsigned int n_parts = 8;



    /** Beyond the mesh by this many cell sizes a place still is at it: cells
     * are chords of what is curved, and places have round-off. */
    constexpr double reach_of_mesh = 0.1;

    /** Of the angle between a surface and the side of a mesh that stands for
     * it; others cross it. */
    constexpr double cosine_along_side = 0.9;



    /** Of cells in which a surface whose pieces cannot be cut exactly ends:
     * halvings that bring the end to 1e-4 of a cell, in 3D to 3e-2. */
    template <int dim>
    constexpr unsigned int n_halvings = dim == 2 ? 10 : 4;



    /** Cuts the parts of a surface in cells that are beside a body. */
    template <int dim>
    class PiecesBeside
    {
    public:
      PiecesBeside(const Surface<dim> &surface, const ShapePointer<dim> &body)
        : surface(surface)
        , body(body)
      {}

      /** Of a cell of size @p cell_size; @p part is it or beside it. */
      void
      add(const CellVertices<dim>        &part,
          const double                    cell_size,
          const unsigned int              n_points,
          std::vector<SurfacePoint<dim>> &points)
      {
        if (!surface.may_touch(part))
          return;
        if (!body)
          return surface.pieces(part, n_points, points);
        if (cell_size != h)
          {
            h      = cell_size;
            extent = beside(body, largest_gap * h);
            exact  = surface.within(extent);
          }
        if (exact)
          exact->pieces(part, n_points, points);
        else
          add_kept_pieces<dim>(
            surface,
            part,
            n_points,
            [&](const auto &place) {
              return extent.value(place.x, place.normal, 1e-9 * h) > 0;
            },
            points,
            n_halvings<dim>);
      }

    private:
      const Surface<dim>      &surface;
      const ShapePointer<dim> &body;
      double                   h = 0;
      Extent<dim>              extent;
      SurfacePointer<dim>      exact; ///< null if there is none
    };



    /** The cell of the mesh nearest to @p x, if it is not farther away than @p
     * tolerance. */
    template <int dim>
    typename GridSpace<dim>::CellIterator
    nearest_cell(const BackgroundMesh<dim> &mesh,
                 const Point<dim>          &x,
                 const double               tolerance)
    {
      namespace bgi = boost::geometry::index;
      BoundingBox<dim> around(std::make_pair(x, x));
      around.extend(tolerance);
      typename GridSpace<dim>::CellIterator nearest =
        mesh.triangulation().end();
      double least = tolerance;
      for (const auto &[box, cell] :
           mesh.search_cache().get_cell_bounding_boxes_rtree() |
             bgi::adaptors::queried(bgi::intersects(around)))
        {
          const double distance = distance_to_cell<dim>(cell, x);
          if (distance <= least)
            {
              least   = distance;
              nearest = cell;
            }
        }
      return nearest;
    }



    /** The cell around @p x, or the nearest one if that is not farther away
     * than @p tolerance: material at the edge may reach over it. */
    template <int dim>
    typename GridSpace<dim>::CellIterator
    cell_around(const GridSpace<dim> &space,
                const Point<dim>     &x,
                const double          tolerance)
    {
      const BackgroundMesh<dim> &mesh = space.mesh();
      if (const auto found = mesh.cell_around(x))
        return found->first;
      return nearest_cell(
        mesh, x, std::max(tolerance, 1.001 * reach_of_mesh * mesh.cell_size()));
    }



    /** Let area and normal of a place follow by Nanson's formula. */
    template <int dim>
    void
    turn_by(const Tensor<2, dim>               &gradient,
            typename CarriedPlaces<dim>::Place &place)
    {
      const Tensor<2, dim> F = Physics::Elasticity::Kinematics::F(gradient);
      const Tensor<1, dim> area =
        determinant(F) * (transpose(invert(F)) * place.normal);
      place.weight *= area.norm();
      place.normal = unit_or_any(area);
    }



    template <int dim>
    Tensor<1, dim>
    normal_of_face(const unsigned int face, const CellVertices<dim> &cell)
    {
      const unsigned int          across = 1u << (face / 2);
      std::vector<Tensor<1, dim>> edges;
      const unsigned int          v = face % 2 == 1 ? across : 0;
      for (unsigned int d = 0; d < dim; ++d)
        if ((1u << d) != across)
          edges.push_back(cell[v | (1u << d)] - cell[v]);
      Tensor<1, dim> normal;
      if constexpr (dim == 2)
        normal = cross_product_2d(edges[0]);
      else
        normal = cross_product_3d(edges[0], edges[1]);
      return normal / normal.norm();
    }
  } // namespace



  template <int dim>
  CarriedPlaces<dim>::CarriedPlaces(std::vector<Place> places)
    : now(std::move(places))
  {
    for (Place &place : now)
      place.in_mesh = place.x;
  }



  template <int dim>
  std::vector<unsigned int>
  CarriedPlaces<dim>::find_cells(const GridSpace<dim> &space,
                                 const double          search_tolerance,
                                 const double          inward)
  {
    std::vector<unsigned int> without;
    for (unsigned int k = 0; k < now.size(); ++k)
      {
        Place &place            = now[k];
        place.active_cell_index = GridSpace<dim>::no_cell;
        const Point<dim> x      = place.in_mesh - inward * place.normal;
        const auto       cell   = cell_around(space, x, search_tolerance);
        if (cell.state() != IteratorState::valid)
          {
            without.push_back(k);
            continue;
          }
        const auto owner =
          nearest_active_cell(space, cell, x, search_tolerance);
        if (owner.state() != IteratorState::valid)
          without.push_back(k);
        else if (owner->is_locally_owned())
          place.active_cell_index = owner->active_cell_index();
      }
    return without;
  }



  template <int dim>
  void
  CarriedPlaces<dim>::sum_over_ranks(std::vector<Increment> &increments,
                                     const MPI_Comm         &communicator)
  {
    constexpr unsigned int n = dim + dim * dim;
    static_assert(sizeof(Increment) == n * sizeof(double));
    const ArrayView<double> values(
      reinterpret_cast<double *>(increments.data()), n * increments.size());
    Utilities::MPI::sum(ArrayView<const double>(values), communicator, values);
  }



  template <int dim>
  void
  CarriedPlaces<dim>::catch_up(const GridSpace<dim> &space, const bool turn)
  {
    // A rank may have no nodes.
    if (!Utilities::MPI::logical_or(space.nodes_moved(), space.communicator()))
      return;
    std::vector<Increment> moves(now.size());
    for (unsigned int k = 0; k < now.size(); ++k)
      if (now[k].active_cell_index != GridSpace<dim>::no_cell)
        moves[k].u = move_of_nodes_at(space,
                                      now[k].active_cell_index,
                                      now[k].in_mesh,
                                      &moves[k].gradient);
    sum_over_ranks(moves, space.communicator());
    for (unsigned int k = 0; k < now.size(); ++k)
      {
        now[k].x += moves[k].u;
        if (turn)
          turn_by(moves[k].gradient, now[k]);
      }
  }



  template <int dim>
  std::vector<typename CarriedPlaces<dim>::Increment>
  CarriedPlaces<dim>::increments(
    const GridSpace<dim>              &space,
    const std::vector<Tensor<1, dim>> &nodal_increments) const
  {
    const unsigned int          n = space.nodes_per_cell();
    std::vector<double>         N(n);
    std::vector<Tensor<1, dim>> grad_N(n);
    std::vector<Increment>      increments(now.size());
    for (unsigned int k = 0; k < now.size(); ++k)
      {
        const unsigned int cell = now[k].active_cell_index;
        if (cell == GridSpace<dim>::no_cell)
          continue;
        evaluate_shapes(space, cell, now[k].x, N.data(), grad_N.data());
        const unsigned int *nodes = space.cell_nodes(cell);
        for (unsigned int a = 0; a < n; ++a)
          {
            const Tensor<1, dim> &u = nodal_increments[nodes[a]];
            increments[k].u += N[a] * u;
            increments[k].gradient += outer_product(u, grad_N[a]);
          }
      }
    sum_over_ranks(increments, space.communicator());
    return increments;
  }



  template <int dim>
  void
  CarriedPlaces<dim>::prepare_move(const std::vector<Increment> &increments,
                                   const bool                    through_mesh,
                                   const bool                    turn)
  {
    next = now;
    for (unsigned int k = 0; k < now.size(); ++k)
      {
        Place &place = next[k];
        place.x += increments[k].u;
        if (through_mesh)
          place.in_mesh = place.x;
        if (turn)
          turn_by(increments[k].gradient, place);
      }
  }



  template <int dim>
  void
  CarriedPlaces<dim>::move() noexcept
  {
    if (!next.empty())
      std::swap(now, next);
    next.clear();
  }



  template <int dim>
  void
  CarriedPlaces<dim>::write(Archive &archive, const std::string &group) const
  {
    archive.write(group + "/place",
                  components_of(now, &Place::x),
                  dim,
                  "length");
    archive.write(group + "/place in mesh",
                  components_of(now, &Place::in_mesh),
                  dim,
                  "length");
    archive.write(group + "/normal", components_of(now, &Place::normal), dim);
    archive.write(group + "/weight", components_of(now, &Place::weight));
  }



  template <int dim>
  void
  CarriedPlaces<dim>::read(const Archive &archive, const std::string &group)
  {
    const auto &weights = archive.numbers(group + "/weight");
    now.resize(weights.size());
    set_components(weights, now, &Place::weight);
    set_components(archive.numbers(group + "/place", dim), now, &Place::x);
    set_components(archive.numbers(group + "/place in mesh", dim),
                   now,
                   &Place::in_mesh);
    set_components(archive.numbers(group + "/normal", dim),
                   now,
                   &Place::normal);
    undo();
  }



  template <int dim>
  std::vector<typename CarriedPlaces<dim>::Place>
  places_on(const Surface<dim>        &surface,
            const BackgroundMesh<dim> &mesh,
            const ShapePointer<dim>   &body,
            const Spacing              spacing)
  {
    const unsigned int             n_points = spacing == Spacing::through_mesh ?
                                                n_points_through_mesh<dim> :
                                                n_gauss_points_of_pieces;
    std::vector<SurfacePoint<dim>> pieces, beyond;
    PiecesBeside<dim>              beside_body(surface, body);
    for (const auto &cell : mesh.triangulation().active_cell_iterators())
      {
        const CellVertices<dim> vertices = vertices_of<dim>(cell);
        const double            h        = edge_of_cell(cell);
        beside_body.add(vertices, h, n_points, pieces);
        for (const unsigned int f : cell->face_indices())
          {
            if (!cell->face(f)->at_boundary())
              continue;
            const CellVertices<dim> layer =
              layer_beyond<dim>(f, vertices, reach_of_mesh * mesh.cell_size());
            beyond.clear();
            beside_body.add(layer, h, n_points, beyond);
            const Tensor<1, dim> along = normal_of_face(f, vertices);
            for (const auto &piece : beyond)
              if (std::abs(piece.normal * along) > cosine_along_side)
                pieces.push_back(piece);
          }
      }
    std::vector<typename CarriedPlaces<dim>::Place> places;
    for (const auto &piece : pieces)
      places.push_back({piece.x, piece.JxW, piece.normal});
    return places;
  }



  template <int dim>
  double
  share_outside(const Surface<dim>        &surface,
                const BackgroundMesh<dim> &mesh,
                const ShapePointer<dim>   &body)
  {
    constexpr double most_cells = dim == 2 ? 100 : 20; // in each direction
    const double     h          = mesh.cell_size();
    BoundingBox<dim> box        = surface.bounding_box();
    if (!is_finite(box))
      return 0.;
    // Not by round numbers, so that no face of a cell lies in the surface.
    box.extend(0.3137 * h);
    std::vector<unsigned int> n(dim);
    for (unsigned int d = 0; d < dim; ++d)
      n[d] = std::ceil(std::clamp(box.side_length(d) / h, 1., most_cells));
    Triangulation<dim> cells;
    GridGenerator::subdivided_hyper_rectangle(cells,
                                              n,
                                              box.get_boundary_points().first,
                                              box.get_boundary_points().second);
    std::vector<SurfacePoint<dim>> pieces;
    try
      {
        for (const auto &cell : cells.active_cell_iterators())
          surface.pieces(vertices_of<dim>(cell),
                         n_gauss_points_of_pieces,
                         pieces);
      }
    catch (const InputError &)
      {
        // fine enough for cells of the mesh, not for these
        return 0.;
      }
    const Extent<dim> extent =
      body ? beside(body, largest_gap * h) : Extent<dim>();
    double outside = 0, all = 0;
    for (const auto &piece : pieces)
      {
        all += piece.JxW;
        if (nearest_cell(mesh, piece.x, reach_of_mesh * h).state() !=
              IteratorState::valid ||
            extent.value(piece.x, piece.normal, 1e-9 * h) <= 0)
          outside += piece.JxW;
      }
    return all > 0 ? outside / all : 0.;
  }



  template <int dim>
  std::vector<typename CarriedPlaces<dim>::Place>
  places_on_side(const BackgroundMesh<dim> &mesh,
                 const types::boundary_id   side,
                 const Covers<dim>         &covers,
                 const Quadrature<dim - 1> &of_whole_face)
  {
    const StraightMapping<dim> mapping;
    const FE_Nothing<dim>      nothing;
    const UpdateFlags          flags =
      update_quadrature_points | update_JxW_values | update_normal_vectors;
    FEFaceValues<dim> whole(mapping, nothing, of_whole_face, flags);
    // Of a face on which a body ends.
    FEFaceValues<dim>                               in_parts(mapping,
                               nothing,
                               QIterated<dim - 1>(QGauss<1>(2), n_parts),
                               flags);
    std::vector<typename CarriedPlaces<dim>::Place> places;
    const auto add_places = [&](const FEFaceValues<dim> &on_face,
                                const double             h) {
      const std::size_t before = places.size();
      for (const unsigned int q : on_face.quadrature_point_indices())
        if (!covers || is_at_body(covers,
                                  on_face.quadrature_point(q),
                                  on_face.normal_vector(q),
                                  h))
          places.push_back({on_face.quadrature_point(q),
                            on_face.JxW(q),
                            on_face.normal_vector(q)});
      return places.size() - before;
    };
    for (const auto &cell : mesh.triangulation().active_cell_iterators())
      for (const unsigned int f : cell->face_indices())
        if (cell->face(f)->at_boundary() &&
            cell->face(f)->boundary_id() == side)
          {
            const double h = edge_of_cell(cell);
            whole.reinit(cell, f);
            const std::size_t n = add_places(whole, h);
            if (n == 0 || n == whole.n_quadrature_points)
              continue;
            places.resize(places.size() - n);
            in_parts.reinit(cell, f);
            add_places(in_parts, h);
          }
    return places;
  }



#define INSTANTIATE(dim)                                     \
  template class CarriedPlaces<dim>;                         \
  template decltype(places_on<dim>)      places_on<dim>;     \
  template decltype(share_outside<dim>)  share_outside<dim>; \
  template decltype(places_on_side<dim>) places_on_side<dim>;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
