// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/geometry/mesh_groups.h>

#include <moraine/core/exceptions.h>
#include <moraine/core/words.h>
#include <moraine/mesh/active_search.h>

#include <deal.II/base/geometry_info.h>
#include <deal.II/base/mpi.h>

#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    namespace bgi = boost::geometry::index;



    /** Half-spaces behind the faces of a cell: inward normals at places. */
    template <int dim>
    std::vector<std::pair<Point<dim>, Tensor<1, dim>>>
    half_spaces_of(const CellVertices<dim> &vertices)
    {
      std::vector<std::pair<Point<dim>, Tensor<1, dim>>> planes;
      ConvexPolytope<dim>(vertices, 0., false)
        .for_each_face([&](const auto &loop) {
          const unsigned int n = loop.size();
          if constexpr (dim == 2)
            for (unsigned int i = 0; i < n; ++i)
              planes.emplace_back(loop[i],
                                  cross_product_2d(loop[i] -
                                                   loop[(i + 1) % n]));
          else
            {
              Point<dim>     middle;
              Tensor<1, dim> outward;
              for (unsigned int i = 0; i < n; ++i)
                {
                  middle += 1. / n * loop[i];
                  outward += cross_product_3d(loop[i] - loop[0],
                                              loop[(i + 1) % n] - loop[0]);
                }
              planes.emplace_back(middle, -outward);
            }
        });
      return planes;
    }



    /** The cells of a mesh that have some material ids. */
    template <int dim>
    class CellsShape : public Shape<dim>
    {
    public:
      CellsShape(const std::shared_ptr<const BackgroundMesh<dim>> &mesh,
                 const std::set<types::material_id>               &ids)
        : Shape<dim>(unlimited_box<dim>(), true)
        , mesh(mesh)
        , ids(ids)
      {
        for (const auto &cell : mesh->triangulation().active_cell_iterators())
          for (const unsigned int f : cell->face_indices())
            if (is_of_group(cell) &&
                (cell->at_boundary(f) || !is_of_group(cell->neighbor(f))))
              add_face(cell->face(f));
        std::vector<std::pair<BoundingBox<dim>, unsigned int>> boxes;
        for (const auto &simplex : rim)
          boxes.emplace_back(BoundingBox<dim>(std::vector<Point<dim>>(
                               simplex.begin(), simplex.end())),
                             boxes.size());
        tree = pack_rtree(boxes);
        for (const auto &cell : mesh->triangulation().active_cell_iterators())
          of_centres.push_back(from_rim(cell->center()));
      }

      double
      level(const Point<dim> &p) const override
      {
        const auto found = mesh->cell_around(p);
        if (!found)
          return -from_rim(p);
        const auto  &cell = found->first;
        const double sign = is_of_group(cell) ? 1. : -1.;
        // Far from the rim a bound will do, which needs no search.
        const double bound =
          of_centres[cell->active_cell_index()] - p.distance(cell->center());
        return sign * (bound > 0.5 * mesh->cell_size() ? bound : from_rim(p));
      }

      bool
      covers(const Point<dim> &p, const double margin) const override
      {
        return distance(p, 0.) > -margin;
      }

      double
      distance(const Point<dim> &p, const double) const override
      {
        const auto found = mesh->cell_around(p);
        return found && is_of_group(found->first) ? from_rim(p) : -from_rim(p);
      }

      Overlap
      overlap(const ConvexPolytope<dim> &cell) const override
      {
        const auto found = mesh->cell_around(cell.vertex_mean());
        if (!found || !is_in(cell, found->first))
          return Shape<dim>::overlap(cell);
        return is_of_group(found->first) ? Overlap::all : Overlap::none;
      }

      typename Shape<dim>::Faces
      faces(const std::string &, const bool, const Extent<dim> &) const override
      {
        return {};
      }

    protected:
      void
      add_pieces_of_part(const ConvexPolytope<dim> &cell,
                         const double               sign,
                         SignedPieces<dim>         &pieces) const override
      {
        for (const auto &[box, of_mesh] :
             mesh->search_cache().get_cell_bounding_boxes_rtree() |
               bgi::adaptors::queried(bgi::intersects(cell.bounding_box())))
          {
            if (!is_of_group(of_mesh))
              continue;
            ConvexPolytope<dim> part = cell;
            for (const auto &[x, inward] :
                 half_spaces_of<dim>(vertices_of<dim>(of_mesh)))
              if (!part.empty())
                part.clip(x, inward);
            if (!part.empty())
              pieces.push_back({sign, part});
          }
      }

    private:
      template <class Face>
      void
      add_face(const Face &face)
      {
        if constexpr (dim == 2)
          rim.push_back({{face->vertex(0), face->vertex(1)}});
        else
          for (const unsigned int corner : {0, 3})
            rim.push_back(
              {{face->vertex(corner), face->vertex(1), face->vertex(2)}});
      }

      template <class Cell>
      bool
      is_of_group(const Cell &cell) const
      {
        return ids.count(cell->material_id()) > 0;
      }

      double
      from_rim(const Point<dim> &p) const
      {
        // The face with the nearest box is near; none nearer is beyond it.
        double least = 0;
        for (const auto &face :
             tree | bgi::adaptors::queried(bgi::nearest(p, 1)))
          least = distance_to_simplex<dim>(rim[face.second], p);
        BoundingBox<dim> around(std::make_pair(p, p));
        around.extend(least);
        for (const auto &face :
             tree | bgi::adaptors::queried(bgi::intersects(around)))
          least =
            std::min(least, distance_to_simplex<dim>(rim[face.second], p));
        return least;
      }

      /** Whether a polytope lies in a cell but for round-off. */
      template <class Cell>
      bool
      is_in(const ConvexPolytope<dim> &polytope, const Cell &cell) const
      {
        std::vector<Point<dim>> unit(polytope.vertices().size());
        mesh->mapping().transform_points_real_to_unit_cell(
          cell,
          ArrayView<const Point<dim>>(polytope.vertices().data(), unit.size()),
          make_array_view(unit));
        const double tolerance =
          1e-10 + 4 * polytope.tolerance() / edge_of_cell(cell);
        return std::all_of(unit.begin(), unit.end(), [&](const auto &xi) {
          return GeometryInfo<dim>::distance_to_unit_cell(xi) <= tolerance;
        });
      }

      const std::shared_ptr<const BackgroundMesh<dim>> mesh;
      const std::set<types::material_id>               ids;
      /** The outer faces, in 3D as two triangles each, and where they are. */
      std::vector<std::array<Point<dim>, dim>>         rim;
      RTree<std::pair<BoundingBox<dim>, unsigned int>> tree;
      std::vector<double> of_centres; ///< how far those of cells are from it
    };
  } // namespace



  template <int dim>
  MeshGroups<dim>::MeshGroups(const MeshParameters<dim> &parameters)
    : mesh(std::make_shared<BackgroundMesh<dim>>(parameters, MPI_COMM_SELF))
    , groups(groups_of_cells(parameters, mesh->triangulation()))
  {}



  template <int dim>
  ShapePointer<dim>
  MeshGroups<dim>::shape(const std::vector<std::string> &names,
                         const std::string              &section) const
  {
    std::vector<std::string> known;
    for (const auto &group : groups)
      known.push_back(group.first);
    std::set<types::material_id> ids;
    for (const std::string &name : names)
      {
        const auto found = std::find(known.begin(), known.end(), name);
        if (found == known.end())
          reject(section,
                 "Group",
                 name,
                 "groups of cells of the mesh (" + list_of(known) + ")");
        if (!ids.insert(groups[found - known.begin()].second).second)
          reject(section, "Group", list_of(names), "each group once");
      }
    return std::make_shared<CellsShape<dim>>(mesh, ids);
  }



  template class MeshGroups<2>;
  template class MeshGroups<3>;
} // namespace moraine
