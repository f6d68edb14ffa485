// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/mesh/active_search.h>
#include <moraine/mesh/cell_shapes.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    double
    distance_to(const BoundingBox<dim> &box, const Point<dim> &x)
    {
      Tensor<1, dim> gap;
      for (unsigned int d = 0; d < dim; ++d)
        gap[d] =
          std::max({box.lower_bound(d) - x[d], x[d] - box.upper_bound(d), 0.});
      return gap.norm();
    }



    /**
     * Distance of @p x from a cell it does not lie in: the nearest place is
     * sought along one unit coordinate after the other, which ends at once in a
     * box.
     */
    template <int dim>
    double
    distance_to(const CellVertices<dim> &vertices, const Point<dim> &x)
    {
      const CellMap<dim> map(vertices);
      Point<dim>         xi;
      double             distance = map.place(xi).distance(x);
      for (unsigned int sweep = 0; sweep < 100; ++sweep)
        {
          for (unsigned int d = 0; d < dim; ++d)
            {
              Point<dim> start = xi, end = xi;
              start[d]                  = 0;
              end[d]                    = 1;
              const Point<dim>     foot = map.place(start);
              const Tensor<1, dim> edge = map.place(end) - foot;
              xi[d] =
                std::clamp((edge * (x - foot)) / edge.norm_square(), 0., 1.);
            }
          const double before = distance;
          distance            = map.place(xi).distance(x);
          if (distance >= before * (1 - 1e-12) && sweep > 0)
            break;
        }
      return distance;
    }



    /** Whether @p x is at @p xi of the cell with nodes @p X, but for
     * @p round_off times the size of the cell. */
    template <int dim, int degree>
    bool
    is_at(const Point<dim> &x,
          const Point<dim> &xi,
          const Point<dim> *X,
          const double      round_off = 1e-6)
    {
      constexpr unsigned int n = CellShapes<dim, degree>::n_nodes;
      double                 N[n];
      CellShapes<dim, degree>::values(xi, N);
      Tensor<1, dim> gap = x;
      for (unsigned int a = 0; a < n; ++a)
        gap -= N[a] * X[a];
      return gap.norm() <= round_off * X[0].distance(X[n - 1]);
    }



    /** The unit cell's place of @p x: of one that is folded where it holds no
     * material from the node nearest to @p x; not a number if it is nowhere. */
    template <int dim, int degree>
    Point<dim>
    place_in_cell(const Point<dim> &x, const Point<dim> *X)
    {
      const Point<dim> xi = CellShapes<dim, degree>::inverse(x, X);
      if (is_at<dim, degree>(x, xi, X))
        return xi;
      constexpr unsigned int n       = CellShapes<dim, degree>::n_nodes;
      unsigned int           nearest = 0;
      for (unsigned int a = 1; a < n; ++a)
        if (X[a].distance_square(x) < X[nearest].distance_square(x))
          nearest = a;
      Point<dim> start;
      for (unsigned int d = 0; d < dim; ++d, nearest /= degree + 1)
        start[d] = double(nearest % (degree + 1)) / degree;
      Point<dim> other = CellShapes<dim, degree>::inverse(x, X, start);
      if (!is_at<dim, degree>(x, other, X))
        other[0] = std::numeric_limits<double>::quiet_NaN();
      return other;
    }



    /** Where the nodes of an active cell are now. */
    template <int dim, int degree>
    std::array<Point<dim>, CellShapes<dim, degree>::n_nodes>
    present_nodes(const GridSpace<dim> &space, const unsigned int cell)
    {
      const unsigned int *nodes = space.cell_nodes(cell);
      std::array<Point<dim>, CellShapes<dim, degree>::n_nodes> X;
      for (unsigned int a = 0; a < X.size(); ++a)
        X[a] = space.node_position(nodes[a]);
      return X;
    }



    template <int dim, int degree>
    void
    evaluate_at(const GridSpace<dim> &space,
                const unsigned int    cell,
                const Point<dim>     &x,
                double               *N,
                Tensor<1, dim>       *grad_N)
    {
      const auto X = present_nodes<dim, degree>(space, cell);
      CellShapes<dim, degree>::evaluate(place_in_cell<dim, degree>(x, X.data()),
                                        X.data(),
                                        N,
                                        grad_N);
    }



    /**
     * Whether the map of a cell with nodes @p X takes @p xi to @p x, clear of
     * folds: the volume is not much less than in the middle of the cell, where
     * the Jacobian is @p J, and @p xi is not much further from there than
     * @p distance, by which J alone takes it there.
     */
    template <int dim, int degree>
    bool
    is_clear_of_folds(const Point<dim>     &x,
                      const Point<dim>     &xi,
                      const Point<dim>     *X,
                      const Tensor<2, dim> &J,
                      const double          distance)
    {
      constexpr double least_volume = 0.25;
      constexpr double much_further = 1.5;
      using Shapes                  = CellShapes<dim, degree>;

      // Far from the origin places have few digits.
      const double round_off =
        1e-9 + 1e-11 * x.norm() / X[0].distance(X[Shapes::n_nodes - 1]);
      return is_at<dim, degree>(x, xi, X, round_off) &&
             determinant(Shapes::jacobian(xi, X)) >=
               least_volume * std::abs(determinant(J)) &&
             xi.distance(Shapes::middle()) <= much_further * distance;
    }



    template <int dim, int degree>
    void
    continue_to(const GridSpace<dim> &space,
                const unsigned int    cell,
                const Point<dim>     &x,
                double               *N)
    {
      using Shapes            = CellShapes<dim, degree>;
      const auto       X      = present_nodes<dim, degree>(space, cell);
      const Point<dim> middle = Shapes::middle();
      Tensor<1, dim>   grad_N[Shapes::n_nodes];
      Shapes::evaluate(middle, X.data(), N, grad_N);
      Tensor<1, dim> from_middle = x;
      for (unsigned int a = 0; a < X.size(); ++a)
        from_middle -= N[a] * X[a];
      const Tensor<2, dim> J  = Shapes::jacobian(middle, X.data());
      const Point<dim>     xi = Shapes::inverse(x, X.data());
      if (is_clear_of_folds<dim, degree>(
            x, xi, X.data(), J, (invert(J) * from_middle).norm()))
        Shapes::values(xi, N);
      else
        for (unsigned int a = 0; a < X.size(); ++a)
          N[a] += grad_N[a] * from_middle;
    }



    template <int dim, int degree>
    Tensor<1, dim>
    move_at(const GridSpace<dim> &space,
            const unsigned int    cell,
            const Point<dim>     &x,
            Tensor<2, dim>       *gradient)
    {
      constexpr unsigned int n     = CellShapes<dim, degree>::n_nodes;
      const unsigned int    *nodes = space.cell_nodes(cell);
      Point<dim>             X[n];
      for (unsigned int a = 0; a < n; ++a)
        X[a] = space.node_position(nodes[a]) - space.node_move(nodes[a]);
      const Point<dim> xi = place_in_cell<dim, degree>(x, X);
      double           N[n];
      CellShapes<dim, degree>::values(xi, N);
      Tensor<1, dim> move;
      for (unsigned int a = 0; a < n; ++a)
        move += N[a] * space.node_move(nodes[a]);
      if (gradient)
        {
          Tensor<1, dim> grad_N[n];
          CellShapes<dim, degree>::evaluate(xi, X, N, grad_N);
          *gradient = Tensor<2, dim>();
          for (unsigned int a = 0; a < n; ++a)
            *gradient += outer_product(space.node_move(nodes[a]), grad_N[a]);
        }
      return move;
    }
  } // namespace



  template <int dim>
  typename GridSpace<dim>::CellIterator
  nearest_active_cell(const GridSpace<dim>                        &space,
                      const typename GridSpace<dim>::CellIterator &cell,
                      const Point<dim>                            &x,
                      const double search_tolerance)
  {
    if (space.is_active(cell))
      return cell;

    const auto &cells_at_vertex =
      space.mesh().search_cache().get_vertex_to_cell_map();
    typename GridSpace<dim>::CellIterator owner =
      space.mesh().triangulation().end();
    double nearest = search_tolerance;
    for (const unsigned int v : cell->vertex_indices())
      for (const auto &neighbour : cells_at_vertex[cell->vertex_index(v)])
        if (space.is_active(neighbour) &&
            distance_to(neighbour->bounding_box(), x) < nearest)
          {
            const double distance = distance_to_cell<dim>(neighbour, x);
            if (distance < nearest - 1e-9 * search_tolerance)
              {
                nearest = distance;
                owner   = neighbour;
              }
          }
    return owner;
  }



  template <int dim>
  double
  distance_to_cell(const typename GridSpace<dim>::CellIterator &cell,
                   const Point<dim>                            &x)
  {
    return distance_to(vertices_of<dim>(cell), x);
  }



  template <int dim>
  double
  distance_to_simplex(const std::array<Point<dim>, dim> &simplex,
                      const Point<dim>                  &x)
  {
    const auto to_edge = [&](const unsigned int i, const unsigned int j) {
      const Tensor<1, dim> along = simplex[j] - simplex[i],
                           to_x  = x - simplex[i];
      const double share =
        std::clamp(along * to_x / along.norm_square(), 0., 1.);
      return (to_x - share * along).norm();
    };
    if constexpr (dim == 2)
      return to_edge(0, 1);
    else
      {
        const Tensor<1, 3> normal =
          cross_product_3d(simplex[1] - simplex[0], simplex[2] - simplex[0]);
        bool above = true;
        for (unsigned int i = 0; i < 3; ++i)
          above = above &&
                  normal * cross_product_3d(simplex[(i + 1) % 3] - simplex[i],
                                            x - simplex[i]) >=
                    0;
        return above ? std::abs(normal * (x - simplex[0])) / normal.norm() :
                       std::min({to_edge(0, 1), to_edge(1, 2), to_edge(2, 0)});
      }
  }



  template <int dim>
  CellVertices<dim>
  layer_beyond(const unsigned int       face,
               const CellVertices<dim> &cell,
               const double             thickness)
  {
    const unsigned int across = 1u << (face / 2);
    CellVertices<dim>  layer  = cell;
    for (unsigned int v = 0; v < cell.size(); ++v)
      if (((v & across) != 0) == (face % 2 == 1))
        {
          const Tensor<1, dim> edge = cell[v] - cell[v ^ across];
          layer[v ^ across]         = cell[v];
          layer[v] += thickness / edge.norm() * edge;
        }
    return layer;
  }



  template <int dim>
  void
  evaluate_shapes(const GridSpace<dim> &space,
                  const unsigned int    active_cell_index,
                  const Point<dim>     &x,
                  double               *N,
                  Tensor<1, dim>       *grad_N)
  {
    if (space.degree() == 1)
      evaluate_at<dim, 1>(space, active_cell_index, x, N, grad_N);
    else
      evaluate_at<dim, 2>(space, active_cell_index, x, N, grad_N);
  }



  template <int dim>
  void
  continue_shapes(const GridSpace<dim> &space,
                  const unsigned int    active_cell_index,
                  const Point<dim>     &x,
                  double               *N)
  {
    if (space.degree() == 1)
      continue_to<dim, 1>(space, active_cell_index, x, N);
    else
      continue_to<dim, 2>(space, active_cell_index, x, N);
  }



  template <int dim>
  Tensor<1, dim>
  move_of_nodes_at(const GridSpace<dim> &space,
                   const unsigned int    active_cell_index,
                   const Point<dim>     &X,
                   Tensor<2, dim>       *gradient)
  {
    return space.degree() == 1 ?
             move_at<dim, 1>(space, active_cell_index, X, gradient) :
             move_at<dim, 2>(space, active_cell_index, X, gradient);
  }



#define INSTANTIATE(dim)                                                \
  template decltype(nearest_active_cell<dim>) nearest_active_cell<dim>; \
  template decltype(layer_beyond<dim>)        layer_beyond<dim>;        \
  template decltype(distance_to_cell<dim>)    distance_to_cell<dim>;    \
  template decltype(distance_to_simplex<dim>) distance_to_simplex<dim>; \
  template decltype(evaluate_shapes<dim>)     evaluate_shapes<dim>;     \
  template decltype(continue_shapes<dim>)     continue_shapes<dim>;     \
  template decltype(move_of_nodes_at<dim>)    move_of_nodes_at<dim>;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
