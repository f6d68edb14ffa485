// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/assembly/absorbing_term.h>
#include <moraine/assembly/mechanics_system.h>
#include <moraine/geometry/shape_library.h>
#include <moraine/material/linear_elastic.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <cmath>

#include "../small_scene.h"

namespace
{
  using namespace dealii;
  using namespace moraine;

  constexpr double E = 1000., nu = 0.25, rho = 2.;
  constexpr double G = E / (2 * (1 + nu));
  constexpr double M = E * (1 - nu) / ((1 + nu) * (1 - 2 * nu));



  TEST(AbsorbingLaw, HasTheImpedancesOfTheMaterial)
  {
    const LameConstants C = {M - 2 * G, G};
    AbsorbingLaw        law;
    law.dashpot_factors = {2., 3.};
    auto found          = law.coefficients(C, rho);
    EXPECT_NEAR(found.dashpots.normal, 2 * std::sqrt(rho * M), 1e-10);
    EXPECT_NEAR(found.dashpots.along, 3 * std::sqrt(rho * G), 1e-10);
    EXPECT_EQ(found.springs.normal, 0.);

    law.springs       = AbsorbingLaw::Springs::radius;
    law.spring_length = 5;
    found             = law.coefficients(C, rho);
    EXPECT_NEAR(found.springs.normal, 2 * G / 5, 1e-10);
    EXPECT_NEAR(found.springs.along, G / 10, 1e-10);

    law.springs = AbsorbingLaw::Springs::thickness;
    found       = law.coefficients(C, rho);
    EXPECT_NEAR(found.springs.normal, M / 5, 1e-10);
    EXPECT_NEAR(found.springs.along, G / 5, 1e-10);

    law.medium = {3., 20., 10.};
    found      = law.coefficients(C, rho);
    EXPECT_NEAR(found.dashpots.normal, 2 * 60, 1e-10);
    EXPECT_NEAR(found.springs.along, 300 / 5., 1e-10);

    law.medium           = {};
    law.impedances       = {7., 8.};
    law.springs          = AbsorbingLaw::Springs::given;
    law.spring_stiffness = {11., 12.};
    found                = law.coefficients(C, rho);
    EXPECT_EQ(found.dashpots.along, 24.);
    EXPECT_EQ(found.springs.normal, 11.);
    EXPECT_EQ(found.springs.along, 12.);
  }



  /** A box with an absorbing plane along one of its faces, turned a little, and
   * a wave from outside. Its mesh moves with the material. */
  template <int dim>
  struct AbsorbingBox
  {
    using Place = typename AbsorbingBoundary<dim>::Place;

    static AbsorbingLaw
    law()
    {
      AbsorbingLaw law;
      law.springs       = AbsorbingLaw::Springs::radius;
      law.spring_length = 5;
      return law;
    }

    /** A grid of places on a plane inside the box. */
    static std::vector<Place>
    places()
    {
      std::vector<Place> places;
      Tensor<1, dim>     normal;
      normal[0] = 0.8;
      normal[1] = 0.6;
      for (unsigned int i = 0; i < 40; ++i)
        {
          Point<dim> x;
          x[0] = 2.8 - 0.6 * (0.06 * i - 1.);
          x[1] = 1.5 + 0.8 * (0.06 * i - 1.);
          if (dim == 3)
            x[2] = 0.5 + 0.07 * i;
          places.push_back({x, 0.06, normal});
        }
      return places;
    }

    static typename AbsorbingBoundary<dim>::Finder
    finder()
    {
      return [](const auto &, const double) { return places(); };
    }

    explicit AbsorbingBox(
      const StrainMeasure   measure    = StrainMeasure::small,
      const TimeIntegrator &integrator = TimeIntegrator::newmark(0.25, 0.5),
      const bool            acts       = true)
      : law_of_solid(std::make_shared<LinearElastic>(E, nu, rho))
      , scene(false, 2, measure, {law_of_solid})
      , state(scene.space,
              scene.points,
              *scene.basis,
              {law_of_solid},
              MeshAfterStep::follow_material,
              measure)
      , boundary("rim", finder(), law(), incident, false)
      , system(state,
               make_terms(boundaries, conditions, loads, 0., true),
               {"box"})
      , motion(state, scene.points, integrator, VelocityTransfer(), false)
    {
      auto of_boundary = std::make_unique<AbsorbingTerm<dim>>(boundary, acts);
      term             = of_boundary.get();
      system.add(std::move(of_boundary));
      system.set_motion(&motion);
    }

    static Tensor<1, dim>
    incident(const Point<dim> &x, const double t)
    {
      Tensor<1, dim> v;
      v[0] = 0.02 * std::sin(x[1] + t);
      v[1] = 0.01 * t;
      return v;
    }

