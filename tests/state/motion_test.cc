// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// What transfers between points and nodes keep, and what archives keep.

#include <moraine/core/simulation_state.h>
#include <moraine/material/linear_elastic.h>
#include <moraine/state/motion.h>

#include <gtest/gtest.h>

#include "../small_scene.h"

namespace
{
  using namespace dealii;
  using namespace moraine;

  IntegratorParameters
  transfer_named(const std::string &name)
  {
    IntegratorParameters parameters;
    parameters.integrator = "Newmark";
    parameters.transfer   = name;
    return parameters;
  }

  /** A block of points, with what they carry. */
  template <int dim>
  struct MovingBlock
  {
    static PointFields
    fields(const VelocityTransfer                             &transfer,
           const std::vector<std::shared_ptr<const Material>> &materials)
    {
      PointFields layout;
      StateFields<dim>(layout, StrainMeasure::small, materials);
      Motion<dim>::request_fields(transfer, layout);
      return layout;
    }

    explicit MovingBlock(const VelocityTransfer &transfer)
      : materials{std::make_shared<LinearElastic>(1000., 0.3, 2.)}
      , mesh(unit_cells<dim>(4), MPI_COMM_WORLD)
      , space(mesh, 1)
      , points(mesh, fields(transfer, materials))
      , basis(space, points)
    {
      Point<dim> lower, upper;
      for (unsigned int d = 0; d < dim; ++d)
        {
          lower[d] = 0.8;
          upper[d] = 2.9;
        }
      seed_bodies({{"box", make_box<dim>(lower, upper)}},
                  CellSeeder<dim>(2, PointLayout::equal),
                  points);
      basis.initialise_points(points);
      state.emplace(space,
                    points,
                    basis,
                    materials,
                    MeshAfterStep::reset,
                    StrainMeasure::small);
      motion.emplace(
        *state, points, TimeIntegrator::newmark(0.25, 0.5), transfer, false);
      state->begin_step();
    }

    /** Turns and stretches. */
    static Tensor<1, dim>
    linear_velocity(const unsigned int, const Point<dim> &x)
    {
      Tensor<1, dim> v;
      v[0] = 1 + 2 * x[1] + 0.5 * x[0];
      v[1] = -2 * x[0] + 3;
      return v;
    }

    std::vector<std::shared_ptr<const Material>> materials;
    BackgroundMesh<dim>                          mesh;
    GridSpace<dim>                               space;
    PointSet<dim>                                points;
    CellBasis<dim, 1>                            basis;
    std::optional<State<dim>>                    state;
    std::optional<Motion<dim>>                   motion;
  };



  /** Largest difference of the nodes' velocities from the linear ones, at
   * nodes with mass. */
  template <int dim>
  double
  nodal_error(const MovingBlock<dim> &block)
  {
    double      error = 0;
    const auto &v     = block.motion->velocities();
    for (unsigned int node = 0; node < v.size(); ++node)
      error = std::max(error,
                       (v[node] - MovingBlock<dim>::linear_velocity(
                                    0, block.space.node_position(node)))
                         .norm());
    return Utilities::MPI::max(error, MPI_COMM_WORLD);
  }



  template <int dim>
  void
  check_linear_velocity()
  {
    for (const auto &[name, allowed, exceeded] :
         {std::make_tuple("APIC", 1e-11, 0.),
          std::make_tuple("FLIP", 3., 0.1),
          std::make_tuple("FMPM", 3., 0.1)})
      {
        SCOPED_TRACE(name);
        MovingBlock<dim> block{VelocityTransfer(transfer_named(name))};
        block.motion->start(MovingBlock<dim>::linear_velocity);
        block.motion->begin_step();
        EXPECT_LT(nodal_error(block), allowed);
        EXPECT_GE(nodal_error(block), exceeded);
      }
    MovingBlock<dim> fe{VelocityTransfer()};
    fe.motion->start(MovingBlock<dim>::linear_velocity);
    fe.motion->begin_step();
    EXPECT_LT(nodal_error(fe), 1e-13);
  }



