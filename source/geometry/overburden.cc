// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/geometry/overburden.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** Levels that are zero but for round-off, over the cell size. */
    constexpr double on_surface = 1e-6;

    /** Where distances are estimates, over the cell size: what is thinner may
     * be missed. */
    constexpr double longest_blind_step = 1. / 8;

    /** Gaps that are slips of drawing, over the cell size: bodies that share
     * nodes bear each other. */
    constexpr double smallest_gap = 1e-2;



    /** Directions perpendicular to @p up, opposite ones in pairs; in 3D four,
     * along no plane that a scene is likely to have. */
    template <int dim>
    std::vector<Tensor<1, dim>>
    sideways(const Tensor<1, dim> &up)
    {
      if constexpr (dim == 2)
        {
          const Tensor<1, dim> a = cross_product_2d(up);
          return {a, -a};
        }
      else
        {
          unsigned int smallest = 0;
          for (unsigned int d = 1; d < dim; ++d)
            if (std::abs(up[d]) < std::abs(up[smallest]))
              smallest = d;
          Tensor<1, dim> axis;
          axis[smallest]   = 1;
          Tensor<1, dim> a = cross_product_3d(up, axis);
          a /= a.norm();
          const Tensor<1, dim> b = cross_product_3d(up, a);
          const double         c = std::cos(0.3), s = std::sin(0.3);
          return {c * a + s * b, c * b - s * a, -c * a - s * b, s * a - c * b};
        }
    }



    /** Where the line x + s up meets the facet, if it does beyond x. */
    template <int dim>
    std::optional<double>
    meeting(const Point<dim>                      &x,
            const Tensor<1, dim>                  &up,
            const typename Overburden<dim>::Facet &facet)
    {
      // x + s up = p_0 + sum_k t_k (p_k - p_0)
      Tensor<2, dim> columns;
      double         size = 1;
      for (unsigned int d = 0; d < dim; ++d)
        columns[d][0] = up[d];
      for (unsigned int k = 1; k < dim; ++k)
        {
          for (unsigned int d = 0; d < dim; ++d)
            columns[d][k] = facet[0][d] - facet[k][d];
          size *= facet[k].distance(facet[0]);
        }
      if (!(std::abs(determinant(columns)) > 1e-10 * size))
        return {};
      const Tensor<1, dim> found     = invert(columns) * (facet[0] - x);
      constexpr double     round_off = 1e-9;
      double               last      = 1; // barycentric coordinate of p_0
      for (unsigned int k = 1; k < dim; ++k)
        {
          last -= found[k];
          if (found[k] < -round_off)
            return {};
        }
      if (last < -round_off || !(found[0] > 0))
        return {};
      return found[0];
    }
  } // namespace



  template <int dim>
  Overburden<dim>::Overburden(const std::vector<ShapePointer<dim>> &bodies,
                              const BoundingBox<dim>               &mesh_box,
                              const double                          cell_size,
                              const std::vector<Facet> &mesh_surface)
    : bodies(bodies)
    , box(mesh_box)
    , cell_size(cell_size)
    , mesh_surface(mesh_surface)
  {}



  template <int dim>
  double
  Overburden<dim>::length_in_mesh(const Point<dim>     &x,
                                  const Tensor<1, dim> &up) const
  {
    double length = std::numeric_limits<double>::max();
    for (unsigned int d = 0; d < dim; ++d)
      if (up[d] != 0)
        length =
          std::min(length,
                   ((up[d] > 0 ? box.upper_bound(d) : box.lower_bound(d)) -
                    x[d]) /
                     up[d]);
    for (const Facet &facet : mesh_surface)
      if (const auto s = meeting<dim>(x, up, facet))
        length = std::min(length, *s);
    return std::max(length, 0.);
  }



  template <int dim>
  bool
  Overburden<dim>::add_parts(const unsigned int    b,
                             const Point<dim>     &x,
                             const Tensor<1, dim> &up,
                             const double          length,
                             std::vector<Part>    &parts) const
  {
    const Shape<dim> &body     = *bodies[b];
    const auto        distance = [&](const double s) {
      return body.distance(x + s * up, cell_size);
    };
    const double longest =
      (body.estimates_distance() ? longest_blind_step : 1.) * cell_size;
    double s = 0, value = distance(0.), begin = 0;
    bool   runs_along = false;
    while (s < length)
      {
        const double next =
          std::min(length,
                   s + std::clamp(std::abs(value), cell_size / 32, longest));
        const bool was_inside = value > 0;
        const bool was_on_it  = std::abs(value) <= on_surface * cell_size;
        value                 = distance(next);
        runs_along            = runs_along ||
                     (was_on_it && std::abs(value) <= on_surface * cell_size);
        if ((value > 0) != was_inside)
          {
            double lower = s, upper = next;
            for (unsigned int halving = 0; halving < 60; ++halving)
              {
                const double middle = 0.5 * (lower + upper);
                (body.contains(x + middle * up) == was_inside ? lower : upper) =
                  middle;
              }
            if (was_inside)
              parts.push_back({begin, upper, b});
            begin = upper;
          }
        s = next;
      }
    if (value > 0)
      parts.push_back({begin, length, b});
    return runs_along;
  }



  template <int dim>
  typename Overburden<dim>::Column
  Overburden<dim>::column(const Point<dim>          &x,
                          const unsigned int         body,
                          const Tensor<1, dim>      &up,
                          const std::vector<double> &weights,
                          bool                      &runs_along) const
  {
    const double      length = length_in_mesh(x, up);
    std::vector<Part> parts;
    for (unsigned int b = 0; b < bodies.size(); ++b)
      if (bodies[b])
        runs_along = add_parts(b, x, up, length, parts) || runs_along;
    std::sort(parts.begin(), parts.end(), [](const Part &a, const Part &b) {
      return a.begin < b.begin;
    });
    Column column{0., body, x};
    double reached = 0;
    for (const Part &part : parts)
      {
        if (part.begin > reached + smallest_gap * cell_size)
          break;
        column.pressure += weights[part.body] * (part.end - part.begin);
        column.top = part.body;
        reached    = std::max(reached, part.end);
      }
    column.surface = x + reached * up;
    return column;
  }



  template <int dim>
  std::vector<typename Overburden<dim>::Column>
  Overburden<dim>::above(const Point<dim>          &x,
                         const unsigned int         body,
                         const Tensor<1, dim>      &up,
                         const std::vector<double> &weights) const
  {
    bool         runs_along = false;
    const Column straight   = column(x, body, up, weights, runs_along);
    if (!runs_along)
      return {straight};
    std::vector<Column> beside;
    for (const Tensor<1, dim> &shift : sideways(up))
      beside.push_back(column(
        x + 4 * on_surface * cell_size * shift, body, up, weights, runs_along));
    return beside;
  }



  template class Overburden<2>;
  template class Overburden<3>;
} // namespace moraine
