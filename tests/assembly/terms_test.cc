// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/assembly/fictitious_stiffness.h>
#include <moraine/assembly/internal_force.h>
#include <moraine/assembly/mechanics_system.h>
#include <moraine/assembly/conflict_term.h>
#include <moraine/geometry/shapes.h>
#include <moraine/material/linear_elastic.h>
#include <moraine/solver/linear_solver.h>
#include <moraine/solver/newton.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include "../small_scene.h"

namespace
{
  using namespace dealii;
  using namespace moraine;

  /** The node at a place, or an invalid number if this rank does not know it.
   */
  unsigned int
  node_at(const GridSpace<2> &space, const Point<2> &x)
  {
    for (unsigned int node = 0; node < space.n_nodes(); ++node)
      if (space.node_position(node).distance(x) < 1e-9)
        return node;
    return numbers::invalid_unsigned_int;
  }



  /** All entries of a vector on all ranks. */
  std::vector<double>
  gather(const LA::Vector &vector)
  {
    std::vector<double> all(vector.size(), 0.);
    for (const auto i : vector.locally_owned_elements())
      all[i] = vector(i);
    Utilities::MPI::sum(all, MPI_COMM_WORLD, all);
    return all;
  }



  /** A term of no effect but what a test adds. */
  class TestTerm : public Term<2>
  {
  public:
    std::vector<Effect>
    effects(const StepContext<2> &) const override
    {
      return {{"test", "", ""}};
    }
  };



  /** Components of the node at a are the means of those at b and c. */
  struct Tie : TestTerm
  {
    Tie(const Point<2>            &a,
        const Point<2>            &b,
        const Point<2>            &c,
        const std::array<bool, 2> &components)
      : a(a)
      , b(b)
      , c(c)
      , components(components)
    {}

    void
    constrain(const StepContext<2>      &context,
              AffineConstraints<double> &lines) const override
    {
      // A rank that has a in a cell of its own knows b and c.
      const GridSpace<2> &space = context.state.grid();
      for (const Point<2> &x : {a, b, c})
        if (node_at(space, x) == numbers::invalid_unsigned_int)
          return;
      for (unsigned int d = 0; d < 2; ++d)
        {
          if (!components[d])
            continue;
          const auto dof = space.node_dof(node_at(space, a)) + d;
          lines.add_line(dof);
          for (const Point<2> &x : {b, c})
            lines.add_entry(dof, space.node_dof(node_at(space, x)) + d, 0.5);
        }
    }

    const Point<2>            a, b, c;
    const std::array<bool, 2> components;
  };



  /** @f$f_a = c\,(\Delta u_b - \Delta u_a)/\Delta t = -f_b@f$ */
  struct Dashpot : TestTerm
  {
    Dashpot(const Point<2> &a, const Point<2> &b, const double c)
      : a(a)
      , b(b)
      , c(c)
    {}

    /** The two nodes, if this rank owns the first. */
    std::vector<unsigned int>
    nodes(const GridSpace<2> &space) const
    {
      const unsigned int first = node_at(space, a);
      if (first == numbers::invalid_unsigned_int ||
          !space.locally_owned().is_element(space.node_dof(first)))
        return {};
      return {first, node_at(space, b)};
    }

    void
    couple(const StepContext<2> &context,
           const Couple         &couple_nodes) const override
    {
      const auto pair = nodes(context.state.grid());
      if (!pair.empty())
        couple_nodes(pair.data(), 2);
    }

    void
    add(const StepContext<2> &context,
        const bool            tangent,
        GlobalSystem<2>      &system) const override
    {
      const auto pair = nodes(context.state.grid());
      if (pair.empty())
        return;
      LocalSystem<2> local;
      local.reinit(context.state, pair.data(), 2, tangent);
      const double k = c / context.step_size();
      for (unsigned int d = 0; d < 2; ++d)
        for (unsigned int i = 0; i < 2; ++i)
          {
            local.force[2 * i + d] = k * (context.increments()[pair[1 - i]] -
                                          context.increments()[pair[i]])[d];
            local.matrix(2 * i + d, 2 * i + d) += k;
            local.matrix(2 * i + d, 2 * (1 - i) + d) -= k;
          }
      system.add(local, tangent);
    }

