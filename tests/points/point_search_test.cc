// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/points/bodies.h>
#include <moraine/geometry/shapes.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace moraine;
using dealii::Point;
using dealii::Tensor;

namespace
{
  /** n cells per direction in a cube of edge 1.2 from @p corner. */
  template <int dim>
  MeshParameters<dim>
  cube(const unsigned int n, const Point<dim> &corner)
  {
    MeshParameters<dim> parameters;
    parameters.lower_corner = corner;
    for (unsigned int d = 0; d < dim; ++d)
      {
        parameters.upper_corner[d] = corner[d] + 1.2;
        parameters.cells.push_back(n);
      }
    return parameters;
  }

  /** Volume of the points in the quadrant or octant of a ring or a hollow
   * sphere around the corner of the mesh, less the exact one, relative to it.
   */
  template <int dim>
  double
  seeding_error(const unsigned int n,
                const Point<dim>  &corner,
                const double       inner,
                const double       outer)
  {
    const auto                mesh_parameters = cube<dim>(n, corner);
    const BackgroundMesh<dim> mesh(mesh_parameters, MPI_COMM_WORLD);
    PointSet<dim>             points(mesh, {});
    const auto                ring = combine<dim>(Operation::subtract,
                                   make_ball<dim>(corner, outer),
                                   make_ball<dim>(corner, inner));
    const auto   box = make_box<dim>(corner, mesh_parameters.upper_corner);
    const double volume =
      seed_bodies<dim>({{"part",
                         combine<dim>(Operation::intersect, ring, box)}},
                       CellSeeder<dim>(2, PointLayout::gauss),
                       points)[0];
    const double exact = dealii::numbers::PI / (dim == 2 ? 4 : 6) *
                         (std::pow(outer, dim) - std::pow(inner, dim));
    return volume / exact - 1;
  }

  /**
   * Random places on the vertices, edges and faces of the inner cells, but for
   * a few units in the last place.
   */
  template <int dim>
  std::vector<Point<dim>>
  places_on_faces(const BackgroundMesh<dim> &mesh, std::mt19937 &random)
  {
    std::vector<Point<dim>>                places;
    std::uniform_int_distribution<int>     ulps(-3, 3);
    std::uniform_real_distribution<double> inside(0.1, 0.9);
    const auto                            &box = *mesh.box_grid();
    for (const auto &cell : mesh.triangulation().active_cell_iterators())
      for (unsigned int kind = 0; kind + 1 < (1u << dim); ++kind)
        {
          Point<dim> x = cell->vertex(0);
          for (unsigned int d = 0; d < dim; ++d)
            if ((kind >> d) & 1)
              x[d] += inside(random) * box.cell_size[d];
            else if (x[d] > box.lower_corner[d] + 0.5 * box.cell_size[d])
              x[d] += ulps(random) * 2e-16 * std::abs(x[d]);
          places.push_back(x);
        }
    return places;
  }

  template <int dim>
  void
  check_points_on_faces(const Point<dim> &corner)
  {
    const BackgroundMesh<dim> mesh(cube<dim>(dim == 2 ? 13 : 7, corner),
                                   MPI_COMM_WORLD);
    std::mt19937              random(1);
    const auto                places = places_on_faces(mesh, random);
    PointSet<dim>             points(mesh, {});
    unsigned int              id = 0;
    for (const auto &cell : mesh.triangulation().active_cell_iterators())
      for (unsigned int kind = 0; kind + 1 < (1u << dim); ++kind, ++id)
        if (cell->is_locally_owned())
          points.insert(cell,
                        places[id],
                        mesh.mapping().transform_real_to_unit_cell(cell,
                                                                   places[id]),
                        id,
                        0,
                        1.);
    points.finish_insertion();
    ASSERT_EQ(points.n_global(), places.size());
    for (unsigned int p = 0; p < points.n_local(); ++p)
      EXPECT_EQ(points.cell_of(p)->active_cell_index(),
                points.id(p) / ((1u << dim) - 1));

    for (unsigned int sweep = 0; sweep < 5; ++sweep)
      {
        const auto moved = places_on_faces(mesh, random);
        for (unsigned int p = 0; p < points.n_local(); ++p)
          points.set_position(p, moved[points.id(p)]);
        ASSERT_NO_THROW(points.find_cells());
        ASSERT_EQ(points.n_global(), places.size());
        for (unsigned int p = 0; p < points.n_local(); ++p)
          EXPECT_LT(points.position(p).distance(moved[points.id(p)]),
                    1e-13 * (1 + corner.norm()));
      }
  }
} // namespace



TEST(PointSearch, PointsOnFaces)
{
  check_points_on_faces<2>(Point<2>());
  check_points_on_faces<2>(Point<2>(-0.7, 13.1));
  check_points_on_faces<3>(Point<3>());
  check_points_on_faces<3>(Point<3>(0.1, -55.3, 1. / 3));
}



// All meshes in Release; Debug has assertions instead, and is slow.
#ifdef DEBUG
constexpr unsigned int every_mesh = 5;
#else
constexpr unsigned int every_mesh = 1;
#endif

TEST(PointSearch, RingsInManyMeshes)
{
  for (unsigned int n = 8; n <= 48; n += every_mesh)
    for (const auto &corner : {Point<2>(), Point<2>(-0.3, 7.7)})
      for (const double outer : {1., 0.9, 1.13})
        ASSERT_NO_THROW(
          EXPECT_NEAR(seeding_error<2>(n, corner, 0.4, outer), 0., 1e-6))
          << n << " cells, corner " << corner << ", radius " << outer;
}



TEST(PointSearch, HollowSpheresInManyMeshes)
{
  const std::vector<unsigned int> cells{11, 8, 12, 18, 20, 23, 28};
  for (unsigned int i = 0; i < cells.size(); i += every_mesh)
    for (const auto &corner : {Point<3>(), Point<3>(-0.3, 7.7, 0.1)})
      ASSERT_NO_THROW(EXPECT_NEAR(
        seeding_error<3>(cells[i], corner, 0.4, cells[i] < 20 ? 0.95 : 1.),
        0.,
        1e-6))
        << cells[i] << " cells, corner " << corner;
}
