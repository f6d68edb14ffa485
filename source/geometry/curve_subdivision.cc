// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/geometry/curve_subdivision.h>

#include <algorithm>
#include <cmath>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  Tensor<1, dim>
  central_gradient(const LevelFunction<dim> &level,
                   const Point<dim>         &x,
                   const double              step)
  {
    Tensor<1, dim> slope;
    for (unsigned int d = 0; d < dim; ++d)
      {
        const Tensor<1, dim> shift = step * Point<dim>::unit_vector(d);
        slope[d] = (level(x + shift) - level(x - shift)) / (2. * step);
      }
    return slope;
  }



  namespace
  {
    // A level function in a polytope and its linear part at a point.
    template <int dim>
    struct LinearPart
    {
      LinearPart(const LevelFunction<dim>  &level,
                 const ConvexPolytope<dim> &cell,
                 const Point<dim>          &x,
                 const double               size)
        : x(x)
        , value(level(x))
        , slope(central_gradient(level, x, 1e-3 * size))
      {
        lowest = highest = value;
        for (const auto &vertex : cell.vertices())
          {
            const double there = level(vertex);
            lowest             = std::min(lowest, there);
            highest            = std::max(highest, there);
            bend =
              std::max(bend, std::abs(there - value - slope * (vertex - x)));
          }
      }

      // decided where no vertex and not thrice the bend reach zero
      Overlap
      overlap() const
      {
        if (lowest >= 3. * bend && lowest > 0.)
          return Overlap::all;
        return highest <= -3. * bend ? Overlap::none : Overlap::part;
      }

      // where the linear part vanishes
      Point<dim>
      zero() const
      {
        return linear_zero<dim>(x, value, slope);
      }

      Point<dim>     x;
      double         value;
      Tensor<1, dim> slope;
      double         lowest, highest;
      double         bend = 0.;
    };



    // mean of f over a cut face; exact for quadratic functions
    template <int dim>
    double
    mean_on_cut(const typename ConvexPolytope<dim>::PointList &cut,
                const LevelFunction<dim>                      &f)
    {
      if constexpr (dim == 2)
        return (f(cut[0]) + 4. * f(Point<2>((cut[0] + cut[1]) / 2.)) +
                f(cut[1])) /
               6.;
      else
        {
          double integral = 0., area = 0.;
          for (unsigned int i = 1; i + 1 < cut.size(); ++i)
            {
              const std::array<Point<3>, 3> x{{cut[0], cut[i], cut[i + 1]}};
              const double                  part =
                cross_product_3d(x[1] - x[0], x[2] - x[0]).norm();
              area += part;
              for (unsigned int k = 0; k < 3; ++k)
                integral += part / 3. * f(x[k] + (x[(k + 1) % 3] - x[k]) / 2.);
            }
          return area > 0. ? integral / area : f(cut[0]);
        }
    }



    template <int dim>
    class CurveCutter
    {
    public:
      CurveCutter(const LevelFunction<dim> &level,
                  const bool                is_distance,
                  const double              sign,
                  SignedPieces<dim>        &pieces)
        : level(level)
        , is_distance(is_distance)
        , sign(sign)
        , pieces(pieces)
      {}

      void
      add(const ConvexPolytope<dim> &cell, const unsigned int n_halvings)
      {
        const Point<dim> middle = cell.vertex_mean();
        const double     size   = cell.radius(middle);
        Overlap          answer = Overlap::part;
        if (is_distance && std::abs(level(middle)) >= size)
          answer = level(middle) > 0. ? Overlap::all : Overlap::none;
        LinearPart<dim> linear(level, cell, middle, size);
        if (answer == Overlap::part)
          answer = linear.overlap();
        if (answer == Overlap::all)
          pieces.push_back({sign, cell});
        if (answer != Overlap::part)
          return;
        // the tangent plane at a point of the boundary near the middle
        for (unsigned int k = 0; k < 2 && linear.slope.norm() > 0. &&
                                 linear.zero().distance(middle) <= size;
             ++k)
          linear = LinearPart<dim>(level, cell, linear.zero(), size);
        if (linear.bend > flat_enough * size * linear.slope.norm() &&
            n_halvings > 0)
          halve(cell, n_halvings);
        else if (linear.slope.norm() > 0.)
          cut(cell, linear.zero(), linear.slope);
        else if (linear.value > 0.)
          pieces.push_back({sign, cell});
      }

    private:
      // Of the size of a leaf. Chosen by the error it leaves in a cut cell:
      // below 1e-6 of its volume where the radius is five cells or more.
      static constexpr double flat_enough = (dim == 2 ? 5e-3 : 2e-2);

      void
      halve(const ConvexPolytope<dim> &cell, const unsigned int n_halvings)
      {
        const auto   box  = cell.bounding_box();
        unsigned int wide = 0;
        for (unsigned int d = 1; d < dim; ++d)
          if (box.side_length(d) > box.side_length(wide))
            wide = d;
        for (const double side : {1., -1.})
          {
            ConvexPolytope<dim> half = cell;
            half.clip(box.center(), side * Point<dim>::unit_vector(wide));
            if (!half.empty())
              add(half, n_halvings - 1);
          }
      }

      void
      cut(const ConvexPolytope<dim> &cell,
          const Point<dim>          &foot,
          const Tensor<1, dim>      &slope)
      {
        std::vector<typename ConvexPolytope<dim>::PointList> faces;
        ConvexPolytope<dim>                                  part = cell;
        part.clip(foot, slope, &faces);
        if (!faces.empty())
          {
            const double mean = mean_on_cut<dim>(faces[0], level);
            part              = cell;
            part.clip(linear_zero<dim>(foot, mean, slope), slope);
          }
        if (!part.empty())
          pieces.push_back({sign, part});
      }

      const LevelFunction<dim> &level;
      const bool                is_distance;
      const double              sign;
      SignedPieces<dim>        &pieces;
    };
  } // namespace



  template <int dim>
  void
  add_curved_pieces(const LevelFunction<dim>  &level,
                    const bool                 is_distance,
                    const ConvexPolytope<dim> &cell,
                    const double               sign,
                    SignedPieces<dim>         &pieces)
  {
    constexpr unsigned int depth = (dim == 2 ? 10 : 6);
    CurveCutter<dim>(level, is_distance, sign, pieces).add(cell, dim * depth);
  }



  template <int dim>
  Overlap
  overlap_by_values(const LevelFunction<dim>  &level,
                    const ConvexPolytope<dim> &cell)
  {
    const Point<dim> middle = cell.vertex_mean();
    return LinearPart<dim>(level, cell, middle, cell.radius(middle)).overlap();
  }



#define INSTANTIATE(dim)                                                 \
  template Tensor<1, dim> central_gradient(const LevelFunction<dim> &,   \
                                           const Point<dim> &,           \
                                           const double);                \
  template void           add_curved_pieces(const LevelFunction<dim> &,  \
                                            const bool,                  \
                                            const ConvexPolytope<dim> &, \
                                            const double,                \
                                            SignedPieces<dim> &);        \
  template Overlap        overlap_by_values(const LevelFunction<dim> &,  \
                                            const ConvexPolytope<dim> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