    const Point<2> a, b;
    const double   c;
  };



  /** A body whose nodes at x = 0 are moved, with terms that a test adds. */
  struct HeldBody
  {
    explicit HeldBody(const StrainMeasure measure = StrainMeasure::small)
      : scene(false, 2, measure)
      , state(scene.space,
              scene.points,
              *scene.basis,
              {std::make_shared<LinearElastic>(1000., 0.3, 1.)},
              MeshAfterStep::reset,
              measure)
      , conditions(1)
    {
      conditions[0].name         = "wall";
      conditions[0].region       = BoundingBox<2>({{0., 0.}, {0., 4.}});
      conditions[0].component    = {{true, true}};
      conditions[0].displacement = [](const Point<2> &x, const double t) {
        return t * Tensor<1, 2>({0.05 * x[1], 0.02});
      };
      loads.body_forces.push_back({"weight",
                                   [](const Point<2> &, const double t) {
                                     return Tensor<1, 2>({0., -2 * t});
                                   },
                                   false,
                                   {true}});
    }

    MechanicsSystem<2>
    system()
    {
      return {state,
              make_terms(boundaries, conditions, loads),
              std::vector<std::string>{"block"}};
    }

    SmallScene<2>                    scene;
    State<2>                         state;
    std::vector<ImplicitBoundary<2>> boundaries;
    std::vector<GridCondition<2>>    conditions;
    Loads<2>                         loads;
  };



  class Measures : public testing::TestWithParam<StrainMeasure>
  {};

  INSTANTIATE_TEST_SUITE_P(SmallAndFinite,
                           Measures,
                           testing::Values(StrainMeasure::small,
                                           StrainMeasure::finite));



  TEST_P(Measures, ATiedNodeHandsItsForceToThoseItIsTiedTo)
  {
    // The second tie has a prescribed node in it; by the third, rows of the
    // components of a node differ in the matrix.
    const std::vector<Tie> ties{
      {Point<2>(2, 2), Point<2>(1, 1), Point<2>(3, 2), {{true, true}}},
      {Point<2>(1, 3), Point<2>(0, 3), Point<2>(2, 3), {{true, true}}},
      {Point<2>(3, 1), Point<2>(2, 1), Point<2>(3, 2), {{false, true}}}};

    HeldBody           body(GetParam());
    MechanicsSystem<2> tied = body.system();
    for (const Tie &tie : ties)
      tied.add(std::make_unique<Tie>(tie));
    tied.begin_step(0);
    tied.set_target(1);
    LinearSolver linear_solver(LinearSolverParameters(), 2);
    LA::Vector   x;
    const auto   report =
      Newton(NewtonParameters()).solve(tied, linear_solver, x);
    ASSERT_TRUE(report.converged()) << report.message;
    EXPECT_LE(report.iterations, GetParam() == StrainMeasure::small ? 1u : 6u);
    EXPECT_NO_THROW(tied.check_that_it_is_held(true));

    // The same body without ties needs forces at the tied nodes; condensed by
    // hand, they are in equilibrium.
    MechanicsSystem<2> untied = body.system();
    untied.begin_step(0);
    untied.set_target(1);
    untied.assemble(x, false);
    const auto          u     = gather(x);
    std::vector<double> r     = gather(untied.residual());
    const double        scale = untied.force_scales()[0];
    const auto          dof   = [&](const Point<2> &place) {
      const auto  &space = body.scene.space;
      unsigned int node  = node_at(space, place);
      const double mine  = node == numbers::invalid_unsigned_int ?
                                        -1. :
                                        double(space.node_dof(node));
      return static_cast<unsigned int>(
        Utilities::MPI::max(mine, MPI_COMM_WORLD));
    };
    for (const Tie &tie : ties)
      {
        const auto a = dof(tie.a), b = dof(tie.b), c = dof(tie.c);
        EXPECT_GT(std::abs(r[a + 1]), 1e-3 * scale);
        for (unsigned int d = 0; d < 2; ++d)
          {
            if (!tie.components[d])
              continue;
            EXPECT_NEAR(u[a + d], 0.5 * (u[b + d] + u[c + d]), 1e-14);
            if (tie.b[0] > 0)
              r[b + d] += 0.5 * r[a + d];
            r[c + d] += 0.5 * r[a + d];
            r[a + d] = 0;
          }
      }
    for (const double f : r)
      EXPECT_NEAR(f, 0., 1e-8 * scale);
  }



