// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/assembly/aggregation.h>
#include <moraine/assembly/boundary_term.h>
#include <moraine/assembly/hourglass_stiffness.h>
#include <moraine/assembly/mechanics_system.h>
#include <moraine/assembly/pressure_term.h>
#include <moraine/assembly/rayleigh_damping.h>
#include <moraine/assembly/water_term.h>
#include <moraine/basis/cpdi1_basis.h>
#include <moraine/basis/cpdi2_basis.h>
#include <moraine/material/drucker_prager.h>
#include <moraine/material/linear_elastic.h>
#include <moraine/material/mohr_coulomb.h>
#include <moraine/material/von_mises.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/lapack_full_matrix.h>

#include <gtest/gtest.h>

#include "../small_scene.h"

namespace
{
  using namespace dealii;
  using namespace moraine;

  enum class Method
  {
    material_point,
    linear_elements,
    quadratic_elements,
    gimp,
    cpdi1,
    cpdi2,
    reduced_elements ///< quadratic ones with 2 Gauss points per direction
  };

  bool
  is_quadratic(const Method method)
  {
    return method == Method::quadratic_elements ||
           method == Method::reduced_elements;
  }

  constexpr double yield_radius = 5.;

  std::shared_ptr<const Material>
  material(const bool plastic)
  {
    if (plastic)
      return std::make_shared<VonMises>(
        1000.,
        0.3,
        1.,
        std::vector<std::pair<double, double>>{{0., yield_radius},
                                               {1., 4 * yield_radius}});
    return std::make_shared<LinearElastic>(1000., 0.3, 1.);
  }



  /** Where in the step internal forces are. */
  enum class Forces
  {
    at_the_end,
    conserving
  };

  /** A box at finite strain in a mesh of 3^dim unit cells, cut by its faces. */
  template <int dim>
  struct Box
  {
    static PointFields
    fields(const Method                           method,
           const std::shared_ptr<const Material> &material,
           const StrainMeasure                    measure)
    {
      PointFields layout;
      if (method == Method::gimp)
        GimpBasis<dim>::request_fields(layout);
      if (method == Method::cpdi1)
        Cpdi1Basis<dim>::request_fields(layout);
      if (method == Method::cpdi2)
        Cpdi2Basis<dim>::request_fields(layout);
      StateFields<dim>(layout, measure, {material});
      Motion<dim>::request_fields(VelocityTransfer(), layout);
      return layout;
    }

    Box(const Method           method,
        const bool             plastic,
        const Forces           forces     = Forces::at_the_end,
        const StrainMeasure    measure    = StrainMeasure::finite,
        const VolumetricStrain volumetric = VolumetricStrain::pointwise)
      : Box(method, material(plastic), forces, measure, volumetric)
    {}

    Box(const Method                          method,
        const std::shared_ptr<const Material> law,
        const Forces                          forces,
        const StrainMeasure                   measure,
        const VolumetricStrain                volumetric)
      : law(law)
      , mesh(unit_cells<dim>(3), MPI_COMM_WORLD)
      , space(mesh, is_quadratic(method) ? 2 : 1)
      , points(mesh, fields(method, law, measure))
    {
      const bool fe = method == Method::linear_elements || is_quadratic(method);
      const unsigned int    n = method == Method::quadratic_elements ? 3 : 2;
      const CellSeeder<dim> seeder(n,
                                   fe ? PointLayout::gauss :
                                        PointLayout::equal);
      Point<dim>            lower, upper;
      for (unsigned int d = 0; d < dim; ++d)
        {
          lower[d] = fe ? 0. : 0.1;
          upper[d] = fe ? 3. : 2.4;
        }
      const std::vector<Body<dim>> bodies{{"box", make_box<dim>(lower, upper)}};
      seed_bodies(bodies, seeder, points);
      switch (method)
        {
          case Method::material_point:
          case Method::linear_elements:
            basis = std::make_unique<CellBasis<dim, 1>>(space, points);
            break;
          case Method::quadratic_elements:
          case Method::reduced_elements:
            basis = std::make_unique<CellBasis<dim, 2>>(space, points);
            break;
          case Method::gimp:
            basis = std::make_unique<GimpBasis<dim>>(space, points, seeder);
            break;
          case Method::cpdi1:
            basis =
              std::make_unique<Cpdi1Basis<dim>>(space, points, seeder, bodies);
            break;
          case Method::cpdi2:
            basis =
              std::make_unique<Cpdi2Basis<dim>>(space, points, seeder, bodies);
            break;
        }
      basis->initialise_points(points);
      state = std::make_unique<State<dim>>(space,
                                           points,
                                           *basis,
                                           std::vector{law},
                                           fe ? MeshAfterStep::follow_material :
                                                MeshAfterStep::reset,
                                           measure,
                                           PointWeights::volumes,
                                           volumetric);
      system =
        std::make_unique<MechanicsSystem<dim>>(*state,
                                               make_terms(boundaries,
                                                          conditions,
                                                          loads,
                                                          0.,
                                                          false,
                                                          forces ==
                                                            Forces::conserving),
                                               std::vector<std::string>{"box"});
      if (method == Method::reduced_elements)
        system->add(std::make_unique<HourglassStiffness<dim>>());
      begin_step(0);
    }

