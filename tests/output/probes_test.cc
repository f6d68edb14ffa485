// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/core/exceptions.h>
#include <moraine/output/probes.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "scene.h"

namespace moraine
{
  using namespace dealii;

  namespace
  {
    ProbeParameters<2>
    probe(const std::string              &name,
          const std::vector<double>      &location,
          const std::string              &kind,
          const std::vector<std::string> &quantities)
    {
      ProbeParameters<2> parameters;
      parameters.name       = name;
      parameters.location   = location;
      parameters.kind       = kind;
      parameters.quantities = quantities;
      return parameters;
    }

    std::string
    message_of(const ProbeParameters<2> &parameters)
    {
      try
        {
          parameters.check(false, false);
        }
      catch (const InputError &error)
        {
          return error.what();
        }
      return "nothing thrown";
    }
  } // namespace



  TEST(Probes, follow_the_nearest_point_over_ranks)
  {
    const BackgroundMesh<2> mesh(mesh_parameters<2>(), MPI_COMM_WORLD);
    PointSet<2>             points(mesh, {});
    fill(points);
    // (0.5, 0.5) is as near to (0.25, 0.25) as to (0.75, 0.75): ids 100, 99 in
    // the first cell.
    const Probes<2> probes(
      {probe("A",
             {0.5, 0.5},
             "nearest point",
             {"position", "displacement", "stress"}),
       probe("B", {3.7, 1.9}, "nearest point", {"position"})},
      points,
      {"ground"},
      true);

    const Tensor<1, 2> step({2.5, 0.75});
    for (unsigned int p = 0; p < points.n_local(); ++p)
      if (points.position(p)[0] < 1. && points.position(p)[1] < 1.)
        {
          double *values                           = points.values(p);
          values[points.displacement_offset()]     = step[0];
          values[points.displacement_offset() + 1] = step[1];
          for (unsigned int c = 0; c < 4; ++c)
            values[points.stress_offset() + c] = points.id(p) + 0.1 * c;
          points.set_position(p, points.position(p) + step);
        }
    points.find_cells();

    const auto columns = probes.values(points);
    ASSERT_EQ(columns.size(), 10u);
    const std::vector<std::string> names  = {"x at A",
                                             "y at A",
                                             "u_x at A",
                                             "u_y at A",
                                             "sigma_xx at A",
                                             "sigma_yy at A",
                                             "sigma_zz at A",
                                             "sigma_xy at A",
                                             "x at B",
                                             "y at B"};
    const std::vector<double>      values = {
           3.25, 1.5, 2.5, 0.75, 99., 99.1, 99.2, 99.3, 3.75, 1.75};
    for (unsigned int i = 0; i < names.size(); ++i)
      {
        EXPECT_EQ(columns[i].name, names[i]);
        EXPECT_DOUBLE_EQ(columns[i].value, values[i]) << names[i];
        EXPECT_EQ(columns[i].unit, i >= 4 && i < 8 ? "stress" : "length");
      }
  }



  TEST(Probes, go_on_from_an_archive)
  {
    const BackgroundMesh<2> mesh(mesh_parameters<2>(), MPI_COMM_WORLD);
    PointSet<2>             points(mesh, {});
    fill(points);
    const std::vector<ProbeParameters<2>> two = {
      probe("A", {0.5, 0.5}, "nearest point", {"position"}),
      probe("B",
            {1.5, 0.5},
            "interpolated",
            {"displacement", "velocity", "acceleration"})};
    Probes<2> probes(two, points, {}, true);
    Archive   written, before;
    probes.write(before);
    EXPECT_EQ(before.integers("probes/point")[0], 99u);
    written.write("probes/point", std::vector<unsigned int>{100, 0});
    written.write("probes/body", std::vector<unsigned int>{0, 1});
    written.write("probes/has_left", std::vector<unsigned int>{0, 0});
    // How far they went, what is ahead of their points, and does not count.
    written.write(
      "probes/displacement",
      std::vector<double>{0., 0., 0., 0., 0., 0., 0.25, -0.5, 0., 0., 0., 0.},
      6);
    written.write("probes/velocity", std::vector<double>{0., 0., 3., 4.}, 2);
    written.write("probes/acceleration",
                  std::vector<double>{0., 0., -5., 6.},
                  2);
    probes.read(written);
    Archive again;
    probes.write(again);
    EXPECT_TRUE(again == written);
    const auto columns = probes.values(points);
    EXPECT_DOUBLE_EQ(columns[0].value, 0.25);
    EXPECT_DOUBLE_EQ(columns[2].value, 0.25);
    EXPECT_DOUBLE_EQ(columns[3].value, -0.5);
    for (unsigned int k = 0; k < 4; ++k)
      EXPECT_DOUBLE_EQ(columns[4 + k].value,
                       (std::array<double, 4>{{3, 4, -5, 6}})[k]);
  }