    /** Displacements of all nodes, by place, that @p seed varies. */
    LA::Vector
    displacements(const double scale, const double seed) const
    {
      LA::Vector x = scene.space.vector();
      for (unsigned int node = 0; node < scene.space.n_nodes(); ++node)
        for (unsigned int c = 0; c < dim; ++c)
          {
            const auto dof = scene.space.node_dof(node) + c;
            if (!scene.space.locally_owned().is_element(dof))
              continue;
            const Point<dim> X     = scene.space.node_position(node);
            double           phase = seed + 0.7 * c;
            for (unsigned int d = 0; d < dim; ++d)
              phase += (1.3 + 0.9 * d * seed) * X[d];
            x(dof) = scale * std::sin(phase);
          }
      x.compress(VectorOperation::insert);
      return x;
    }

    LA::Vector
    residual(const LA::Vector &x)
    {
      system.assemble(x, false);
      return system.residual();
    }

    /** Begin at rest and accept a step of size 0.1. */
    void
    take_a_step()
    {
      system.begin_step(0.);
      motion.start([](const unsigned int, const Point<dim> &x) {
        Tensor<1, dim> v;
        v[0] = 0.1 * x[1];
        return v;
      });
      motion.begin_step();
      system.set_target(0.1);
      const LA::Vector x = displacements(0.02, 0.4);
      system.assemble(x, false);
      system.accept(x);
    }

    std::shared_ptr<const Material>    law_of_solid;
    SmallScene<dim>                    scene;
    State<dim>                         state;
    std::vector<ImplicitBoundary<dim>> boundaries;
    std::vector<GridCondition<dim>>    conditions;
    Loads<dim>                         loads;
    AbsorbingBoundary<dim>             boundary;
    MechanicsSystem<dim>               system;
    Motion<dim>                        motion;
    AbsorbingTerm<dim>                *term;
  };



  /** Against central differences, in the second step, where springs are
   * extended and nodes have velocities. */
  template <int dim>
  void
  check_tangent(
    const StrainMeasure   measure,
    const TimeIntegrator &integrator = TimeIntegrator::generalised_alpha(0.7))
  {
    AbsorbingBox<dim> box(measure, integrator);
    box.take_a_step();
    box.system.begin_step(0.1);
    box.system.set_target(0.15);
    const LA::Vector x = box.displacements(0.03, 0.9);
    box.system.assemble(x, false); // the next one is not linearised
    const LA::Vector v = box.displacements(1e-5, 1.7);
    box.system.assemble(x, true);
    LA::Vector Kv = box.scene.space.vector();
    box.system.tangent()->vmult(Kv, v);
    const double size = Kv.l2_norm();
    ASSERT_GT(size, 1e-5);
    LA::Vector there = x;
    there += v;
    LA::Vector difference = box.residual(there);
    there.add(-2., v);
    difference -= box.residual(there);
    Kv.add(0.5, difference);
    EXPECT_LT(Kv.l2_norm(), 1e-7 * size);
  }



  TEST(AbsorbingTerm, TangentIsTheDerivative)
  {
    check_tangent<2>(StrainMeasure::small);
    check_tangent<2>(StrainMeasure::finite);
    check_tangent<3>(StrainMeasure::small);
    check_tangent<2>(StrainMeasure::small, TimeIntegrator::energy_momentum());
  }



  TEST(AbsorbingTerm, PlacesFollowTheMaterialAndGoThroughAnArchive)
  {
    AbsorbingBox<2> box(StrainMeasure::finite);
    const auto      first = AbsorbingBox<2>::places();
    box.take_a_step();
    const auto  &places = box.boundary.places();
    Tensor<1, 2> sum;
    for (unsigned int k = 0; k < places.size(); ++k)
      {
        // Springs know the motion but not that of the wave.
        const Tensor<1, 2> u_in =
          0.05 * (AbsorbingBox<2>::incident(first[k].x, 0.) +
                  AbsorbingBox<2>::incident(first[k].x, 0.1));
        const Tensor<1, 2> moved = places[k].x - first[k].x;
        EXPECT_LT((box.boundary.extension(k) - (moved - u_in)).norm(), 1e-14);
        EXPECT_NEAR(places[k].normal.norm(), 1., 1e-14);
        sum += moved;
      }
    EXPECT_GT(sum.norm(), 1e-3);
    EXPECT_GT((places[3].normal - first[3].normal).norm(), 1e-3);

    Archive archive;
    box.boundary.write(archive);
    AbsorbingBoundary<2> copy("rim",
                              AbsorbingBox<2>::finder(),
                              AbsorbingBox<2>::law(),
                              AbsorbingBox<2>::incident,
                              false);
    copy.read(archive);
    Archive again;
    copy.write(again);
    EXPECT_TRUE(archive == again);

    // A step that is not accepted leaves nothing.
    box.system.begin_step(0.1);
    box.system.set_target(0.2);
    box.system.assemble(box.displacements(0.03, 0.9), false);
    box.term->prepare(box.system.step_context(), box.scene.space.vector());
    box.boundary.undo();
    Archive untouched;
    box.boundary.write(untouched);
    EXPECT_TRUE(archive == untouched);
  }



