// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/mesh/joined_cells.h>
#include <moraine/mesh/make_mesh.h>

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>

#include <gtest/gtest.h>

#include <map>

using namespace moraine;
using dealii::Point;
using dealii::Triangulation;

namespace
{
  /** A mesh of @p generator as scenes get it. */
  template <int dim>
  void
  make(const std::string  &generator,
       const std::string  &arguments,
       Triangulation<dim> &cells,
       const unsigned int  layers      = 0,
       const unsigned int  refinements = 0)
  {
    MeshParameters<dim> parameters;
    parameters.type             = "generator";
    parameters.generator        = generator;
    parameters.arguments        = arguments;
    parameters.refinements      = refinements;
    parameters.extrusion_layers = layers;
    parameters.extrusion_height = layers;
    make_mesh(parameters, cells);
  }

  template <int dim>
  std::map<dealii::types::boundary_id, unsigned int>
  faces_of_sides(const Triangulation<dim> &cells)
  {
    std::map<dealii::types::boundary_id, unsigned int> n;
    for (const auto &face : cells.active_face_iterators())
      if (face->at_boundary())
        ++n[face->boundary_id()];
    return n;
  }

  using Sides = std::map<dealii::types::boundary_id, unsigned int>;

  /** Two boxes with vertices of their own, the second from x = 1. */
  template <int dim>
  void
  two_boxes(const double shift, Triangulation<dim> &cells)
  {
    std::vector<Point<dim>>            vertices;
    std::vector<dealii::CellData<dim>> boxes(2);
    constexpr unsigned int             n = 1 << dim;
    for (unsigned int box = 0; box < 2; ++box)
      for (unsigned int v = 0; v < n; ++v)
        {
          Point<dim> x;
          for (unsigned int d = 0; d < dim; ++d)
            x[d] = (v >> d) & 1;
          x[0] += box * (1 + 1e-12);
          x[1] += box * shift;
          boxes[box].vertices[v] = vertices.size();
          vertices.push_back(x);
        }
    cells.create_triangulation(vertices, boxes, {});
  }
} // namespace



// In Debug an assertion in deal.II's generator refuses these arguments.
#ifndef DEBUG
TEST(JoinedCells, ShellsHaveNoCracks)
{
  for (const unsigned int shells : {3, 10, 40, 60, 80})
    for (const unsigned int n : {12, 36, 72})
      {
        Triangulation<2> cells;
        make("concentric_hyper_shells",
             "0, 0 : 5 : 10 : " + std::to_string(shells) +
               " : 0 : " + std::to_string(n) + " : true",
             cells);
        EXPECT_EQ(cells.n_active_cells(), shells * n);
        EXPECT_EQ(cells.n_vertices(), (shells + 1) * n);
        EXPECT_EQ(faces_of_sides(cells), (Sides{{0, n}, {1, n}}));
      }
}



TEST(JoinedCells, ShellsThatWereJoinedRefineToCircles)
{
  Triangulation<2> cells;
  make("concentric_hyper_shells",
       "0, 0 : 5 : 10 : 60 : 0 : 36 : true",
       cells,
       0,
       1);
  EXPECT_EQ(cells.n_vertices(), 121u * 72u);
  for (const auto &face : cells.active_face_iterators())
    if (face->at_boundary())
      {
        for (const unsigned int v : {0, 1})
          EXPECT_NEAR(face->vertex(v).norm(),
                      face->boundary_id() == 0 ? 5. : 10.,
                      1e-12);
      }
}



TEST(JoinedCells, ExtrudedShells)
{
  Triangulation<3> cells;
  make("concentric_hyper_shells",
       "0, 0 : 5 : 10 : 40 : 0 : 36 : true",
       cells,
       2);
  EXPECT_EQ(cells.n_vertices(), 3u * 41u * 36u);
  EXPECT_EQ(faces_of_sides(cells),
            (Sides{{0, 72}, {1, 72}, {2, 1440}, {3, 1440}}));
}
#endif



TEST(JoinedCells, ASlitStays)
{
  Triangulation<2> cells;
  make("hyper_cube_slit", "0 : 1 : false", cells, 0, 1);
  unsigned int n = 0;
  for (const auto &side : faces_of_sides(cells))
    n += side.second;
  EXPECT_EQ(n, 16u + 4u);
}



TEST(JoinedCells, BoxesThatTouchInAFace)
{
  Triangulation<2> squares;
  two_boxes(0., squares);
  const auto pairs = coincident_vertices(squares);
  EXPECT_EQ(pairs,
            (std::vector<std::pair<unsigned int, unsigned int>>{{1, 4},
                                                                {3, 6}}));
  EXPECT_TRUE(find_torn_face(pairs, squares));
  join_cells(pairs, squares);
  EXPECT_EQ(squares.n_vertices(), 6u);
  EXPECT_EQ(faces_of_sides(squares), (Sides{{0, 6}}));

  Triangulation<3> cubes;
  two_boxes(0., cubes);
  EXPECT_EQ(coincident_vertices(cubes).size(), 4u);
  EXPECT_TRUE(find_torn_face(coincident_vertices(cubes), cubes));
  join_cells(coincident_vertices(cubes), cubes);
  EXPECT_EQ(cubes.n_vertices(), 12u);
  EXPECT_EQ(faces_of_sides(cubes), (Sides{{0, 10}}));
  EXPECT_TRUE(coincident_vertices(cubes).empty());
  EXPECT_FALSE(find_unmatched_vertex(cubes));
}



TEST(JoinedCells, BoxesThatShareAPartOfAFace)
{
  Triangulation<2> squares;
  two_boxes(0.4, squares);
  EXPECT_TRUE(coincident_vertices(squares).empty());
  ASSERT_TRUE(find_unmatched_vertex(squares));
  EXPECT_LT(find_unmatched_vertex(squares)->distance(Point<2>(1., 1.)), 1e-9);

  Triangulation<3> cubes;
  two_boxes(0.4, cubes);
  EXPECT_TRUE(find_unmatched_vertex(cubes));

  // With a boundary id the faces are meant to be apart.
  for (const auto &face : squares.active_face_iterators())
    if (std::abs(face->center()[0] - 1) < 1e-9)
      face->set_boundary_id(1);
  EXPECT_FALSE(find_unmatched_vertex(squares));
}
