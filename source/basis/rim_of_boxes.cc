// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/basis/rim_of_boxes.h>

#include <moraine/mesh/cell_inverse.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/geometry_info.h>
#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** In lengths of a box: where the search before a face begins. */
    constexpr double reach_of_cover = 0.25;

    /** Of a face, in each direction. */
    constexpr unsigned int n_points_of_face = 4;



    /** The corners of the box of a point. */
    template <int dim>
    CellVertices<dim>
    corners_of(const PointSet<dim> &points,
               const Basis<dim>    &basis,
               const unsigned int   p)
    {
      if (basis.has_domains())
        return basis.domain_corners(p);
      const double      half = 0.5 * std::pow(points.volume(p), 1. / dim);
      CellVertices<dim> corners;
      for (unsigned int v = 0; v < corners.size(); ++v)
        {
          corners[v] = points.position(p);
          for (unsigned int d = 0; d < dim; ++d)
            corners[v][d] += (v >> d) & 1u ? half : -half;
        }
      return corners;
    }



    /** The boxes of the points of a body, of all ranks, by id. */
    template <int dim>
    std::vector<std::pair<unsigned int, CellVertices<dim>>>
    gather_boxes(const PointSet<dim> &points,
                 const Basis<dim>    &basis,
                 const unsigned int   body)
    {
      std::vector<std::pair<unsigned int, CellVertices<dim>>> boxes;
      std::vector<unsigned int>                               ids;
      std::vector<double>                                     numbers;
      for (unsigned int p = 0; p < points.n_local(); ++p)
        if (points.body(p) == body)
          {
            ids.push_back(points.id(p));
            for (const Point<dim> &corner : corners_of(points, basis, p))
              for (unsigned int d = 0; d < dim; ++d)
                numbers.push_back(corner[d]);
          }
      const MPI_Comm communicator =
        points.mesh().triangulation().get_communicator();
      const auto all_ids = Utilities::MPI::all_gather(communicator, ids);
      const auto all_numbers =
        Utilities::MPI::all_gather(communicator, numbers);
      for (unsigned int r = 0; r < all_ids.size(); ++r)
        {
          auto number = all_numbers[r].begin();
          for (const unsigned int id : all_ids[r])
            {
              boxes.emplace_back(id, CellVertices<dim>());
              for (Point<dim> &corner : boxes.back().second)
                for (unsigned int d = 0; d < dim; ++d)
                  corner[d] = *number++;
            }
        }
      std::sort(boxes.begin(), boxes.end(), [](const auto &a, const auto &b) {
        return a.first < b.first;
      });
      return boxes;
    }



    /** Knows which places are in boxes. */
    template <int dim>
    class Cover
    {
    public:
      Cover(
        const std::vector<std::pair<unsigned int, CellVertices<dim>>> &boxes,
        const double cell_size)
        : cell_size(cell_size)
      {
        std::vector<std::pair<BoundingBox<dim>, unsigned int>> around;
        for (const auto &[id, corners] : boxes)
          {
            around.emplace_back(BoundingBox<dim>(std::vector<Point<dim>>(
                                  corners.begin(), corners.end())),
                                inverses.size());
            inverses.emplace_back(corners);
          }
        tree = pack_rtree(around);
      }

      bool
      contains(const Point<dim> &x) const
      {
        namespace bgi = boost::geometry::index;
        for (const auto &[box, i] :
             tree | bgi::adaptors::queried(bgi::intersects(x)))
          if (const auto xi = inverses[i](x))
            if (GeometryInfo<dim>::is_inside_unit_cell(*xi))
              return true;
        return false;
      }

      /** Whether anything lies less than a cell before a place of the face of a
       * box of this @p length. */
      bool
      lies_before(const Point<dim>     &x,
                  const Tensor<1, dim> &normal,
                  const double          length) const
      {
        for (double away = reach_of_cover * length; away < cell_size;
             away += 0.5 * length)
          if (contains(x + away * normal))
            return true;
        return false;
      }

    private:
      const double                                     cell_size;
      std::vector<CellInverse<dim>>                    inverses;
      RTree<std::pair<BoundingBox<dim>, unsigned int>> tree;
    };



    /** Add the places of a face of a box that @p cover leaves free. */
    template <int dim>
    void
    add_free_places(const CellVertices<dim>                         &corners,
                    const unsigned int                               face,
                    const Cover<dim>                                &cover,
                    std::vector<typename CarriedPlaces<dim>::Place> &places)
    {
      const unsigned int           across = face / 2;
      const CellMap<dim>           map(corners);
      static const QGauss<dim - 1> on_face(n_points_of_face);
      for (unsigned int q = 0; q < on_face.size(); ++q)
        {
          Point<dim> xi;
          for (unsigned int d = 0, e = 0; d < dim; ++d)
            xi[d] = d == across ? face % 2 : on_face.point(q)[e++];
          const Tensor<2, dim> J    = map.jacobian(xi);
          const Tensor<2, dim> to_x = transpose(J);
          Tensor<1, dim>       area = determinant(J) * invert(J)[across];
          if (face % 2 == 0)
            area *= -1;
          const Tensor<1, dim> normal = area / area.norm();
          const Point<dim>     x      = map.place(xi);
          if (!cover.lies_before(x, normal, to_x[across].norm()))
            places.push_back({x, on_face.weight(q) * area.norm(), normal});
        }
    }
  } // namespace



  template <int dim>
  std::vector<typename CarriedPlaces<dim>::Place>
  rim_of_boxes(const PointSet<dim> &points,
               const Basis<dim>    &basis,
               const unsigned int   body)
  {
    const auto       boxes = gather_boxes(points, basis, body);
    const Cover<dim> cover(boxes, points.mesh().cell_size());
    std::vector<typename CarriedPlaces<dim>::Place> places;
    for (const auto &[id, corners] : boxes)
      for (unsigned int face = 0; face < 2 * dim; ++face)
        add_free_places(corners, face, cover, places);
    return places;
  }



  template std::vector<CarriedPlaces<2>::Place>
  rim_of_boxes(const PointSet<2> &, const Basis<2> &, const unsigned int);
  template std::vector<CarriedPlaces<3>::Place>
  rim_of_boxes(const PointSet<3> &, const Basis<3> &, const unsigned int);
} // namespace moraine