    /** Tie the nodes of cells that points fill less than @p fill of. */
    void
    aggregate(const double fill)
    {
      state->aggregate_below({fill});
      state->points_changed();
      begin_step(0);
    }

    /** Hold them by a ghost term. */
    void
    hold(const double fill, const double factor)
    {
      state->aggregate_below({fill}, /* give_way = */ true);
      system->add(std::make_unique<GhostStiffness<dim>>(factor));
      state->points_changed();
      begin_step(0);
    }

    void
    begin_step(const double t)
    {
      system->begin_step(t);
      system->set_target(t + 1);
    }

    /** Take a step, so that the next one starts with stress. */
    void
    deform()
    {
      system->accept(displacements(0.03, 0.4));
      begin_step(1);
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

    LA::Vector
    residual(const LA::Vector &x)
    {
      system->assemble(x, false);
      return system->residual();
    }

    const std::shared_ptr<const Material> law;
    BackgroundMesh<dim>                   mesh;
    GridSpace<dim>                        space;
    PointSet<dim>                         points;
    std::unique_ptr<Basis<dim>>           basis;
    std::unique_ptr<State<dim>>           state;
    std::vector<ImplicitBoundary<dim>>    boundaries;
    std::vector<GridCondition<dim>>       conditions;
    Loads<dim>                            loads;
    std::unique_ptr<MechanicsSystem<dim>> system;
  };



  /** Against central differences, along two directions, at @p scale. */
  template <int dim>
  void
  check_tangent(Box<dim> &box, const double scale = 0.03)
  {
    const LA::Vector x = box.displacements(scale, 0.4);
    box.system->assemble(x, false); // the next one is not linearised
    for (const double seed : {1.1, 2.3})
      {
        const LA::Vector v = box.displacements(1e-6, seed);
        box.system->assemble(x, true);
        LA::Vector Kv = box.space.vector();
        box.system->tangent()->vmult(Kv, v);
        const double size = Kv.l2_norm();
        ASSERT_GT(size, 1e-5);

        LA::Vector there = x;
        there += v;
        LA::Vector difference = box.residual(there);
        there.add(-2., v);
        difference -= box.residual(there);
        Kv.add(0.5, difference);
        EXPECT_LT(Kv.l2_norm(), 1e-7 * size) << "direction " << seed;
      }
  }



  using TangentCase = std::tuple<unsigned int, Method, bool>;
  class EveryMethod : public testing::TestWithParam<TangentCase>
  {};

  std::string
  name_of(const testing::TestParamInfo<TangentCase> &info)
  {
    const auto &[dim, method, plastic] = info.param;
    const std::vector<std::string> names{"MaterialPoint",
                                         "LinearElements",
                                         "QuadraticElements",
                                         "Gimp",
                                         "Cpdi1",
                                         "Cpdi2"};
    return names[static_cast<int>(method)] + std::to_string(dim) + "D" +
           (plastic ? "Plastic" : "Elastic");
  }

  TEST_P(EveryMethod, TangentIsTheDerivativeOfTheForces)
  {
    const auto [dim, method, plastic] = GetParam();
    if (dim == 2)
      {
        Box<2> box(method, plastic);
        check_tangent(box);
      }
    else
      {
        Box<3> box(method, plastic);
        check_tangent(box);
      }
  }



  /** @f$|v \cdot K w - w \cdot K v|@f$ over their size. */
  template <int dim>
  double
  asymmetry(Box<dim> &box)
  {
    const LA::Vector x = box.displacements(0.03, 0.4);
    box.system->assemble(x, false);
    const LA::Vector v = box.displacements(1., 1.1),
                     w = box.displacements(1., 2.3);
    box.system->assemble(x, true);
    LA::Vector Kv = box.space.vector(), Kw = box.space.vector();
    box.system->tangent()->vmult(Kv, v);
    box.system->tangent()->vmult(Kw, w);
    return std::abs(v * Kw - w * Kv) / (v.l2_norm() * Kw.l2_norm());
  }



  /** Sum of forces, and of moments about the origin, over their size. */
  template <int dim>
  double
  imbalance(const Box<dim> &box, const LA::Vector &f, const LA::Vector &x)
  {
    std::vector<Tensor<1, dim>> du, force;
    box.space.node_values(x, du);
    box.space.node_values(f, force);
    Tensor<1, dim>              sum;
    Tensor<1, dim == 2 ? 1 : 3> moment;
    double                      size = 0;
    for (unsigned int node = 0; node < box.space.n_nodes(); ++node)
      if (box.space.locally_owned().is_element(box.space.node_dof(node)))
        {
          Tensor<1, dim> r(box.space.node_position(node));
          if (box.state->strain_measure() == StrainMeasure::finite)
            r += du[node];
          sum += force[node];
          if constexpr (dim == 2)
            moment[0] += r[0] * force[node][1] - r[1] * force[node][0];
          else
            moment += cross_product_3d(r, force[node]);
          size += force[node].norm();
        }
    return (Utilities::MPI::sum(sum, MPI_COMM_WORLD).norm() +
            Utilities::MPI::sum(moment, MPI_COMM_WORLD).norm()) /
           Utilities::MPI::sum(size, MPI_COMM_WORLD);
  }



