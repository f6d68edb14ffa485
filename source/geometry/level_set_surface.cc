// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/geometry/level_set_surface.h>

#include <moraine/geometry/cell_cut.h>

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

  template class LevelSetSurface<2>;
  template class LevelSetSurface<3>;
} // namespace moraine