  TEST(MechanicsSystem, ATermCouplesNodesThatShareNoCellAndKnowsTheTimeStep)
  {
    const Point<2>     a(1, 2), b(3, 2);
    HeldBody           body;
    MechanicsSystem<2> with = body.system(), without = body.system();
    with.add(std::make_unique<Dashpot>(a, b, 70.));
    double stiffness[2];
    for (const double t_end : {1., 0.5})
      {
        with.begin_step(0);
        without.begin_step(0);
        with.set_target(t_end);
        without.set_target(t_end);
        LA::Vector x = body.scene.space.vector(), f = x, g = x;
        for (unsigned int node = 0; node < body.scene.space.n_nodes(); ++node)
          {
            const auto dof = body.scene.space.node_dof(node);
            if (body.scene.space.locally_owned().is_element(dof))
              x(dof) = body.scene.space.node_position(node).distance(a) < 0.5;
          }
        x.compress(VectorOperation::insert);
        with.assemble(x, false); // not linearised
        with.assemble(x, true);
        without.assemble(x, false);
        without.assemble(x, true);
        with.tangent()->vmult(f, x);
        without.tangent()->vmult(g, x);
        f -= g;
        const auto   difference = gather(f);
        const double largest =
          *std::max_element(difference.begin(), difference.end());
        const double smallest =
          *std::min_element(difference.begin(), difference.end());
        EXPECT_NEAR(largest, -smallest, 1e-9);
        stiffness[t_end == 1.] = largest;
        LA::Vector forces      = with.residual();
        forces -= without.residual();
        const auto of_residual = gather(forces);
        for (unsigned int i = 0; i < of_residual.size(); ++i)
          EXPECT_NEAR(of_residual[i], -difference[i], 1e-9);
      }
    EXPECT_NEAR(stiffness[1], 70., 1e-9);
    EXPECT_NEAR(stiffness[0], 140., 1e-9);
  }



  /** Bodies in the middle of a mesh of 4 x 4 unit cells. */
  struct Bodies
  {
    Bodies(const std::vector<std::pair<Point<2>, Point<2>>> &boxes,
           const MeshAfterStep                               after_step,
           const bool                                        gimp = false)
      : mesh(unit_cells<2>(4), MPI_COMM_WORLD)
      , space(mesh, 1)
      , points(mesh,
               SmallScene<2>::fields(
                 gimp,
                 StrainMeasure::finite,
                 {std::make_shared<LinearElastic>(1000., 0.3, 1.)}))
    {
      std::vector<Body<2>>                         bodies;
      std::vector<std::shared_ptr<const Material>> materials;
      for (const auto &[lower, upper] : boxes)
        {
          bodies.push_back({"box", make_box<2>(lower, upper)});
          materials.push_back(
            std::make_shared<LinearElastic>(10 * bodies.size(), 0., 1.));
        }
      const CellSeeder<2> seeder(4, PointLayout::equal);
      seed_bodies(bodies, seeder, points);
      if (gimp)
        basis = std::make_unique<GimpBasis<2>>(space, points, seeder);
      else
        basis = std::make_unique<CellBasis<2, 1>>(space, points);
      basis->initialise_points(points);
      state = std::make_unique<State<2>>(
        space, points, *basis, materials, after_step, StrainMeasure::finite);
    }

