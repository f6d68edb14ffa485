// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/points/seeding.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <limits>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    // d-linear image of a point of the reference cell
    template <int dim>
    Point<dim>
    image(const typename ConvexPolytope<dim>::CellVertices &cell,
          const Point<dim>                                 &unit)
    {
      Point<dim> x;
      for (unsigned int v = 0; v < cell.size(); ++v)
        {
          double value = 1.;
          for (unsigned int d = 0; d < dim; ++d)
            value *= ((v >> d) & 1) ? unit[d] : 1. - unit[d];
          x += value * cell[v];
        }
      return x;
    }

    template <int dim>
    double
    volume_element(const typename ConvexPolytope<dim>::CellVertices &cell,
                   const Point<dim>                                 &unit)
    {
      Tensor<2, dim> jacobian;
      for (unsigned int v = 0; v < cell.size(); ++v)
        for (unsigned int k = 0; k < dim; ++k)
          {
            double slope = 1.;
            for (unsigned int d = 0; d < dim; ++d)
              slope *= d == k ? (((v >> d) & 1) ? 1. : -1.) :
                                (((v >> d) & 1) ? unit[d] : 1. - unit[d]);
            for (unsigned int i = 0; i < dim; ++i)
              jacobian[i][k] += slope * cell[v][i];
          }
      return determinant(jacobian);
    }

    template <int dim>
    bool
    is_parallelepiped(const typename ConvexPolytope<dim>::CellVertices &cell,
                      const double tolerance)
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

    // of a box that may be infinite
    template <int dim>
    double
    box_volume(const BoundingBox<dim> &box)
    {
      double volume = 1.;
      for (unsigned int d = 0; d < dim; ++d)
        volume *= box.side_length(d);
      return is_finite(box) ? volume : std::numeric_limits<double>::infinity();
    }
  } // namespace



  template <int dim>
  CellSeeder<dim>::CellSeeder(const unsigned int n_per_direction,
                              const PointLayout  layout)
    : layout(layout)
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
  typename CellSeeder<dim>::CellVertices
  CellSeeder<dim>::sub_cell(const CellVertices &cell,
                            const unsigned int  q) const
  {
    CellVertices vertices;
    for (unsigned int v = 0; v < vertices.size(); ++v)
      {
        Point<dim> unit = lower[q];
        for (unsigned int d = 0; d < dim; ++d)
          if ((v >> d) & 1)
            unit[d] += lengths[q][d];
        vertices[v] = image<dim>(cell, unit);
      }
    return vertices;
  }



  template <int dim>
  void
  CellSeeder<dim>::seed_full_cell(const CellVertices            &cell,
                                  std::vector<SeededPoint<dim>> &points) const
  {
    const double tolerance =
      1e-14 * (cell[0].norm() + (cell[1] - cell[0]).norm());
    const bool rule_is_exact =
      layout == PointLayout::gauss || is_parallelepiped<dim>(cell, tolerance);
    for (unsigned int q = 0; q < rule.size(); ++q)
      if (rule_is_exact)
        points.push_back(
          {image<dim>(cell, rule.point(q)),
           rule.weight(q) * volume_element<dim>(cell, rule.point(q)),
           lengths[q],
           false});
      else
        {
          const ConvexPolytope<dim> part(sub_cell(cell, q));
          points.push_back({part.centroid(), part.volume(), lengths[q], false});
        }
  }



  template <int dim>
  void
  CellSeeder<dim>::seed(const CellVertices            &cell,
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
    const double       body_volume = box_volume(shape.bounding_box());
    const unsigned int n_before    = points.size();
    bool               is_cut      = false;
    for (unsigned int q = 0; q < rule.size(); ++q)
      {
        const ConvexPolytope<dim> whole(sub_cell(cell, q));
        const double              volume = whole.volume();
        const auto                part   = shape.clip(whole);
        const bool is_clipped            = part.volume < (1. - 1e-13) * volume;
        is_cut                           = is_cut || is_clipped;
        if (part.volume > 1e-12 * std::min(volume, body_volume))
          points.push_back(
            {part.centroid, part.volume, lengths[q], is_clipped});
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