  TEST(Probes, interpolate_and_are_carried_along)
  {
    const BackgroundMesh<2> mesh(mesh_parameters<2>(), MPI_COMM_WORLD);
    PointSet<2>             points(mesh, {});
    fill(points);
    for (const unsigned int degree : {1u, 2u})
      {
        GridSpace<2> space(mesh, degree);
        // Column 3 <= x <= 4 is empty.
        std::vector<unsigned char> active(8, 0);
        for (const auto &cell : mesh.triangulation().active_cell_iterators())
          active[cell->active_cell_index()] = cell->center()[0] < 3.;
        space.set_active_cells(active);
        std::vector<Tensor<1, 2>> increment(space.n_nodes());
        for (unsigned int n = 0; n < increment.size(); ++n)
          {
            const Point<2> x = space.node_position(n);
            increment[n] =
              Tensor<1, 2>({0.5 + 0.25 * x[0] * x[1], -0.1 * x[1]});
          }
        const auto field = grid_evaluation<2>(space, increment);

        const auto place =
          probe("P", {1., 0.5}, "interpolated", {"displacement", "position"});
        Probes<2> carried({place}, points, {}, true);
        Probes<2> kept({place}, points, {}, false);
        carried.try_step(field, points);
        carried.keep_step();
        kept.try_step(field, points);
        kept.keep_step();
        EXPECT_NEAR(carried.values(points)[0].value, 0.625, 1e-14);
        EXPECT_NEAR(carried.values(points)[2].value, 1.625, 1e-14);
        carried.try_step(field, points);
        carried.keep_step();
        kept.try_step(field, points);
        kept.keep_step();
        const double second = 0.5 + 0.25 * 1.625 * 0.45;
        EXPECT_NEAR(carried.values(points)[0].value, 0.625 + second, 1e-14);
        EXPECT_NEAR(carried.values(points)[1].value, -0.05 - 0.045, 1e-14);
        EXPECT_NEAR(kept.values(points)[0].value, 1.25, 1e-14);

        // x is now 2.31, and after one more step 3.04, where no material is:
        // from there on it goes with the point nearest to it.
        carried.try_step(field, points);
        carried.keep_step();
        EXPECT_TRUE(carried.changes().empty());
        const auto there = carried.values(points);
        EXPECT_GT(there[2].value, 3.);
        carried.try_step(field, points);
        EXPECT_EQ(carried.values(points)[0].value, there[0].value);
        carried.keep_step();
        ASSERT_EQ(carried.changes().size(), 1u);
        EXPECT_EQ(carried.changes()[0].rfind("probe 'P' has left the cells", 0),
                  0u);
        for (unsigned int i = 0; i < there.size(); ++i)
          EXPECT_NEAR(carried.values(points)[i].value, there[i].value, 1e-14);
        const double u[] = {0.125, -0.25};
        for (unsigned int p = 0; p < points.n_local(); ++p)
          for (unsigned int d = 0; d < 2; ++d)
            points.values(p)[points.displacement_offset() + d] += u[d];
        carried.try_step(field, points);
        carried.keep_step();
        EXPECT_TRUE(carried.changes().empty());
        for (unsigned int i = 0; i < there.size(); ++i)
          EXPECT_NEAR(carried.values(points)[i].value,
                      there[i].value + u[i % 2],
                      1e-14);
      }
  }



  TEST(ProbeParameters, are_read)
  {
    ProbeParameters<3> parameters;
    ParameterHandler   prm;
    parameters.add_parameters(prm);
    EXPECT_TRUE(parameters.location.empty());
    prm.parse_input_from_string("set Location = 1, 2.5, -3\n"
                                "set Kind = interpolated\n"
                                "set Quantities = displacement, position\n");
    EXPECT_EQ(parameters.location, (std::vector<double>{1., 2.5, -3.}));
    EXPECT_EQ(parameters.kind, "interpolated");
    EXPECT_EQ(parameters.quantities,
              (std::vector<std::string>{"displacement", "position"}));
    EXPECT_THROW(prm.set("Quantities", "colour"), ExceptionBase);
  }



  TEST(ProbeParameters, mistakes_are_named)
  {
    EXPECT_EQ(
      message_of(probe("A", {1.}, "nearest point", {"stress"})),
      "section 'Probes/A', key 'Location': found 1 numbers, but a place "
      "in this scene has 2");
    EXPECT_EQ(
      message_of(probe("A", {1., 2.}, "interpolated", {"stress"})),
      "section 'Probes/A', key 'Quantities': found 'stress', but stress "
      "is known at points only; allowed with 'Kind = interpolated' are "
      "displacement, position, velocity and acceleration");
    EXPECT_EQ(
      message_of(probe("A", {1., 2.}, "interpolated", {})),
      "section 'Probes/A', key 'Quantities': found nothing; allowed are "
      "displacement, position, stress, velocity and acceleration");
    EXPECT_EQ(
      message_of(probe("A", {1., 2.}, "nearest point", {"velocity"})),
      "section 'Probes/A', key 'Quantities': found 'velocity' in a scene "
      "without inertia; allowed are displacement, position and stress, or an "
      "'Integrator' of section 'Time' that is not quasi-static");
  }
} // namespace moraine
