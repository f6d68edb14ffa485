// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/geometry/covered_pieces.h>

#include <moraine/core/exceptions.h>
#include <moraine/geometry/shapes.h>

#include <algorithm>
#include <iterator>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** Of a cell: where the edge of a body at the surface is known to. */
    constexpr double margin_of_edge = 1e-3;

    /** Of a cell: a gap between surface and body that is none. */
    constexpr double small_gap = 0.1;



    /** They see all but the last tenth of a part. */
    constexpr unsigned int n_gauss_in_parts = 3;



    /** The parts of a cell that is halved along each of its axes. */
    template <int dim>
    std::vector<CellVertices<dim>>
    halves(const CellVertices<dim> &cell)
    {
      std::vector<CellVertices<dim>> parts(cell.size());
      for (unsigned int part = 0; part < parts.size(); ++part)
        for (unsigned int v = 0; v < cell.size(); ++v)
          {
            // Half way between these two vertices of the reference cell: the
            // mean of the vertices of the face or edge that they span.
            Tensor<1, dim> sum;
            unsigned int   n = 0;
            for (unsigned int w = 0; w < cell.size(); ++w)
              if (((w ^ part) & ~(part ^ v)) == 0)
                {
                  sum += cell[w];
                  ++n;
                }
            parts[part][v] = Point<dim>(sum / n);
          }
      return parts;
    }
  } // namespace



  template <int dim>
  bool
  covers_place(const Shape<dim> &shape,
               const Point<dim> &x,
               const double      margin)
  {
    try
      {
        return shape.covers(x, margin);
      }
    catch (const InputError &)
      {
        return true;
      }
  }



  template <int dim>
  Covers<dim>
  covers_of(const std::vector<std::shared_ptr<const Shape<dim>>> &shapes)
  {
    if (std::find(shapes.begin(), shapes.end(), nullptr) != shapes.end())
      return {};
    return [shapes](const Point<dim> &x, const double margin) {
      return std::any_of(shapes.begin(), shapes.end(), [&](const auto &shape) {
        return covers_place(*shape, x, margin);
      });
    };
  }



  template <int dim>
  bool
  is_at_body(const Covers<dim>    &covers,
             const Point<dim>     &x,
             const Tensor<1, dim> &normal,
             const double          h)
  {
    const double margin = margin_of_edge * h;
    return covers(x, margin) || covers(x - small_gap * h * normal, margin);
  }



  template <int dim>
  bool
  is_near_body(const Covers<dim>    &covers,
               const Point<dim>     &x,
               const Tensor<1, dim> &normal,
               const double          h)
  {
    return covers(x - largest_gap * h * normal, margin_of_edge * h);
  }



  template <int dim>
  ShapePointer<dim>
  united(const std::vector<ShapePointer<dim>> &shapes)
  {
    if (shapes.empty() ||
        std::find(shapes.begin(), shapes.end(), nullptr) != shapes.end())
      return nullptr;
    ShapePointer<dim> all = shapes[0];
    for (std::size_t b = 1; b < shapes.size(); ++b)
      all = combine(Operation::unite, all, shapes[b]);
    return all;
  }



  template <int dim>
  Extent<dim>
  beside(const ShapePointer<dim> &body, const double reach)
  {
    Extent<dim> extent;
    extent.limits.push_back({body, true, Extent<dim>::Along::beside, reach});
    extent.box = body->bounding_box();
    extent.box.extend(reach);
    return extent;
  }



  template <int dim>
  void
  add_kept_pieces(const Surface<dim>                                   &surface,
                  const CellVertices<dim>                              &cell,
                  const unsigned int                                    n_gauss,
                  const std::function<bool(const SurfacePoint<dim> &)> &keep,
                  std::vector<SurfacePoint<dim>>                       &points,
                  const unsigned int n_halvings)
  {
    std::vector<SurfacePoint<dim>> all, kept;
    surface.pieces(cell, n_gauss, all);
    std::copy_if(all.begin(), all.end(), std::back_inserter(kept), keep);
    if (n_halvings == 0 || kept.empty() || kept.size() == all.size())
      points.insert(points.end(), kept.begin(), kept.end());
    else
      for (const CellVertices<dim> &part : halves<dim>(cell))
        add_kept_pieces(
          surface, part, n_gauss_in_parts, keep, points, n_halvings - 1);
  }



#define INSTANTIATE(dim)                                        \
  template decltype(covers_place<dim>)    covers_place<dim>;    \
  template decltype(covers_of<dim>)       covers_of<dim>;       \
  template decltype(is_at_body<dim>)      is_at_body<dim>;      \
  template decltype(is_near_body<dim>)    is_near_body<dim>;    \
  template decltype(add_kept_pieces<dim>) add_kept_pieces<dim>; \
  template decltype(united<dim>)          united<dim>;          \
  template decltype(beside<dim>)          beside<dim>;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
