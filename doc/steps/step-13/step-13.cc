// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// New is the contact with the wall; the rest is that of step-11.
#include <moraine/assembly/contact_term.h>
#include <moraine/assembly/mechanics_system.h>
#include <moraine/basis/gimp_basis.h>
#include <moraine/boundary/contact_boundary.h>
#include <moraine/geometry/carried_places.h>
#include <moraine/geometry/shapes.h>
#include <moraine/material/mohr_coulomb.h>
#include <moraine/mesh/background_mesh.h>
#include <moraine/mesh/grid_space.h>
#include <moraine/points/bodies.h>
#include <moraine/solver/linear_solver.h>
#include <moraine/solver/newton.h>
#include <moraine/state/state.h>
#include <moraine/time/time_control.h>

#include <deal.II/base/mpi.h>

#include <cmath>
#include <iomanip>
#include <iostream>
#include <limits>
#include <memory>

using namespace dealii;
using namespace moraine;

// @sect3{The wall}
//
// A rigid wall, 5 m high, holds level ground and then tilts about its foot,
// away from the ground, until its top has moved by 40 mm. (m, kPa, t)
//
//         ^ y
//       5 o-----------------------------o
//    <-  /|                             |
//       / | wall      ground            |
//      /  |                             |
//     o   o-----------------------------o---> x
//         0                            14
constexpr int          dim       = 2;
constexpr double       height    = 5;
constexpr double       length    = 14;
constexpr double       mesh_size = 0.5;
constexpr double       top_moves = 0.04;
constexpr unsigned int n_steps   = 20;
constexpr double       density   = 2;
constexpr double       gravity   = 10;
constexpr double       gamma_    = density * gravity;

// Dry sand and undrained clay, as stiff as each other.
constexpr double phi   = 30; // degrees
constexpr double delta = 15; // of the rough wall, degrees
constexpr double s_u   = 10;



std::ostream &
root_output()
{
  static std::ostream nothing(nullptr);
  return Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0 ? std::cout :
                                                                 nothing;
}



// K0 is the ratio of the horizontal to the vertical stress before the wall
// moves.
struct Soil
{
  std::shared_ptr<const Material> material;
  double                          K0;
};



Soil
make_sand()
{
  SoilParameters sand;
  sand.elasticity     = {20e3, 0.3, density};
  sand.friction_angle = {{0., phi}};
  sand.dilation_angle = {{0., phi}};
  return {std::make_shared<MohrCoulomb>(sand), 0.5};
}



// With cracks the clay bears no tension.
Soil
make_clay(const bool cracks)
{
  SoilParameters clay;
  clay.elasticity       = {20e3, 0.49, density};
  clay.cohesion         = {{0., s_u}};
  clay.tensile_strength = {
    {0., cracks ? 0. : std::numeric_limits<double>::infinity()}};
  return {std::make_shared<MohrCoulomb>(clay), 1};
}



// @sect3{Contact}
//
// Three things make up the contact with a rigid surface:
//
// - *Where*: the surface and its motion, and the rim of the body that may touch
//   it. The material carries the places of the rim, so that a gap is known
//   after body and surface have parted, and a later touch is seen.
// - *Law*: the traction that the surface lets through. It presses, or it does
//   not touch; along the surface it bears at most mu times the pressure. With
//   separates = false it also pulls: the roller of step-3, with friction.
// - *Enforcement*: passes of the augmented Lagrangian, with c_n = factor/h
//   (lambda + 2 mu); 4/(3 0.05) is the default of scenes.
ContactBoundary<dim>
make_wall(const ShapePointer<dim> &ground, const ContactLaw &law)
{
  // The ground is on the left of the way along the wall.
  const auto wall =
    make_flat_face<dim>({Point<dim>(0, height + 1), Point<dim>(0, -1)});
  const double angle = std::atan(top_moves / height) * 180 / numbers::PI;
  const RigidMotion<dim> tilts(
    {},
    [angle](const double t) { return angle * t; },
    /* centre = */ Point<dim>());
  EnforcementParameters passes;
  passes.enforcement = "augmented Lagrangian";
  passes.band_width  = 0.05;
  return ContactBoundary<dim>(
    "wall",
    wall,
    tilts,
    [rim = ground->rim()](const BackgroundMesh<dim> &mesh,
                          const unsigned int /* body */) {
      return places_on<dim>(*rim, mesh, nullptr, Spacing::through_mesh);
    },
    law,
    passes.enforcement_of());
}



