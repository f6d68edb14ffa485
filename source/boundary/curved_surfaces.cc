// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/boundary/cell_cut.h>
#include <moraine/boundary/curved_surfaces.h>
#include <moraine/core/exceptions.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/hp/q_collection.h>
#include <deal.II/non_matching/quadrature_generator.h>

#include <algorithm>
#include <cmath>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    void
    check_radius(const double radius)
    {
      if (!(radius > 0.) || !std::isfinite(radius))
        throw InputError("a radius must be positive, found " +
                         std::to_string(radius));
    }

    template <int dim>
    BoundingBox<dim>
    box_around(const Point<dim> &centre, const double radius)
    {
      Point<dim> lower = centre, upper = centre;
      for (unsigned int d = 0; d < dim; ++d)
        {
          lower[d] -= radius;
          upper[d] += radius;
        }
      return BoundingBox<dim>({lower, upper});
    }

    /** The direction of v, or any where v is zero. */
    template <int dim>
    Tensor<1, dim>
    unit_or_any(const Tensor<1, dim> &v)
    {
      const double length = v.norm();
      return length > 0. ? v / length : Point<dim>::unit_vector(0);
    }
  } // namespace

  Arc::Arc(const Point<2> &centre,
           const double    radius,
           const bool      body_inside,
           const double    start_angle,
           const double    end_angle)
    : centre(centre)
    , radius(radius)
    , sign(body_inside ? 1. : -1.)
    , start(start_angle * numbers::PI / 180.)
    , sweep((end_angle - start_angle) * numbers::PI / 180.)
  {
    check_radius(radius);
    if (!(end_angle > start_angle) || end_angle > start_angle + 360.)
      throw InputError("an arc must end after its start and within 360 degrees "
                       "of it, found " +
                       std::to_string(start_angle) + " to " +
                       std::to_string(end_angle));
    std::vector<Point<2>> extremes{at_angle(0.), at_angle(sweep)};
    for (int quarter = std::ceil(2. * start / numbers::PI);
         quarter * numbers::PI / 2. < start + sweep;
         ++quarter)
      extremes.push_back(at_angle(quarter * numbers::PI / 2. - start));
    box = BoundingBox<2>(extremes);
  }

  double
  Arc::angle_from_start(const Point<2> &x) const
  {
    double angle = std::atan2(x[1] - centre[1], x[0] - centre[0]) - start;
    angle -= 2. * numbers::PI * std::floor(angle / (2. * numbers::PI));
    return angle;
  }

  Point<2>
  Arc::at_angle(const double from_start) const
  {
    return centre + radius * Point<2>(std::cos(start + from_start),
                                      std::sin(start + from_start));
  }

  double
  Arc::level(const Point<2> &x) const
  {
    return sign * (radius - x.distance(centre));
  }

  Tensor<1, 2>
  Arc::normal(const Point<2> &x) const
  {
    return sign * unit_or_any<2>(x - centre);
  }

  bool
  Arc::in_extent(const Point<2> &x) const
  {
    const double angle = angle_from_start(x), tolerance = 1e-10;
    return angle <= sweep + tolerance || angle >= 2. * numbers::PI - tolerance;
  }

  namespace
  {
    /**
     * The line of a cell's edge as a circle sees it: points of the circle
     * within
     * @p half_angle of the direction @p middle lie on the cell's side if
     * @p cell_within, else on the other. Computed from the ends in an order
     * that neighbours share, so both see the same angles, even where it grazes.
     */
    struct EdgeOnCircle
    {
      double middle, half_angle;
      bool   cell_within;
      /** Crossings on the edge or so near that they may be. */
      std::vector<double> breaks;
    };

    EdgeOnCircle
    edge_on_circle(Point<2>        a,
                   Point<2>        b,
                   const Point<2> &centre,
                   const double    radius)
    {
      EdgeOnCircle edge;
      edge.cell_within =
        std::make_pair(a[0], a[1]) < std::make_pair(b[0], b[1]);
      if (!edge.cell_within)
        std::swap(a, b);
      const double       length = a.distance(b);
      const Tensor<1, 2> t      = (b - a) / length;
      const Tensor<1, 2> left   = Point<2>(-t[1], t[0]);
      const double       height = (centre - a) * left;
      // (R − h)(R + h) keeps the digits of a grazing line
      const double half_chord =
        std::sqrt(std::max(0., (radius - height) * (radius + height)));
      edge.middle = std::atan2(left[1], left[0]);
      // a line that does not cross leaves every angle on one side, ±π too
      edge.half_angle = half_chord > 0. ? std::atan2(half_chord, -height) :
                        height > 0.     ? 4. :
                                          0.;
      if (half_chord > 0.)
        for (const double side : {-1., 1.})
          {
            const double abscissa = (centre - a) * t - side * half_chord;
            // one break too many does no harm, one too few does
            if (abscissa >= -1e-3 * length && abscissa <= 1.001 * length)
              edge.breaks.push_back(edge.middle + side * edge.half_angle);
          }
      return edge;
    }

    bool
    contains(const std::vector<EdgeOnCircle> &edges, const double angle)
    {
      return std::all_of(edges.begin(), edges.end(), [angle](const auto &edge) {
        const double off =
          std::remainder(angle - edge.middle, 2. * numbers::PI);
        return (std::abs(off) < edge.half_angle) == edge.cell_within;
      });
    }
  } // namespace

  void
  Arc::pieces(const CellVertices<2>        &cell,
              const unsigned int            n_gauss,
              std::vector<SurfacePoint<2>> &out) const
  {
    if (!may_touch<2>(cell, box))
      return;
    constexpr unsigned int    cycle[5] = {0, 1, 3, 2, 0};
    std::vector<EdgeOnCircle> edges;
    std::vector<double>       breaks{0., sweep};
    for (unsigned int e = 0; e < 4; ++e)
      {
        edges.push_back(
          edge_on_circle(cell[cycle[e]], cell[cycle[e + 1]], centre, radius));
        for (const double angle : edges.back().breaks)
          {
            const double turn = 2. * numbers::PI;
            const double from_start =
              angle - start - turn * std::floor((angle - start) / turn);
            if (from_start < sweep)
              breaks.push_back(from_start);
          }
      }
    std::sort(breaks.begin(), breaks.end());

    const QGauss<1> gauss(n_gauss);
    for (unsigned int i = 0; i + 1 < breaks.size();)
      {
        unsigned int j = i + 1;
        while (j < breaks.size() &&
               contains(edges, start + .5 * (breaks[j - 1] + breaks[j])))
          ++j;
        const double from = breaks[i], angle = breaks[j - 1] - from;
        i = j;
        if (angle <= 4e-15)
          continue;
        const unsigned int n =
          std::max(1., std::ceil(angle / (numbers::PI / 4.) - 1e-9));
        for (unsigned int part = 0; part < n; ++part)
          for (unsigned int q = 0; q < gauss.size(); ++q)
            {
              const auto x =
                at_angle(from + (part + gauss.point(q)[0]) * angle / n);
              out.push_back(
                {x, normal(x), gauss.weight(q) * radius * angle / n});
            }
      }
  }

  BoundingBox<2>
  Arc::bounding_box() const
  {
    return box;
  }

  bool
  Arc::curved() const
  {
    return true;
  }

  namespace
  {
    /** The multilinear map of a cell from the unit box. */
    template <int dim>
    class CellMap
    {
    public:
      explicit CellMap(const CellVertices<dim> &cell)
        : cell(cell)
      {}

      Point<dim>
      place(const Point<dim> &xi) const
      {
        Point<dim> x;
        for (unsigned int v = 0; v < cell.size(); ++v)
          x += factor(v, xi, dim, dim) * cell[v];
        return x;
      }

      /** J_kd = ∂x_k/∂ξ_d */
      Tensor<2, dim>
      jacobian(const Point<dim> &xi) const
      {
        Tensor<2, dim> J;
        for (unsigned int v = 0; v < cell.size(); ++v)
          for (unsigned int d = 0; d < dim; ++d)
            {
              const double f = factor(v, xi, d, dim);
              for (unsigned int k = 0; k < dim; ++k)
                J[k][d] += f * cell[v][k];
            }
        return J;
      }

      /** ∂²x/∂ξ_d∂ξ_e, zero for d = e */
      Tensor<1, dim>
      second(const Point<dim>  &xi,
             const unsigned int d,
             const unsigned int e) const
      {
        Tensor<1, dim> result;
        if (d != e)
          for (unsigned int v = 0; v < cell.size(); ++v)
            result += factor(v, xi, d, e) * cell[v];
        return result;
      }

    private:
      /** Shape function of vertex v, differentiated in ξ_d and ξ_e (dim: not).
       */
      double
      factor(const unsigned int v,
             const Point<dim>  &xi,
             const unsigned int d,
             const unsigned int e) const
      {
        double f = 1.;
        for (unsigned int i = 0; i < dim; ++i)
          {
            const bool upper = (v >> i) & 1u;
            if (i == d || i == e)
              f *= upper ? 1. : -1.;
            else
              f *= upper ? xi[i] : 1. - xi[i];
          }
        return f;
      }

      const CellVertices<dim> &cell;
    };

    /** φ of a surface composed with the map of a cell, lowered by a shift. */
    template <int dim>
    class ReferenceLevelSet : public Function<dim>
    {
    public:
      ReferenceLevelSet(const LevelSetSurface<dim> &surface,
                        const CellMap<dim>         &map,
                        const double                length,
                        const double                shift)
        : surface(surface)
        , map(map)
        , length(length)
        , shift(shift)
      {}

      double
      value(const Point<dim> &xi, const unsigned int = 0) const override
      {
        return surface.function_value(map.place(xi)) - shift;
      }

      Tensor<1, dim>
      gradient(const Point<dim> &xi, const unsigned int = 0) const override
      {
        return transpose(map.jacobian(xi)) *
               surface.function_gradient(map.place(xi), length);
      }

      SymmetricTensor<2, dim>
      hessian(const Point<dim> &xi, const unsigned int = 0) const override
      {
        const Point<dim>        x        = map.place(xi);
        const Tensor<2, dim>    J        = map.jacobian(xi);
        const Tensor<1, dim>    gradient = surface.function_gradient(x, length);
        const Tensor<2, dim>    H        = surface.function_hessian(x, length);
        SymmetricTensor<2, dim> result   = symmetrize(transpose(J) * H * J);
        for (unsigned int d = 0; d < dim; ++d)
          for (unsigned int e = d + 1; e < dim; ++e)
            result[d][e] += gradient * map.second(xi, d, e);
        return result;
      }

    private:
      const LevelSetSurface<dim> &surface;
      const CellMap<dim>         &map;
      const double                length;
      const double                shift;
    };

    /**
     * Cut the unit box down to the part within the limits. False where none is
     * left; @p exact is cleared where a limit runs across the box.
     */
    template <int dim>
    bool
    trim(const CellVertices<dim>           &cell,
         const CellMap<dim>                &map,
         const std::vector<HalfSpace<dim>> &limits,
         BoundingBox<dim>                  &box,
         bool                              &exact)
    {
      const double size = cell_size<dim>(cell);
      for (const auto &limit : limits)
        {
          std::array<double, (1 << dim)> margin;
          for (unsigned int v = 0; v < cell.size(); ++v)
            margin[v] =
              limit.direction * map.place(box.vertex(v)) - limit.offset;
          const double tolerance = 1e-12 * size * limit.direction.norm();
          const auto range = std::minmax_element(margin.begin(), margin.end());
          if (*range.second <= tolerance)
            return false;
          if (*range.first >= -tolerance)
            continue;
          // a limit along the axes changes the margin in one direction only
          unsigned int along = dim, n_along = 0;
          for (unsigned int d = 0; d < dim; ++d)
            for (unsigned int v = 0; v < cell.size(); ++v)
              if (std::abs(margin[v] - margin[v ^ (1u << d)]) > tolerance)
                {
                  along = d;
                  ++n_along;
                  break;
                }
          if (n_along != 1)
            {
              exact = false;
              continue;
            }
          auto         corners = box.get_boundary_points();
          const double low = margin[0], high = margin[1u << along];
          const double cut =
            corners.first[along] +
            low / (low - high) * (corners.second[along] - corners.first[along]);
          (low < 0. ? corners.first : corners.second)[along] = cut;
          box = BoundingBox<dim>(corners);
        }
      return true;
    }

    /** Whether a surface surely keeps away from the image of a box. */
    template <int dim>
    bool
    far_from(const LevelSetSurface<dim> &surface,
             const CellMap<dim>         &map,
             const BoundingBox<dim>     &box)
    {
      const Point<dim> middle = map.place(box.center());
      const bool       inside = surface.function_value(middle) > 0.;
      double           reach  = 0.;
      for (unsigned int v = 0; v < (1 << dim); ++v)
        {
          const Point<dim> x = map.place(box.vertex(v));
          if ((surface.function_value(x) > 0.) != inside)
            return false;
          reach = std::max(reach, x.distance(middle));
        }
      // twice the reach: the level of an expression is only an estimate
      return std::abs(surface.level(middle)) > 2. * reach;
    }

    /** Boxes that make up the part of the unit box within the limits. */
    template <int dim>
    void
    boxes_within(const LevelSetSurface<dim>        &surface,
                 const CellVertices<dim>           &cell,
                 const CellMap<dim>                &map,
                 const std::vector<HalfSpace<dim>> &limits,
                 BoundingBox<dim>                   box,
                 const unsigned int                 halvings,
                 std::vector<BoundingBox<dim>>     &result)
    {
      bool exact = true;
      if (far_from(surface, map, box) || !trim(cell, map, limits, box, exact))
        return;
      if (exact || halvings == 0)
        result.push_back(box);
      else
        for (unsigned int child = 0; child < (1 << dim); ++child)
          boxes_within(
            surface, cell, map, limits, box.child(child), halvings - 1, result);
    }
  } // namespace

  template <int dim>
  bool
  LevelSetSurface<dim>::in_extent(const Point<dim> &x) const
  {
    const Point<dim> foot = foot_point(x);
    return std::all_of(limits.begin(), limits.end(), [&](const auto &limit) {
      return limit.direction * foot >=
             limit.offset - 1e-10 * std::max(std::abs(limit.offset),
                                             coordinate_magnitude<dim>(foot));
    });
  }

  template <int dim>
  void
  LevelSetSurface<dim>::pieces(const CellVertices<dim>        &cell,
                               const unsigned int              n_gauss,
                               std::vector<SurfacePoint<dim>> &out) const
  {
    if (!may_touch<dim>(cell, this->bounding_box()))
      return;
    const CellMap<dim>            map(cell);
    std::vector<BoundingBox<dim>> boxes;
    boxes_within(
      *this, cell, map, limits, create_unit_bounding_box<dim>(), 4, boxes);
    if (boxes.empty())
      return;
    const double reach = cell_size<dim>(cell);
    // a surface that follows a face is moved into the body, to be found once
    const double shift =
      1e-10 * reach *
      function_gradient(map.place(boxes[0].center()), reach).norm();
    const ReferenceLevelSet<dim>          level_set(*this, map, reach, shift);
    const hp::QCollection<1>              gauss((QGauss<1>(n_gauss)));
    NonMatching::QuadratureGenerator<dim> generator(gauss);
    for (const auto &box : boxes)
      {
        generator.generate(level_set, box);
        const auto &rule = generator.get_surface_quadrature();
        for (unsigned int q = 0; q < rule.size(); ++q)
          {
            const Tensor<2, dim> J = map.jacobian(rule.point(q));
            Point<dim>           x = map.place(rule.point(q));
            Tensor<1, dim>       g = function_gradient(x, reach);
            x -= function_value(x) / g.norm_square() * g;
            if (!in_extent(x))
              continue;
            const double stretch =
              determinant(J) *
              (transpose(invert(J)) * rule.normal_vector(q)).norm();
            g = function_gradient(x, reach);
            out.push_back({x, g / -g.norm(), rule.weight(q) * stretch});
          }
      }
  }

  template <int dim>
  bool
  LevelSetSurface<dim>::curved() const
  {
    return true;
  }

  template <int dim>
  Sphere<dim>::Sphere(const Point<dim> &centre,
                      const double      radius,
                      const bool        body_inside)
    : centre(centre)
    , radius(radius)
    , sign(body_inside ? 1. : -1.)
  {
    check_radius(radius);
  }

  template <int dim>
  double
  Sphere<dim>::level(const Point<dim> &x) const
  {
    return sign * (radius - x.distance(centre));
  }

  template <int dim>
  Tensor<1, dim>
  Sphere<dim>::normal(const Point<dim> &x) const
  {
    return sign * unit_or_any<dim>(x - centre);
  }

  template <int dim>
  BoundingBox<dim>
  Sphere<dim>::bounding_box() const
  {
    return box_around<dim>(centre, radius);
  }

  // (R² − r²)/(2R) has the zeros of the distance and is smooth at the centre
  template <int dim>
  double
  Sphere<dim>::function_value(const Point<dim> &x) const
  {
    return sign * (radius * radius - x.distance_square(centre)) / (2. * radius);
  }

  template <int dim>
  Tensor<1, dim>
  Sphere<dim>::function_gradient(const Point<dim> &x, const double) const
  {
    return -sign / radius * (x - centre);
  }

  template <int dim>
  SymmetricTensor<2, dim>
  Sphere<dim>::function_hessian(const Point<dim> &, const double) const
  {
    return -sign / radius * unit_symmetric_tensor<dim>();
  }

  template <int dim>
  Point<dim>
  Sphere<dim>::foot_point(const Point<dim> &x) const
  {
    return centre + radius * unit_or_any<dim>(x - centre);
  }

  Cylinder::Cylinder(const Point<3> &axis_start,
                     const Point<3> &axis_end,
                     const double    radius,
                     const bool      body_inside)
    : start(axis_start)
    , end(axis_end)
    , axis(axis_end - axis_start)
    , radius(radius)
    , sign(body_inside ? 1. : -1.)
  {
    check_radius(radius);
    if (!(axis.norm() > 0.))
      throw InputError("the axis of a cylinder must have a length");
    axis /= axis.norm();
    limits = {{axis, axis * start}, {-axis, -(axis * end)}};
  }

  Tensor<1, 3>
  Cylinder::radial(const Point<3> &x) const
  {
    return (x - start) - ((x - start) * axis) * axis;
  }

  double
  Cylinder::level(const Point<3> &x) const
  {
    return sign * (radius - radial(x).norm());
  }

  Tensor<1, 3>
  Cylinder::normal(const Point<3> &x) const
  {
    return sign * unit_or_any<3>(radial(x));
  }

  BoundingBox<3>
  Cylinder::bounding_box() const
  {
    Tensor<1, 3> reach;
    for (unsigned int d = 0; d < 3; ++d)
      reach[d] = radius * std::sqrt(std::max(0., 1. - axis[d] * axis[d]));
    return BoundingBox<3>(std::vector<Point<3>>{
      start - reach, start + reach, end - reach, end + reach});
  }

  double
  Cylinder::function_value(const Point<3> &x) const
  {
    return sign * (radius * radius - radial(x).norm_square()) / (2. * radius);
  }

  Tensor<1, 3>
  Cylinder::function_gradient(const Point<3> &x, const double) const
  {
    return -sign / radius * radial(x);
  }

  SymmetricTensor<2, 3>
  Cylinder::function_hessian(const Point<3> &, const double) const
  {
    return -sign / radius *
           (unit_symmetric_tensor<3>() - symmetrize(outer_product(axis, axis)));
  }

  Point<3>
  Cylinder::foot_point(const Point<3> &x) const
  {
    const Tensor<1, 3> r       = radial(x);
    Tensor<1, 3>       outward = unit_or_any<3>(r);
    // on the axis r is round-off in any direction
    outward -= (outward * axis) * axis;
    return x - r + radius * unit_or_any<3>(outward);
  }

  namespace
  {
    template <int dim>
    BoundingBox<dim>
    everywhere()
    {
      return box_around<dim>(Point<dim>(), unlimited_extent);
    }
  } // namespace

  template <int dim>
  ExpressionSurface<dim>::ExpressionSurface(const std::string &expression)
    : ExpressionSurface(expression, everywhere<dim>())
  {}

  template <int dim>
  ExpressionSurface<dim>::ExpressionSurface(const std::string      &expression,
                                            const BoundingBox<dim> &extent)
    : function(1)
    , box(extent)
  {
    try
      {
        function.initialize(FunctionParser<dim>::default_variable_names(),
                            expression,
                            {{"pi", numbers::PI}});
        function.value(Point<dim>());
      }
    catch (const ExceptionBase &error)
      {
        throw InputError("the expression '" + expression +
                         "' cannot be read as a function of " +
                         FunctionParser<dim>::default_variable_names());
      }
    for (unsigned int d = 0; d < dim; ++d)
      {
        const Tensor<1, dim> e = Point<dim>::unit_vector(d);
        if (box.lower_bound(d) > -unlimited_extent)
          this->limits.push_back({e, box.lower_bound(d)});
        if (box.upper_bound(d) < unlimited_extent)
          this->limits.push_back({-e, -box.upper_bound(d)});
      }
  }

  template <int dim>
  double
  ExpressionSurface<dim>::length_near(const Point<dim> &x) const
  {
    const double largest = coordinate_magnitude<dim>(x);
    if (!this->limits.empty())
      {
        const double side = box.side_length(0);
        return side < unlimited_extent ? side : std::max(largest, 1e-3);
      }
    return std::max(largest, 1e-3);
  }

  template <int dim>
  double
  ExpressionSurface<dim>::level(const Point<dim> &x) const
  {
    const double slope = function_gradient(x, length_near(x)).norm();
    const double value = function_value(x);
    return slope > 0. ? value / slope : value;
  }

  template <int dim>
  Tensor<1, dim>
  ExpressionSurface<dim>::normal(const Point<dim> &x) const
  {
    return -unit_or_any<dim>(function_gradient(x, length_near(x)));
  }

  template <int dim>
  BoundingBox<dim>
  ExpressionSurface<dim>::bounding_box() const
  {
    return box;
  }

  template <int dim>
  double
  ExpressionSurface<dim>::function_value(const Point<dim> &x) const
  {
    return function.value(x);
  }

  template <int dim>
  Tensor<1, dim>
  ExpressionSurface<dim>::function_gradient(const Point<dim> &x,
                                            const double      length) const
  {
    // step ~ eps^(1/3)
    const double   h = 1e-5 * length;
    Tensor<1, dim> gradient;
    for (unsigned int d = 0; d < dim; ++d)
      {
        const Tensor<1, dim> e = h * Point<dim>::unit_vector(d);
        gradient[d] =
          (function.value(x + e) - function.value(x - e)) / (2. * h);
      }
    return gradient;
  }

  template <int dim>
  SymmetricTensor<2, dim>
  ExpressionSurface<dim>::function_hessian(const Point<dim> &x,
                                           const double      length) const
  {
    // step ~ eps^(1/4)
    const double            h = 2e-4 * length;
    SymmetricTensor<2, dim> hessian;
    const double            middle = function.value(x);
    for (unsigned int d = 0; d < dim; ++d)
      {
        const Tensor<1, dim> a = h * Point<dim>::unit_vector(d);
        hessian[d][d] =
          (function.value(x + a) - 2. * middle + function.value(x - a)) /
          (h * h);
        for (unsigned int e = d + 1; e < dim; ++e)
          {
            const Tensor<1, dim> b = h * Point<dim>::unit_vector(e);
            hessian[d][e] =
              (function.value(x + a + b) - function.value(x + a - b) -
               function.value(x - a + b) + function.value(x - a - b)) /
              (4. * h * h);
          }
      }
    return hessian;
  }

  template <int dim>
  Point<dim>
  ExpressionSurface<dim>::foot_point(const Point<dim> &x) const
  {
    const Tensor<1, dim> g      = function_gradient(x, length_near(x));
    const double         square = g.norm_square();
    return square > 0. ? x - function_value(x) / square * g : x;
  }

  template class LevelSetSurface<2>;
  template class LevelSetSurface<3>;
  template class Sphere<2>;
  template class Sphere<3>;
  template class ExpressionSurface<2>;
  template class ExpressionSurface<3>;
} // namespace moraine
