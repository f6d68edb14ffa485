// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/state/fitted_weights.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/base/symmetric_tensor.h>

#include <algorithm>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** Volume and centroid in reference coordinates, and the second moment
     * about that over the volume. */
    template <int dim>
    struct Moments
    {
      double                  volume = 0;
      Point<dim>              centroid;
      SymmetricTensor<2, dim> spread;
    };



    template <int dim>
    Moments<dim>
    moments_of_cell(const CellVertices<dim> &cell, const Quadrature<dim> &rule)
    {
      const CellMap<dim> map(cell);
      Moments<dim>       result;
      for (unsigned int q = 0; q < rule.size(); ++q)
        {
          const double JxW =
            rule.weight(q) * determinant(map.jacobian(rule.point(q)));
          result.volume += JxW;
          result.centroid += JxW * rule.point(q);
        }
      result.centroid /= result.volume;
      return result;
    }



    /** Of the points [first, last). */
    template <int dim>
    Moments<dim>
    moments_of_points(const PointSet<dim> &points,
                      const unsigned int   first,
                      const unsigned int   last)
    {
      Moments<dim> result;
      for (unsigned int p = first; p < last; ++p)
        {
          result.volume += points.volume(p);
          result.centroid += points.volume(p) * points.reference_position(p);
        }
      result.centroid /= result.volume;
      for (unsigned int p = first; p < last; ++p)
        result.spread +=
          points.volume(p) / result.volume *
          symmetrize(
            outer_product(points.reference_position(p) - result.centroid,
                          points.reference_position(p) - result.centroid));
      return result;
    }



    enum class Around : unsigned char
    {
      filled,
      edge, ///< of the mesh
      empty
    };

    /** Of each vertex, the worst there is around it. */
    template <int dim>
    std::vector<Around>
    surroundings(const GridSpace<dim> &space)
    {
      const auto         &tria = space.mesh().triangulation();
      std::vector<Around> around(tria.n_vertices(), Around::filled);
      const auto note = [&around](const auto &object, const Around what) {
        for (const unsigned int v : object->vertex_indices())
          around[object->vertex_index(v)] =
            std::max(around[object->vertex_index(v)], what);
      };
      for (const auto &cell : tria.active_cell_iterators())
        {
          if (!space.is_active(cell))
            note(cell, Around::empty);
          for (const auto &face : cell->face_iterators())
            if (face->at_boundary())
              note(face, Around::edge);
        }
      return around;
    }



    template <int dim>
    bool
    one_body(const PointSet<dim> &points,
             const unsigned int   first,
             const unsigned int   last)
    {
      for (unsigned int p = first + 1; p < last; ++p)
        if (points.body(p) != points.body(first))
          return false;
      return true;
    }



    /** The factors of the points [first, last) of a filled cell. */
    template <int dim>
    void
    fit(const PointSet<dim> &points,
        const unsigned int   first,
        const unsigned int   last,
        const Moments<dim>  &cell,
        const Moments<dim>  &sum,
        std::vector<double> &factors)
    {
      constexpr double flat  = 1e-6; // (spread / size of the cell)^(2 dim)
      constexpr double least = 0.1;
      Tensor<1, dim>   g;
      if (determinant(sum.spread) > flat)
        g = invert(sum.spread) * (cell.centroid - sum.centroid);
      const auto slope = [&](const unsigned int p) {
        return g * (points.reference_position(p) - sum.centroid);
      };
      double lowest = 0;
      for (unsigned int p = first; p < last; ++p)
        lowest = std::min(lowest, slope(p));
      const double theta = lowest < least - 1 ? (least - 1) / lowest : 1.;
      for (unsigned int p = first; p < last; ++p)
        factors[p] = cell.volume / sum.volume * (1 + theta * slope(p));
    }
  } // namespace



  template <int dim>
  FittedWeights<dim>::FittedWeights(const PointSet<dim> &points)
    : full_at_start(points.mesh().triangulation().n_active_cells())
  {
    constexpr double round_off = 1e-10;
    for (const auto &in_cell : points.cells())
      {
        double volume = 0;
        for (unsigned int p = in_cell.first; p < in_cell.last; ++p)
          volume += points.volume(p);
        full_at_start[in_cell.cell->active_cell_index()] =
          volume >= (1 - round_off) * volume_of_cell(in_cell.cell);
      }
  }



  template <int dim>
  std::vector<double>
  FittedWeights<dim>::factors(const GridSpace<dim> &space,
                              const PointSet<dim>  &points) const
  {
    const QGauss<dim>         rule(2);
    const std::vector<Around> around = surroundings(space);
    std::vector<double>       result(points.n_local(), 1.);
    for (const auto &in_cell : points.cells())
      {
        const unsigned int first = in_cell.first, last = in_cell.last;
        Around             worst = Around::filled;
        for (const unsigned int v : in_cell.cell->vertex_indices())
          worst = std::max(worst, around[in_cell.cell->vertex_index(v)]);
        if (worst == Around::empty ||
            (worst == Around::edge &&
             !full_at_start[in_cell.cell->active_cell_index()]) ||
            !one_body(points, first, last))
          continue;
        const Moments<dim> cell =
          moments_of_cell(vertices_of<dim>(in_cell.cell), rule);
        const Moments<dim> sum = moments_of_points(points, first, last);
        if (sum.volume > 0.5 * cell.volume)
          fit(points, first, last, cell, sum, result);
      }
    return result;
  }



  template class FittedWeights<2>;
  template class FittedWeights<3>;
} // namespace moraine
