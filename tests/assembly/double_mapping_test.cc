// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/assembly/double_mapping.h>
#include <moraine/assembly/mechanics_system.h>
#include <moraine/basis/composite_functions.h>
#include <moraine/core/exceptions.h>
#include <moraine/material/linear_elastic.h>
#include <moraine/material/mohr_coulomb.h>
#include <moraine/material/von_mises.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include "../small_scene.h"

namespace double_mapping_test
{
  using namespace dealii;
  using namespace moraine;

  enum class Kind
  {
    finite_element,
    material_point,
    gimp,
    dm,
    dm_g,
    dm_c,
    dm_gc
  };

  enum class Law
  {
    elastic,
    plastic,
    frictional
  };

  constexpr double young = 1000, poisson = 0.33;

  std::shared_ptr<const Material>
  material(const Law law)
  {
    if (law == Law::plastic)
      return std::make_shared<VonMises>(
        young,
        poisson,
        1.,
        std::vector<std::pair<double, double>>{{0., 5.}, {1., 20.}});
    if (law == Law::frictional)
      {
        SoilParameters soil;
        soil.elasticity     = {young, poisson, 1.};
        soil.cohesion       = {{0., 5.}};
        soil.friction_angle = {{0., 30.}};
        soil.dilation_angle = {{0., 10.}};
        return std::make_shared<MohrCoulomb>(soil);
      }
    return std::make_shared<LinearElastic>(young, poisson, 1.);
  }



  /** A box of points, from @p lower to @p upper in every direction, in a mesh
   * of 4^dim unit cells, with nothing but its internal force. */
  template <int dim>
  struct Block
  {
    static bool
    has_boxes(const Kind kind)
    {
      return kind == Kind::gimp || kind == Kind::dm_g || kind == Kind::dm_gc;
    }

    static PointFields
    fields(const Kind                             kind,
           const StrainMeasure                    measure,
           const std::shared_ptr<const Material> &material)
    {
      PointFields layout;
      if (has_boxes(kind))
        GimpBasis<dim>::request_fields(layout);
      StateFields<dim>(layout, measure, {material});
      return layout;
    }

    static Point<dim>
    diagonal(const double x)
    {
      Point<dim> result;
      for (unsigned int d = 0; d < dim; ++d)
        result[d] = x;
      return result;
    }

    Block(const Kind          kind,
          const StrainMeasure measure = StrainMeasure::small,
          const Law           law     = Law::elastic,
          const double        lower   = 0.3,
          const double        upper   = 3.4,
          const MeshAfterStep after   = MeshAfterStep::reset)
      : kind(kind)
      , law(material(law))
      , mesh(unit_cells<dim>(4), MPI_COMM_WORLD)
      , space(mesh, 1)
      , points(mesh, fields(kind, measure, this->law))
    {
      const CellSeeder<dim> seeder(2,
                                   kind == Kind::finite_element ?
                                     PointLayout::gauss :
                                     PointLayout::equal);
      seed_bodies({{"box", make_box<dim>(diagonal(lower), diagonal(upper))}},
                  seeder,
                  points);
      if (kind == Kind::gimp || kind == Kind::dm_g)
        basis = std::make_unique<GimpBasis<dim>>(space, points, seeder);
      else if (kind == Kind::dm_c)
        basis =
          std::make_unique<WithCompositeStrain<dim, CellBasis<dim, 1>>>(space,
                                                                        points);
      else if (kind == Kind::dm_gc)
        basis =
          std::make_unique<WithCompositeStrain<dim, GimpBasis<dim>>>(space,
                                                                     points,
                                                                     seeder);
      else
        basis = std::make_unique<CellBasis<dim, 1>>(space, points);
      basis->initialise_points(points);
      state = std::make_unique<State<dim>>(
        space, points, *basis, std::vector{this->law}, after, measure);
    }

    /** Move all points by @p distance along x. */
    void
    shift(const double distance)
    {
      for (unsigned int p = 0; p < points.n_local(); ++p)
        {
          Point<dim> x = points.position(p);
          x[0] += distance;
          points.set_position(p, x);
        }
      points.find_cells();
    }