  template <int dim>
  void
  check_cell_means(const Method        method,
                   const bool          plastic,
                   const StrainMeasure measure,
                   const bool          grouped)
  {
    Box<dim> box(method,
                 plastic,
                 Forces::at_the_end,
                 measure,
                 VolumetricStrain::cell_mean);
    if (grouped)
      box.aggregate(0.6);
    check_tangent(box);
    box.deform();
    check_tangent(box);
    EXPECT_LT(asymmetry(box), 1e-14);
    const LA::Vector x = box.displacements(0.05, 1.7);
    EXPECT_LT(imbalance(box, box.residual(x), x), 1e-13);
  }



  TEST(CellMeans, TangentIsTheSymmetricDerivativeOfForcesInBalance)
  {
    for (const auto method : {Method::material_point,
                              Method::linear_elements,
                              Method::gimp,
                              Method::cpdi1,
                              Method::cpdi2})
      for (const bool plastic : {false, true})
        for (const auto measure : {StrainMeasure::small, StrainMeasure::finite})
          {
            SCOPED_TRACE(std::to_string(static_cast<int>(method)) +
                         (plastic ? " plastic" : " elastic") +
                         (measure == StrainMeasure::finite ? " finite" : ""));
            for (const bool grouped : {false, true})
              {
                check_cell_means<2>(method, plastic, measure, grouped);
                check_cell_means<3>(method, plastic, measure, grouped);
              }
          }
  }



  /** Water whose level cuts the box at a slope, and weighs in its pores. */
  template <int dim>
  struct WaterAround
  {
    WaterAround(Box<dim> &box, const WaterTexts &texts)
    {
      water.water.emplace(texts);
      water.extra_density = {0.4};
      gravity             = {"weight",
                             [](const Point<dim> &, const double) {
                   Tensor<1, dim> g;
                   g[0]       = 0.7;
                   g[dim - 1] = -10;
                   return g;
                 },
                             true,
                             {true},
                             false};
      box.system->add(std::make_unique<WaterTerm<dim>>(
        water,
        box.points,
        std::vector<const BodyForce<dim> *>{&gravity},
        box.state->strain_measure()));
      box.begin_step(0);
    }

    WaterInBodies<dim> water;
    BodyForce<dim>     gravity;
  };

  WaterTexts
  texts_of_water(const std::string &level, const std::string &free_level)
  {
    WaterTexts texts;
    texts.level       = level;
    texts.free_level  = free_level;
    texts.section     = "Water";
    texts.unit_weight = 90;
    return texts;
  }



  template <int dim>
  void
  check_water(const Method method, const VolumetricStrain volumetric)
  {
    Box<dim> box(
      method, false, Forces::at_the_end, StrainMeasure::finite, volumetric);
    WaterAround<dim> around(box, texts_of_water("1.3 + 0.2*x", "0.9 - 0.1*x"));
    EXPECT_FALSE(box.system->symmetric());
    check_tangent(box);
    box.deform();
    check_tangent(box);
  }

  TEST(Water, TangentIsTheDerivativeOfTheForces)
  {
    for (const auto method : {Method::material_point,
                              Method::linear_elements,
                              Method::quadratic_elements,
                              Method::gimp,
                              Method::cpdi1,
                              Method::cpdi2})
      {
        SCOPED_TRACE(static_cast<int>(method));
        check_water<2>(method, VolumetricStrain::pointwise);
        check_water<3>(method, VolumetricStrain::pointwise);
        if (method != Method::quadratic_elements)
          check_water<2>(method, VolumetricStrain::cell_mean);
      }
  }

  TEST(Water, UniformPressureHasNoForceInElementsThatDeform)
  {
    for (const auto volumetric :
         {VolumetricStrain::pointwise, VolumetricStrain::cell_mean})
      {
        Box<2>     box(Method::linear_elements,
                   false,
                   Forces::at_the_end,
                   StrainMeasure::finite,
                   volumetric);
        Box<2>     dry(Method::linear_elements,
                   false,
                   Forces::at_the_end,
                   StrainMeasure::finite,
                   volumetric);
        WaterTexts texts = texts_of_water("", "-100");
        texts.pressure   = "50";
        WaterAround<2> around(box, texts);
        around.water.extra_density = {0.};
        box.deform();
        dry.deform();
        const LA::Vector x     = box.displacements(0.03, 0.4);
        LA::Vector       force = box.residual(x);
        force -= dry.residual(x);
        EXPECT_LT(imbalance(box, force, x), 1e-13);
        std::vector<Tensor<1, 2>> of_nodes;
        box.space.node_values(force, of_nodes);
        double inside = 0, largest = 0;
        for (unsigned int node = 0; node < box.space.n_nodes(); ++node)
          {
            const Tensor<1, 2> X =
              box.space.node_position(node) - box.space.node_move(node);
            const double f = of_nodes[node].norm();
            largest        = std::max(largest, f);
            if (X[0] > 0.5 && X[0] < 2.5 && X[1] > 0.5 && X[1] < 2.5)
              inside = std::max(inside, f);
          }
        EXPECT_GT(largest, 10.);
        EXPECT_LT(inside, 1e-11 * largest);
      }
  }



