// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/mesh/background_mesh.h>

#include <moraine/core/exceptions.h>
#include <moraine/mesh/active_search.h>
#include <moraine/mesh/grid_space.h>

#include <deal.II/base/mpi.h>

#include <deal.II/grid/grid_tools.h>

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "../core/message.h"

using namespace moraine;
using dealii::Point;
using dealii::Tensor;

namespace
{
  /** Radii 5 to 10, 5 radial times 18 circumferential cells. */
  template <int dim>
  MeshParameters<dim>
  annulus()
  {
    MeshParameters<dim> parameters;
    parameters.type       = "generator";
    parameters.generator  = "concentric_hyper_shells";
    parameters.arguments  = "0, 0 : 5 : 10 : 5 : 0 : 18 : true";
    parameters.side_names = "hole: 0, outer: 1";
    if (dim == 3)
      {
        parameters.extrusion_layers = 3;
        parameters.extrusion_height = 1.5;
      }
    return parameters;
  }

  /** Area between two polygons of 18 corners. */
  const double area =
    0.5 * 18 * (100. - 25.) * std::sin(2 * dealii::numbers::PI / 18);

  template <int dim>
  Point<dim>
  turned(const Point<dim> &x, const double degrees)
  {
    const double angle = degrees * dealii::numbers::PI / 180;
    Point<dim>   y     = x;
    y[0]               = std::cos(angle) * x[0] - std::sin(angle) * x[1];
    y[1]               = std::sin(angle) * x[0] + std::cos(angle) * x[1];
    return y;
  }

  template <int dim>
  std::string
  complaint(const MeshParameters<dim> &parameters)
  {
    return message_of<InputError>(
      [&] { BackgroundMesh<dim> mesh(parameters, MPI_COMM_WORLD); });
  }

  /** Measure of the faces of each side. */
  template <int dim>
  std::map<dealii::types::boundary_id, double>
  side_measures(const BackgroundMesh<dim> &mesh)
  {
    std::map<dealii::types::boundary_id, double> measures;
    for (const auto &face : mesh.triangulation().active_face_iterators())
      if (face->at_boundary())
        measures[face->boundary_id()] += face->measure();
    return measures;
  }
} // namespace



TEST(MeshKinds, ConcentricShellsAreAUniformAnnulus)
{
  const BackgroundMesh<2> mesh(annulus<2>(), MPI_COMM_WORLD);
  EXPECT_EQ(mesh.triangulation().n_global_active_cells(), 90u);
  EXPECT_EQ(mesh.triangulation().n_vertices(), 108u);
  EXPECT_FALSE(mesh.box_grid());
  std::map<long, unsigned int> per_radius;
  for (const auto &x : mesh.triangulation().get_vertices())
    {
      EXPECT_NEAR(x.norm(), std::round(x.norm()), 1e-13);
      ++per_radius[std::lround(x.norm())];
    }
  EXPECT_EQ(per_radius.size(), 6u);
  for (const auto &radius : per_radius)
    EXPECT_EQ(radius.second, 18u);
  EXPECT_NEAR(dealii::GridTools::volume(mesh.triangulation()), area, 1e-11);
  EXPECT_NEAR(mesh.cell_size(), 20 * std::sin(dealii::numbers::PI / 18), 1e-13);
}



TEST(MeshKinds, RefinementFollowsTheGeneratorAndEndsStraight)
{
  auto parameters        = annulus<2>();
  parameters.refinements = 1;
  const BackgroundMesh<2> mesh(parameters, MPI_COMM_WORLD);
  EXPECT_EQ(mesh.triangulation().n_global_active_cells(), 360u);
  EXPECT_EQ(mesh.triangulation().n_levels(), 1u);
  for (const auto &cell : mesh.triangulation().active_cell_iterators())
    for (const auto &face : cell->face_iterators())
      for (unsigned int v = 0; face->at_boundary() && v < 2; ++v)
        EXPECT_NEAR(face->vertex(v).norm(),
                    face->boundary_id() == 0 ? 5. : 10.,
                    1e-13);
  // the middle of an edge as the mapping sees it
  const auto cell = mesh.triangulation().begin_active();
  EXPECT_LT(mesh.mapping()
              .transform_unit_to_real_cell(cell, Point<2>(0.5, 0.))
              .distance(0.5 * (cell->vertex(0) + cell->vertex(1))),
            1e-14);
}



