// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// The headers of step-1 and two more: shapes that are moved into place, and
// boundaries that need not follow the mesh.
#include <moraine/assembly/mechanics_system.h>
#include <moraine/basis/basis.h>
#include <moraine/boundary/implicit_boundary.h>
#include <moraine/material/linear_elastic.h>
#include <moraine/mesh/background_mesh.h>
#include <moraine/mesh/grid_space.h>
#include <moraine/output/point_vtu.h>
#include <moraine/points/bodies.h>
#include <moraine/geometry/shapes.h>
#include <moraine/solver/linear_solver.h>
#include <moraine/solver/newton.h>
#include <moraine/state/state.h>

#include <deal.II/base/mpi.h>

#include <cmath>
#include <iomanip>
#include <iostream>

using namespace dealii;
using namespace moraine;

// A block lies on a slope, held by a stop at its foot. Slope and stop are
// frictionless: rollers, at an angle at which they cut through the cells of the
// mesh wherever they like. (mm, N)
constexpr int    dim           = 2;
constexpr double length        = 100;
constexpr double height        = 50;
constexpr double angle         = 25;  // degrees
constexpr double weight        = 0.1; // force per volume
constexpr double young_modulus = 1000;
constexpr double poisson_ratio = 0.3;



// @sect3{Boundaries that cut cells}
//
// A boundary is a surface with the body on one side (on the left, walking along
// a line), a rigid motion of the surface, a displacement prescribed relative to
// it, what it constrains, and how. We draw the surfaces in the axes of the
// block and let the motion, a constant rotation angle here, put them in place;
// an angle that changed with time would tilt them during the run.
//
// A roller constrains the component of the displacement that is normal to the
// surface: $M = n \otimes n$. The default enforcement is the skew-symmetric
// variant of Nitsche's method; the paper's Dirichlet-weighted basis is another
// value of <code>enforcement</code>.
ImplicitBoundary<dim>
make_roller(const std::string &name,
            const Point<dim>  &from,
            const Point<dim>  &to)
{
  const RigidMotion<dim> tilt({}, [](const double) { return angle; });
  const auto no_displacement = [](const Point<dim> &, const double) {
    return Tensor<1, dim>();
  };
  Constraint<dim> roller;
  roller.kind = Constraint<dim>::roller;
  return ImplicitBoundary<dim>(name,
                               make_flat_face<dim>(
                                 std::vector<Point<dim>>{from, to}),
                               tilt,
                               no_displacement,
                               roller,
                               EnforcementParameters().enforcement_of(),
                               /* no limit on */ 0);
}



// @sect3{What is known}
//
// Whatever happens inside the block, slope and stop together carry its weight
// $W$: the slope $W \cos\alpha$ along its normal, the stop $W \sin\alpha$. We
// print both ratios. The violation is the largest $|M(u-g)|$ on the surface in
// this step, the penetration the largest depth of a point behind it.
void
print_reports(const std::vector<BoundaryReport<dim>> &reports,
              const double                            total_weight,
              const double                            t)
{
  if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) != 0)
    return;
  const double alpha    = angle * numbers::PI / 180;
  const double share[2] = {std::cos(alpha), std::sin(alpha)};
  for (unsigned int b = 0; b < reports.size(); ++b)
    std::cout << std::fixed << std::setprecision(2) << t << std::setw(7)
              << reports[b].name << std::setprecision(4) << std::setw(11)
              << reports[b].reaction[0] << std::setw(11)
              << reports[b].reaction[1] << std::setprecision(8) << std::setw(13)
              << reports[b].reaction.norm() / (t * total_weight * share[b])
              << std::scientific << std::setprecision(2) << std::setw(11)
              << reports[b].violation << std::setw(11) << reports[b].penetration
              << std::endl;
}



// @sect3{The program}
int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);

  // A mesh that covers the turned block; cells without points do not count.
  MeshParameters<dim> box;
  box.lower_corner = Point<dim>(-30, -10);
  box.upper_corner = Point<dim>(100, 100);
  box.cell_size    = 5;
  const BackgroundMesh<dim> mesh(box, MPI_COMM_WORLD);
  GridSpace<dim>            space(mesh, /* degree = */ 1);

  // The only difference to the body of step-1 is that the box is turned. Each
  // sub-cell is clipped with the shape, and its point gets volume and centroid
  // of what is left; the volumes sum up to that of the block to round-off.
  const auto flat = make_box<dim>(Point<dim>(0, 0), Point<dim>(length, height));
  const auto block = make_moved<dim>(
    flat,
    Placement<dim>(angle, Point<dim>(), Tensor<1, dim>(), Tensor<1, dim>()));
  PointSet<dim> points(mesh, PointFields());
  const double  volume = seed_bodies({{"block", block}},
                                    CellSeeder<dim>(2, PointLayout::equal),
                                    points)[0];

  CellBasis<dim, 1> basis(space, points);
  State<dim>        state(space,
                   points,
                   basis,
                   {std::make_shared<LinearElastic>(young_modulus,
                                                    poisson_ratio,
                                                    /* density = */ 0)},
                   MeshAfterStep::reset);

  // Weight grows with time. The stop is the left side of the block; walking
  // down along it has the block on the left.
  Loads<dim> loads;
  loads.body_forces.push_back({"weight",
                               [](const Point<dim> &, const double t) {
                                 return Tensor<1, dim>(
                                   Point<dim>(0, -weight * t));
                               },
                               /* times_density = */ false,
                               /* acts_on = */ {true}});
  std::vector<ImplicitBoundary<dim>> boundaries;
  boundaries.push_back(
    make_roller("slope", Point<dim>(0, 0), Point<dim>(length, 0)));
  boundaries.push_back(
    make_roller("stop", Point<dim>(0, height), Point<dim>(0, 0)));

  const std::vector<GridCondition<dim>> no_conditions;
  MechanicsSystem<dim>                  system(state,
                              make_terms(boundaries, no_conditions, loads),
                              {"block"});
  Newton                                newton{NewtonParameters()};
  LinearSolver linear_solver(LinearSolverParameters(), dim);

  // Is it the block we wanted?
  if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    std::cout << points.n_global() << " points, volume " << std::fixed
              << std::setprecision(10) << volume << "\n   t boundary        x"
              << "          y   over exact  violation penetration" << std::endl;

  // The loop of step-1. accept() returns what the boundaries have to report.
  constexpr unsigned int n_steps = 4;
  for (unsigned int step = 0; step < n_steps; ++step)
    {
      LA::Vector   increment;
      const double t_end = (step + 1) / double(n_steps);
      system.begin_step(step / double(n_steps));
      system.set_target(t_end);
      const NewtonReport report =
        newton.solve(system, linear_solver, increment);
      AssertThrow(report.converged(), ExcMessage(report.message));
      print_reports(system.accept(increment), weight * volume, t_end);
    }

  // Something to look at, with ParaView or './moraine plot'.
  write_point_vtu(points, {"step-3.vtu", 1., n_steps});
}
