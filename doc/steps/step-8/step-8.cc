// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// Nothing but the basis is new since step-7.
#include <moraine/assembly/absorbing_term.h>
#include <moraine/assembly/mechanics_system.h>
#include <moraine/basis/gimp_basis.h>
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
#include <deal.II/base/numbers.h>

#include <cmath>
#include <iomanip>
#include <iostream>

using namespace dealii;
using namespace moraine;

// An embankment of 12 m on rock, which is three times as stiff to a wave and
// more. (m, kPa, t, s)
constexpr int          dim           = 2;
constexpr double       young_modulus = 100e3;
constexpr double       poisson_ratio = 0.3;
constexpr double       density       = 2;
constexpr double       gravity       = 9.81;
constexpr double       step_size     = 0.01;
constexpr unsigned int n_steps       = 200;
constexpr unsigned int n_lines       = 10;

// Density and the speeds of both waves in the rock.
constexpr AbsorbingLaw::Medium rock{2.4, 1200, 600};



// @sect3{The earthquake}
//
// The velocity of the wave that comes up through the rock, in its simplest
// form: Ricker's wavelet of 3 Hz. A bare outcrop of the rock would move by
// twice that, as the wave comes back from it; records of earthquakes mostly are
// those of an outcrop.
double
incident_velocity(const double t)
{
  const double x = numbers::PI * 3 * (t - 0.4);
  return 0.1 * (1 - 2 * x * x) * std::exp(-x * x);
}



constexpr double largest_velocity_of_outcrop = 0.2;



// @sect3{What acts}
//
// The rock has two faces: at first nodes are held, then it is a compliant base,
// dashpots with the impedance of the rock that the wave comes through.
GridCondition<dim>
make_fixed_rock(const BackgroundMesh<dim> &mesh)
{
  GridCondition<dim> fixed;
  fixed.name = "rock";
  fixed.side = mesh.boundary_id("bottom", "step-8");
  fixed.component.fill(true);
  fixed.displacement = [](const Point<dim> &, const double) {
    return Tensor<1, dim>();
  };
  return fixed;
}



AbsorbingBoundary<dim>
make_compliant_rock(const BackgroundMesh<dim> &mesh)
{
  AbsorbingLaw law;
  law.medium = rock;
  return AbsorbingBoundary<dim>(
    "rock",
    [side = mesh.boundary_id("bottom", "step-8")](const GridSpace<dim> &space,
                                                  const double) {
      return places_on_side(space.mesh(), side);
    },
    law,
    [](const Point<dim> &, const double t) {
      return Tensor<1, dim>(Point<dim>(incident_velocity(t), 0));
    },
    /* on_side = */ true);
}



Loads<dim>
make_weight()
{
  Loads<dim> loads;
  loads.body_forces.push_back({"weight",
                               [](const Point<dim> &, const double) {
                                 return Tensor<1, dim>(Point<dim>(0, -gravity));
                               },
                               /* times_density = */ true,
                               /* acts_on = */ {true}});
  return loads;
}



// @sect3{What we print}
//
// The displacement of the point that was nearest to a place at the start.
// Points have numbers that they keep.
class Gauge
{
public:
  Gauge(const PointSet<dim> &points, const Point<dim> &place)
    : points(points)
  {
    double       nearest = 1e100;
    unsigned int found   = numbers::invalid_unsigned_int;
    for (unsigned int p = 0; p < points.n_local(); ++p)
      if (points.position(p).distance(place) < nearest)
        {
          nearest = points.position(p).distance(place);
          found   = points.id(p);
        }
    if (nearest > Utilities::MPI::min(nearest, MPI_COMM_WORLD))
      found = numbers::invalid_unsigned_int;
    id = Utilities::MPI::min(found, MPI_COMM_WORLD);
  }