TEST(MeshKinds, ExtrusionKeepsSidesAndAddsTwo)
{
  const BackgroundMesh<3> mesh(annulus<3>(), MPI_COMM_WORLD);
  EXPECT_EQ(mesh.triangulation().n_global_active_cells(), 270u);
  EXPECT_NEAR(dealii::GridTools::volume(mesh.triangulation()),
              1.5 * area,
              1e-10);
  const auto   measures = side_measures(mesh);
  const double chord    = 2 * std::sin(dealii::numbers::PI / 18);
  ASSERT_EQ(measures.size(), 4u);
  EXPECT_NEAR(measures.at(mesh.boundary_id("hole", "")),
              1.5 * 18 * 5 * chord,
              1e-10);
  EXPECT_NEAR(measures.at(mesh.boundary_id("outer", "")),
              1.5 * 18 * 10 * chord,
              1e-10);
  for (const std::string name : {"bottom", "top"})
    {
      const auto id = mesh.boundary_id(name, "");
      EXPECT_NEAR(measures.at(id), area, 1e-10);
      for (const auto &face : mesh.triangulation().active_face_iterators())
        if (face->at_boundary() && face->boundary_id() == id)
          {
            EXPECT_NEAR(face->center()[2], name == "top" ? 1.5 : 0., 1e-14);
          }
    }
}



TEST(MeshKinds, SidesHaveNamesOrNumbers)
{
  auto                    parameters = annulus<2>();
  const BackgroundMesh<2> named(parameters, MPI_COMM_WORLD);
  EXPECT_EQ(named.boundary_id("outer", ""), 1u);
  EXPECT_EQ(message_of<InputError>([&] { named.boundary_id("1", "here"); }),
            "here: found '1', allowed: a side of the mesh (hole, outer)");
  parameters.side_names = "";
  const BackgroundMesh<2> numbered(parameters, MPI_COMM_WORLD);
  EXPECT_EQ(numbered.boundary_id("1", ""), 1u);
  EXPECT_EQ(message_of<InputError>(
              [&] { numbered.boundary_id("hole", "here"); }),
            "here: found 'hole', allowed: a side of the mesh (0, 1)");
  parameters.side_names = "hole: 7";
  EXPECT_EQ(complaint(parameters),
            "section 'Mesh', key 'Side names': found 'hole: 7', allowed: "
            "numbers that the boundary of the mesh has (0, 1)");
  auto extruded       = annulus<3>();
  extruded.side_names = "top: 1";
  EXPECT_NE(complaint(extruded).find("those of the extrusion"),
            std::string::npos);
}



TEST(MeshKinds, EveryGeneratorThatIsOfferedTakesArguments)
{
  // All that a message lists are known to deal.II: wrong arguments are
  // answered with what they are.
  auto parameters           = annulus<3>();
  parameters.generator      = "concentric_shells";
  const std::string unknown = complaint(parameters);
  EXPECT_NE(unknown.find("did you mean 'concentric_hyper_shells'?"),
            std::string::npos)
    << unknown;
  parameters.extrusion_layers = 0;
  parameters.extrusion_height = 0;
  const std::string list      = complaint(parameters);
  std::string       names     = list.substr(list.find("Allowed here: ") + 14);
  unsigned int      n_names   = 0;
  for (const std::string &name : dealii::Utilities::split_string_list(names))
    {
      parameters.generator      = name;
      parameters.arguments      = "@";
      const std::string message = complaint(parameters);
      EXPECT_EQ(message.find("section 'Mesh', key 'Arguments': found '@', "
                             "allowed: arguments of " +
                             name + ": "),
                0u)
        << message;
      EXPECT_EQ(message.find("implemented"), std::string::npos) << message;
      ++n_names;
    }
  EXPECT_EQ(n_names, 28u);
}



