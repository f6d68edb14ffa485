// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/geometry/overburden.h>

#include <moraine/core/exceptions.h>

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

    /** Steps along a line, over the cell size: the shortest, and where a level
     * is no length the longest; what is thinner may be missed. */
    constexpr double shortest_step = 1. / 32;
    constexpr double longest_blind = 1. / 4;

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
          const PlaneFrame     across(Point<3>(), up);
          const Tensor<1, dim> a = across.first, b = across.second;
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



    /** A way along a line, in steps that its surface is away: by the level, or
     * where that is no length, by how it changes along the line. */
    template <int dim>
    class LineWalk
    {
    public:
      LineWalk(const Shape<dim>     &shape,
               const Point<dim>     &x,
               const Tensor<1, dim> &up,
               const double          cell_size)
        : shape(shape)
        , x(x)
        , up(up)
        , h(cell_size)
        , is_length(!shape.estimates_distance())
        , step(shortest_step * h)
      {
        if (!is_length)
          look_beside();
        look();
        if (is_length)
          step = std::clamp(std::abs(value), shortest_step * h, h);
      }

      void
      go_on(const double length)
      {
        const double begin = at, before = value;
        at = std::min(length, at + step);
        look();
        const double change = std::abs(value - before);
        if (is_length)
          step = std::clamp(std::abs(value), shortest_step * h, h);
        else if (change > 0)
          step = std::clamp(std::abs(value) * (at - begin) / change,
                            shortest_step * h,
                            longest_blind * h);
        else
          step = longest_blind * h;
      }

      double
      s() const
      {
        return at;
      }

      bool
      inside() const
      {
        return value > 0;
      }

      bool
      on_edge() const
      {
        return is_on_edge;
      }

    private:
      void
      look_beside()
      {
        try
          {
            largest = std::abs(shape.level(x + h * sideways(up)[0]));
          }
        catch (const InputError &)
          {} // an expression need not have values there
      }

      void
      look()
      {
        const Point<dim> place = x + at * up;
        value                  = shape.level(place);
        largest                = std::max(largest, std::abs(value));
        is_on_edge             = is_length ?
                                   std::abs(value) <= on_surface * h :
                                   std::abs(value) <= 100 * on_surface * largest &&
                         std::abs(shape.distance(place, h)) <= on_surface * h;
      }

      const Shape<dim>    &shape;
      const Point<dim>     x;
      const Tensor<1, dim> up;
      const double         h;
      const bool           is_length;
      double               largest = 0; ///< level, beside the line too
      double               step;
      double               at         = 0;
      double               value      = 0;
      bool                 is_on_edge = false;
    };
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
    LineWalk<dim> walk(*bodies[b], x, up, cell_size);
    double        begin      = 0;
    bool          runs_along = false;
    while (walk.s() < length)
      {
        const double s          = walk.s();
        const bool   was_inside = walk.inside(), was_on_edge = walk.on_edge();
        walk.go_on(length);
        runs_along = runs_along || (was_on_edge && walk.on_edge());
        if (walk.inside() != was_inside)
          {
            double lower = s, upper = walk.s();
            for (unsigned int halving = 0; halving < 60; ++halving)
              {
                const double middle = 0.5 * (lower + upper);
                (bodies[b]->contains(x + middle * up) == was_inside ? lower :
                                                                      upper) =
                  middle;
              }
            if (was_inside)
              parts.push_back({begin, upper, b});
            begin = upper;
          }
      }
    if (walk.inside())
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
    Column column{0., body, x, {}};
    double reached = 0;
    for (const Part &part : parts)
      {
        if (part.begin > reached + smallest_gap * cell_size)
          break;
        column.pressure += weights[part.body] * (part.end - part.begin);
        column.top = part.body;
        column.parts.push_back(part);
        reached = std::max(reached, part.end);
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
