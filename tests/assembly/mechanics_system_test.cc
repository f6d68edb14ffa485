// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/assembly/mechanics_system.h>

#include <moraine/geometry/shapes.h>
#include <moraine/material/linear_elastic.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>


#include "../small_scene.h"

namespace
{
  using namespace dealii;
  using namespace moraine;

  /** A small system with one straight boundary that cuts cells. */
  struct System
  {
    System(const bool             gimp,
           const std::string     &enforcement,
           const bool             roller,
           const StrainMeasure    measure    = StrainMeasure::small,
           const VolumetricStrain volumetric = VolumetricStrain::pointwise)
      : scene(gimp, 2, measure)
      , state(scene.space,
              scene.points,
              *scene.basis,
              {std::make_shared<LinearElastic>(1000., 0.3, 1.)},
              MeshAfterStep::reset,
              measure,
              PointWeights::volumes,
              volumetric)
    {
      EnforcementParameters parameters;
      parameters.enforcement = enforcement;
      parameters.band_width  = 1e-2;
      Constraint<2> constraint;
      constraint.kind = roller ? Constraint<2>::roller : Constraint<2>::fixed;
      boundaries.emplace_back(
        "line",
        make_flat_face<2>(std::vector<Point<2>>{{0.4, 3.1}, {0.7, 0.5}}, false),
        RigidMotion<2>(),
        [](const Point<2> &x, const double t) {
          return Tensor<1, 2>({0.01 * t * x[1], 0.02 * t});
        },
        constraint,
        parameters.enforcement_of(),
        0.);
      loads.body_forces.push_back({"weight",
                                   [](const Point<2> &, const double t) {
                                     return Tensor<1, 2>({0., -t});
                                   },
                                   false,
                                   {true}});
      system = std::make_unique<MechanicsSystem<2>>(
        state,
        make_terms(boundaries, conditions, loads),
        std::vector<std::string>{"block"});
      system->begin_step(0);
      system->set_target(1);
    }

    /** A vector of unknowns that depends on the place only. */
    LA::Vector
    field(const double scale) const
    {
      LA::Vector x = scene.space.vector();
      for (unsigned int node = 0; node < scene.space.n_nodes(); ++node)
        for (unsigned int c = 0; c < 2; ++c)
          {
            const auto dof = scene.space.node_dof(node) + c;
            const auto X   = scene.space.node_position(node);
            if (scene.space.locally_owned().is_element(dof))
              x(dof) = scale * std::sin(1.3 * X[0] + 0.7 * c + X[1] * X[1]);
          }
      x.compress(VectorOperation::insert);
      return x;
    }

    SmallScene<2>                       scene;
    State<2>                            state;
    std::vector<ImplicitBoundary<2>>    boundaries;
    std::vector<GridCondition<2>>       conditions;
    Loads<2>                            loads;
    std::unique_ptr<MechanicsSystem<2>> system;
  };



  using Case = std::tuple<bool, std::string, bool, VolumetricStrain>;
  class EveryEnforcement : public testing::TestWithParam<Case>
  {};



  TEST_P(EveryEnforcement, TangentIsTheDerivativeOfTheResidual)
  {
    const auto [gimp, enforcement, roller, volumetric] = GetParam();
    System s(gimp, enforcement, roller, StrainMeasure::small, volumetric);
    const LA::Vector x = s.field(0.1), v = s.field(-0.03);
    s.system->assemble(x, true);
    LA::Vector Kv = s.scene.space.vector();
    s.system->tangent()->vmult(Kv, v);

    LA::Vector there = x;
    there += v;
    LA::Vector difference = s.system->residual();
    s.system->assemble(there, false);
    difference -= s.system->residual();
    const double size = Kv.l2_norm();
    ASSERT_GT(size, 0.1);
    Kv -= difference;
    // The system is linear, so the difference quotient is exact.
    EXPECT_LT(Kv.l2_norm(), 1e-12 * size);
  }