    /** A system with the internal force of the kind, or that of points. */
    MechanicsSystem<dim>
    system(const bool of_points = false)
    {
      std::unique_ptr<Term<dim>> force;
      if (kind > Kind::gimp && !of_points)
        force = std::make_unique<DoubleMapping<dim>>(space, points, "DM");
      return {
        *state,
        make_terms(
          boundaries, conditions, loads, 0., false, false, std::move(force)),
        std::vector<std::string>{"box"}};
    }

    /** Displacements of all nodes, by place, that @p seed varies. */
    LA::Vector
    displacements(const double scale, const double seed) const
    {
      LA::Vector x = space.vector();
      for (unsigned int node = 0; node < space.n_nodes(); ++node)
        for (unsigned int c = 0; c < dim; ++c)
          {
            const auto dof = space.node_dof(node) + c;
            if (!space.locally_owned().is_element(dof))
              continue;
            const Point<dim> X     = space.node_position(node);
            double           phase = seed + 0.7 * c;
            for (unsigned int d = 0; d < dim; ++d)
              phase += (1.3 + 0.9 * d * seed) * X[d];
            x(dof) = scale * std::sin(phase);
          }
      x.compress(VectorOperation::insert);
      return x;
    }

    const Kind                            kind;
    const std::shared_ptr<const Material> law;
    BackgroundMesh<dim>                   mesh;
    GridSpace<dim>                        space;
    PointSet<dim>                         points;
    std::unique_ptr<Basis<dim>>           basis;
    std::unique_ptr<State<dim>>           state;
    std::vector<ImplicitBoundary<dim>>    boundaries;
    std::vector<GridCondition<dim>>       conditions;
    Loads<dim>                            loads;
  };



  template <int dim>
  void
  start(MechanicsSystem<dim> &system)
  {
    system.begin_step(0);
    system.set_target(1);
  }



  template <int dim>
  LA::Vector
  residual(MechanicsSystem<dim> &system, const LA::Vector &x)
  {
    system.assemble(x, false); // the next one is not linearised
    system.assemble(x, false);
    return system.residual();
  }



  using Case = std::tuple<unsigned int, Kind, StrainMeasure, Law>;
  class EveryKind : public testing::TestWithParam<Case>
  {};

  std::string
  name_of(const testing::TestParamInfo<Case> &info)
  {
    const auto &[dim, kind, measure, law] = info.param;
    const std::vector<std::string> names{
      "FE", "MPM", "GIMP", "DM", "DMG", "DMC", "DMGC"};
    return names[static_cast<int>(kind)] + std::to_string(dim) + "D" +
           (measure == StrainMeasure::small ? "Small" : "Finite") +
           (law == Law::elastic ? "Elastic" :
            law == Law::plastic ? "Plastic" :
                                  "Frictional");
  }

  INSTANTIATE_TEST_SUITE_P(
    All,
    EveryKind,
    testing::Combine(
      testing::Values(2u, 3u),
      testing::Values(Kind::dm, Kind::dm_g, Kind::dm_c, Kind::dm_gc),
      testing::Values(StrainMeasure::small, StrainMeasure::finite),
      testing::Values(Law::elastic, Law::plastic, Law::frictional)),
    name_of);



  /** In the second step, when points carry stresses, against central
   * differences; the sum of the forces of nodes is zero. */
  template <int dim>
  void
  check_second_step(const Kind kind, const StrainMeasure measure, const Law law)
  {
    Block<dim>           block(kind, measure, law);
    MechanicsSystem<dim> system = block.system();
    start(system);
    system.accept(block.displacements(0.02, 0.4));
    start(system);
    const LA::Vector x = block.displacements(0.02, 1.9);
    const LA::Vector f = residual(system, x);
    EXPECT_EQ(system.symmetric(), law != Law::frictional);

    Tensor<1, dim> sum;
    for (unsigned int node = 0; node < block.space.n_nodes(); ++node)
      for (unsigned int c = 0; c < dim; ++c)
        if (block.space.locally_owned().is_element(block.space.node_dof(node)))
          sum[c] += f(block.space.node_dof(node) + c);
    EXPECT_LT(Utilities::MPI::sum(sum, MPI_COMM_WORLD).norm(),
              1e-13 * f.l1_norm());

    for (const double seed : {1.1, 2.3})
      {
        const LA::Vector v = block.displacements(1e-6, seed);
        system.assemble(x, true);
        LA::Vector Kv = block.space.vector();
        system.tangent()->vmult(Kv, v);
        const double size = Kv.l2_norm();
        ASSERT_GT(size, 1e-5);
        // A point may begin to flow between the ends of a difference, but not
        // of one a hundredth as long too.
        double error = std::numeric_limits<double>::max();
        for (const double length : {1., 0.01})
          {
            LA::Vector there = x;
            there.add(length, v);
            LA::Vector difference = residual(system, there);
            there.add(-2. * length, v);
            difference -= residual(system, there);
            difference *= 0.5 / length;
            difference += Kv;
            error = std::min(error, difference.l2_norm());
          }
        EXPECT_LT(error, 1e-7 * size) << "direction " << seed;
      }
  }