  /** Nothing moves in the step, so nothing but the transfer acts. */
  template <int dim>
  void
  check_momentum(const std::string &name)
  {
    SCOPED_TRACE(name);
    MovingBlock<dim> block{VelocityTransfer(transfer_named(name))};
    block.motion->start(MovingBlock<dim>::linear_velocity);
    const auto before = block.motion->sums();
    double     volume = 1;
    for (unsigned int d = 0; d < dim; ++d)
      volume *= 2.1;
    EXPECT_NEAR(before.mass, 2 * volume, 1e-12);
    for (unsigned int step = 0; step < 3; ++step)
      {
        block.motion->begin_step();
        block.motion->set_target(0.1, {});
        // The increments of nodes that go on as they are.
        const auto &v  = block.motion->velocities();
        auto        du = v;
        LA::Vector  x  = block.space.vector();
        for (unsigned int node = 0; node < v.size(); ++node)
          for (unsigned int d = 0; d < dim; ++d)
            {
              const auto dof = block.space.node_dof(node) + d;
              if (block.space.locally_owned().is_element(dof))
                x(dof) = 0.1 * v[node][d];
            }
        x.compress(VectorOperation::insert);
        block.state->set_trial(x);
        block.motion->accept({});
        block.state->reject();
      }
    const auto after = block.motion->sums();
    EXPECT_NEAR((after.momentum - before.momentum).norm(),
                0.,
                1e-12 * before.momentum.norm());
    const double lost = before.kinetic_energy - after.kinetic_energy;
    if (name == "FLIP")
      EXPECT_NEAR(lost, 0., 1e-11 * before.kinetic_energy);
    else
      EXPECT_GT(lost, 0.);
  }



  Archive
  archive_of(const Motion<2> &motion)
  {
    Archive archive;
    motion.write(archive);
    return archive;
  }
} // namespace



TEST(Motion, NodesGetLinearVelocities)
{
  check_linear_velocity<2>();
  check_linear_velocity<3>();
}



TEST(Motion, TransfersKeepMomentum)
{
  for (const char *name : {"FLIP", "PIC", "blend", "APIC", "FMPM"})
    {
      check_momentum<2>(name);
      check_momentum<3>(name);
    }
}



TEST(Motion, HigherOrderFmpmLosesLess)
{
  double error = std::numeric_limits<double>::max();
  for (const unsigned int order : {1, 2, 4, 8})
    {
      IntegratorParameters parameters = transfer_named("FMPM");
      parameters.fmpm_order           = order;
      MovingBlock<2> block{VelocityTransfer(parameters)};
      block.motion->start(MovingBlock<2>::linear_velocity);
      block.motion->begin_step();
      EXPECT_LT(nodal_error(block), error);
      error = nodal_error(block);
    }
}



TEST(Motion, ArchivesKeepNodesAndWorks)
{
  MovingBlock<2> block{VelocityTransfer()};
  block.motion->start(MovingBlock<2>::linear_velocity);
  block.motion->begin_step();
  block.motion->set_target(0.1, {});
  Motion<2>::StepWorks works;
  works.at_start = {{1., 2., 3., 4.}};
  works.at_end   = {{5., 6., 7., 8.}};
  block.motion->accept(works);
  block.motion->count(StepEnergies{1., 2., 3.});
  const Archive kept = archive_of(*block.motion);

  MovingBlock<2> other{VelocityTransfer()};
  other.motion->begin_step();
  EXPECT_TRUE(archive_of(*other.motion) != kept);
  other.motion->read(kept);
  EXPECT_TRUE(archive_of(*other.motion) == kept);
  EXPECT_EQ(other.motion->works().of_forces[1], 4.);
  const double n_ranks = Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
  EXPECT_EQ(other.motion->works().stored_at_start, n_ranks);
  EXPECT_EQ(other.motion->works().stored, 2 * n_ranks);
  EXPECT_EQ(other.motion->works().dissipated, 3 * n_ranks);
}