  Tensor<1, dim>
  displacement() const
  {
    Tensor<1, dim> u;
    for (unsigned int p = 0; p < points.n_local(); ++p)
      if (points.id(p) == id)
        for (unsigned int d = 0; d < dim; ++d)
          u[d] = points.values(p)[points.displacement_offset() + d];
    return Utilities::MPI::sum(u, MPI_COMM_WORLD);
  }

private:
  const PointSet<dim> &points;
  unsigned int         id;
};



std::ostream &
root_output()
{
  static std::ostream nothing(nullptr);
  return Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0 ? std::cout :
                                                                 nothing;
}



// Displacements, and where the energy is: in motion, in strain beyond that of
// the weight, and what came from the rock so far less what went back.
void
print_line(const double t,
           const double crest,
           const double base,
           const Works &works)
{
  root_output()
    << std::fixed << std::setprecision(1) << std::setw(4) << t
    << std::setprecision(2) << std::setw(12) << 1000 * crest << std::setw(11)
    << 1000 * base << std::setw(13) << works.kinetic << std::setw(13)
    << works.stored - works.stored_at_start << std::setw(16)
    << works.of_forces[static_cast<unsigned int>(WorkKind::absorbed)]
    << std::endl;
}



void
print_balance(const Works &works)
{
  const double balance = std::abs(works.out_of_balance()) / works.largest();
  root_output() << "lost between points and nodes " << std::setprecision(2)
                << works.lost_in_transfer << " kJ, energy out of balance "
                << std::scientific << std::setprecision(1)
                << (balance < 1e-10 ? 0. : balance) << std::endl;
}



// @sect3{A step}
//
// It is the same in both stages.
std::vector<BoundaryReport<dim>>
make_step(const double          t_start,
          const double          t_end,
          MechanicsSystem<dim> &system)
{
  Newton       newton{NewtonParameters()};
  LinearSolver linear_solver(LinearSolverParameters(), dim);
  LA::Vector   increment;
  system.begin_step(t_start);
  system.set_target(t_end);
  const NewtonReport report = newton.solve(system, linear_solver, increment);
  AssertThrow(report.converged(), ExcMessage(report.message));
  return system.accept(increment);
}



// @sect3{The first stage}
//
// Quasi-static: no inertia, no motion. In one step the weight is there; the
// points have moved by then, and a second step finds the balance where they are
// now.
void
settle(const std::vector<GridCondition<dim>> &conditions,
       Loads<dim>                            &weight,
       const Gauge                           &crest,
       MechanicsSystem<dim>                  &system)
{
  std::vector<ImplicitBoundary<dim>> no_boundaries;
  system.set_terms(make_terms(no_boundaries, conditions, weight));
  for (unsigned int step = 0; step < 2; ++step)
    {
      const double reaction = make_step(0, 0, system)[0].reaction[1];
      root_output() << "gravity, step " << step + 1 << ": the rock carries "
                    << std::fixed << std::setprecision(3) << reaction
                    << " kN, the crest is at " << std::setprecision(5)
                    << crest.displacement()[1] << " m" << std::endl;
    }
}



// @sect3{Between the stages}
//
// From now on points have inertia, and the rock is compliant. Dashpots hold
// nothing that is at rest, so the forces by which the rock held the embankment
// become tractions on its base, which stay. We ask for them while the fixed
// base is there, where the points are (no displacement from there), and hand
// them to the one that takes its place.
void
release(const GridSpace<dim>   &space,
        AbsorbingBoundary<dim> &compliant_rock,
        Loads<dim>             &weight,
        Motion<dim>            &motion,
        PointSet<dim>          &points,
        MechanicsSystem<dim>   &system)
{
  system.begin_step(0);
  system.set_target(0);
  const LA::Vector held = system.constraint_forces("rock", space.vector());

  std::vector<ImplicitBoundary<dim>> no_boundaries;
  Terms<dim>                         terms =
    make_terms(no_boundaries, {}, weight, 0., /* inertia = */ true);
  terms.push_back(std::make_unique<AbsorbingTerm<dim>>(compliant_rock));
  system.set_terms(std::move(terms));
  system.set_motion(&motion);
  system.begin_step(0);
  const double missed = system.hold("rock", held);
  AssertThrow(missed < 1e-6, ExcMessage("the base cannot hold the weight"));

  // All is at rest and in balance, and displacements count from here.
  motion.start(
    [](const unsigned int, const Point<dim> &) { return Tensor<1, dim>(); });
  points.reset_displacements();
}



