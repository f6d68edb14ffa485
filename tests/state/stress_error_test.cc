// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/state/stress_error.h>

#include <gtest/gtest.h>

#include <functional>

#include "../small_scene.h"

namespace
{
  using namespace dealii;
  using namespace moraine;

  /** Of points with this stress along x, shear modulus 2, bulk modulus 3. */
  template <int dim>
  std::optional<double>
  error_of(const std::function<double(const Point<dim> &)> &stress_along_x)
  {
    SmallScene<dim> scene;
    for (unsigned int p = 0; p < scene.points.n_local(); ++p)
      {
        SymmetricTensor<2, 3> stress;
        stress[0][0] = stress_along_x(scene.points.position(p));
        scene.points.stress_field().store(stress, scene.points.values(p));
      }
    return estimated_stress_error(scene.points,
                                  std::vector<LameConstants>{{3 - 4. / 3, 2}});
  }

  template <int dim>
  void
  linear_stress_has_none()
  {
    const auto linear = error_of<dim>(
      [](const Point<dim> &x) { return 7 - 3 * x[0] + x[dim - 1]; });
    ASSERT_TRUE(linear.has_value());
    EXPECT_LT(*linear, 1e-13);
    EXPECT_FALSE(error_of<dim>([](const Point<dim> &) { return 1e-12; }));

    // What alternates from cell to cell is error, in the same part of any
    // stress; at the rims of a few cells linear functions follow the half of
    // it.
    const auto saw = [](const double size) {
      return error_of<dim>([size](const Point<dim> &x) {
        return size * (int(std::floor(x[0])) % 2 == 0 ? 1. : -1.);
      });
    };
    ASSERT_TRUE(saw(1).has_value());
    EXPECT_GT(*saw(1), 0.3);
    EXPECT_NEAR(*saw(1e3) / *saw(1), 1, 1e-12);
  }

  TEST(StressError, LinearStressHasNone)
  {
    linear_stress_has_none<2>();
    linear_stress_has_none<3>();
  }
} // namespace