  /** A pressure on the whole rim of the box, which changes along it. */
  template <int dim>
  struct PressureAround
  {
    PressureAround(Box<dim> &box, const bool fe, const double slope)
    {
      Point<dim> lower, upper;
      for (unsigned int d = 0; d < dim; ++d)
        {
          lower[d] = fe ? 0. : 0.1;
          upper[d] = fe ? 3. : 2.4;
        }
      load.emplace("gas",
                   "pressure",
                   Pressure<dim>{[slope](const Point<dim> &x, const double t) {
                                   return t * (300 + slope * x[0]);
                                 },
                                 true},
                   places_on(*make_box<dim>(lower, upper)->rim("", true, {}),
                             box.mesh));
      box.system->add(std::make_unique<PressureTerm<dim>>(*load));
      box.begin_step(1);
    }

    std::optional<CarriedLoad<dim>> load;
  };



  template <int dim>
  void
  check_pressure(const Method method)
  {
    const bool fe = method == Method::linear_elements || is_quadratic(method);
    {
      Box<dim>            box(method, false);
      PressureAround<dim> gas(box, fe, 200);
      EXPECT_FALSE(box.system->symmetric());
      check_tangent(box);
      const LA::Vector x = box.displacements(0.03, 0.4);
      const double     p = gas.load->pressure_at(gas.load->places()[0], 2.);
      EXPECT_GT(p, 500.);
      box.deform();
      check_tangent(box);
    }
    // A uniform one has neither resultant nor moment.
    Box<dim>            box(method, false), free(method, false);
    PressureAround<dim> gas(box, fe, 0);
    const LA::Vector    x     = box.displacements(0.1, 0.4);
    LA::Vector          force = box.residual(x);
    force -= free.residual(x);
    EXPECT_GT(force.l2_norm(), 100.);
    EXPECT_LT(imbalance(box, force, x), 1e-13);
    // Areas and normals that have gone along are those of the end of the step.
    box.system->accept(x);
    box.begin_step(1);
    LA::Vector after = box.residual(box.space.vector());
    free.system->accept(x);
    free.begin_step(1);
    after -= free.residual(box.space.vector());
    if (!fe && method != Method::material_point && method != Method::gimp)
      return;
    Tensor<1, dim> sum;
    double         area = 0;
    for (const auto &place : gas.load->places())
      {
        sum += place.weight * place.normal;
        area += place.weight;
      }
    EXPECT_LT(sum.norm(), 1e-13 * area);
    if (!fe)
      return;
    force -= after;
    EXPECT_LT(force.l2_norm(), 1e-12 * after.l2_norm());
  }

  TEST(Pressure, TangentIsTheDerivativeOfForcesInBalance)
  {
    for (const auto method : {Method::material_point,
                              Method::linear_elements,
                              Method::quadratic_elements,
                              Method::gimp,
                              Method::cpdi1,
                              Method::cpdi2})
      {
        SCOPED_TRACE(static_cast<int>(method));
        check_pressure<2>(method);
        check_pressure<3>(method);
      }
  }



  /** Soils whose flow is not associated, perfectly plastic and softening. */
  std::vector<std::shared_ptr<const Material>>
  soils()
  {
    SoilParameters soil;
    soil.elasticity       = {1000., 0.3, 1.};
    soil.cohesion         = {{0., 3.}};
    soil.friction_angle   = {{0., 30.}};
    soil.dilation_angle   = {{0., 10.}};
    SoilParameters softer = soil;
    softer.cohesion       = {{0., 3.}, {0.5, 2.}};
    return {std::make_shared<MohrCoulomb>(soil),
            std::make_shared<MohrCoulomb>(softer),
            std::make_shared<DruckerPrager>(soil)};
  }

