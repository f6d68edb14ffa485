// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/points/seeding.h>

#include <moraine/mesh/cell_inverse.h>
#include <moraine/points/moment_fitting.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    bool
    is_parallelepiped(const CellVertices<dim> &cell, const double tolerance)
    {
      for (unsigned int v = 0; v < cell.size(); ++v)
        {
          Tensor<1, dim> x = cell[v] - cell[0];
          for (unsigned int d = 0; d < dim; ++d)
            if ((v >> d) & 1)
              x -= cell[1u << d] - cell[0];
          if (x.norm() > tolerance)
            return false;
        }
      return true;
    }

    /** Round-off in the vertices of a cell. */
    template <int dim>
    double
    round_off(const CellVertices<dim> &cell)
    {
      return 1e-14 * (cell[0].norm() + (cell[1] - cell[0]).norm());
    }

    /** Whether all edges of one direction are the same vector. */
    template <int dim>
    bool
    is_prism(const CellVertices<dim> &cell, const double tolerance)
    {
      for (unsigned int d = 0; d < dim; ++d)
        {
          const unsigned int next = 1u << d;
          bool               same = true;
          for (unsigned int v = 0; v < cell.size() && same; ++v)
            if (!(v & next))
              same =
                ((cell[v | next] - cell[v]) - (cell[next] - cell[0])).norm() <=
                tolerance;
          if (same)
            return true;
        }
      return false;
    }

    /**
     * The place at which the gradients of bilinear functions have their mean
     * over the part of a cell: in the unit cell, detJ grad N is linear, so it
     * is the centroid of the part's image there, int xi / detJ dV over
     * int 1 / detJ dV, to the accuracy of a Gauss rule on triangles.
     */
    Point<2>
    centroid_in_unit_cell(const ConvexPolytope<2> &part_of_cell,
                          const CellVertices<2>   &cell,
                          const Shape<2>          &shape)
    {
      static const QGauss<2>      rule(8);
      const CellMap<2>            map(cell);
      const CellInverse<2>        inverse(cell);
      std::vector<SignedPiece<2>> pieces;
      shape.add_pieces(part_of_cell, 1., pieces);
      double       area = 0.;
      Tensor<1, 2> first;
      for (const auto &piece : pieces)
        for (unsigned int i = 1; i + 1 < piece.polytope.vertices().size(); ++i)
          {
            const auto        &x = piece.polytope.vertices();
            const Tensor<1, 2> a = x[i] - x[0], b = x[i + 1] - x[i];
            const double       twice_area = a[0] * b[1] - a[1] * b[0];
            for (unsigned int q = 0; q < rule.size(); ++q)
              {
                const double   u = rule.point(q)[0], v = rule.point(q)[1];
                const Point<2> xi     = inverse(x[0] + u * (a + v * b)).value();
                const double   weight = piece.sign * rule.weight(q) * u *
                                      twice_area /
                                      determinant(map.jacobian(xi));
                area += weight;
                first += weight * xi;
              }
          }
      return Point<2>(first / area);
    }

    /** int (x - c) (x - c)^T dV, the sum over tetrahedra with one tip. */
    SymmetricTensor<2, 3>
    second_moments(const ConvexPolytope<3> &polytope, const Point<3> &c)
    {
      SymmetricTensor<2, 3> sum;
      const Tensor<1, 3>    tip = polytope.vertices()[0] - c;
      polytope.for_each_face([&](const ConvexPolytope<3>::PointList &loop) {
        for (unsigned int i = 1; i + 1 < loop.size(); ++i)
          {
            const std::array<Tensor<1, 3>, 4> x{
              {tip, loop[0] - c, loop[i] - c, loop[i + 1] - c}};
            const double volume =
              (x[1] - tip) * cross_product_3d(x[2] - tip, x[3] - tip) / 6.;
            const Tensor<1, 3>    s       = x[0] + x[1] + x[2] + x[3];
            SymmetricTensor<2, 3> squares = symmetrize(outer_product(s, s));
            for (const auto &x_i : x)
              squares += symmetrize(outer_product(x_i, x_i));
            sum += volume / 20. * squares;
          }
      });
      return sum;
    }

    /**
     * Offsets from the centroid, in the reference cell, of three points of
     * equal volume that have the mean products xy, yz and zx of the region:
     * a triangle in the plane of the two larger principal axes, turned by
     * @p angle. Only products of different coordinates count, so the smallest
     * principal value may be taken off the squares.
     */
    std::array<Tensor<1, 3>, 3>
    triangle(const SymmetricTensor<2, 3> &covariance, const double angle)
    {
      const auto                  principal = eigenvectors(covariance);
      std::array<Tensor<1, 3>, 3> corners;
      for (unsigned int k = 0; k < 3; ++k)
        {
          const double phi = angle + 2. * numbers::PI * k / 3.;
          for (unsigned int i = 0; i < 2; ++i)
            corners[k] +=
              std::sqrt(2. *
                        std::max(0., principal[i].first - principal[2].first)) *
              (i == 0 ? std::cos(phi) : std::sin(phi)) * principal[i].second;
        }
      return corners;
    }

    /**
     * The points that stand for a sub-cell cut by a straight-sided body. The
     * centroid integrates linear functions, which the gradients of bilinear
     * shape functions are. Those of trilinear ones hold products of two
     * coordinates as well: three points integrate them, if they find room.
     */
    std::vector<Point<3>>
    points_of_part(const ConvexPolytope<3> &sub_cell,
                   const CellVertices<3>   &cell,
                   const Shape<3>          &shape,
                   const ClippedVolume<3>  &part)
    {
      SymmetricTensor<2, 3>       moments;
      std::vector<SignedPiece<3>> pieces;
      shape.add_pieces(sub_cell, 1., pieces);
      for (const auto &piece : pieces)
        if (!piece.polytope.empty())
          moments += piece.sign * second_moments(piece.polytope, part.centroid);
      Tensor<2, 3> jacobian;
      for (unsigned int d = 0; d < 3; ++d)
        for (unsigned int i = 0; i < 3; ++i)
          jacobian[i][d] = cell[1u << d][i] - cell[0][i];
      const Tensor<2, 3>          inverse    = invert(jacobian);
      const SymmetricTensor<2, 3> covariance = symmetrize(
        inverse * Tensor<2, 3>(moments / part.volume) * transpose(inverse));

      double product = 0.;
      for (unsigned int d = 0; d < 3; ++d)
        product = std::max(product, std::abs(covariance[d][(d + 1) % 3]));
      constexpr unsigned int n_angles = 12;
      for (unsigned int n = 0;
           n < n_angles && product > 1e-13 * trace(covariance);
           ++n)
        {
          std::vector<Point<3>> points;
          for (const auto &offset :
               triangle(covariance, 2. * numbers::PI / 3. * n / n_angles))
            {
              const Point<3> x = part.centroid + jacobian * offset;
              if (shape.contains(x) && sub_cell.pull_inside(x) == x)
                points.push_back(x);
            }
          if (points.size() == 3)
            return points;
        }
      return {part.centroid};
    }
  } // namespace



  template <int dim>
  CellSeeder<dim>::CellSeeder(const unsigned int n_per_direction,
                              const PointLayout  layout,
                              const unsigned int fitted_degree)
    : layout(layout)
    , fitted_degree(fitted_degree)
    , rule(layout == PointLayout::gauss ?
             Quadrature<dim>(QGauss<dim>(n_per_direction)) :
             Quadrature<dim>(QIterated<dim>(QMidpoint<1>(), n_per_direction)))
  {
    const QGauss<1>     line(n_per_direction);
    std::vector<double> start(1, 0.);
    for (unsigned int i = 0; i < n_per_direction; ++i)
      start.push_back(layout == PointLayout::gauss ?
                        start.back() + line.weight(i) :
                        (i + 1.) / n_per_direction);
    start.back() = 1.;
    for (unsigned int q = 0; q < rule.size(); ++q)
      {
        unsigned int   rest = q;
        Point<dim>     corner;
        Tensor<1, dim> length;
        for (unsigned int d = 0; d < dim; ++d, rest /= n_per_direction)
          {
            const unsigned int i = rest % n_per_direction;
            corner[d]            = start[i];
            length[d]            = start[i + 1] - start[i];
          }
        lower.push_back(corner);
        lengths.push_back(length);
      }
  }



  template <int dim>
  unsigned int
  CellSeeder<dim>::max_points() const
  {
    const unsigned int n_fitted =
      fitted_degree > 0 ? Utilities::pow(fitted_degree + 1, dim) : 0;
    return std::max((dim == 3 ? 3 : 1) * rule.size(), n_fitted);
  }



  template <int dim>
  CellVertices<dim>
  CellSeeder<dim>::sub_cell(const CellVertices<dim> &cell,
                            const unsigned int       q) const
  {
    const CellMap<dim> map(cell);
    CellVertices<dim>  vertices;
    for (unsigned int v = 0; v < vertices.size(); ++v)
      {
        Point<dim> unit = lower[q];
        for (unsigned int d = 0; d < dim; ++d)
          if ((v >> d) & 1)
            unit[d] += lengths[q][d];
        vertices[v] = map.place(unit);
      }
    return vertices;
  }



  template <int dim>
  unsigned int
  CellSeeder<dim>::sub_cell_index(const Point<dim> &xi) const
  {
    unsigned int best    = 0;
    double       nearest = std::numeric_limits<double>::infinity();
    for (unsigned int q = 0; q < rule.size(); ++q)
      {
        double outside = 0.;
        for (unsigned int d = 0; d < dim; ++d)
          outside = std::max({outside,
                              lower[q][d] - xi[d],
                              xi[d] - lower[q][d] - lengths[q][d]});
        if (outside < nearest)
          {
            best    = q;
            nearest = outside;
          }
      }
    return best;
  }



  template <int dim>
  Tensor<1, dim>
  CellSeeder<dim>::distance_to_faces(const Point<dim> &xi) const
  {
    const unsigned int q = sub_cell_index(xi);
    Tensor<1, dim>     distance;
    for (unsigned int d = 0; d < dim; ++d)
      distance[d] = std::min(std::abs(xi[d] - lower[q][d]),
                             std::abs(lower[q][d] + lengths[q][d] - xi[d]));
    return distance;
  }



  template <int dim>
  double
  CellSeeder<dim>::longest_edge() const
  {
    double longest = 0;
    for (const Tensor<1, dim> &edges : lengths)
      for (unsigned int d = 0; d < dim; ++d)
        longest = std::max(longest, edges[d]);
    return longest;
  }



  template <int dim>
  void
  CellSeeder<dim>::seed_full_cell(const CellVertices<dim>       &cell,
                                  std::vector<SeededPoint<dim>> &points) const
  {
    const CellMap<dim> map(cell);
    // detJ and detJ grad N are linear in each unit coordinate of such a cell.
    const bool rule_is_exact = dim == 2 || layout == PointLayout::gauss ||
                               is_prism<dim>(cell, round_off<dim>(cell));
    for (unsigned int q = 0; q < rule.size(); ++q)
      if (rule_is_exact)
        points.push_back(
          {map.place(rule.point(q)),
           rule.weight(q) * determinant(map.jacobian(rule.point(q)))});
      else
        {
          const ConvexPolytope<dim> part(sub_cell(cell, q));
          points.push_back({part.centroid(), part.volume()});
        }
  }



  template <int dim>
  bool
  CellSeeder<dim>::seed_fitted(const CellVertices<dim>       &cell,
                               const Shape<dim>              &shape,
                               std::vector<SeededPoint<dim>> &points) const
  {
    const ConvexPolytope<dim> whole(cell);
    const double              part = shape.clip(whole).volume;
    if (part <= 1e-12 * whole.volume() || part >= (1. - 1e-13) * whole.volume())
      return false;
    // Pieces that are taken off leave few points to choose from in a large one.
    for (const unsigned int n : {1, 3, 9})
      {
        std::vector<SignedPiece<dim>> pieces;
        const CellSeeder<dim>         grid(n, PointLayout::equal);
        for (unsigned int q = 0; q < grid.rule.size(); ++q)
          shape.add_pieces(ConvexPolytope<dim>(grid.sub_cell(cell, q)),
                           1.,
                           pieces);
        const auto fitted =
          moment_fitted_rule(pieces, shape, part, fitted_degree);
        for (unsigned int q = 0; q < fitted.size(); ++q)
          points.push_back({fitted.point(q), fitted.weight(q)});
        if (fitted.size() > 0)
          return true;
      }
    return false;
  }



  template <int dim>
  void
  CellSeeder<dim>::seed(const CellVertices<dim>       &cell,
                        const Shape<dim>              &shape,
                        std::vector<SeededPoint<dim>> &points) const
  {
    const Overlap answer = shape.overlap(ConvexPolytope<dim>(cell));
    if (answer == Overlap::none)
      return;
    if (answer == Overlap::all)
      {
        seed_full_cell(cell, points);
        return;
      }
    if (fitted_degree > 0 && seed_fitted(cell, shape, points))
      return;
    const double       body_volume = shape.bounding_box().volume();
    const unsigned int n_before    = points.size();
    const bool is_skewed = !is_parallelepiped<dim>(cell, round_off<dim>(cell));
    bool       is_cut    = false;
    for (unsigned int q = 0; q < rule.size(); ++q)
      {
        const ConvexPolytope<dim> whole(sub_cell(cell, q));
        const double              volume = whole.volume();
        const auto                part   = shape.clip(whole);
        const bool is_clipped            = part.volume < (1. - 1e-13) * volume;
        is_cut                           = is_cut || is_clipped;
        if (part.volume <= 1e-12 * std::min(volume, body_volume))
          continue;
        std::vector<Point<dim>> positions{part.centroid};
        if constexpr (dim == 2)
          if (is_skewed && shape.is_straight())
            positions[0] =
              CellMap<2>(cell).place(centroid_in_unit_cell(whole, cell, shape));
        if constexpr (dim == 3)
          if (is_clipped && shape.is_straight())
            positions = points_of_part(whole, cell, shape, part);
        for (const Point<dim> &x : positions)
          points.push_back({x, part.volume / positions.size()});
      }
    if (!is_cut)
      {
        points.erase(points.begin() + n_before, points.end());
        seed_full_cell(cell, points);
      }
  }



  template class CellSeeder<2>;
  template class CellSeeder<3>;
} // namespace moraine
