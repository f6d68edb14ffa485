// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/basis/cell_patch.h>

#include <moraine/mesh/cell_shapes.h>

#include <algorithm>
#include <cmath>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  std::array<unsigned int, dim>
  place_in(const BoxGrid<dim> &grid, const Point<dim> &x)
  {
    std::array<unsigned int, dim> ijk;
    for (unsigned int d = 0; d < dim; ++d)
      ijk[d] = static_cast<unsigned int>(std::clamp(
        std::floor((x[d] - grid.lower_corner[d]) / grid.cell_size[d]),
        0.,
        grid.n_cells[d] - 1.));
    return ijk;
  }



  namespace
  {
    template <int dim>
    bool
    in_unit_cell(const Point<dim> &xi)
    {
      for (unsigned int d = 0; d < dim; ++d)
        // also false for what is not a number
        if (!(xi[d] >= -1e-10 && xi[d] <= 1 + 1e-10))
          return false;
      return true;
    }



    template <int dim>
    bool
    in_bounding_box(const CellVertices<dim> &X, const Point<dim> &x)
    {
      for (unsigned int d = 0; d < dim; ++d)
        {
          double lower = X[0][d], upper = X[0][d];
          for (const Point<dim> &vertex : X)
            {
              lower = std::min(lower, vertex[d]);
              upper = std::max(upper, vertex[d]);
            }
          const double margin = 1e-9 * (upper - lower);
          if (x[d] < lower - margin || x[d] > upper + margin)
            return false;
        }
      return true;
    }



    template <int dim>
    Point<dim>
    clamped(Point<dim> xi)
    {
      for (unsigned int d = 0; d < dim; ++d)
        xi[d] = std::clamp(xi[d], 0., 1.);
      return xi;
    }



    /** The functions of a cell at @p x, which has the reference position @p xi,
     * continued linearly if that is outside the unit cell. */
    template <int dim>
    void
    functions_at(const CellVertices<dim> &X,
                 const Point<dim>        &xi,
                 const Point<dim>        &x,
                 double                  *N)
    {
      const Point<dim> nearest = clamped(xi);
      if (nearest.distance(xi) < 1e-6)
        {
          CellShapes<dim, 1>::values(xi, N);
          return;
        }
      Tensor<1, dim> gradients[1 << dim];
      CellShapes<dim, 1>::evaluate(nearest, X.data(), N, gradients);
      const Tensor<1, dim> beyond = x - CellMap<dim>(X).place(nearest);
      for (unsigned int a = 0; a < X.size(); ++a)
        N[a] += gradients[a] * beyond;
    }



    /**
     * A place of the unit cell near @p x, and in @p wanted where the last step
     * of the search would go: Newton's method kept inside the cell, because
     * outside a distorted cell its map has no inverse.
     */
    template <int dim>
    Point<dim>
    nearest_place(const CellVertices<dim> &X,
                  const Point<dim>        &x,
                  Point<dim>              &wanted)
    {
      const CellMap<dim> map(X);
      Point<dim>         xi;
      for (unsigned int d = 0; d < dim; ++d)
        xi[d] = 0.5;
      for (unsigned int iteration = 0; iteration < 20; ++iteration)
        {
          wanted = xi + invert(map.jacobian(xi)) * (x - map.place(xi));
          const Point<dim> next = clamped(wanted);
          const double     step = next.distance(xi);
          xi                    = next;
          if (step < 1e-14)
            break;
        }
      return xi;
    }
  } // namespace



  template <int dim>
  CellNeighbours<dim>::CellNeighbours(const BackgroundMesh<dim> &mesh)
    : background(mesh)
    , is_box(!mesh.box_grid())
    , cells(mesh.triangulation().n_active_cells())
  {
    for (const auto &cell : mesh.triangulation().active_cell_iterators())
      cells[cell->active_cell_index()] = cell;
    update();
  }



  template <int dim>
  void
  CellNeighbours<dim>::update()
  {
    if (is_box == background.box_grid().has_value())
      return;
    is_box = !is_box;
    if (is_box)
      {
        cell_of_box.resize(cells.size());
        for (const CellIterator &cell : cells)
          cell_of_box[box_number(
            place_in(*background.box_grid(), cell->center()))] =
            cell->active_cell_index();
        return;
      }
    const auto &tria = background.triangulation();
    first_at_vertex.assign(tria.n_vertices() + 1, 0);
    for (const CellIterator &cell : cells)
      for (const unsigned int v : cell->vertex_indices())
        ++first_at_vertex[cell->vertex_index(v) + 1];
    for (unsigned int v = 0; v < tria.n_vertices(); ++v)
      first_at_vertex[v + 1] += first_at_vertex[v];
    cells_at_vertices.resize(first_at_vertex.back());
    std::vector<unsigned int> end(first_at_vertex);
    for (const CellIterator &cell : cells)
      for (const unsigned int v : cell->vertex_indices())
        cells_at_vertices[end[cell->vertex_index(v)]++] =
          cell->active_cell_index();
  }



  template <int dim>
  unsigned int
  CellNeighbours<dim>::box_number(
    const std::array<unsigned int, dim> &ijk) const
  {
    unsigned int number = 0;
    for (int d = dim - 1; d >= 0; --d)
      number = number * background.box_grid()->n_cells[d] + ijk[d];
    return number;
  }



  template <int dim>
  void
  CellNeighbours<dim>::find(const CellIterator        &cell,
                            std::vector<unsigned int> &found) const
  {
    found.assign(1, cell->active_cell_index());
    for (const unsigned int v : cell->vertex_indices())
      {
        const unsigned int vertex = cell->vertex_index(v);
        for (unsigned int i = first_at_vertex[vertex];
             i < first_at_vertex[vertex + 1];
             ++i)
          if (std::find(found.begin(), found.end(), cells_at_vertices[i]) ==
              found.end())
            found.push_back(cells_at_vertices[i]);
      }
  }



  template <int dim>
  typename CellNeighbours<dim>::CellIterator
  CellNeighbours<dim>::cell_around(const CellIterator &start,
                                   const Point<dim>   &x) const
  {
    if (background.box_grid())
      {
        const auto &grid = *background.box_grid();
        for (unsigned int d = 0; d < dim; ++d)
          {
            const double place =
              (x[d] - grid.lower_corner[d]) / grid.cell_size[d];
            if (!(place >= -1e-10 && place <= grid.n_cells[d] + 1e-10))
              return background.triangulation().end();
          }
        return cells[box_cell(place_in(grid, x))];
      }
    std::vector<unsigned int> near;
    find(start, near);
    for (const unsigned int index : near)
      {
        const auto X = vertices_of<dim>(cells[index]);
        if (!in_bounding_box<dim>(X, x))
          continue;
        const auto xi = CellInverse<dim>(X)(x);
        if (xi && in_unit_cell(*xi))
          return cells[index];
      }
    const auto found = background.cell_around(x);
    return found ? CellIterator(found->first) :
                   CellIterator(background.triangulation().end());
  }



  template <int dim>
  void
  CellPatch<dim>::reinit(const CellIterator &cell)
  {
    if (neighbours.mesh().box_grid())
      {
        place_in_box = place_in(*neighbours.mesh().box_grid(), cell->center());
        return;
      }
    neighbours.find(cell, cells);
    vertices.clear();
    inverses.clear();
    for (const unsigned int index : cells)
      {
        vertices.push_back(vertices_of<dim>(neighbours.cell(index)));
        inverses.emplace_back(vertices.back());
      }
  }



  template <int dim>
  bool
  CellPatch<dim>::locate(const Point<dim> &centre,
                         const Point<dim> &x,
                         unsigned int     &active_cell_index,
                         double           *N) const
  {
    const Point<dim> inner = x + 1e-8 * (centre - x);
    if (neighbours.mesh().box_grid())
      return locate_in_box(inner, x, active_cell_index, N);
    for (unsigned int k = 0; k < cells.size(); ++k)
      {
        if (!in_bounding_box<dim>(vertices[k], inner))
          continue;
        const auto xi_inner = inverses[k](inner);
        if (!xi_inner || !in_unit_cell(*xi_inner))
          continue;
        active_cell_index = cells[k];
        // The two differ by 1e-8 of the distance to the centre.
        functions_at<dim>(vertices[k],
                          inverses[k](x).value_or(*xi_inner),
                          x,
                          N);
        return true;
      }
    return locate_outside(x, active_cell_index, N);
  }



  template <int dim>
  bool
  CellPatch<dim>::locate_in_box(const Point<dim> &inner,
                                const Point<dim> &x,
                                unsigned int     &active_cell_index,
                                double           *N) const
  {
    const BoxGrid<dim> &grid = *neighbours.mesh().box_grid();
    const auto          ijk  = place_in(grid, inner);
    Point<dim>          xi;
    for (unsigned int d = 0; d < dim; ++d)
      {
        if (ijk[d] > place_in_box[d] + 1 || ijk[d] + 1 < place_in_box[d])
          return false;
        xi[d] = (x[d] - grid.lower_corner[d]) / grid.cell_size[d] - ijk[d];
      }
    active_cell_index = neighbours.box_cell(ijk);
    functions_at<dim>(vertices_of<dim>(neighbours.cell(active_cell_index)),
                      xi,
                      x,
                      N);
    return true;
  }



  template <int dim>
  bool
  CellPatch<dim>::locate_outside(const Point<dim> &x,
                                 unsigned int     &active_cell_index,
                                 double           *N) const
  {
    double       nearest = std::numeric_limits<double>::infinity();
    unsigned int best    = 0;
    Point<dim>   xi, wanted;
    for (unsigned int k = 0; k < cells.size(); ++k)
      {
        Point<dim>       wanted_here;
        const Point<dim> here = nearest_place<dim>(vertices[k], x, wanted_here);
        const double     distance =
          CellMap<dim>(vertices[k]).place(here).distance(x);
        if (distance < nearest)
          {
            nearest = distance;
            best    = k;
            xi      = here;
            wanted  = wanted_here;
          }
      }
    active_cell_index = cells[best];
    const auto &cell  = neighbours.cell(active_cell_index);
    for (unsigned int d = 0; d < dim; ++d)
      if (std::abs(wanted[d] - xi[d]) > 1e-10)
        {
          const unsigned int face = 2 * d + (wanted[d] > 1);
          if (!cell->at_boundary(face) &&
              std::find(cells.begin(),
                        cells.end(),
                        cell->neighbor(face)->active_cell_index()) ==
                cells.end())
            return false;
        }
    functions_at<dim>(vertices[best], wanted, x, N);
    return true;
  }



  template <int dim>
  typename CellNeighbours<dim>::CellIterator
  CellNeighbours<dim>::nearest_cell(const CellIterator &start,
                                    const Point<dim>   &x) const
  {
    const CellIterator around = cell_around(start, x);
    if (around.state() == IteratorState::valid)
      return around;
    CellIterator result  = start;
    double       nearest = std::numeric_limits<double>::infinity();
    const auto  &tree    = background.search_cache().get_used_vertices_rtree();
    for (auto it = tree.qbegin(boost::geometry::index::nearest(x, 1));
         it != tree.qend();
         ++it)
      for (const auto &cell :
           background.search_cache().get_vertex_to_cell_map()[it->second])
        if (cell->center().distance(x) < nearest)
          {
            nearest = cell->center().distance(x);
            result  = cell;
          }
    return result;
  }



  template decltype(place_in<2>) place_in<2>;
  template decltype(place_in<3>) place_in<3>;
  template class CellNeighbours<2>;
  template class CellNeighbours<3>;
  template class CellPatch<2>;
  template class CellPatch<3>;
} // namespace moraine