  TEST_P(EveryEnforcement, TangentIsTheDerivativeAtFiniteStrain)
  {
    const auto [gimp, enforcement, roller, volumetric] = GetParam();
    System s(gimp, enforcement, roller, StrainMeasure::finite, volumetric);
    const LA::Vector x = s.field(0.05), v = s.field(1e-6);
    s.system->assemble(x, true);
    LA::Vector Kv = s.scene.space.vector();
    s.system->tangent()->vmult(Kv, v);
    EXPECT_EQ(s.system->symmetric(),
              enforcement == "augmented Lagrangian" ||
                enforcement == "penalty");

    LA::Vector there = x, difference = x;
    there += v;
    s.system->assemble(there, false);
    difference = s.system->residual();
    there.add(-2., v);
    s.system->assemble(there, false);
    difference -= s.system->residual();
    const double size = Kv.l2_norm();
    ASSERT_GT(size, 1e-6);
    Kv.add(0.5, difference);
    EXPECT_LT(Kv.l2_norm(), 1e-7 * size);
  }



  TEST_P(EveryEnforcement, SymmetryIsReportedTruly)
  {
    const auto [gimp, enforcement, roller, volumetric] = GetParam();
    System s(gimp, enforcement, roller, StrainMeasure::small, volumetric);
    const LA::Vector x = s.field(0.1);
    LA::Vector       v = s.field(1.);
    v.scale(s.field(2.));
    s.system->assemble(x, true);
    LA::Vector Kx = s.scene.space.vector(), Kv = Kx;
    s.system->tangent()->vmult(Kx, x);
    s.system->tangent()->vmult(Kv, v);
    const double asymmetry =
      std::abs(v * Kx - x * Kv) / std::abs(v.l2_norm() * Kx.l2_norm());
    if (s.system->symmetric())
      EXPECT_LT(asymmetry, 1e-12);
    else
      EXPECT_GT(asymmetry, 1e-6);
  }



  TEST_P(EveryEnforcement, ReactionBalancesTheForcesOfTheNodes)
  {
    // Inner forces sum to zero, so what is left is reaction plus weight.
    const auto [gimp, enforcement, roller, volumetric] = GetParam();
    System s(gimp, enforcement, roller, StrainMeasure::small, volumetric);
    const LA::Vector x = s.field(0.1);
    s.system->assemble(x, false);
    Tensor<1, 2> sum;
    for (const auto dof : s.scene.space.locally_owned())
      for (unsigned int c = 0; c < 2; ++c)
        sum[c] +=
          s.system->residual()(dof) * s.system->near_null_space()[c](dof);
    sum = Utilities::MPI::sum(sum, MPI_COMM_WORLD);
    const Tensor<1, 2> weight({0., -3.1 * 3.1});
    const auto         reports = s.system->accept(x);
    EXPECT_NEAR((reports[0].reaction + weight - sum).norm(),
                0.,
                1e-12 * (1 + reports[0].reaction.norm()));
    EXPECT_GT(reports[0].reaction.norm(), 1e-3);
  }



  INSTANTIATE_TEST_SUITE_P(
    All,
    EveryEnforcement,
    testing::Combine(testing::Bool(),
                     testing::Values("augmented Lagrangian",
                                     "weighted",
                                     "symmetric Nitsche",
                                     "skew Nitsche",
                                     "penalty"),
                     testing::Bool(),
                     testing::Values(VolumetricStrain::pointwise,
                                     VolumetricStrain::cell_mean)));



  TEST(MechanicsSystem, ABodyThatIsNotHeldIsNamed)
  {
    System free(false, "skew Nitsche", true);
    free.system->assemble(free.field(0.), true);
    try
      {
        free.system->check_that_it_is_held(true);
        FAIL() << "a body on one roller can slide along it";
      }
    catch (const std::exception &error)
      {
        EXPECT_NE(std::string(error.what()).find("block"), std::string::npos)
          << error.what();
      }
    System held(false, "skew Nitsche", false);
    held.system->assemble(held.field(0.), true);
    EXPECT_NO_THROW(held.system->check_that_it_is_held(true));
  }
} // namespace