TEST(MeshKinds, MovedMeshIsSearchedAnew)
{
  for (const unsigned int degree : {1, 2})
    {
      BackgroundMesh<2> mesh(annulus<2>(), MPI_COMM_WORLD);
      GridSpace<2>      space(mesh, degree);
      space.set_active_cells(std::vector<unsigned char>(90, 1));
      std::vector<Point<2>> before;
      for (unsigned int node = 0; node < space.n_nodes(); ++node)
        before.push_back(space.node_position(node));
      const auto dofs = space.n_dofs();
      // fills the caches that must be renewed
      dealii::GridTools::find_active_cell_around_point(mesh.search_cache(),
                                                       Point<2>(7.1, 0.4));
      EXPECT_TRUE(mesh.cell_around(Point<2>(7.1, 0.4)));
      const double size = mesh.cell_size();

      mesh.move_vertices([](const Point<2> &x) { return turned(x, 5.); });

      EXPECT_EQ(space.n_dofs(), dofs);
      EXPECT_NEAR(mesh.cell_size(), size, 1e-13);
      EXPECT_EQ(space.n_nodes(), before.size());
      for (unsigned int node = 0; node < before.size(); ++node)
        EXPECT_LT(space.node_position(node).distance(turned(before[node], 5.)),
                  1e-13);
      for (const auto &[index, x] : mesh.search_cache().get_used_vertices())
        EXPECT_EQ(x, mesh.triangulation().get_vertices()[index]);
      // Cells begin at 0 degrees; the one around 4 degrees now ends at 5.
      for (const double degrees : {4., 6., 24., 94., 356.})
        {
          const Point<2> x = turned(Point<2>(7.4, 0.), degrees);
          const auto found = dealii::GridTools::find_active_cell_around_point(
            mesh.search_cache(), x);
          ASSERT_EQ(found.first.state(), dealii::IteratorState::valid);
          const double middle = std::floor((degrees - 5.) / 20.) * 20. + 15.;
          EXPECT_LT(found.first->center().distance(turned(
                      Point<2>(7.5 * std::cos(dealii::numbers::PI / 18), 0.),
                      middle)),
                    1e-12);
          const auto same = mesh.cell_around(x);
          ASSERT_TRUE(same);
          EXPECT_EQ(same->first, found.first);
          EXPECT_LT(same->second.distance(found.second), 1e-12);
        }
    }
}

TEST(MeshKinds, CellAroundAPlace)
{
  const BackgroundMesh<2> mesh(annulus<2>(), MPI_COMM_WORLD);
  const double            half = dealii::numbers::PI / 18;
  // The middle of an outer edge, and places beside it and in the hole.
  const auto at = [half](const double r) {
    return Point<2>(r * std::cos(half) * std::cos(half),
                    r * std::cos(half) * std::sin(half));
  };
  const auto cell = mesh.cell_around(at(10.));
  ASSERT_TRUE(cell);
  EXPECT_LT(cell->first->center().distance(at(9.5)), 1e-12);
  EXPECT_TRUE(mesh.cell_around(at(10. + 1e-11)));
  EXPECT_FALSE(mesh.cell_around(at(10. + 1e-8)));
  EXPECT_FALSE(mesh.cell_around(at(4.9)));
  EXPECT_FALSE(mesh.cell_around(Point<2>(20., 20.)));
  // Of cells that share a face the first, whatever the search comes across.
  const auto between = mesh.cell_around(at(9.));
  ASSERT_TRUE(between);
  const auto index = [&](const double r) {
    return mesh.cell_around(at(r))->first->active_cell_index();
  };
  EXPECT_EQ(between->first->active_cell_index(),
            std::min(index(8.9), index(9.1)));
}



template <int dim>
void
share_by_work(const MeshParameters<dim> &parameters)
{
  BackgroundMesh<dim> mesh(parameters, MPI_COMM_WORLD);
  const auto         &tria     = mesh.triangulation();
  const unsigned int  n_cells  = tria.n_active_cells();
  const auto          own_work = [&](const auto &work) {
    double own = 0;
    for (const auto &cell : tria.active_cell_iterators())
      if (cell->is_locally_owned())
        own += work(cell);
    return own;
  };
  const auto alike = [](const auto &) { return 1.; };
  // Nearly all of the work is in a quarter of the cells.
  const auto uneven = [](const auto &cell) {
    const Point<dim> x = cell->center();
    return x[0] > 0 && x[1] > 0 ? 1. : 0.01;
  };
  const unsigned int n_ranks =
    dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
  const auto expect_balance = [&](const auto &work) {
    const double own   = own_work(work);
    const double total = dealii::Utilities::MPI::sum(own, MPI_COMM_WORLD);
    EXPECT_NEAR(own, total / n_ranks, 1. + 1e-9);
    EXPECT_EQ(dealii::Utilities::MPI::sum(own_work(alike), MPI_COMM_WORLD),
              n_cells);
    EXPECT_EQ(tria.n_locally_owned_active_cells(), own_work(alike));
  };
  expect_balance(alike);
  mesh.share_cells(uneven);
  expect_balance(uneven);

  // Unknowns see who owns what.
  GridSpace<dim> space(mesh, 1);
  space.set_active_cells(std::vector<unsigned char>(n_cells, 1));
  EXPECT_EQ(dealii::Utilities::MPI::sum(space.locally_owned().n_elements(),
                                        MPI_COMM_WORLD),
            space.n_dofs());
}



