// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/mesh/cell_inverse.h>
#include <moraine/mesh/straight_mapping.h>

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/tria.h>

#include <gtest/gtest.h>

#include <cmath>


namespace
{
  using namespace dealii;
  using moraine::CellInverse;
  using moraine::CellMap;
  using moraine::CellVertices;
  using moraine::StraightMapping;

  /** The unit cell with vertices moved by up to 0.2, then turned and shifted.
   */
  template <int dim>
  CellVertices<dim>
  bent_cell()
  {
    CellVertices<dim> cell;
    for (unsigned int v = 0; v < cell.size(); ++v)
      {
        Point<dim> x;
        for (unsigned int d = 0; d < dim; ++d)
          x[d] = ((v >> d) & 1u) + 0.2 * std::sin(3. * v + 5. * d);
        cell[v]    = x;
        cell[v][0] = 100 + 0.8 * x[0] - 0.6 * x[1];
        cell[v][1] = 0.6 * x[0] + 0.8 * x[1];
      }
    return cell;
  }



  template <int dim>
  void
  find_places_again()
  {
    const auto             cell = bent_cell<dim>();
    const CellInverse<dim> inverse(cell);
    for (unsigned int i = 0; i < 200; ++i)
      {
        // Inside and a fifth of a cell around it.
        Point<dim> xi;
        for (unsigned int d = 0; d < dim; ++d)
          xi[d] = 0.5 + 0.7 * std::sin(i * (1.3 + d));
        const auto found = inverse(CellMap<dim>(cell).place(xi));
        ASSERT_TRUE(found);
        EXPECT_LT(found->distance(xi), 1e-13) << xi;
      }
  }



  TEST(CellInverse, FindsPlacesInAndAroundABentCell)
  {
    find_places_again<2>();
    find_places_again<3>();
  }



  TEST(CellInverse, FindsNothingBeyondTheFoldOfTheMap)
  {
    // Its lines ξ = const meet at (0, 3).
    const CellVertices<2> cell = {{{-1, 0}, {1, 0}, {-0.5, 1.5}, {0.5, 1.5}}};
    const CellInverse<2>  inverse(cell);
    EXPECT_TRUE(inverse({0.1, 2.9}));
    EXPECT_FALSE(inverse({0.1, 3.1}));
    EXPECT_FALSE(inverse({std::nan(""), 0}));
  }



  /** What MappingQ1 finds, StraightMapping finds; so much for the others. */
  template <int dim>
  void
  compare_with_mapping_q1()
  {
    Triangulation<dim> triangulation;
    GridGenerator::hyper_cube(triangulation);
    const auto cell     = triangulation.begin_active();
    const auto vertices = bent_cell<dim>();
    for (unsigned int v = 0; v < vertices.size(); ++v)
      cell->vertex(v) = vertices[v];

    std::vector<Point<dim>> places;
    for (unsigned int i = 0; i < 200; ++i)
      {
        // Half of them about the cell, half far away.
        Point<dim> x = cell->center();
        for (unsigned int d = 0; d < dim; ++d)
          x[d] += (i % 2 == 0 ? 0.6 : 3.) * std::sin(i * (1.7 + d));
        places.push_back(x);
      }
    const MappingQ1<dim>       q1;
    const StraightMapping<dim> straight;
    const auto                 copy = straight.clone();
    std::vector<Point<dim>>    by_q1(places.size()), by_us(places.size());
    q1.transform_points_real_to_unit_cell(cell, places, by_q1);
    copy->transform_points_real_to_unit_cell(cell, places, by_us);
    unsigned int n_inside = 0;
    for (unsigned int i = 0; i < places.size(); ++i)
      {
        if (std::isinf(by_us[i][0]))
          {
            EXPECT_TRUE(std::isinf(by_q1[i][0])) << places[i];
            EXPECT_THROW(straight.transform_real_to_unit_cell(cell, places[i]),
                         typename Mapping<dim>::ExcTransformationFailed);
            continue;
          }
        const bool is_inside = GeometryInfo<dim>::is_inside_unit_cell(by_us[i]);
        EXPECT_EQ(is_inside, GeometryInfo<dim>::is_inside_unit_cell(by_q1[i]));
        if (is_inside)
          {
            EXPECT_LT(by_us[i].distance(by_q1[i]), 1e-11) << places[i];
            EXPECT_EQ(straight.transform_real_to_unit_cell(cell, places[i]),
                      by_us[i]);
          }
        n_inside += is_inside;
      }
    EXPECT_GT(n_inside, 0u);
  }



  TEST(StraightMapping, FindsWhatMappingQ1Finds)
  {
    compare_with_mapping_q1<2>();
    compare_with_mapping_q1<3>();
  }



  TEST(StraightMapping, TellsThatAPlaceHasNoneInTheUnitCell)
  {
    // All lines ξ = const meet at (0, 3), nothing else has y = 3.
    Triangulation<2> triangulation;
    GridGenerator::general_cell(triangulation,
                                {{-1, 0}, {1, 0}, {-0.5, 1.5}, {0.5, 1.5}});
    const auto                  cell = triangulation.begin_active();
    const StraightMapping<2>    mapping;
    const std::vector<Point<2>> places = {{0.1, 0.5}, {1., 3.}};
    std::vector<Point<2>>       found(2);
    mapping.transform_points_real_to_unit_cell(cell, places, found);
    EXPECT_TRUE(GeometryInfo<2>::is_inside_unit_cell(found[0]));
    EXPECT_TRUE(std::isinf(found[1][0]));
    EXPECT_THROW(mapping.transform_real_to_unit_cell(cell, places[1]),
                 Mapping<2>::ExcTransformationFailed);
  }
} // namespace
