// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// Free water on curved surfaces: the forces without a surface against integrals
// over the edges.

#include <moraine/assembly/make_terms.h>
#include <moraine/assembly/mechanics_system.h>
#include <moraine/assembly/water_term.h>
#include <moraine/basis/basis.h>
#include <moraine/geometry/shapes.h>
#include <moraine/material/linear_elastic.h>
#include <moraine/mesh/background_mesh.h>
#include <moraine/points/bodies.h>
#include <moraine/state/state.h>

#include <gtest/gtest.h>

#include <memory>
#include <vector>

namespace water_test
{
  using namespace dealii;
  using namespace moraine;

  namespace
  {
    /** A ring of straight elements, at rest. */
    struct Ring
    {
      Ring()
        : mesh(parameters(), MPI_COMM_WORLD)
        , space(mesh, 1)
        , points(mesh, fields(law))
      {
        const CellSeeder<2> seeder(2, PointLayout::gauss);
        seed_bodies(std::vector<Body<2>>{{"ring", make_space<2>()}},
                    seeder,
                    points);
        basis = std::make_unique<CellBasis<2, 1>>(space, points);
        basis->initialise_points(points);
        state = std::make_unique<State<2>>(
          space, points, *basis, std::vector{law}, MeshAfterStep::keep);
        system = std::make_unique<MechanicsSystem<2>>(
          *state,
          make_terms(boundaries, conditions, loads),
          std::vector<std::string>{"ring"});
      }

      static MeshParameters<2>
      parameters()
      {
        MeshParameters<2> ring;
        ring.type       = "generator";
        ring.generator  = "concentric_hyper_shells";
        ring.arguments  = "0, 0 : 5 : 10 : 5 : 0 : 18 : true";
        ring.side_names = "hole: 0, outer: 1";
        return ring;
      }

      static PointFields
      fields(const std::shared_ptr<const Material> &law)
      {
        PointFields layout;
        StateFields<2>(layout, StrainMeasure::small, {law});
        return layout;
      }

      std::shared_ptr<const Material> law =
        std::make_shared<LinearElastic>(1000., 0.3, 0.);
      BackgroundMesh<2>                   mesh;
      GridSpace<2>                        space;
      PointSet<2>                         points;
      std::unique_ptr<Basis<2>>           basis;
      std::unique_ptr<State<2>>           state;
      std::vector<ImplicitBoundary<2>>    boundaries;
      std::vector<GridCondition<2>>       conditions;
      Loads<2>                            loads;
      std::unique_ptr<MechanicsSystem<2>> system;
    };

    /** Of the water outside; there is none in the pores. */
    double
    pressure(const Point<2> &x)
    {
      return 10 * (30 - x[1]);
    }

    /** Of the edges at the boundary, at the nodes that this rank knows. */
    std::vector<Tensor<1, 2>>
    integrals(const Ring &ring)
    {
      std::vector<Tensor<1, 2>> forces(ring.space.n_nodes());
      const auto                node_at = [&](const Point<2> &x) {
        for (unsigned int node = 0; node < forces.size(); ++node)
          if (ring.space.node_position(node).distance(x) < 1e-9)
            return node;
        return numbers::invalid_unsigned_int;
      };
      for (const auto &cell : ring.mesh.triangulation().active_cell_iterators())
        for (const auto &face : cell->face_iterators())
          if (face->at_boundary())
            {
              const Point<2> a = face->vertex(0), b = face->vertex(1);
              Tensor<1, 2>   normal({b[1] - a[1], a[0] - b[0]}); // times length
              if (normal * (face->center() - cell->center()) < 0)
                normal *= -1;
              const auto add = [&](const Point<2> &x, const Point<2> &other) {
                const unsigned int node = node_at(x);
                if (node != numbers::invalid_unsigned_int)
                  forces[node] -=
                    (pressure(x) / 3 + pressure(other) / 6) * normal;
              };
              add(a, b);
              add(b, a);
            }
      return forces;
    }
  } // namespace



  TEST(Water, ForcesOnCurvedSurfacesAreIntegralsOverThem)
  {
    WaterTexts texts;
    texts.pressure    = "0";
    texts.free_level  = "30";
    texts.section     = "Water";
    texts.unit_weight = 10;
    Ring             ring;
    WaterInBodies<2> water;
    water.water.emplace(texts);
    water.extra_density = {0.};
    ring.system->add(
      std::make_unique<WaterTerm<2>>(water,
                                     ring.points,
                                     std::vector<const BodyForce<2> *>(),
                                     StrainMeasure::small));
    ring.system->begin_step(0);
    ring.system->set_target(1);

    ring.system->assemble(ring.space.vector(), false);
    std::vector<Tensor<1, 2>> found;
    ring.space.node_values(ring.system->residual(), found);
    const auto expected = integrals(ring);
    double     largest = 0, error = 0;
    for (unsigned int node = 0; node < expected.size(); ++node)
      if (ring.space.locally_owned().is_element(ring.space.node_dof(node)))
        {
          largest = std::max(largest, expected[node].norm());
          error   = std::max(error, (found[node] - expected[node]).norm());
        }
    EXPECT_GT(largest, 100.);
    EXPECT_LT(error, 1e-12 * largest);
  }
} // namespace water_test
