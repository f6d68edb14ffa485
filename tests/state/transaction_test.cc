// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// A failure planted at every place of a step leaves the last accepted state,
// bit by bit, and the run can go on from there as if nothing had happened.

#include <moraine/core/exceptions.h>
#include <moraine/core/simulation_state.h>
#include <moraine/material/von_mises.h>
#include <moraine/state/state.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "../core/message.h"
#include "../small_scene.h"

namespace
{
  using namespace dealii;
  using namespace moraine;

  enum class Place
  {
    nowhere,
    marking_cells,
    material,
    domains,
    splitting,
    before_mesh_motion,
    after_mesh_motion,
    search,
    later_part
  };

  /** Where the next failure is. */
  struct Trap
  {
    Place        place  = Place::nowhere;
    unsigned int visits = 0;

    /** Fail at the @p n-th visit. */
    void
    visit(const Place here, const unsigned int n = 1)
    {
      if (here == place && ++visits == n)
        throw ComputationError("planted");
    }
  };

  class TrappedMaterial : public VonMises
  {
  public:
    explicit TrappedMaterial(Trap &trap)
      : VonMises(1000., 0.3, 1., {{0., 20.}})
      , trap(trap)
    {}

    using Material::respond;

    void
    respond(const StepTime                  &time,
            const ArrayView<PrincipalState> &points) const override
    {
      // Others are committed by then.
      trap.visit(Place::material, 3);
      VonMises::respond(time, points);
    }

  private:
    Trap &trap;
  };

  class TrappedBasis : public CellBasis<2, 1>
  {
  public:
    TrappedBasis(const GridSpace<2> &space,
                 const PointSet<2>  &points,
                 Trap               &trap)
      : CellBasis<2, 1>(space, points)
      , trap(trap)
    {}

    void
    mark_cells(std::vector<unsigned char> &active) override
    {
      CellBasis<2, 1>::mark_cells(active);
      trap.visit(Place::marking_cells);
    }

    void
    move_domains(PointSet<2> &,
                 const std::vector<Tensor<1, 2>> &,
                 const std::vector<Tensor<2, 2>> &) const override
    {
      trap.visit(Place::domains);
    }

    bool
    split_domains(PointSet<2> &) override
    {
      trap.visit(Place::splitting);
      return false;
    }

  private:
    Trap &trap;
  };

  /** Commits after the points. */
  struct Counter : StatePart
  {
    void
    write(Archive &archive) const override
    {
      archive.write("counter", steps);
    }

    void
    read(const Archive &archive) override
    {
      steps = archive.integer("counter");
    }

    unsigned int steps = 0;
  };

  /** A plastic body that is bent step by step. */
  struct BentBody
  {
    explicit BentBody(const MeshAfterStep after_step)
      : materials{std::make_shared<TrappedMaterial>(trap)}
      , scene(false, 2, StrainMeasure::finite, materials)
      , basis(scene.space, scene.points, trap)
      , state(scene.space,
              scene.points,
              basis,
              materials,
              after_step,
              StrainMeasure::finite)
    {
      all.add(scene.mesh);
      all.add(scene.points);
      all.add(scene.space);
      all.add(counter);
    }

    LA::Vector
    increments(const double scale) const
    {
      LA::Vector x = scene.space.vector();
      for (unsigned int node = 0; node < scene.space.n_nodes(); ++node)
        for (unsigned int c = 0; c < 2; ++c)
          {
            const auto dof = scene.space.node_dof(node) + c;
            const auto X   = scene.space.node_position(node);
            if (scene.space.locally_owned().is_element(dof))
              x(dof) = scale * std::sin(0.9 * X[0] + 0.7 * c + X[1]);
          }
      x.compress(VectorOperation::insert);
      return x;
    }

    void
    try_step()
    {
      state.begin_step();
      const bool leaves = trap.place == Place::search;
      state.set_trial(increments(leaves ? 50. : 0.05));
      all.keep([&]() {
        state.accept([&]() {
          trap.visit(Place::before_mesh_motion);
          scene.mesh.move_vertices([](const Point<2> &X) {
            return Point<2>(X[0] + 0.011, 1.003 * X[1]);
          });
          trap.visit(Place::after_mesh_motion);
        });
        trap.visit(Place::later_part);
        ++counter.steps;
      });
    }

    void
    step()
    {
      try
        {
          try_step();
        }
      catch (...)
        {
          all.undo();
          state.reject();
          throw;
        }
    }

    Archive
    archive() const
    {
      Archive result;
      all.write(result);
      return result;
    }

    Trap                                         trap;
    std::vector<std::shared_ptr<const Material>> materials;
    SmallScene<2>                                scene;
    TrappedBasis                                 basis;
    State<2>                                     state;
    Counter                                      counter;
    SimulationState                              all;
  };

  void
  check_failure_at(const Place place, const MeshAfterStep after_step)
  {
    SCOPED_TRACE(static_cast<int>(place));
    BentBody run(after_step), undisturbed(after_step);
    run.step();
    undisturbed.step();
    const Archive accepted = run.archive();
    EXPECT_TRUE(accepted == undisturbed.archive());

    run.trap.place = place;
    EXPECT_NE(message_of<ComputationError>([&]() { run.step(); }), "");
    EXPECT_TRUE(run.archive() == accepted);

    run.trap.place = Place::nowhere;
    for (unsigned int i = 0; i < 2; ++i)
      {
        run.step();
        undisturbed.step();
      }
    EXPECT_EQ(run.counter.steps, 3u);
    EXPECT_TRUE(run.archive() == undisturbed.archive());
    EXPECT_TRUE(run.archive() != accepted);
  }
} // namespace



TEST(Transaction, PointsThatMoveThroughTheMesh)
{
  for (const Place place : {Place::marking_cells,
                            Place::material,
                            Place::domains,
                            Place::splitting,
                            Place::before_mesh_motion,
                            Place::after_mesh_motion,
                            Place::search,
                            Place::later_part})
    check_failure_at(place, MeshAfterStep::reset);
}



TEST(Transaction, AMeshThatFollowsTheMaterial)
{
  for (const Place place : {Place::material, Place::domains, Place::later_part})
    check_failure_at(place, MeshAfterStep::follow_material);
}



TEST(Transaction, AStateFromAFileGoesOn)
{
  BentBody           run(MeshAfterStep::reset), resumed(MeshAfterStep::reset);
  const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
  const std::string  path    = "state_" + std::to_string(n_ranks) + ".h5";
  run.step();
  resumed.state.begin_step();
  write_file(run.archive(), path, MPI_COMM_WORLD);
  resumed.all.read(read_file(path, MPI_COMM_WORLD));
  MPI_Barrier(MPI_COMM_WORLD);
  if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    std::remove(path.c_str());

  // Rows come in the order of ids, so that compare what does not know it.
  EXPECT_TRUE(run.archive().gathered(MPI_COMM_WORLD) ==
              resumed.archive().gathered(MPI_COMM_WORLD));
  run.step();
  resumed.step();
  const Archive a = run.archive().gathered(MPI_COMM_WORLD);
  const Archive b = resumed.archive().gathered(MPI_COMM_WORLD);
  if (a.data_sets().empty())
    return;
  EXPECT_EQ(a.integers("points/id"), b.integers("points/id"));
  const auto &x = a.numbers("points/position", 2);
  const auto &y = b.numbers("points/position", 2);
  ASSERT_EQ(x.size(), y.size());
  for (unsigned int i = 0; i < x.size(); ++i)
    EXPECT_NEAR(x[i], y[i], 1e-14);
}