  TEST_P(EveryKind, TangentIsTheDerivativeOfForcesInBalance)
  {
    const auto [dim, kind, measure, law] = GetParam();
    if (dim == 2)
      check_second_step<2>(kind, measure, law);
    else
      check_second_step<3>(kind, measure, law);
  }



  /** The stiffness of full cells times a vector. */
  template <int dim>
  LA::Vector
  stiffness_of_full_cells(const Kind kind, const double distance)
  {
    Block<dim> block(kind, StrainMeasure::small, Law::elastic, 0., 4.);
    if (distance != 0)
      block.shift(distance);
    MechanicsSystem<dim> system = block.system();
    start(system);
    system.assemble(block.displacements(0.1, 0.4), true);
    const LA::Vector v  = block.displacements(1., 1.1);
    LA::Vector       Kv = block.space.vector();
    system.tangent()->vmult(Kv, v);
    return Kv;
  }



  TEST(DoubleMapping, FullCellsHaveTheStiffnessOfFiniteElements)
  {
    for (const Kind kind : {Kind::dm, Kind::dm_g})
      {
        LA::Vector   in_plane = stiffness_of_full_cells<2>(kind, 0.);
        const double size     = in_plane.l2_norm();
        in_plane -= stiffness_of_full_cells<2>(Kind::finite_element, 0.);
        EXPECT_LT(in_plane.l2_norm(), 1e-13 * size);
        LA::Vector   in_space = stiffness_of_full_cells<3>(kind, 0.);
        const double of_space = in_space.l2_norm();
        in_space -= stiffness_of_full_cells<3>(Kind::finite_element, 0.);
        EXPECT_LT(in_space.l2_norm(), 1e-13 * of_space);
      }
  }



  /** What an accepted step leaves at points acts where they are: no trial
   * displacement, the same force as that of points. */
  template <int dim>
  void
  check_carried_force(const Kind kind, const StrainMeasure measure)
  {
    Block<dim>           block(kind, measure);
    MechanicsSystem<dim> system = block.system();
    start(system);
    system.accept(block.displacements(0.02, 0.4));
    start(system);
    LA::Vector   x    = block.space.vector();
    LA::Vector   f    = residual(system, x);
    const double size = f.l2_norm();
    ASSERT_GT(size, 1.);
    MechanicsSystem<dim> of_points = block.system(true);
    start(of_points);
    f -= residual(of_points, x);
    EXPECT_LT(f.l2_norm(), 1e-13 * size);
  }



  TEST(DoubleMapping, CarriedStressActsAtPoints)
  {
    for (const Kind kind : {Kind::dm, Kind::dm_g, Kind::dm_c, Kind::dm_gc})
      for (const StrainMeasure measure :
           {StrainMeasure::small, StrainMeasure::finite})
        {
          check_carried_force<2>(kind, measure);
          check_carried_force<3>(kind, measure);
        }
  }