// @sect3{The second stage}
//
// The largest velocity of the crest over that of an outcrop is what the
// embankment makes of the earthquake.
void
shake(const Gauge          &crest,
      const Gauge          &base,
      const Motion<dim>    &motion,
      MechanicsSystem<dim> &system)
{
  root_output() << "   t  crest [mm]  base [mm]  motion [kJ]  strain [kJ]  "
                   "from rock [kJ]"
                << std::endl;
  double largest = 0, largest_velocity = 0, before = 0;
  for (unsigned int step = 0; step < n_steps; ++step)
    {
      const double t_end = (step + 1) * step_size;
      make_step(step * step_size, t_end, system);
      const double now = crest.displacement()[0];
      largest          = std::max(largest, std::abs(now));
      largest_velocity =
        std::max(largest_velocity, std::abs(now - before) / step_size);
      before               = now;
      const double of_base = base.displacement()[0];
      if ((step + 1) % (n_steps / n_lines) == 0)
        print_line(t_end, now, of_base, motion.works());
    }
  root_output() << "the crest moves by up to " << std::setprecision(1)
                << 1000 * largest << " mm, at " << std::setprecision(3)
                << largest_velocity << " m/s, amplification "
                << std::setprecision(2)
                << largest_velocity / largest_velocity_of_outcrop << std::endl;
}



// @sect3{The program}
//
// Points move through the mesh here, and carry velocities and accelerations,
// for which they need fields. Of the schemes for the way to the nodes and back,
// the default is APIC; doc/topics/dynamics.md says why.
int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);

  MeshParameters<dim> box;
  box.lower_corner = Point<dim>(-1, 0);
  box.upper_corner = Point<dim>(45, 14);
  box.cell_size    = 1;
  const BackgroundMesh<dim> mesh(box, MPI_COMM_WORLD);
  GridSpace<dim>            space(mesh, /* degree = */ 1);

  const VelocityTransfer transfer{IntegratorParameters()};
  PointFields            fields;
  GimpBasis<dim>::request_fields(fields, DomainUpdate::frozen);
  Motion<dim>::request_fields(transfer, fields);
  PointSet<dim>         points(mesh, fields);
  const CellSeeder<dim> seeder(2, PointLayout::equal);
  seed_bodies({{"embankment",
                make_polygon<dim>({Point<dim>(0, 0),
                                   Point<dim>(44, 0),
                                   Point<dim>(26, 12),
                                   Point<dim>(18, 12)})}},
              seeder,
              points);
  GimpBasis<dim> basis(space, points, seeder);
  basis.initialise_points(points);
  State<dim> state(
    space,
    points,
    basis,
    {std::make_shared<LinearElastic>(young_modulus, poisson_ratio, density)},
    MeshAfterStep::reset);
  Motion<dim> motion(
    state, points, TimeIntegrator::newmark(0.25, 0.5), transfer, false);

  const std::vector<GridCondition<dim>> fixed_rock{make_fixed_rock(mesh)};
  AbsorbingBoundary<dim> compliant_rock = make_compliant_rock(mesh);
  Loads<dim>             weight         = make_weight();
  const Gauge            crest(points, Point<dim>(22.1, 12));
  const Gauge            base(points, Point<dim>(22.1, 0));

  MechanicsSystem<dim> system(state, {}, {"embankment"});
  settle(fixed_rock, weight, crest, system);
  release(space, compliant_rock, weight, motion, points, system);
  shake(crest, base, motion, system);
  print_balance(motion.works());
}