  TEST(Soils, UnsymmetricTangentIsTheDerivativeOfTheForces)
  {
    for (const auto method : {Method::material_point,
                              Method::linear_elements,
                              Method::quadratic_elements,
                              Method::reduced_elements,
                              Method::gimp,
                              Method::cpdi1,
                              Method::cpdi2})
      for (const auto measure : {StrainMeasure::small, StrainMeasure::finite})
        for (const auto volumetric : {VolumetricStrain::pointwise,
                                      VolumetricStrain::cell_mean,
                                      VolumetricStrain::cell_mean_with_shear})
          for (const auto &soil : soils())
            {
              if (is_quadratic(method) &&
                  volumetric != VolumetricStrain::pointwise)
                continue;
              SCOPED_TRACE(std::to_string(static_cast<int>(method)) +
                           (measure == StrainMeasure::finite ? " finite" : "") +
                           " means " +
                           std::to_string(static_cast<int>(volumetric)));
              Box<2> box(method, soil, Forces::at_the_end, measure, volumetric);
              EXPECT_FALSE(box.system->symmetric());
              check_tangent(box);
              const double before = asymmetry(box);
              box.deform();
              check_tangent(box);
              EXPECT_GT(std::max(before, asymmetry(box)), 1e-4);
              if (method != Method::gimp)
                continue;
              Box<3> cube(
                method, soil, Forces::at_the_end, measure, volumetric);
              check_tangent(cube);
            }
  }



  /** The eigenvalues of the tangent at rest, over the largest. */
  template <int dim>
  std::vector<double>
  eigenvalues(Box<dim> &box)
  {
    const LA::Vector x = box.space.vector();
    box.system->assemble(x, true);
    const unsigned int       n = x.size();
    LAPACKFullMatrix<double> K(n, n);
    for (unsigned int j = 0; j < n; ++j)
      {
        LA::Vector e = box.space.vector(), Ke = box.space.vector();
        if (box.space.locally_owned().is_element(j))
          e(j) = 1;
        e.compress(VectorOperation::insert);
        box.system->tangent()->vmult(Ke, e);
        std::vector<double> column(n, 0.);
        for (const auto i : Ke.locally_owned_elements())
          column[i] = Ke(i);
        Utilities::MPI::sum(column, MPI_COMM_WORLD, column);
        for (unsigned int i = 0; i < n; ++i)
          K(i, j) = column[i];
      }
    K.compute_eigenvalues();
    std::vector<double> values;
    for (unsigned int i = 0; i < n; ++i)
      values.push_back(std::abs(K.eigenvalue(i)));
    std::sort(values.begin(), values.end());
    for (double &value : values)
      value /= values.back();
    return values;
  }

  template <int dim>
  void
  check_free_body()
  {
    constexpr unsigned int n_rigid = dim * (dim + 1) / 2;
    Box<dim>               box(Method::reduced_elements, false);
    const auto             held = eigenvalues(box);
    EXPECT_LT(held[n_rigid - 1], 1e-12);
    EXPECT_GT(held[n_rigid], 1e-8);

    // Displacements of degree 2 have the forces of the points alone.
    Box<dim>   full(Method::quadratic_elements, false);
    LA::Vector x = box.space.vector();
    for (unsigned int node = 0; node < box.space.n_nodes(); ++node)
      for (unsigned int c = 0; c < dim; ++c)
        if (box.space.locally_owned().is_element(box.space.node_dof(node)))
          {
            const Point<dim> X = box.space.node_position(node);
            x(box.space.node_dof(node) + c) =
              1e-6 * (X[0] * X[1] + (c + 1) * X[dim - 1] * X[dim - 1]);
          }
    x.compress(VectorOperation::insert);
    LA::Vector   f    = full.residual(x);
    const double size = f.l2_norm();
    ASSERT_GT(size, 1e-5);
    f -= box.residual(x);
    EXPECT_LT(f.l2_norm(), 1e-5 * size);
  }

  TEST(ReducedIntegration, OnlyRigidMotionsOfAFreeBodyAreFree)
  {
    check_free_body<2>();
    check_free_body<3>();
  }



  /** What the ghost term adds to the forces at @p x. */
  template <int dim>
  LA::Vector
  ghost_forces(Box<dim> &without, Box<dim> &with, const LA::Vector &x)
  {
    without.system->assemble(x, false); // the next one is not linearised
    with.system->assemble(x, false);
    LA::Vector f = with.residual(x);
    f -= without.residual(x);
    return f;
  }



  template <int dim>
  void
  check_ghost_stiffness(const Method        method,
                        const bool          plastic,
                        const StrainMeasure measure)
  {
    Box<dim> held(method, plastic, Forces::at_the_end, measure);
    held.hold(0.6, 0.7);
    const auto n_ties = held.state->aggregates()->ties().size();
    ASSERT_GT(Utilities::MPI::sum(n_ties, MPI_COMM_WORLD), 0u);
    check_tangent(held);
    held.deform();
    check_tangent(held);
    EXPECT_LT(asymmetry(held), 1e-14);
    LA::Vector x = held.displacements(0.03, 1.7);
    EXPECT_LT(imbalance(held, held.residual(x), x), 1e-13);

    // A rotation, however large, costs nothing.
    Box<dim> free(method, plastic, Forces::at_the_end, measure);
    Box<dim> other(method, plastic, Forces::at_the_end, measure);
    other.hold(0.6, 0.7);
    const LA::Vector f = ghost_forces(free, other, x);
    ASSERT_GT(f.l2_norm(), 1e-2);
    x = free.space.vector();
    for (unsigned int node = 0; node < free.space.n_nodes(); ++node)
      {
        const auto       dof = free.space.node_dof(node);
        const Point<dim> X   = free.space.node_position(node);
        if (!free.space.locally_owned().is_element(dof))
          continue;
        x(dof)     = -0.4 * X[0] - 0.8 * X[1];
        x(dof + 1) = 0.8 * X[0] - 0.4 * X[1];
      }
    x.compress(VectorOperation::insert);
    EXPECT_LT(ghost_forces(free, other, x).l2_norm(), 1e-10 * f.l2_norm());
  }

