// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// Every part of Moraine is a small class with a header of its own, in a folder
// that says what it is about. We take the headers in the order in which the
// parts are put together: a mesh with the displacements on it, points, a basis
// that connects the two, a state, the loads, the equations, and their solver.
#include <moraine/assembly/mechanics_system.h>
#include <moraine/basis/basis.h>
#include <moraine/load/load.h>
#include <moraine/material/linear_elastic.h>
#include <moraine/mesh/background_mesh.h>
#include <moraine/mesh/grid_space.h>
#include <moraine/output/point_vtu.h>
#include <moraine/points/bodies.h>
#include <moraine/geometry/shapes.h>
#include <moraine/solver/linear_solver.h>
#include <moraine/solver/newton.h>
#include <moraine/state/state.h>

// deal.II supplies what a finite element program always needs.
#include <deal.II/base/mpi.h>

#include <iomanip>
#include <iostream>

using namespace dealii;
using namespace moraine;

// Everything in the library is written for two and three dimensions. We stay in
// the plane (plane strain), with lengths in mm and forces in N.
constexpr int    dim           = 2;
constexpr double length        = 100;
constexpr double height        = 50;
constexpr double young_modulus = 1000;
constexpr double poisson_ratio = 0.3;
constexpr double final_tension = 30;

// The line in which FE and MPM differ. With <code>follow_material</code>, nodes
// are moved with the material at the end of a step and the points stay where
// they are in their cells: the finite element method. The other choice is the
// subject of step-2.
constexpr MeshAfterStep after_step = MeshAfterStep::follow_material;



// @sect3{What holds and what pulls}
//
// The block slides along the left and the bottom side of the mesh. Such sides
// coincide with mesh lines, so that nodes can be held: a grid condition.
std::vector<GridCondition<dim>>
make_supports(const BackgroundMesh<dim> &mesh)
{
  std::vector<GridCondition<dim>> supports(2);
  for (unsigned int i = 0; i < 2; ++i)
    {
      supports[i].name         = i == 0 ? "left" : "bottom";
      supports[i].side         = mesh.boundary_id(supports[i].name, "step-1");
      supports[i].component[i] = true;
      supports[i].displacement = [](const Point<dim> &, const double) {
        return Tensor<1, dim>();
      };
    }
  return supports;
}



// The right side is pulled with a traction that grows with the time t from 0 to
// 1. It is carried by the material: its quadrature points lie on a line through
// the undeformed body, weighted with their share of it, and move along.
Loads<dim>
make_loads(const BackgroundMesh<dim> &mesh)
{
  const auto right =
    make_flat_face<dim>({Point<dim>(length, 0), Point<dim>(length, height)});
  Loads<dim> loads;
  loads.carried.emplace_back(
    "tension",
    "surface traction",
    [](const Point<dim> &, const double t) {
      return Tensor<1, dim>(Point<dim>(final_tension * t, 0));
    },
    places_on<dim>(*right, mesh));
  return loads;
}



// @sect3{What we print}
//
// The stress of the first step is known, $\sigma_{xx} = t\,p$ everywhere. We
// print the mean over the points weighted with their volumes, the largest
// deviation from it, and how far the points at the right end have moved. Sums
// and maxima are taken over all processes, so the program gives the same
// numbers on any number of them.
void
print_stress(const PointSet<dim> &points, const double t)
{
  double volume = 0, mean = 0;
  for (unsigned int p = 0; p < points.n_local(); ++p)
    {
      volume += points.volume(p);
      mean += points.volume(p) * points.values(p)[points.stress_offset()];
    }
  volume = Utilities::MPI::sum(volume, MPI_COMM_WORLD);
  mean   = Utilities::MPI::sum(mean, MPI_COMM_WORLD) / volume;

  double spread = 0, motion = 0;
  for (unsigned int p = 0; p < points.n_local(); ++p)
    {
      const double *stress = points.values(p) + points.stress_offset();
      spread               = std::max(spread, std::abs(stress[0] - mean));
      motion = std::max(motion, points.values(p)[points.displacement_offset()]);
    }
  spread = Utilities::MPI::max(spread, MPI_COMM_WORLD);
  motion = Utilities::MPI::max(motion, MPI_COMM_WORLD);

  if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    std::cout << std::fixed << std::setprecision(1) << t << std::setw(10)
              << std::setprecision(5) << mean << std::setw(12)
              << std::scientific << std::setprecision(1)
              << (spread < 1e-9 * mean ? 0. : spread / mean) << std::setw(10)
              << std::fixed << std::setprecision(4) << motion << std::endl;
}



// @sect3{The program}
int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);

  // The mesh is larger than the block, because the block will become longer.
  // Cells without points own no unknowns and cost nothing.
  MeshParameters<dim> box;
  box.lower_corner = Point<dim>(0, 0);
  box.upper_corner = Point<dim>(120, 60);
  box.cell_size    = 10;
  const BackgroundMesh<dim> mesh(box, MPI_COMM_WORLD);
  GridSpace<dim>            space(mesh, /* degree = */ 1);

  // A body is a name and a shape. The seeder divides a cell into sub-cells and
  // gives each of them a point that carries the volume of its part inside the
  // shape. With the Gauss layout and two points per direction these are the
  // points and weights every finite element program uses on bilinear elements.
  const auto block =
    make_box<dim>(Point<dim>(0, 0), Point<dim>(length, height));
  PointSet<dim> points(mesh, PointFields());
  seed_bodies({{"block", block}},
              CellSeeder<dim>(2, PointLayout::gauss),
              points);

  // The basis tells for each point which nodes it touches and the values and
  // gradients of their shape functions there. The state joins what we have: the
  // stresses that were reached are stored at the points, and a trial state is
  // nothing but increments of the displacements of the nodes. Materials are
  // given body by body; there is one.
  CellBasis<dim, 1> basis(space, points);
  State<dim>        state(space,
                   points,
                   basis,
                   {std::make_shared<LinearElastic>(young_modulus,
                                                    poisson_ratio,
                                                    /* density = */ 0)},
                   after_step);

  // The equations of a step: points, supports and loads. There is no boundary
  // that cuts through cells yet; see step-3.
  const auto                         supports = make_supports(mesh);
  Loads<dim>                         loads    = make_loads(mesh);
  std::vector<ImplicitBoundary<dim>> no_boundaries;
  MechanicsSystem<dim>               system(state,
                              make_terms(no_boundaries, supports, loads),
                              {"block"});

  Newton       newton{NewtonParameters()};
  LinearSolver linear_solver(LinearSolverParameters(), dim);

  if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    std::cout << points.n_global() << " points\n"
              << "  t  mean s_xx   deviation    motion" << std::endl;

  // One turn of this loop is one load step. begin_step() finds out which cells
  // have points; set_target() says where the step is to end. Nothing the solver
  // tries is remembered: only accept() writes stresses and positions, and a
  // step that did not converge must not get there.
  constexpr unsigned int n_steps = 10;
  for (unsigned int step = 0; step < n_steps; ++step)
    {
      const double t_start = step / double(n_steps);
      const double t_end   = (step + 1) / double(n_steps);

      LA::Vector increment;
      system.begin_step(t_start);
      system.set_target(t_end);
      const NewtonReport report =
        newton.solve(system, linear_solver, increment);
      AssertThrow(report.converged(), ExcMessage(report.message));

      system.accept(increment);
      print_stress(points, t_end);
    }

  // Something to look at, with ParaView or './moraine plot'.
  write_point_vtu(points, {"block.vtu", 1., n_steps});
}