// @sect3{The other sides}
//
// Rough firm ground below; far away a smooth side.
std::vector<GridCondition<dim>>
make_supports(const BackgroundMesh<dim> &mesh)
{
  std::vector<GridCondition<dim>> supports(2);
  for (unsigned int i = 0; i < 2; ++i)
    {
      supports[i].name         = i == 0 ? "right" : "bottom";
      supports[i].side         = mesh.boundary_id(supports[i].name, "step-13");
      supports[i].component    = {{true, i == 1}};
      supports[i].displacement = [](const Point<dim> &, const double) {
        return Tensor<1, dim>();
      };
    }
  return supports;
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



// @sect3{The start}
//
// The ground begins with its geostatic stress. Contact carries tractions, and
// begins with those that are in equilibrium with this stress: sigma n, on the
// places of the rim that touch the wall.
void
set_geostatic_stress(const PointSet<dim> &points,
                     const double         K0,
                     State<dim>          &state)
{
  for (unsigned int p = 0; p < points.n_local(); ++p)
    {
      SymmetricTensor<2, 3> stress;
      stress[1][1] = -gamma_ * (height - points.position(p)[1]);
      stress[0][0] = stress[2][2] = K0 * stress[1][1];
      state.set_initial_stress(p, stress);
    }
}



void
set_tractions_at_rest(const double K0, ContactBoundary<dim> &wall)
{
  const auto                 &places = wall.places_of_rim().places();
  std::vector<Tensor<1, dim>> tractions(places.size());
  for (unsigned int k = 0; k < places.size(); ++k)
    if (wall.touches(k))
      tractions[k][0] = K0 * gamma_ * (height - places[k].x[1]);
  wall.set_tractions(tractions);
}



// @sect3{The wall gives way}
//
// The force of the wall on the ground, and the height over which they
// touch.
struct Reading
{
  double push, lift, touches;
};



// The ground sinks beside the wall as the wall gives way. Small strain and
// points that stay where they are (keep) will do: 40 mm are a twelfth of a
// cell. Returns the readings after each step.
std::vector<Reading>
give_way(const Soil &soil, const ContactLaw &law)
{
  MeshParameters<dim> box;
  box.lower_corner = Point<dim>(-1, 0);
  box.upper_corner = Point<dim>(length, height + 1);
  box.cell_size    = mesh_size;
  const BackgroundMesh<dim> mesh(box, MPI_COMM_WORLD);
  GridSpace<dim>            space(mesh, /* degree = */ 1);

  PointFields fields;
  GimpBasis<dim>::request_fields(fields, DomainUpdate::frozen);
  StateFields<dim>(fields, StrainMeasure::small, {soil.material});
  PointSet<dim>         points(mesh, fields);
  const CellSeeder<dim> seeder(2, PointLayout::equal);
  const auto            ground =
    make_box<dim>(Point<dim>(0, 0), Point<dim>(length, height));
  seed_bodies({{"ground", ground}}, seeder, points);
  GimpBasis<dim> basis(space, points, seeder);
  basis.initialise_points(points);
  State<dim> state(space,
                   points,
                   basis,
                   {soil.material},
                   MeshAfterStep::keep,
                   StrainMeasure::small,
                   PointWeights::volumes,
                   VolumetricStrain::cell_mean_with_shear);
  set_geostatic_stress(points, soil.K0, state);

  // Contact is one more term of the equations. Everything else that holds and
  // drives the ground is as it was.
  ContactBoundary<dim>               wall     = make_wall(ground, law);
  const auto                         supports = make_supports(mesh);
  Loads<dim>                         weight   = make_weight();
  std::vector<ImplicitBoundary<dim>> no_boundaries;
  Terms<dim>              terms = make_terms(no_boundaries, supports, weight);
  const std::vector<bool> bodies_present{true};
  terms.push_back(std::make_unique<ContactTerm<dim>>(wall, bodies_present));
  const std::vector<std::string> names{"ground"};
  MechanicsSystem<dim>           system(state, std::move(terms), names);

  // The first call finds the places of the rim, the second one gathers them
  // with the tractions that they carry.
  system.begin_step(0);
  set_tractions_at_rest(soil.K0, wall);

  Newton         newton{NewtonParameters()};
  LinearSolver   linear_solver(LinearSolverParameters(), dim);
  TimeParameters steps;
  steps.n_steps = n_steps;
  TimeControl time(steps);

  std::vector<Reading> readings;
  while (!time.finished())
    {
      LA::Vector increment;
      system.begin_step(time.time());
      time.next();
      system.set_target(time.trial_time());
      const auto report = newton.solve(system, linear_solver, increment);
      if (!report.converged())
        {
          AssertThrow(time.reject(report.message), ExcMessage(time.message()));
          continue;
        }
      time.accept(report.iterations);
      const BoundaryReport<dim> of_wall = system.accept(increment).back();
      if (time.at_step_end())
        readings.push_back(
          {of_wall.reaction[0], of_wall.reaction[1], of_wall.contact->area});
    }
  return readings;
}



// @sect3{What is expected}
//
// Sand, smooth wall (Rankine): K gamma H^2/2 with K = tan^2(45 - phi/2). On a
// rough wall the sand that slides down is held up; Coulomb's wedge gives
//
//   K = [cos(phi) / (1 + sqrt(sin(phi + delta) sin(phi) / cos(delta)))]^2
//
// for the normal part.
double
coulomb(const double friction_angle, const double wall_angle)
{
  const double f    = friction_angle * numbers::PI / 180;
  const double d    = wall_angle * numbers::PI / 180;
  const double root = std::sqrt(std::sin(f + d) * std::sin(f) / std::cos(d));
  return std::pow(std::cos(f) / (1 + root), 2) * gamma_ * height * height / 2;
}



void
print_sand(const std::vector<Reading> &smooth,
           const std::vector<Reading> &rough)
{
  root_output() << std::setprecision(0)
                << "sand: top [mm]   smooth [kN/m]   rough: normal   shear"
                << std::endl;
  for (unsigned int i = 3; i < n_steps; i += 4)
    root_output() << std::setw(14) << 1000 * top_moves * (i + 1) / n_steps
                  << std::setw(16) << smooth[i].push << std::setw(16)
                  << rough[i].push << std::setw(8) << rough[i].lift
                  << std::endl;
  root_output() << "Rankine" << std::setw(23) << coulomb(phi, 0) << ", Coulomb"
                << std::setw(7) << coulomb(phi, delta) << std::setw(8)
                << coulomb(phi, delta) * std::tan(delta * numbers::PI / 180)
                << std::endl;
}



// Clay, smooth wall: gamma H^2/2 - 2 s_u H, of which the upper 2 s_u/gamma are
// tension. If neither clay nor wall bear it, gamma (H - 2 s_u/gamma)^2/2 is
// left; if the wall alone does not, it bears something in between.
void
print_clay(const std::vector<Reading> &pulls,
           const std::vector<Reading> &lets_go,
           const std::vector<Reading> &cracks)
{
  root_output() << std::setprecision(1)
                << "clay: top [mm]   pulls   lets go   touches [m]   cracks   "
                   "touches [m]"
                << std::endl;
  for (unsigned int i = 3; i < n_steps; i += 4)
    root_output() << std::setw(14) << 1000 * top_moves * (i + 1) / n_steps
                  << std::setw(8) << pulls[i].push << std::setw(10)
                  << lets_go[i].push << std::setw(14) << lets_go[i].touches
                  << std::setw(9) << cracks[i].push << std::setw(14)
                  << cracks[i].touches << std::endl;
  const double crack = 2 * s_u / gamma_;
  root_output() << "bounds" << std::setw(16)
                << gamma_ * height * height / 2 - 2 * s_u * height
                << std::setw(33) << gamma_ * std::pow(height - crack, 2) / 2
                << std::setw(14) << height - crack << std::endl;
}



int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  root_output() << std::fixed;

  ContactLaw smooth, rough, pulls;
  rough.friction  = std::tan(delta * numbers::PI / 180);
  pulls.separates = false;
  print_sand(give_way(make_sand(), smooth), give_way(make_sand(), rough));
  print_clay(give_way(make_clay(false), pulls),
             give_way(make_clay(false), smooth),
             give_way(make_clay(true), smooth));
}
