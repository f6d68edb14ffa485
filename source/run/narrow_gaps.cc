// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/run/narrow_gaps.h>

#include <moraine/basis/cell_patch.h>
#include <moraine/core/exceptions.h>
#include <moraine/core/words.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <optional>
#include <sstream>
#include <utility>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** Of a cell: a slot that is meant. */
    constexpr double least_slot = 0.05;



    /** Of a cell: nodes join material that is no further apart. */
    constexpr double largest_narrow_gap = 2.;



    /** Of a cell: how finely a gap is looked for. */
    template <int dim>
    constexpr double sample = dim == 2 ? 1. / 16 : 1. / 8;



    /** Part of a line through a body that is not in it. */
    template <int dim>
    struct Gap
    {
      double     width;
      Point<dim> middle;
      Point<dim> beyond; ///< in the body again
    };



    /** How far inside of a shape a place is, estimated over @p h; infinitely
     * where an expression is no number. */
    template <int dim>
    double
    distance_in(const Shape<dim> &shape, const Point<dim> &x, const double h)
    {
      try
        {
          return shape.distance(x, h);
        }
      catch (const InputError &)
        {
          return std::numeric_limits<double>::infinity();
        }
    }



    /** Also where an expression is no number. */
    template <int dim>
    bool
    is_in_shape(const Shape<dim> &shape, const Point<dim> &x)
    {
      try
        {
          return shape.contains(x);
        }
      catch (const InputError &)
        {
          return true;
        }
    }



    /** The first gap on the way from a place in a shape along @p direction, of
     * unit length. */
    template <int dim>
    std::optional<Gap<dim>>
    first_gap(const Shape<dim>     &shape,
              const Point<dim>     &x,
              const Tensor<1, dim> &direction,
              const double          h)
    {
      const double step  = sample<dim> * h;
      double       begin = 0; // of the gap, once it has begun
      for (double s = step; s < largest_narrow_gap * h + begin; s += step)
        {
          const bool inside = is_in_shape<dim>(shape, x + s * direction);
          if (!inside && begin == 0)
            begin = s;
          else if (!inside && s - begin > largest_narrow_gap * h)
            break;
          else if (inside && begin > 0)
            return Gap<dim>{s - begin,
                            x + 0.5 * (begin - step + s) * direction,
                            x + s * direction};
        }
      return {};
    }



    /** How far from a shape one can get from a place outside of it by climbing,
     * or @p h if that is less: in a slot half of its width, in a hole the
     * radius.
     */
    template <int dim>
    double
    depth_around(const Shape<dim> &shape, Point<dim> x, const double h)
    {
      constexpr unsigned int most  = 100;
      double                 depth = -distance_in(shape, x, h);
      for (unsigned int i = 0; i < most && depth < h; ++i)
        {
          Point<dim>         best     = x;
          double             deepest  = depth;
          const unsigned int n_around = Utilities::fixed_power<dim>(3u);
          for (unsigned int k = 0; k < n_around; ++k)
            {
              Point<dim> y = x;
              for (unsigned int d = 0, rest = k; d < dim; ++d, rest /= 3)
                y[d] += (int(rest % 3) - 1) * sample<dim> * h;
              const double deep = -distance_in(shape, y, h);
              if (deep > deepest + 1e-3 * h)
                {
                  deepest = deep;
                  best    = y;
                }
            }
          if (deepest == depth)
            return depth;
          x     = best;
          depth = deepest;
        }
      return std::min(depth, h);
    }



    /** Whether two cells have a node in common. */
    template <int dim>
    bool
    have_common_node(const typename GridSpace<dim>::CellIterator &a,
                     const typename GridSpace<dim>::CellIterator &b)
    {
      for (const unsigned int v : a->vertex_indices())
        for (const unsigned int w : b->vertex_indices())
          if (a->vertex_index(v) == b->vertex_index(w))
            return true;
      return false;
    }



    /** The width of the narrowest gap of a body beside points of this rank,
     * infinite if there is none, and where it is. */
    template <int dim>
    std::pair<double, Point<dim>>
    narrowest_gap(const Model<dim>          &model,
                  const unsigned int         body,
                  const CellNeighbours<dim> &cells)
    {
      const Shape<dim> &shape       = *model.bodies[body].shape;
      const double      h           = model.mesh->cell_size();
      const auto        is_of_other = [&](const Point<dim> &x) {
        return std::any_of(model.bodies.begin(),
                           model.bodies.end(),
                           [&](const Body<dim> &other) {
                             return !other.shape ||
                                    is_in_shape(*other.shape, x);
                           });
      };
      std::pair<double, Point<dim>> narrowest(
        std::numeric_limits<double>::infinity(), {});
      for (unsigned int p = 0; p < model.points->n_local(); ++p)
        {
          const Point<dim> x = model.points->position(p);
          if (model.points->body(p) != body || distance_in(shape, x, h) > h)
            continue;
          for (unsigned int d = 0; d < dim; ++d)
            {
              const auto gap =
                first_gap<dim>(shape, x, Point<dim>::unit_vector(d), h);
              if (!gap || gap->width < least_slot * h ||
                  is_of_other(gap->middle))
                continue;
              const auto cell =
                cells.cell_around(model.points->cell_of(p), gap->beyond);
              if (cell == model.mesh->triangulation().end() ||
                  !have_common_node<dim>(model.points->cell_of(p), cell))
                continue;
              const double depth = depth_around(shape, gap->middle, h);
              // The joint of two operands is none.
              if (depth > 1e-6 * h && depth < h && 2 * depth < narrowest.first)
                narrowest = {2 * depth, gap->middle};
            }
        }
      return narrowest;
    }
  } // namespace



  template <int dim>
  void
  tell_of_narrow_gaps(const Model<dim>               &model,
                      const std::vector<std::string> &known,
                      std::vector<std::string>       &notes)
  {
    const CellNeighbours<dim> cells(*model.mesh);
    for (unsigned int body = 0; body < model.bodies.size(); ++body)
      {
        if (!model.bodies[body].shape ||
            contains(known, model.body_names[body]))
          continue;
        auto narrowest = narrowest_gap(model, body, cells);
        for (const auto &of_rank :
             Utilities::MPI::all_gather(model.space->communicator(), narrowest))
          if (of_rank.first < narrowest.first)
            narrowest = of_rank;
        if (!std::isfinite(narrowest.first))
          continue;
        std::ostringstream text;
        text << model.body_names[body]
             << ": cells are too coarse for its gap or "
             << "hole at (" << std::setprecision(3) << narrowest.second
             << "), about " << narrowest.first
             << " wide; what is on both sides of it touches the same nodes and "
                "hangs together. Cells smaller than half of that part it";
        notes.push_back(text.str());
      }
  }



  template void
  tell_of_narrow_gaps(const Model<2> &,
                      const std::vector<std::string> &,
                      std::vector<std::string> &);
  template void
  tell_of_narrow_gaps(const Model<3> &,
                      const std::vector<std::string> &,
                      std::vector<std::string> &);
} // namespace moraine