  TEST(GhostStiffness, TangentIsTheSymmetricDerivativeOfForcesInBalance)
  {
    for (const auto method :
         {Method::material_point, Method::gimp, Method::cpdi1, Method::cpdi2})
      for (const bool plastic : {false, true})
        for (const auto measure : {StrainMeasure::small, StrainMeasure::finite})
          {
            SCOPED_TRACE(std::to_string(static_cast<int>(method)) +
                         (plastic ? " plastic" : " elastic") +
                         (measure == StrainMeasure::finite ? " finite" : ""));
            check_ghost_stiffness<2>(method, plastic, measure);
            check_ghost_stiffness<3>(method, plastic, measure);
          }
  }



  TEST(GhostStiffness, FollowsTheTangentOfWhatYields)
  {
    for (const auto measure : {StrainMeasure::small, StrainMeasure::finite})
      {
        double size[2];
        for (const bool plastic : {false, true})
          {
            Box<3> free(Method::gimp, plastic, Forces::at_the_end, measure);
            Box<3> held(Method::gimp, plastic, Forces::at_the_end, measure);
            held.hold(0.6, 0.7);
            for (Box<3> *box : {&free, &held})
              box->deform();
            const LA::Vector x = free.displacements(0.01, 1.7);
            size[plastic]      = ghost_forces(free, held, x).l2_norm();
          }
        // With hardening, one of two directions keeps a bit of its stiffness.
        EXPECT_GT(size[1], 0.5 * size[0]);
        EXPECT_LT(size[1], 0.7 * size[0]);
      }
  }



  TEST(GhostMass, TangentIsTheDerivativeOfTheForces)
  {
    for (const auto &integrator : {TimeIntegrator::newmark(0.25, 0.5),
                                   TimeIntegrator::energy_momentum()})
      {
        Box<2>    box(Method::gimp, false);
        Motion<2> motion(
          *box.state, box.points, integrator, VelocityTransfer(), false);
        box.system->set_motion(&motion);
        box.system->add(std::make_unique<GhostMass<2>>(0.7));
        box.hold(0.6, 0.7);
        motion.begin_step();
        box.system->set_target(0.03);
        check_tangent(box);
      }
  }



  TEST(GhostMass, IsCountedOnceInForcesAtTheStart)
  {
    Box<2>    box(Method::gimp, false);
    Motion<2> motion(*box.state,
                     box.points,
                     TimeIntegrator::newmark(0.25, 0.5),
                     VelocityTransfer(),
                     false);
    box.system->set_motion(&motion);
    box.system->add(std::make_unique<GhostMass<2>>(0.7));
    box.hold(0.6, 0.7);
    const LA::Vector a = box.displacements(1., 0.4);
    motion.set_accelerations(a);
    // There is no stress yet.
    LA::Vector forces = box.system->forces_and_mass();
    LA::Vector mass_a = box.space.vector();
    box.system->tangent()->vmult(mass_a, a);
    const double size = mass_a.l2_norm();
    ASSERT_GT(size, 1e-3);
    forces += mass_a;
    EXPECT_LT(forces.l2_norm(), 1e-12 * size);
  }



  /** Cells follow the filled ones beside them in the last layer of each
   * direction, and at corners. */
  template <int dim>
  void
  check_one_mean_for_a_group()
  {
    Box<dim> box(Method::material_point,
                 false,
                 Forces::at_the_end,
                 StrainMeasure::small,
                 VolumetricStrain::cell_mean);
    box.aggregate(0.6);
    box.system->accept(box.displacements(0.03, 0.4));
    // Of a box on mesh lines each cut cell has one root.
    std::map<unsigned int, unsigned int> roots;
    for (const auto &cell : box.mesh.triangulation().active_cell_iterators())
      roots[cell->active_cell_index()] = cell->active_cell_index();
    for (const auto &[cell, roots_of_cell] :
         box.state->aggregates()->roots_of_cells())
      {
        ASSERT_EQ(roots_of_cell.size(), 1u);
        roots[cell] = roots_of_cell[0];
      }
    std::map<unsigned int, std::pair<double, double>> of_group;
    std::map<unsigned int, std::set<unsigned int>>    cells;
    for (unsigned int p = 0; p < box.points.n_local(); ++p)
      {
        const unsigned int cell = box.points.cell_of(p)->active_cell_index();
        const double       mean =
          trace(box.points.stress_field()(box.points.values(p)));
        auto &[least, largest] =
          of_group.emplace(roots[cell], std::pair(mean, mean)).first->second;
        least   = std::min(least, mean);
        largest = std::max(largest, mean);
        cells[roots[cell]].insert(cell);
      }
    double       range = 0, first = 0;
    unsigned int n_largest = 0;
    for (const auto &[root, means] : of_group)
      {
        EXPECT_LT(means.second - means.first, 1e-12 * std::abs(means.first));
        range     = std::max(range, std::abs(means.first - first));
        first     = means.first;
        n_largest = std::max<unsigned int>(n_largest, cells[root].size());
      }
    EXPECT_GT(range, 1.);
    EXPECT_GT(Utilities::MPI::max(n_largest, MPI_COMM_WORLD), 1u);
  }

