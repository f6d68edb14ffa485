// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_tests_geometry_surface_cases_h
#define moraine_tests_geometry_surface_cases_h

#include <moraine/geometry/shape.h>

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/tria.h>

#include <random>

namespace moraine_tests
{
  /** Numbers that are the same on every machine and rank. */
  class Numbers
  {
  public:
    explicit Numbers(const unsigned int seed)
      : engine(seed)
    {}

    double
    between(const double a, const double b)
    {
      return a + (b - a) * (engine() / 4294967296.);
    }

    template <int dim>
    dealii::Point<dim>
    point(const double a, const double b)
    {
      dealii::Point<dim> x;
      for (unsigned int d = 0; d < dim; ++d)
        x[d] = between(a, b);
      return x;
    }

    template <int dim>
    dealii::Tensor<1, dim>
    direction()
    {
      dealii::Tensor<1, dim> v;
      do
        v = point<dim>(-1., 1.);
      while (v.norm() < 0.1 || v.norm() > 1.);
      return v / v.norm();
    }

  private:
    std::mt19937 engine;
  };

  template <int dim>
  using Cells = std::vector<moraine::CellVertices<dim>>;

  /**
   * The cells of a box from 0 to @p length with @p n cells a side. Inner
   * vertices are moved by up to @p distortion times the cell size.
   */
  template <int dim>
  Cells<dim>
  box_cells(const unsigned int n,
            const double       length,
            const double       distortion,
            const unsigned int seed = 1)
  {
    dealii::Triangulation<dim> tria;
    dealii::GridGenerator::subdivided_hyper_cube(tria, n, 0., length);
    Numbers numbers(seed);
    auto   &vertices =
      const_cast<std::vector<dealii::Point<dim>> &>(tria.get_vertices());
    for (auto &v : vertices)
      {
        const dealii::Tensor<1, dim> shift =
          distortion * length / n * numbers.point<dim>(-1., 1.);
        bool inner = true;
        for (unsigned int d = 0; d < dim; ++d)
          inner = inner && v[d] > 1e-9 * length && v[d] < (1 - 1e-9) * length;
        if (inner)
          v += shift;
      }
    Cells<dim> cells;
    for (const auto &cell : tria.active_cell_iterators())
      {
        cells.emplace_back();
        for (const unsigned int v : cell->vertex_indices())
          cells.back()[v] = cell->vertex(v);
      }
    return cells;
  }

  template <int dim>
  std::vector<moraine::SurfacePoint<dim>>
  all_pieces(const moraine::Surface<dim> &surface,
             const Cells<dim>            &cells,
             const unsigned int           n_gauss)
  {
    std::vector<moraine::SurfacePoint<dim>> points;
    for (const auto &cell : cells)
      surface.pieces(cell, n_gauss, points);
    return points;
  }

  template <int dim>
  double
  measure(const std::vector<moraine::SurfacePoint<dim>> &points)
  {
    double sum = 0.;
    for (const auto &p : points)
      sum += p.JxW;
    return sum;
  }

  template <int dim>
  dealii::Point<dim>
  centre(const moraine::CellVertices<dim> &cell)
  {
    dealii::Point<dim> c;
    for (const auto &v : cell)
      c += v / (1. * cell.size());
    return c;
  }

  /** Whether a segment of a 2D cell's outline has x on its right by more than
   * @p slack. */
  inline bool
  inside_cell(const moraine::CellVertices<2> &cell,
              const dealii::Point<2>         &x,
              const double                    slack)
  {
    const unsigned int cycle[5] = {0, 1, 3, 2, 0};
    for (unsigned int i = 0; i < 4; ++i)
      {
        const auto a = cell[cycle[i]], b = cell[cycle[i + 1]];
        const auto t = (b - a) / (b - a).norm();
        if (t[0] * (x[1] - a[1]) - t[1] * (x[0] - a[0]) < -slack)
          return false;
      }
    return true;
  }
} // namespace moraine_tests

#endif
