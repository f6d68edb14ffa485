// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/state/stress_signs.h>

#include <gtest/gtest.h>

#include <functional>

#include "../small_scene.h"

namespace
{
  using namespace dealii;
  using namespace moraine;

  /** Of points with this mean stress and a deviatoric stress of norm 1. */
  template <int dim>
  StressSigns
  signs_of(const std::function<double(const Point<dim> &)> &mean_stress)
  {
    SmallScene<dim> scene;
    for (unsigned int p = 0; p < scene.points.n_local(); ++p)
      {
        SymmetricTensor<2, 3> stress =
          mean_stress(scene.points.position(p)) * unit_symmetric_tensor<3>();
        stress[0][1] = std::sqrt(0.5);
        scene.points.stress_field().store(stress, scene.points.values(p));
      }
    return stress_signs(scene.space, scene.points);
  }

  /** Where this is in its unit cell. */
  double
  in_cell(const double x)
  {
    return x - std::floor(x);
  }

  template <int dim>
  void
  jumps_are_those_at_faces()
  {
    const auto linear =
      signs_of<dim>([](const Point<dim> &x) { return 7 - 3 * x[0] + x[1]; });
    EXPECT_LT(linear.jump, 1e-13);
    EXPECT_NEAR(linear.step, std::sqrt(10. / dim), 1e-13);
    EXPECT_NEAR(linear.deviatoric, 1, 1e-13);

    // Each face across x has a jump of 2, others have none.
    const auto saw =
      signs_of<dim>([](const Point<dim> &x) { return 2 * in_cell(x[0]); });
    EXPECT_NEAR(saw.jump, 2 / std::sqrt(1. * dim), 1e-13);
    EXPECT_LT(saw.step, 1e-13);

    // Not of cells that are filled by less than 3/4.
    const auto at_rim = signs_of<dim>(
      [](const Point<dim> &x) { return x[0] < 1 ? 100 * x[0] : 0.; });
    EXPECT_LT(at_rim.jump, 1e-13);
  }

  TEST(StressSigns, JumpsAreThoseOfLinearFitsAtFaces)
  {
    jumps_are_those_at_faces<2>();
    jumps_are_those_at_faces<3>();
  }

  TEST(StressSigns, StressInCutsIsThatOfCellsFilledByLessThanHalf)
  {
    const auto signs = signs_of<2>([](const Point<2> &x) {
      return x[0] > 3 ? 8. : x[0] < 1 ? 4. : 0.;
    });
    EXPECT_NEAR(signs.in_cuts, std::sqrt(3 * 64 + 1.), 1e-12);
    EXPECT_NEAR(signs.elsewhere, std::sqrt(3 * 16 + 1.), 1e-12);
  }
} // namespace
