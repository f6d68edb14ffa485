// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/run/strain_signs.h>

#include <gtest/gtest.h>

#include "../small_scene.h"

namespace
{
  using namespace dealii;
  using namespace moraine;

  /** Where points were sheared and stretched, in axes through the origin. */
  template <int dim>
  void
  strain_is_that_of_displacements()
  {
    SmallScene<dim> scene;
    Tensor<2, dim>  gradient;
    gradient[0][0]       = 0.03;
    gradient[0][dim - 1] = 0.1;
    gradient[1][0]       = -0.06;
    for (unsigned int p = 0; p < scene.points.n_local(); ++p)
      {
        const Tensor<1, dim> X =
          invert(unit_symmetric_tensor<dim>() + gradient) *
          scene.points.position(p);
        scene.points.displacement_field().store(gradient * X,
                                                scene.points.values(p));
      }
    const auto strains = mean_strains(scene.points, 1., 2, MPI_COMM_WORLD);
    ASSERT_EQ(strains.size(), 2u);
    EXPECT_NEAR(strains[0], symmetrize(gradient).norm(), 1e-12);
    EXPECT_EQ(strains[1], 0);
  }

  TEST(StrainSigns, MeanStrainIsThatOfDisplacements)
  {
    strain_is_that_of_displacements<2>();
    strain_is_that_of_displacements<3>();
  }
} // namespace