  /** Points get the stress of a displacement that is cubic in the interior and
   * quadratic at the edge, whatever the cell they are in. */
  TEST(DoubleMapping, PointsRecoverStressesOfQuadraticDisplacements)
  {
    for (const Kind kind : {Kind::dm_c, Kind::dm_gc})
      {
        Block<2>           block(kind,
                       StrainMeasure::small,
                       Law::elastic,
                       0.,
                       4.,
                       MeshAfterStep::keep);
        MechanicsSystem<2> system = block.system();
        start(system);
        LA::Vector x = block.space.vector();
        for (unsigned int node = 0; node < block.space.n_nodes(); ++node)
          {
            const auto     dof = block.space.node_dof(node);
            const Point<2> X   = block.space.node_position(node);
            if (!block.space.locally_owned().is_element(dof))
              continue;
            x(dof)     = 0.01 * X[0] * X[0] + 0.02 * X[0] * X[1];
            x(dof + 1) = 0.03 * X[1] * X[1] * X[0];
          }
        x.compress(VectorOperation::insert);
        system.accept(x);
        const LameConstants C = block.law->elastic_stiffness();
        for (unsigned int p = 0; p < block.points.n_local(); ++p)
          {
            const Point<2>        X = block.points.position(p);
            SymmetricTensor<2, 3> strain;
            strain[0][0] = 0.02 * X[0] + 0.02 * X[1];
            strain[1][1] = 0.06 * X[1] * X[0];
            strain[0][1] = 0.5 * (0.02 * X[0] + 0.03 * X[1] * X[1]);
            EXPECT_LT((block.points.stress_field()(block.points.values(p)) -
                       C * strain)
                        .norm(),
                      1e-10);
          }
      }
  }



  /** The least and the largest error of the diagonal entry of an inner node,
   * for the x direction, while points that fill cells with 2 x 2 each move
   * along x from their first places by a cell. */
  std::array<double, 2>
  errors_of_stiffness(const Kind kind)
  {
    // Of a bilinear function, the integrals of the squares of its derivatives
    // are 4/3.
    const LameConstants C     = material(Law::elastic)->elastic_stiffness();
    const double        exact = 4. / 3. * (C.lambda + 3 * C.mu);
    double              least = 1, largest = -1;
    for (unsigned int i = 0; i < 40; ++i)
      {
        Block<2> block(kind, StrainMeasure::small, Law::elastic, 0.5, 3.5);
        block.shift(i / 80. - 0.25);
        MechanicsSystem<2> system = block.system();
        start(system);
        system.assemble(block.space.vector(), true);
        double K = 0;
        for (unsigned int node = 0; node < block.space.n_nodes(); ++node)
          {
            const auto dof = block.space.node_dof(node);
            if (block.space.node_position(node).distance(Point<2>(2, 2)) <
                  1e-10 &&
                block.space.locally_owned().is_element(dof))
              K = system.tangent()->diag_element(dof);
          }
        K       = Utilities::MPI::sum(K, MPI_COMM_WORLD);
        least   = std::min(least, K / exact - 1);
        largest = std::max(largest, K / exact - 1);
      }
    return {{least, largest}};
  }



  TEST(DoubleMapping, LosesNoStiffnessWhilePointsWithBoxesCrossCells)
  {
    const auto expect =
      [](const Kind kind, const double least, const double largest) {
        const auto error = errors_of_stiffness(kind);
        EXPECT_NEAR(error[0], least, 5e-5);
        EXPECT_NEAR(error[1], largest, 5e-5);
      };
    expect(Kind::material_point, -0.0625, -0.0246);
    expect(Kind::gimp, -0.3394, -0.0625);
    expect(Kind::dm, 0., 0.);
    expect(Kind::dm_g, 0., 0.);
  }



  TEST(DoubleMapping, APointTurnedInsideOutIsNamed)
  {
    Block<2>           block(Kind::dm_gc, StrainMeasure::finite);
    MechanicsSystem<2> system = block.system();
    start(system);
    LA::Vector x = block.displacements(0.01, 0.4);
    residual(system, x);
    EXPECT_EQ(system.failure(), "");
    EXPECT_EQ(system.reason_to_reject(x), "");
    x = block.displacements(3., 0.4);
    residual(system, x);
    EXPECT_NE(system.failure().find("would be turned inside out"),
              std::string::npos);
    EXPECT_NE(system.reason_to_reject(x), "");
  }



  TEST(DoubleMapping, RefusesAMeshThatIsNoBox)
  {
    MeshParameters<2> parameters;
    parameters.type      = "generator";
    parameters.generator = "hyper_ball";
    parameters.arguments = "0, 0 : 1 : false";
    const BackgroundMesh<2> mesh(parameters, MPI_COMM_WORLD);
    const GridSpace<2>      space(mesh, 1);
    const PointSet<2>       points(mesh, PointFields());
    EXPECT_THROW(DoubleMapping<2>(space, points, "DM"), InputError);
  }
} // namespace double_mapping_test