  TEST(BoundarySlopes, TangentIsTheDerivativeOfTheForces)
  {
    for (const Method method : {Method::material_point, Method::cpdi2})
      {
        Box<2>                box(method, /* plastic = */ false);
        EnforcementParameters parameters;
        parameters.enforcement = "augmented Lagrangian";
        parameters.band_width  = 0.1;
        box.boundaries.emplace_back(
          "line",
          make_flat_face<2>(std::vector<Point<2>>{{0.3, -0.1}, {0.9, 2.6}}),
          RigidMotion<2>(),
          [](const Point<2> &, const double) { return Tensor<1, 2>(); },
          Constraint<2>{Constraint<2>::roller, {}},
          parameters.enforcement_of(),
          0.);
        const ImplicitBoundary<2> &line = box.boundaries.front();
        box.system->add(
          std::make_unique<BoundaryTerm<2>>(box.boundaries.front()));
        box.state->points_changed();
        box.begin_step(0);
        EXPECT_GT(Utilities::MPI::sum<unsigned int>(line.slopes().size(),
                                                    MPI_COMM_WORLD),
                  1u);
        check_tangent(box);
        EXPECT_TRUE(box.system->symmetric());
        // With what it carries.
        box.deform();
        double carried = 0;
        for (const BoundarySlope<2> &slope : line.slopes())
          carried = std::max(carried, slope.multiplier.norm());
        EXPECT_GT(Utilities::MPI::max(carried, MPI_COMM_WORLD), 1.);
        check_tangent(box);
      }
  }



  TEST(CellMeans, OneMeanForACutCellAndTheFilledOneNearest)
  {
    check_one_mean_for_a_group<2>();
    check_one_mean_for_a_group<3>();
  }



  TEST(CellMeans, APointTurnedInsideOutIsNamed)
  {
    Box<3>     box(Method::material_point,
               false,
               Forces::at_the_end,
               StrainMeasure::finite,
               VolumetricStrain::cell_mean);
    LA::Vector x = box.space.vector();
    // All points near a node go through their cell, others stay.
    for (unsigned int node = 0; node < box.space.n_nodes(); ++node)
      if (box.space.node_position(node).distance(Point<3>(1, 1, 1)) < 0.1 &&
          box.space.locally_owned().is_element(box.space.node_dof(node)))
        x(box.space.node_dof(node)) = 3;
    x.compress(VectorOperation::insert);
    box.system->assemble(x, true);
    EXPECT_FALSE(std::isfinite(box.system->residual().l2_norm()) &&
                 box.system->failure().empty());
    EXPECT_NE(box.system->failure().find("inside out"), std::string::npos)
      << box.system->failure();
  }



  /** The nodal forces that balance a uniform stress are those of the points'
   * own gradients. */
  template <int dim>
  void
  check_uniform_stress(const Method method)
  {
    LA::Vector f[3];
    for (const auto volumetric : {VolumetricStrain::pointwise,
                                  VolumetricStrain::cell_mean,
                                  VolumetricStrain::cell_mean_with_shear})
      {
        Box<dim> box(
          method, false, Forces::at_the_end, StrainMeasure::small, volumetric);
        SymmetricTensor<2, 3> stress;
        stress[0][0] = -3;
        stress[1][1] = 2;
        stress[0][1] = 0.7;
        for (unsigned int p = 0; p < box.points.n_local(); ++p)
          box.state->set_initial_stress(p, stress);
        box.begin_step(0);
        f[static_cast<int>(volumetric)] = box.residual(box.space.vector());
      }
    const double size = f[0].l2_norm();
    EXPECT_GT(size, 0.5);
    for (const auto i : {1, 2})
      {
        f[i] -= f[0];
        EXPECT_LT(f[i].l2_norm(), 1e-14 * size) << i;
      }
  }



  TEST(CellMeans, CarryAUniformStressAsPointsDo)
  {
    for (const auto method :
         {Method::material_point, Method::linear_elements, Method::gimp})
      {
        check_uniform_stress<2>(method);
        check_uniform_stress<3>(method);
      }
  }