    /** A step in which every node x moves to x + @p move(x). */
    void
    step(const std::function<Tensor<1, 2>(const Point<2> &)> &move)
    {
      state->begin_step();
      LA::Vector x = space.vector();
      for (unsigned int node = 0; node < space.n_nodes(); ++node)
        for (unsigned int d = 0; d < 2; ++d)
          if (space.locally_owned().is_element(space.node_dof(node) + d))
            x(space.node_dof(node) + d) = move(space.node_position(node))[d];
      x.compress(VectorOperation::insert);
      state->set_trial(x);
      state->accept();
      state->begin_step();
    }

    /** The stiffness of the cell around a place, if this rank owns it. */
    double
    shear_modulus_at(const Point<2> &x) const
    {
      CellMaterials<2> materials;
      materials.update(*state);
      for (const auto &cell : mesh.triangulation().active_cell_iterators())
        if (cell->point_inside(x) && cell->is_locally_owned())
          return Utilities::MPI::max(
            materials.elastic_stiffness(cell->active_cell_index()).mu,
            MPI_COMM_WORLD);
      return Utilities::MPI::max(0., MPI_COMM_WORLD);
    }

    BackgroundMesh<2>         mesh;
    GridSpace<2>              space;
    PointSet<2>               points;
    std::unique_ptr<Basis<2>> basis;
    std::unique_ptr<State<2>> state;
  };



  TEST(FictitiousStiffness, KnowsEmptyPartsOnAMeshThatFollowsTheMaterial)
  {
    for (const bool full : {true, false})
      {
        Bodies bodies({{Point<2>(1, 1), Point<2>(full ? 3. : 2.5, 3)}},
                      MeshAfterStep::follow_material);
        bodies.step([](const Point<2> &x) {
          return Tensor<1, 2>({-0.5 * x[0], 0.});
        });
        StepContext<2> context(*bodies.state);
        context.cell_materials.update(*bodies.state);
        FictitiousStiffness<2> term(0.1);
        term.begin_step(context);
        EXPECT_EQ(term.any_empty_part(context), !full);
      }
  }



  TEST(CellMaterials, WeighsBodiesWithTheirVolumesWhereTheyAre)
  {
    Bodies bodies({{Point<2>(1, 1), Point<2>(2.25, 2)},
                   {Point<2>(2.25, 1), Point<2>(3, 2)}},
                  MeshAfterStep::reset);
    bodies.state->begin_step();
    EXPECT_NEAR(bodies.shear_modulus_at({1.5, 1.5}), 5., 1e-12);
    EXPECT_NEAR(bodies.shear_modulus_at({2.5, 1.5}),
                0.25 * 5. + 0.75 * 10.,
                1e-12);
    bodies.step([](const Point<2> &) { return Tensor<1, 2>({-0.25, 0.}); });
    EXPECT_NEAR(bodies.shear_modulus_at({2.5, 1.5}), 10., 1e-12);
  }



  TEST(CellMaterials, KnowsTheBodyThatReachesIntoACellWithoutPoints)
  {
    Bodies bodies({{Point<2>(1, 3), Point<2>(3, 4)},
                   {Point<2>(1, 2), Point<2>(3, 3)}},
                  MeshAfterStep::reset,
                  /* gimp = */ true);
    bodies.state->begin_step();
    bodies.step([](const Point<2> &) { return Tensor<1, 2>({0., -1e-6}); });
    for (const double x : {1.5, 2.5})
      {
        EXPECT_NEAR(bodies.shear_modulus_at({x, 2.5}), 10., 1e-12);
        EXPECT_NEAR(bodies.shear_modulus_at({x, 1.5}), 10., 1e-9);
      }
  }



