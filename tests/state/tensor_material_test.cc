// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// Materials that are not isotropic, or keep variables of their own, at points.

#include <moraine/state/state.h>

#include <gtest/gtest.h>

#include <cmath>

#include "../material/transversely_isotropic.h"
#include "../small_scene.h"

namespace
{
  using namespace dealii;
  using namespace moraine;

  constexpr TransverseConstants slate{50., 90., 0.2, 0.3, 25.};

  /** A unit of the increments @f$A X@f$ of all unknowns. */
  template <int dim>
  LA::Vector
  linear_field(const GridSpace<dim> &space, const Tensor<2, dim> &A)
  {
    LA::Vector x = space.vector();
    for (unsigned int node = 0; node < space.n_nodes(); ++node)
      for (unsigned int c = 0; c < dim; ++c)
        if (space.locally_owned().is_element(space.node_dof(node) + c))
          x(space.node_dof(node) + c) =
            (A * Tensor<1, dim>(space.node_position(node)))[c];
    x.compress(VectorOperation::insert);
    return x;
  }

  /** A block that is pulled in the direction x, free at the sides. */
  void
  pull_block(const double angle, const StrainMeasure measure)
  {
    const Tensor<1, 3> axis({std::cos(angle), std::sin(angle), 0.});
    const auto         material =
      std::make_shared<TransverselyIsotropic>(slate, axis, 1.);
    SmallScene<3> scene(false, 2, measure, {material});
    State<3>      state(scene.space,
                   scene.points,
                   *scene.basis,
                   {material},
                   MeshAfterStep::keep,
                   measure);
    state.begin_step();
    const double          c = std::cos(angle), s = std::sin(angle);
    SymmetricTensor<2, 3> pull;
    pull[0][0]                = 1e-3;
    const Tensor<2, 3> strain = invert(material->stiffness()) * pull;
    state.set_trial(linear_field(scene.space, strain));
    state.accept();
    const double compliance = std::pow(c, 4) / slate.axial_modulus +
                              std::pow(s, 4) / slate.transverse_modulus +
                              (1 / slate.axial_shear_modulus -
                               2 * slate.axial_ratio / slate.axial_modulus) *
                                c * c * s * s;
    EXPECT_NEAR(strain[0][0], 1e-3 * compliance, 1e-17);
    for (unsigned int p = 0; p < scene.points.n_local(); ++p)
      {
        const auto stress = scene.points.stress_field()(scene.points.values(p));
        // At finite strain the two differ by the strain, 1e-5.
        EXPECT_NEAR((stress - pull).norm(),
                    0.,
                    measure == StrainMeasure::small ? 1e-16 : 1e-7);
      }
  }

  /** Elastic, and counts steps and adds up time. */
  class Clock : public Material
  {
  public:
    using Material::respond;

    void
    respond(const StepTime                  &time,
            const ArrayView<PrincipalState> &points) const override
    {
      for (PrincipalState &point : points)
        {
          point.internal[0] += time.size();
          point.internal[1] = time.end;
          point.stress      = 2. * point.strain;
          point.tangent     = 2. * unit_symmetric_tensor<3>();
        }
    }

    std::vector<InternalVariable>
    internal_variables() const override
    {
      return {{"age", "time", 0.5}, {"last_time", "time"}};
    }

    LameConstants
    elastic_stiffness() const override
    {
      return {0., 1.};
    }

    double
    density() const override
    {
      return 1;
    }

    bool
    is_linear() const override
    {
      return false;
    }
  };
} // namespace



TEST(TensorMaterial, BlockInTension)
{
  for (const double angle : {0., 0.5, 1.1, numbers::PI_2})
    {
      pull_block(angle, StrainMeasure::small);
      pull_block(angle, StrainMeasure::finite);
    }
}



// The force of the internal stress and the derivative that goes with it.
TEST(TensorMaterial, TangentOfPointsIsTheDerivative)
{
  const auto material =
    std::make_shared<TransverselyIsotropic>(slate,
                                            Tensor<1, 3>({1., 0.5, 0.}),
                                            1.);
  SmallScene<2> scene(false, 2, StrainMeasure::finite, {material});
  State<2>      state(scene.space,
                 scene.points,
                 *scene.basis,
                 {material},
                 MeshAfterStep::reset,
                 StrainMeasure::finite);
  state.begin_step();
  StencilBlock<2> block;
  scene.basis->evaluate(0, block);
  const auto force = [&](const Tensor<2, 2> &A, TrialPoints<2> &points) {
    std::vector<Tensor<1, 2>> nodal(block.n_nodes);
    for (unsigned int a = 0; a < block.n_nodes; ++a)
      nodal[a] = A * Tensor<1, 2>(scene.space.node_position(block.nodes[a]));
    points.evaluate(state, block, 0, 1, nodal.data());
    return points.stress(0);
  };
  const Tensor<2, 2> A({{0.05, 0.1}, {-0.04, 0.02}});
  const Tensor<2, 2> l({{0.3, -0.2}, {0.5, 0.4}});
  const double       h = 1e-6;
  TrialPoints<2>     points, other;
  const Tensor<2, 3> tau = force(A, points);
  // F(t) = (1 + t l)(1 + A)
  const Tensor<2, 2> one     = unit_symmetric_tensor<2>();
  const Tensor<2, 3> forward = force(A + h * l * (one + A), other);
  const Tensor<2, 3> back    = force(A - h * l * (one + A), other);
  const Tensor<2, 3> rate    = (forward - back) / (2 * h);
  const auto         c       = points.tangent(0);
  const double       d[]     = {l[0][0], l[1][1], l[0][1] + l[1][0]};
  const auto         pairs   = voigt_pairs<2>();
  for (unsigned int I = 0; I < 3; ++I)
    {
      const unsigned int i = pairs[I][0], j = pairs[I][1];
      double             lie = rate[i][j], c_d = 0;
      for (unsigned int k = 0; k < 2; ++k)
        lie -= l[i][k] * tau[k][j] + tau[i][k] * l[j][k];
      for (unsigned int J = 0; J < 3; ++J)
        c_d += c[I][J] * d[J];
      EXPECT_NEAR(lie, c_d, 1e-6 * slate.transverse_modulus);
    }
}



TEST(InternalVariables, HaveFieldsOfTheirNamesAndSeeTheTime)
{
  const auto    material = std::make_shared<Clock>();
  SmallScene<2> scene(false, 2, StrainMeasure::small, {material});
  State<2>      state(
    scene.space, scene.points, *scene.basis, {material}, MeshAfterStep::keep);
  const auto age =
    scene.points.fields().find(FieldName<2, double>{"age", "time"});
  const auto last =
    scene.points.fields().find(FieldName<2, double>{"last_time", "time"});
  ASSERT_TRUE(age.exists() && last.exists());
  for (const double t : {0., 1., 2.})
    {
      state.begin_step();
      state.set_step_time({t, t + 1});
      state.set_trial(scene.space.vector());
      // What is tried and rejected leaves no trace.
      state.point_increments();
      state.reject();
      state.set_trial(scene.space.vector());
      state.accept();
    }
  for (unsigned int p = 0; p < scene.points.n_local(); ++p)
    {
      EXPECT_EQ(age(scene.points.values(p)), 3.5);
      EXPECT_EQ(last(scene.points.values(p)), 3.);
    }
}