  /** Of conserving forces in the second step. */
  template <int dim>
  void
  check_conserving_forces(const Method        method,
                          const bool          plastic,
                          const StrainMeasure measure)
  {
    Box<dim> box(method, plastic, Forces::conserving, measure);
    box.deform();
    check_tangent(box);

    const LA::Vector x = box.displacements(0.05, 1.7);
    const LA::Vector f = box.residual(x);
    // The forces are internal ones alone.
    Tensor<1, dim == 2 ? 1 : 3> moment;
    double                      size = 0;
    std::vector<Tensor<1, dim>> du, force;
    box.space.node_values(x, du);
    box.space.node_values(f, force);
    for (unsigned int node = 0; node < box.space.n_nodes(); ++node)
      if (box.space.locally_owned().is_element(box.space.node_dof(node)))
        {
          Tensor<1, dim> r(box.space.node_position(node));
          // At small strain places do not change.
          if (measure == StrainMeasure::finite)
            r += 0.5 * du[node];
          if constexpr (dim == 2)
            moment[0] += r[0] * force[node][1] - r[1] * force[node][0];
          else
            moment += cross_product_3d(r, force[node]);
          size += r.norm() * force[node].norm();
        }
    const double moments = Utilities::MPI::sum(moment, MPI_COMM_WORLD).norm();
    EXPECT_LT(moments, 1e-14 * Utilities::MPI::sum(size, MPI_COMM_WORLD));

    const double work = -(f * x);
    StepEnergies energies;
    box.state->set_trial(x);
    box.state->accept({}, &energies);
    const auto all = [](const double value) {
      return Utilities::MPI::sum(value, MPI_COMM_WORLD);
    };
    const double stored     = all(energies.stored),
                 change     = stored - all(energies.stored_at_start),
                 dissipated = all(energies.dissipated);
    EXPECT_GT(std::abs(change), 0.05 * stored);
    if (plastic)
      EXPECT_GT(dissipated, 0.02 * work);
    else
      EXPECT_EQ(dissipated, 0.);
    EXPECT_NEAR(work, change + dissipated, 1e-13 * (stored + dissipated));
  }



  TEST_P(EveryMethod, ConservingForcesDoTheWorkThatIsStoredAndDissipated)
  {
    const auto [dim, method, plastic] = GetParam();
    for (const auto measure : {StrainMeasure::small, StrainMeasure::finite})
      if (dim == 2)
        check_conserving_forces<2>(method, plastic, measure);
      else
        check_conserving_forces<3>(method, plastic, measure);
  }



  TEST(ConservingForces, AreTheMeanOfBothEndsInSmallSteps)
  {
    double far = 0;
    for (const double scale : {1e-2, 1e-3, 1e-4, 1e-5, 1e-9})
      {
        LA::Vector f[2];
        for (const auto forces : {Forces::at_the_end, Forces::conserving})
          {
            Box<2> box(Method::material_point, false, forces);
            box.deform();
            const LA::Vector x = box.displacements(scale, 1.7);
            box.system->assemble(x, false);
            LA::Vector &of = f[forces == Forces::conserving];
            of             = box.residual(x);
            if (forces == Forces::conserving)
              continue;
            of.sadd(0.5, 0.5, box.residual(box.space.vector()));
          }
        const double size = f[0].l2_norm();
        f[1] -= f[0];
        const double now = f[1].l2_norm() / size;
        if (far > 0 && scale > 1e-6)
          {
            EXPECT_NEAR(now / far, 0.01, 0.004);
          }
        else
          EXPECT_LT(now, 1e-2) << scale;
        far = now;
      }
  }



  TEST(RayleighDamping, TangentIsTheDerivativeOfTheForces)
  {
    for (const auto measure : {StrainMeasure::small, StrainMeasure::finite})
      for (const auto &integrator : {TimeIntegrator::newmark(0.25, 0.5),
                                     TimeIntegrator::energy_momentum()})
        {
          Box<2>     box(Method::quadratic_elements,
                     false,
                     Forces::at_the_end,
                     measure);
          const bool lumped = measure == StrainMeasure::small;
          Motion<2>  motion(
            *box.state, box.points, integrator, VelocityTransfer(), lumped);
          box.system->set_motion(&motion);
          motion.begin_step();
          box.system->set_target(0.3);
          box.system->add(std::make_unique<RayleighDamping<2>>(
            std::vector<RayleighFactors>{{0.7, 2.}}));
          check_tangent(box);
        }
  }

  INSTANTIATE_TEST_SUITE_P(
    All,
    EveryMethod,
    testing::Combine(testing::Values(2u, 3u),
                     testing::Values(Method::material_point,
                                     Method::quadratic_elements,
                                     Method::gimp,
                                     Method::cpdi1,
                                     Method::cpdi2),
                     testing::Bool()),
    name_of);



  TEST(PlasticBox, YieldsInTheStateOfTheTest)
  {
    LA::Vector f[2];
    for (const bool plastic : {false, true})
      {
        Box<3>           box(Method::material_point, plastic);
        const LA::Vector x = box.displacements(0.03, 0.4);
        box.system->assemble(x, false); // the next one is not linearised
        f[plastic] = box.residual(x);
      }
    const double elastic = f[0].l2_norm();
    f[1] -= f[0];
    EXPECT_GT(f[1].l2_norm(), 0.3 * elastic);
  }
} // namespace