  TEST(AbsorbingTerm, CarriesPlacesAndLetsSpringsGoWhereItDoesNotAct)
  {
    const auto      newmark = TimeIntegrator::newmark(0.25, 0.5);
    AbsorbingBox<2> box(StrainMeasure::finite);
    AbsorbingBox<2> idle(StrainMeasure::finite, newmark, /* acts = */ false);
    box.take_a_step();
    idle.take_a_step();
    const unsigned int n = box.boundary.places().size();
    ASSERT_EQ(idle.boundary.places().size(), n);
    for (unsigned int k = 0; k < n; ++k)
      {
        EXPECT_LT(
          (idle.boundary.places()[k].x - box.boundary.places()[k].x).norm(),
          1e-14);
        EXPECT_GT(box.boundary.extension(k).norm(), 0.);
        EXPECT_EQ(idle.boundary.extension(k).norm(), 0.);
      }

    // Another stage, in which it acts no more.
    AbsorbingTerm<2>      rests(box.boundary, /* acts = */ false);
    const LA::Vector      none = box.scene.space.vector();
    const StepContext<2> &step = box.system.step_context();
    box.system.begin_step(0.1);
    box.system.set_target(0.2);
    box.system.assemble(box.displacements(0.03, 0.9), false);
    rests.begin_step(step);
    EXPECT_TRUE(rests.effects(step).empty());
    rests.prepare(step, none);
    rests.keep();
    for (unsigned int k = 0; k < n; ++k)
      EXPECT_EQ(box.boundary.extension(k).norm(), 0.);
  }



  /** Forces of the term at rest, before and after it holds them. */
  TEST(AbsorbingTerm, HoldsForcesAsTractions)
  {
    AbsorbingBox<2> box;
    box.system.begin_step(0.);
    const auto &context = box.system.step_context();
    const auto &space   = box.scene.space;

    // What uniform pressure on the places is at the nodes.
    std::vector<Tensor<1, 2>> pressure;
    for (const auto &place : box.boundary.places())
      pressure.push_back(-3. * place.normal);
    box.boundary.hold(pressure);
    box.system.set_target(0.);
    LA::Vector forces = box.residual(space.vector());
    ASSERT_GT(forces.l2_norm(), 1.);

    box.boundary.hold(std::vector<Tensor<1, 2>>(pressure.size()));
    LA::Vector without = box.residual(space.vector());
    forces -= without;
    EXPECT_LT(box.term->hold(context, "rim", forces).value(), 1e-9);
    EXPECT_FALSE(box.term->hold(context, "another", forces).has_value());
    LA::Vector again = box.residual(space.vector());
    again -= without;
    again -= forces;
    EXPECT_LT(again.l2_norm(), 1e-9 * forces.l2_norm());

    // Forces that the places do not see cannot be held.
    LA::Vector elsewhere = space.vector();
    for (unsigned int node = 0; node < space.n_nodes(); ++node)
      if (space.node_position(node).norm() < 1e-9)
        if (space.locally_owned().is_element(space.node_dof(node)))
          elsewhere(space.node_dof(node)) = 1;
    elsewhere.compress(VectorOperation::insert);
    EXPECT_NEAR(box.term->hold(context, "rim", elsewhere).value(), 1., 1e-12);
  }



  TEST(AbsorbingTerm, DashpotsTakeEnergyInEveryMotion)
  {
    AbsorbingLaw law;
    const auto   found = law.coefficients({M - 2 * G, G}, rho);
    for (unsigned int k = 0; k < 20; ++k)
      {
        const Tensor<1, 3> n =
          unit_or_any(Tensor<1, 3>({std::sin(k), std::cos(2. * k), 0.3}));
        const Tensor<1, 3> v({std::cos(3. * k), 0.5, std::sin(5. * k)});
        EXPECT_LE(std::sqrt(rho * G) * v.norm_square(),
                  v * (found.dashpots.matrix<3>(n) * v) + 1e-12);
      }
  }
} // namespace
