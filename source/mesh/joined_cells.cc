// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/mesh/joined_cells.h>

#include <moraine/mesh/active_search.h>

#include <deal.II/base/bounding_box.h>

#include <deal.II/grid/grid_tools.h>

#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <set>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    // of the shortest edge at a vertex
    constexpr double same_place = 1e-6;



    /** The shortest edge at each vertex. */
    template <int dim>
    std::vector<double>
    shortest_edges(const Triangulation<dim> &cells)
    {
      std::vector<double> shortest(cells.n_vertices(),
                                   std::numeric_limits<double>::infinity());
      for (const auto &cell : cells.active_cell_iterators())
        for (unsigned int l = 0; l < cell->n_lines(); ++l)
          {
            const auto   line   = cell->line(l);
            const double length = line->vertex(0).distance(line->vertex(1));
            for (const unsigned int v : {0, 1})
              shortest[line->vertex_index(v)] =
                std::min(shortest[line->vertex_index(v)], length);
          }
      return shortest;
    }



    template <int dim>
    std::vector<unsigned int>
    boundary_vertices(const Triangulation<dim> &cells)
    {
      std::vector<unsigned int> vertices;
      for (const auto &face : cells.active_face_iterators())
        if (face->at_boundary())
          for (const unsigned int v : face->vertex_indices())
            vertices.push_back(face->vertex_index(v));
      std::sort(vertices.begin(), vertices.end());
      vertices.erase(std::unique(vertices.begin(), vertices.end()),
                     vertices.end());
      return vertices;
    }



    /** The vertices of a part of a cell, in ascending order. */
    std::vector<unsigned int>
    sorted(std::vector<unsigned int> vertices)
    {
      std::sort(vertices.begin(), vertices.end());
      return vertices;
    }



    /** How many cells each face has. */
    template <int dim>
    std::map<std::vector<unsigned int>, unsigned int>
    cells_of_faces(const std::vector<CellData<dim>> &cells)
    {
      std::map<std::vector<unsigned int>, unsigned int> n_cells;
      for (const auto &cell : cells)
        for (const unsigned int f : GeometryInfo<dim>::face_indices())
          {
            std::vector<unsigned int> face;
            for (unsigned int v = 0; v < GeometryInfo<dim>::vertices_per_face;
                 ++v)
              face.push_back(
                cell.vertices[GeometryInfo<dim>::face_to_cell_vertices(f, v)]);
            ++n_cells[sorted(face)];
          }
      return n_cells;
    }



    /** Keep each object once; take the boundary id from those inside. */
    template <class Data, class IsInside>
    void
    clean(std::vector<Data> &objects, const IsInside &is_inside)
    {
      std::map<std::vector<unsigned int>, Data> once;
      for (Data &object : objects)
        {
          const auto vertices = sorted(object.vertices);
          if (is_inside(vertices))
            object.boundary_id = numbers::internal_face_boundary_id;
          once.emplace(vertices, object);
        }
      objects.clear();
      for (const auto &object : once)
        objects.push_back(object.second);
    }



    /** Distance from a face, in 3D from the triangles at its corners. */
    template <int dim, class Face>
    double
    distance_from_face(const Point<dim> &x, const Face &face)
    {
      if constexpr (dim == 2)
        return distance_to_simplex<2>({{face->vertex(0), face->vertex(1)}}, x);
      else
        {
          double nearest = std::numeric_limits<double>::infinity();
          for (const unsigned int v : {0, 1, 2, 3})
            nearest = std::min(nearest,
                               distance_to_simplex<3>({{face->vertex(v),
                                                        face->vertex(v ^ 1u),
                                                        face->vertex(v ^ 2u)}},
                                                      x));
          return nearest;
        }
    }
  } // namespace



  template <int dim>
  std::vector<std::pair<unsigned int, unsigned int>>
  coincident_vertices(const Triangulation<dim> &cells)
  {
    const auto &places   = cells.get_vertices();
    const auto  shortest = shortest_edges(cells);
    std::vector<std::pair<Point<dim>, unsigned int>> entries;
    for (const unsigned int v : boundary_vertices(cells))
      entries.emplace_back(places[v], v);
    const auto tree = pack_rtree(entries);

    std::vector<std::pair<unsigned int, unsigned int>> pairs;
    for (const auto &[x, v] : entries)
      {
        unsigned int     first = v;
        BoundingBox<dim> around({x, x});
        around.extend(same_place * shortest[v]);
        const auto near = boost::geometry::index::intersects(around);
        for (auto other = tree.qbegin(near); other != tree.qend(); ++other)
          if (other->first.distance(x) <
              same_place * std::min(shortest[v], shortest[other->second]))
            first = std::min(first, other->second);
        if (first != v)
          pairs.emplace_back(first, v);
      }
    return pairs;
  }



  template <int dim>
  std::optional<Point<dim>>
  find_torn_face(
    const std::vector<std::pair<unsigned int, unsigned int>> &pairs,
    const Triangulation<dim>                                 &cells)
  {
    std::vector<unsigned int> kept(cells.n_vertices());
    std::iota(kept.begin(), kept.end(), 0u);
    for (const auto &[first, other] : pairs)
      kept[other] = first;
    std::set<std::vector<unsigned int>> seen;
    for (const auto &face : cells.active_face_iterators())
      if (face->at_boundary() && face->boundary_id() == 0)
        {
          std::vector<unsigned int> vertices;
          for (const unsigned int v : face->vertex_indices())
            vertices.push_back(kept[face->vertex_index(v)]);
          if (!seen.insert(sorted(vertices)).second)
            return face->center();
        }
    return {};
  }



  template <int dim>
  void
  join_cells(const std::vector<std::pair<unsigned int, unsigned int>> &pairs,
             Triangulation<dim>                                       &cells)
  {
    auto [vertices, cell_data, parts] =
      GridTools::get_coarse_mesh_description(cells);
    std::vector<unsigned int> kept(vertices.size());
    std::iota(kept.begin(), kept.end(), 0u);
    for (const auto &[first, other] : pairs)
      kept[other] = first;
    const auto renumber = [&kept](auto &objects) {
      for (auto &object : objects)
        for (unsigned int &v : object.vertices)
          v = kept[v];
    };
    renumber(cell_data);
    renumber(parts.boundary_lines);
    renumber(parts.boundary_quads);

    const auto n_cells   = cells_of_faces<dim>(cell_data);
    const auto is_inside = [&n_cells](const auto &face) {
      const auto found = n_cells.find(face);
      return found == n_cells.end() || found->second > 1;
    };
    clean(parts.boundary_lines, is_inside);
    clean(parts.boundary_quads, is_inside);
    GridTools::delete_unused_vertices(vertices, cell_data, parts);
    GridTools::consistently_order_cells(cell_data);

    Triangulation<dim> joined;
    joined.create_triangulation(vertices, cell_data, parts);
    for (const auto id : cells.get_manifold_ids())
      if (id != numbers::flat_manifold_id)
        joined.set_manifold(id, cells.get_manifold(id));
    cells.clear();
    cells.copy_triangulation(joined);
  }



  template <int dim>
  std::optional<Point<dim>>
  find_unmatched_vertex(const Triangulation<dim> &cells)
  {
    using Face = typename Triangulation<dim>::active_face_iterator;
    const auto       &places   = cells.get_vertices();
    const auto        shortest = shortest_edges(cells);
    std::vector<Face> faces;
    std::vector<std::pair<BoundingBox<dim>, unsigned int>> boxes;
    for (const auto &face : cells.active_face_iterators())
      if (face->at_boundary() && face->boundary_id() == 0)
        {
          boxes.emplace_back(face->bounding_box(), faces.size());
          faces.push_back(face);
        }
    const auto tree = pack_rtree(boxes);
    for (const unsigned int v : boundary_vertices(cells))
      {
        const Point<dim> &x      = places[v];
        const double      margin = same_place * shortest[v];
        BoundingBox<dim>  around({x, x});
        around.extend(margin);
        const auto near = boost::geometry::index::intersects(around);
        for (auto box = tree.qbegin(near); box != tree.qend(); ++box)
          {
            const Face &face      = faces[box->second];
            bool        is_corner = false;
            for (const unsigned int w : face->vertex_indices())
              is_corner = is_corner || face->vertex(w).distance(x) < margin;
            if (!is_corner && distance_from_face<dim>(x, face) < margin)
              return x;
          }
      }
    return {};
  }



#define INSTANTIATE(dim)                                                  \
  template decltype(coincident_vertices<dim>)   coincident_vertices<dim>; \
  template decltype(find_torn_face<dim>)        find_torn_face<dim>;      \
  template decltype(join_cells<dim>)            join_cells<dim>;          \
  template decltype(find_unmatched_vertex<dim>) find_unmatched_vertex<dim>;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
