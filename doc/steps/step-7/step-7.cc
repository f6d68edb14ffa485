// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// Three headers are new: velocities and accelerations, the boundary that
// swallows waves, and the term that puts its forces into the equations.
#include <moraine/assembly/absorbing_term.h>
#include <moraine/assembly/mechanics_system.h>
#include <moraine/basis/basis.h>
#include <moraine/boundary/absorbing_boundary.h>
#include <moraine/material/linear_elastic.h>
#include <moraine/mesh/background_mesh.h>
#include <moraine/mesh/grid_space.h>
#include <moraine/points/bodies.h>
#include <moraine/geometry/shapes.h>
#include <moraine/solver/linear_solver.h>
#include <moraine/solver/newton.h>
#include <moraine/state/motion.h>
#include <moraine/state/state.h>

#include <deal.II/base/mpi.h>

#include <cmath>
#include <iomanip>
#include <iostream>

using namespace dealii;
using namespace moraine;

// A column that cannot move sideways. (m, kPa, t, s)
constexpr int          dim           = 2;
constexpr double       length        = 20;
constexpr double       width         = 0.25;
constexpr double       young_modulus = 20e3;
constexpr double       poisson_ratio = 0.25;
constexpr double       density       = 1.5;
constexpr double       end_time      = 0.6;
constexpr unsigned int n_steps       = 240;
constexpr unsigned int n_lines       = 12;

// What the wave meets at the lower end.
enum class Base
{
  fixed,
  absorbing
};



// @sect3{The exact solution}
//
// The pressure on the top, a triangle of 0.5 s, and its integral.
double
pressure(const double t)
{
  return 300 * std::max(0., 1 - std::abs(t / 0.25 - 1));
}



double
impulse(const double t)
{
  if (t <= 0.25)
    return t > 0 ? 600 * t * t : 0.;
  return t <= 0.5 ? 75 - 600 * (0.5 - t) * (0.5 - t) : 75.;
}



// Waves run down from the top and, if the base is fixed, up from the base and
// down again (d'Alembert). A pressure that comes back from a fixed end is a
// pressure, one that comes back from a free end is a tension.
struct Exact
{
  double settlement = 0, stress = 0;
};



Exact
exact_solution(const Base base, const double depth, const double t)
{
  const double M = young_modulus * (1 - poisson_ratio) / (1 + poisson_ratio) /
                   (1 - 2 * poisson_ratio);
  const double c = std::sqrt(M / density);
  Exact        exact;
  double       sign = 1;
  for (unsigned int k = 0; k < (base == Base::fixed ? 10 : 1);
       ++k, sign = -sign)
    {
      const double down = t - (2 * k * length + depth) / c;
      const double up =
        base == Base::fixed ? t - (2 * (k + 1) * length - depth) / c : -1.;
      exact.settlement += sign * (impulse(down) - impulse(up)) / (density * c);
      exact.stress -= sign * (pressure(down) + pressure(up));
    }
  return exact;
}



// @sect3{What holds and what pushes}
//
// Rollers on both sides, and a fixed base if there is one.
std::vector<GridCondition<dim>>
make_supports(const Base base, const BackgroundMesh<dim> &mesh)
{
  const std::vector<std::string>  sides{"left", "right", "bottom"};
  std::vector<GridCondition<dim>> supports(base == Base::fixed ? 3 : 2);
  for (unsigned int i = 0; i < supports.size(); ++i)
    {
      supports[i].name         = sides[i];
      supports[i].side         = mesh.boundary_id(sides[i], "step-7");
      supports[i].component[0] = true;
      supports[i].component[1] = i == 2;
      supports[i].displacement = [](const Point<dim> &, const double) {
        return Tensor<1, dim>();
      };
    }
  return supports;
}



Loads<dim>
make_loads(const BackgroundMesh<dim> &mesh)
{
  Loads<dim> loads;
  loads.carried.emplace_back(
    "pulse",
    "side traction",
    [](const Point<dim> &, const double t) {
      return Tensor<1, dim>(Point<dim>(0, -pressure(t)));
    },
    places_on_side(mesh, mesh.boundary_id("top", "step-7")));
  return loads;
}



// The other base is a line of dashpots, $t = -\rho c\, v$. Nothing has to be
// said about $\rho c$: it is that of the material beside the line. The body is
// on the left of the line, as for implicit boundaries.
AbsorbingBoundary<dim>
make_absorbing_base()
{
  const SurfacePointer<dim> line =
    make_flat_face<dim>({Point<dim>(0, 0), Point<dim>(width, 0)});
  return AbsorbingBoundary<dim>(
    "base",
    [line](const GridSpace<dim> &space, const double) {
      return places_on<dim>(*line, space.mesh());
    },
    AbsorbingLaw(),
    /* no incident wave */ {},
    /* on_side = */ false);
}



// @sect3{What we print}
//
// A line for the point that is nearest to the middle of the column. Only one
// process has it, the others add zeros.
struct AtMiddle
{
  double depth = 0, settlement = 0, stress = 0;
};



