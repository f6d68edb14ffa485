// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/core/exceptions.h>
#include <moraine/output/error_norms.h>

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "scene.h"

namespace moraine
{
  using namespace dealii;

  namespace
  {
    std::map<std::string, std::optional<double>>
    as_map(const ErrorNorms &norms)
    {
      return {norms.begin(), norms.end()};
    }

    /** Two points of volume 1 and 3 that started at x = 1 and x = 2. */
    void
    insert_two_points(PointSet<2> &points)
    {
      for (const auto &cell :
           points.mesh().triangulation().active_cell_iterators())
        if (cell->is_locally_owned() && cell->center()[1] < 1.)
          for (const double x : {1., 2.})
            if (cell->center()[0] == x + 0.5)
              points.insert(cell,
                            Point<2>(x + 0.25, 0.5),
                            Point<2>(0.25, 0.5),
                            x,
                            0,
                            x == 1. ? 1. : 3.);
      points.finish_insertion();
      for (unsigned int p = 0; p < points.n_local(); ++p)
        {
          double *u     = points.values(p) + points.displacement_offset();
          double *sigma = points.values(p) + points.stress_offset();
          u[0]          = 0.25;
          sigma[0]      = points.id(p) == 1 ? 10. : 22.;
          sigma[3]      = points.id(p) == 1 ? 0.5 : 0.;
        }
    }
  } // namespace



  TEST(ErrorNorms, by_hand)
  {
    const BackgroundMesh<2> mesh(mesh_parameters<2>(), MPI_COMM_WORLD);
    PointSet<2>             points(mesh, {});
    insert_two_points(points);

    ExactSolutionParameters<2> parameters;
    ParameterHandler           prm;
    parameters.add_parameters(prm);
    prm.parse_input_from_string("set Displacement = a*x; 0\n"
                                "set Stress = 10*b*x*t; 0; 0; 0\n"
                                "set Constants = a: 0.2, b: 1\n");
    auto norms =
      as_map(error_norms<2>(points, parameters.solution(), 1., true));

    // u: exact 0.2 and 0.4, found 0.25 and 0.25; volumes 1 and 3
    EXPECT_NEAR(*norms["r_u"], (0.05 / 0.2 + 3 * 0.15 / 0.4) / 4., 1e-14);
    EXPECT_NEAR(*norms["l2_u"],
                std::sqrt((0.05 * 0.05 + 3 * 0.15 * 0.15) /
                          (0.2 * 0.2 + 3 * 0.4 * 0.4)),
                1e-14);
    EXPECT_NEAR(*norms["max_u"], 0.15, 1e-14);
    // sigma_xx: exact 10 and 20, found 10 and 22; sigma_xy: found 0.5 and 0
    EXPECT_NEAR(*norms["r_sigma_xx"], 3 * 0.1 / 4., 1e-14);
    EXPECT_FALSE(norms["r_sigma_xy"].has_value());
    EXPECT_FALSE(norms["r_sigma_yy"].has_value());
    EXPECT_FALSE(norms["r_sigma_zz"].has_value());
    EXPECT_NEAR(*norms["l2_sigma"],
                std::sqrt((2 * 0.25 + 3 * 4.) / (100. + 3 * 400.)),
                1e-14);
    EXPECT_NEAR(*norms["max_sigma"], 2., 1e-14);
  }



  TEST(ErrorNorms, zero_at_a_point_is_measured_against_the_largest)
  {
    const BackgroundMesh<2> mesh(mesh_parameters<2>(), MPI_COMM_WORLD);
    PointSet<2>             points(mesh, {});
    insert_two_points(points);

    ExactSolutionParameters<2> parameters;
    parameters.displacement = "0.5*(x - 1); 0";
    const auto norms = error_norms<2>(points, parameters.solution(), 0., true);
    ASSERT_EQ(norms.size(), 3u);
    EXPECT_NEAR(*norms[0].second, (0.25 / 0.5 + 3 * 0.25 / 0.5) / 4., 1e-14);

    // On a kept mesh the points stand where they started: at x = 1.25, 2.25.
    const auto kept = error_norms<2>(points, parameters.solution(), 0., false);
    EXPECT_NEAR(*kept[0].second,
                (0.125 / 0.125 + 3 * 0.375 / 0.625) / 4.,
                1e-14);
  }



  TEST(ErrorNorms, wrong_number_of_components)
  {
    ExactSolutionParameters<3> parameters;
    parameters.stress = "1; 2; 3";
    try
      {
        parameters.solution();
        FAIL() << "nothing thrown";
      }
    catch (const InputError &error)
      {
        EXPECT_NE(std::string(error.what())
                    .find("section 'Exact solution', key 'Stress'"),
                  std::string::npos)
          << error.what();
      }
  }
} // namespace moraine