  /** A fixed line that moves up by @p rate. */
  ImplicitBoundary<2>
  rising_line(const std::string           &name,
              const std::vector<Point<2>> &line,
              const double                 rate)
  {
    RigidMotion<2> motion;
    if (rate != 0)
      motion =
        RigidMotion<2>({{{}, [rate](const double t) { return rate * t; }}},
                       {},
                       Point<2>());
    EnforcementParameters parameters;
    parameters.enforcement = "augmented Lagrangian";
    return ImplicitBoundary<2>(
      name,
      make_flat_face<2>(line),
      motion,
      [](const Point<2> &, const double) { return Tensor<1, 2>(); },
      {Constraint<2>::fixed, {}},
      parameters.enforcement_of(),
      0.);
  }

  TEST(ConflictTerm, SlopesHoldAgainWhereTheOtherHasGone)
  {
    SmallScene<2> scene;
    State<2>      state(scene.space,
                   scene.points,
                   *scene.basis,
                   {std::make_shared<LinearElastic>(1000., 0.3, 1.)},
                   MeshAfterStep::reset);
    state.begin_step();
    ImplicitBoundary<2> door =
      rising_line("door", {{0.3, 0.9}, {2.3, 1.4}}, 1.);
    ImplicitBoundary<2> base =
      rising_line("base", {{2.3, 1.4}, {3.4, 1.7}}, 0.);
    ConflictTerm<2> term({&door, &base}, {}, {0., 1.});
    StepContext<2>  context(state);
    const auto      n_slopes_of_base = [&](const double t, const bool all) {
      for (auto *boundary : {&door, &base})
        boundary->begin_step(scene.space,
                             t,
                             0.5,
                             true,
                             StrainMeasure::finite,
                             false,
                             false,
                             {},
                             true);
      term.begin_step(context);
      unsigned int n = 0;
      for (const auto &slope : base.slopes())
        n += all || slope.holds ? 1 : 0;
      return Utilities::MPI::sum(n, MPI_COMM_WORLD);
    };
    const unsigned int n_held = n_slopes_of_base(0., false);
    const unsigned int n      = n_slopes_of_base(0., true);
    EXPECT_LT(n_held, n);
    // The base stands still, and is not found anew.
    EXPECT_EQ(n_slopes_of_base(2., false), n);
    EXPECT_EQ(base.n_searches(), 1u);
  }

  TEST(ConflictTerm, PiecesThatAreFoundAnewLetGoAgain)
  {
    SmallScene<2> scene;
    State<2>      state(scene.space,
                   scene.points,
                   *scene.basis,
                   {std::make_shared<LinearElastic>(1000., 0.3, 1.)},
                   MeshAfterStep::reset);
    state.begin_step();
    const auto make = [](const std::string           &name,
                         const std::vector<Point<2>> &line,
                         const double                 rate) {
      return ImplicitBoundary<2>(
        name,
        make_flat_face<2>(line),
        RigidMotion<2>(),
        [rate](const Point<2> &, const double t) {
          return Tensor<1, 2>({0., rate * t});
        },
        {Constraint<2>::fixed, {}},
        EnforcementParameters().enforcement_of(),
        0.);
    };
    ImplicitBoundary<2> door = make("door", {{0.3, 0.6}, {2.3, 0.6}}, -0.1),
                        base = make("base", {{2.3, 0.6}, {3.4, 0.6}}, 0.);
    ConflictTerm<2> term({&door, &base}, {}, {0., 1.});
    StepContext<2>  context(state);
    const auto      n_let_go = [&](const bool door_is_found_anew) {
      context.cells_moved = false;
      door.begin_step(
        scene.space, 0, 0.5, true, StrainMeasure::small, door_is_found_anew);
      base.begin_step(scene.space, 0, 0.5, true, StrainMeasure::small, false);
      term.begin_step(context);
      unsigned int n = 0;
      for (const auto *boundary : {&door, &base})
        for (const auto &point : boundary->points())
          n += point.holds ? 0 : 1;
      return Utilities::MPI::sum(n, MPI_COMM_WORLD);
    };
    const unsigned int at_first = n_let_go(true);
    EXPECT_GT(at_first, 0u);
    EXPECT_EQ(n_let_go(false), at_first);
    EXPECT_EQ(n_let_go(true), at_first);
  }
} // namespace