TEST(MeshKinds, ProcessesShareTheWork)
{
  MeshParameters<2> box;
  box.lower_corner = Point<2>(-1, -1);
  box.upper_corner = Point<2>(1, 1);
  box.cells        = {{17, 12}};
  share_by_work(box);
  share_by_work(annulus<2>());
  share_by_work(annulus<3>());
}



TEST(MeshKinds, MotionThatInvertsACellIsRefused)
{
  BackgroundMesh<2> mesh(annulus<2>(), MPI_COMM_WORLD);
  const auto        before = mesh.triangulation().get_vertices();
  const auto        flip   = [&](const Point<2> &x) {
    return x.distance(Point<2>(5, 0)) < 1e-9 ? Point<2>(7.5, 0) : x;
  };
  EXPECT_EQ(message_of<ComputationError>([&] {
              mesh.move_vertices(flip);
            }).find("a motion of the mesh turns the cell at ("),
            0u);
  EXPECT_EQ(mesh.triangulation().get_vertices(), before);
}



TEST(MeshKinds, MovedBoxIsNoBox)
{
  MeshParameters<3> parameters;
  parameters.upper_corner = Point<3>(4, 4, 4);
  parameters.cell_size    = 1;
  BackgroundMesh<3> mesh(parameters, MPI_COMM_WORLD);
  EXPECT_TRUE(mesh.box_grid());
  Archive before;
  mesh.write(before);
  mesh.move_vertices([](const Point<3> &x) {
    return Point<3>(x[0] + 0.1 * x[1], x[1], 2 * x[2]);
  });
  EXPECT_FALSE(mesh.box_grid());
  EXPECT_NEAR(dealii::GridTools::volume(mesh.triangulation()), 128, 1e-11);
  EXPECT_NEAR(mesh.cell_size(), 2, 1e-14);

  // A step that fails takes it back.
  mesh.read(before);
  ASSERT_TRUE(mesh.box_grid());
  EXPECT_EQ(mesh.box_grid()->cell_size, (Tensor<1, 3>({1., 1., 1.})));
  EXPECT_EQ(mesh.box_grid()->n_cells, (std::array<unsigned int, 3>{{4, 4, 4}}));
}



TEST(ActiveSearch, NearestCellIsNotTheOneWithTheNearestBox)
{
  // Beside a slanted cell its bounding box holds places that it does not.
  MeshParameters<2> parameters;
  parameters.upper_corner = Point<2>(3, 2);
  parameters.cell_size    = 1;
  BackgroundMesh<2> mesh(parameters, MPI_COMM_WORLD);
  mesh.move_vertices(
    [](const Point<2> &x) { return Point<2>(x[0] + 2 * x[1], x[1]); });
  GridSpace<2>               space(mesh, 1);
  std::vector<unsigned char> active(6, 0);
  unsigned int               right = 0, empty = 0;
  for (const auto &cell : mesh.triangulation().active_cell_iterators())
    {
      // cells of the lower row: (0..1), (1..2), (2..3) at y = 0
      if (cell->center().distance(Point<2>(2.5, 0.5)) < 1e-9)
        empty = cell->active_cell_index();
      if (cell->center().distance(Point<2>(3.5, 0.5)) < 1e-9)
        right = cell->active_cell_index();
    }
  active.assign(6, 1);
  active[empty] = 0;
  space.set_active_cells(active);
  for (const auto &cell : mesh.triangulation().active_cell_iterators())
    if (cell->active_cell_index() == empty)
      {
        // close to the edge to the right, but also in the box of the left cell
        const Point<2> x(2 + 2 * 0.3 - 0.05, 0.3);
        const auto     near = nearest_active_cell(space, cell, x, 1.);
        ASSERT_EQ(near.state(), dealii::IteratorState::valid);
        EXPECT_EQ(near->active_cell_index(), right);
        EXPECT_EQ(nearest_active_cell(space, cell, x, 1e-3).state(),
                  dealii::IteratorState::past_the_end);
      }
}