AtMiddle
look_at_middle(const PointSet<dim> &points)
{
  const Point<dim> middle(0.1, length / 2 - 0.1);
  AtMiddle         found;
  double           nearest = 1e100;
  for (unsigned int p = 0; p < points.n_local(); ++p)
    if (points.position(p).distance(middle) < nearest)
      {
        const double *values = points.values(p);
        nearest              = points.position(p).distance(middle);
        found                = {length - points.position(p)[1],
                                -values[points.displacement_offset() + 1],
                                values[points.stress_offset() + 1]};
      }
  if (nearest > Utilities::MPI::min(nearest, MPI_COMM_WORLD))
    found = AtMiddle();
  return {Utilities::MPI::sum(found.depth, MPI_COMM_WORLD),
          Utilities::MPI::sum(found.settlement, MPI_COMM_WORLD),
          Utilities::MPI::sum(found.stress, MPI_COMM_WORLD)};
}



void
print_middle(const Base base, const AtMiddle &found, const double t)
{
  const Exact exact = exact_solution(base, found.depth, t);
  if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    std::cout << std::fixed << std::setprecision(2) << std::setw(5) << t
              << std::setprecision(4) << std::setw(12) << found.settlement
              << std::setw(9) << exact.settlement << std::setprecision(1)
              << std::setw(11) << found.stress << std::setw(9) << exact.stress
              << std::endl;
}



// Where the energy went. Works of forces are positive where they push the
// material along; that of the dashpots is not, and neither is that of a fixed
// base, which does none.
void
print_energy(const Works &works)
{
  if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) != 0)
    return;
  const auto work = [&works](const WorkKind kind) {
    return works.of_forces[static_cast<unsigned int>(kind)];
  };
  const double balance = std::abs(works.out_of_balance()) / works.largest();
  std::cout << std::fixed << std::setprecision(3)
            << "energy [kJ]: work of the pulse " << work(WorkKind::external)
            << " = kinetic " << works.kinetic << " + strain " << works.stored
            << " + absorbed " << std::abs(work(WorkKind::absorbed))
            << std::scientific << std::setprecision(1) << "; out of balance "
            << (balance < 1e-10 ? 0. : balance) << std::endl;
}



// @sect3{One run}
void
run(const Base base)
{
  MeshParameters<dim> box;
  box.lower_corner = Point<dim>(0, 0);
  box.upper_corner = Point<dim>(width, length);
  box.cell_size    = width;
  const BackgroundMesh<dim> mesh(box, MPI_COMM_WORLD);
  GridSpace<dim>            space(mesh, /* degree = */ 1);

  const auto  column = make_box<dim>(box.lower_corner, box.upper_corner);
  PointFields fields;
  Motion<dim>::request_fields(VelocityTransfer(), fields);
  PointSet<dim> points(mesh, fields);
  seed_bodies({{"column", column}},
              CellSeeder<dim>(2, PointLayout::gauss),
              points);
  CellBasis<dim, 1> basis(space, points);
  State<dim>        state(
    space,
    points,
    basis,
    {std::make_shared<LinearElastic>(young_modulus, poisson_ratio, density)},
    MeshAfterStep::keep);

  // What makes it dynamic. The time integrator is a handful of coefficients;
  // ours is the average acceleration. The motion is the velocities and
  // accelerations. Our nodes stay with the material and keep theirs; points
  // have fields to show them. Where points move through the mesh they carry
  // them, and the transfer says how.
  Motion<dim> motion(state,
                     points,
                     TimeIntegrator::newmark(/* beta = */ 0.25,
                                             /* gamma = */ 0.5),
                     VelocityTransfer(),
                     /* lumped_mass = */ false);

  // The equations of step-1, with inertia. An absorbing boundary is one term
  // more.
  const auto                         supports = make_supports(base, mesh);
  Loads<dim>                         loads    = make_loads(mesh);
  std::vector<ImplicitBoundary<dim>> no_boundaries;
  AbsorbingBoundary<dim>             dashpots = make_absorbing_base();
  Terms<dim>                         terms    = make_terms(no_boundaries,
                                supports,
                                loads,
                                /* fictitious_stiffness = */ 0.,
                                /* inertia = */ true);
  if (base == Base::absorbing)
    terms.push_back(std::make_unique<AbsorbingTerm<dim>>(dashpots));
  MechanicsSystem<dim> system(state, std::move(terms), {"column"});
  system.set_motion(&motion);

  // The column is at rest, and the pulse begins with nothing, so there are no
  // accelerations at the start either. (A load that is there at once wants
  // MechanicsSystem::forces_and_mass() and Motion::set_accelerations().)
  motion.start(
    [](const unsigned int, const Point<dim> &) { return Tensor<1, dim>(); });

  // The loop is that of step-1. t is a time now.
  Newton       newton{NewtonParameters()};
  LinearSolver linear_solver(LinearSolverParameters(), dim);
  for (unsigned int step = 0; step < n_steps; ++step)
    {
      const double t_start = end_time * step / n_steps;
      const double t_end   = end_time * (step + 1) / n_steps;

      LA::Vector increment;
      system.begin_step(t_start);
      system.set_target(t_end);
      const NewtonReport report =
        newton.solve(system, linear_solver, increment);
      AssertThrow(report.converged(), ExcMessage(report.message));

      system.accept(increment);
      if ((step + 1) % (n_steps / n_lines) == 0)
        print_middle(base, look_at_middle(points), t_end);
    }
  print_energy(motion.works());
}



// @sect3{The program}
int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const Base base : {Base::fixed, Base::absorbing})
    {
      if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
        std::cout << (base == Base::fixed ? "fixed base" : "absorbing base")
                  << "\n    t  settlement    exact     stress    exact"
                  << std::endl;
      run(base);
    }
}
