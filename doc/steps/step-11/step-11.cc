// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// New are the soil and the test of one point; the rest is that of step-9.
#include <moraine/assembly/mechanics_system.h>
#include <moraine/basis/gimp_basis.h>
#include <moraine/geometry/shapes.h>
#include <moraine/material/material_test.h>
#include <moraine/material/mohr_coulomb.h>
#include <moraine/mesh/background_mesh.h>
#include <moraine/mesh/grid_space.h>
#include <moraine/points/bodies.h>
#include <moraine/solver/linear_solver.h>
#include <moraine/solver/newton.h>
#include <moraine/state/state.h>
#include <moraine/time/time_control.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/polynomial.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>

using namespace dealii;
using namespace moraine;

// @sect3{What the laboratory measured}
//
// Three drained triaxial tests of sand; the numbers are made up. First the cell
// pressure sigma_3 and the largest q = sigma_1 - sigma_3. (m, kPa, t)
const std::vector<Point<2>> peaks{{50, 97}, {100, 208}, {200, 399}};

// Then the axial and the volumetric strain of the test at 100 kPa after its
// peak, in per cent, compression positive.
constexpr double            pressure_of_volumes = 100;
const std::vector<Point<2>> volumes{{0.8, -0.61},
                                    {1.2, -1.47},
                                    {1.6, -2.21},
                                    {2.0, -3.03}};

// The stiffness sets the settlement at which the sand fails, not the load.
constexpr double young_modulus = 50e3;
constexpr double poisson_ratio = 0.3;
constexpr double density       = 1.8;

// @sect3{The footing}
//
// A rough strip, 2 m wide, on the surface of the ground. K0 is the ratio of the
// horizontal to the vertical stress in the ground.
constexpr int    dim            = 2;
constexpr double width          = 2;
constexpr double depth          = 4;
constexpr double half_of_ground = 6;
constexpr double mesh_size      = 2. / 7;
constexpr double gravity        = 10;
constexpr double K0             = 0.5;
constexpr double settlement     = 0.08;

// Exact N_gamma of a rough strip for some friction angles, by slip lines, for
// psi = phi (Martin 2005).
const std::vector<Point<2>> exact_N_gamma{{20, 2.83894},
                                          {25, 6.49131},
                                          {30, 14.7543},
                                          {40, 85.5656}};



std::ostream &
root_output()
{
  static std::ostream nothing(nullptr);
  return Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0 ? std::cout :
                                                                 nothing;
}



// @sect3{A line through points}
//
// Least squares: the value of the line at zero, and its slope.
std::pair<double, double>
fit_line(const std::vector<Point<2>> &points)
{
  double x = 0, y = 0, xx = 0, xy = 0;
  for (const Point<2> &point : points)
    {
      x += point[0] / points.size();
      y += point[1] / points.size();
    }
  for (const Point<2> &point : points)
    {
      xx += (point[0] - x) * (point[0] - x);
      xy += (point[0] - x) * (point[1] - y);
    }
  return {y - xy / xx * x, xy / xx};
}



// @sect3{From the tests to the strength}
//
// At failure, Mohr-Coulomb relates the radius of Mohr's circle to its centre,
//
//   (sigma_1 - sigma_3)/2 = c cos(phi) + sin(phi) (sigma_1 + sigma_3)/2 .
//
// After the peak the stress is constant, all further strain is plastic, and
//
//   d eps_v / d eps_1 = -2 sin(psi) / (1 - sin(psi)) .
struct Strength
{
  double c, phi, psi; // kPa, degrees
};



Strength
measured_strength()
{
  std::vector<Point<2>> circles;
  for (const Point<2> &peak : peaks)
    circles.emplace_back(peak[0] + peak[1] / 2, peak[1] / 2);
  const auto [at_zero, sin_phi] = fit_line(circles);
  const double slope            = fit_line(volumes).second;
  const double phi              = std::asin(sin_phi);
  const double psi              = std::asin(slope / (slope - 2));
  return {at_zero / std::cos(phi),
          phi * 180 / numbers::PI,
          psi * 180 / numbers::PI};
}



// The scatter of the tests allows whole kPa and degrees, no more. Sand with psi
// above phi would gain energy as it flows; the library rejects it.
Strength
rounded(const Strength &measured)
{
  const double phi = std::round(measured.phi);
  return {std::round(measured.c), phi, std::min(phi, std::round(measured.psi))};
}



// By default the sand bears no tension.
std::shared_ptr<const Material>
make_sand(const Strength &strength)
{
  SoilParameters sand;
  sand.elasticity     = {young_modulus, poisson_ratio, density};
  sand.cohesion       = {{0., strength.c}};
  sand.friction_angle = {{0., strength.phi}};
  sand.dilation_angle = {{0., strength.psi}};
  return std::make_shared<MohrCoulomb>(sand);
}



// @sect3{The same tests at one point}
//
// A leg of a test prescribes six components of stress or strain, in the order
// xx, yy, zz, xy, xz, yz. Here the stresses xx and yy remain at the cell
// pressure, the strain zz goes to its value, and the shear strains remain zero.
// In the library tension is positive.
void
compress(MaterialTest &test, const double strain)
{
  MaterialTestLeg leg;
  for (unsigned int i = 0; i < 6; ++i)
    (i < 2 ? leg.sums[i].of_stress : leg.sums[i].of_strain)[i] = 1;
  leg.values[2] = -strain;
  leg.n_steps   = 10;
  test.lead(leg, [] {});
}



void
compare_tests(const std::shared_ptr<const Material> &sand)
{
  const auto start = [&](const double pressure) {
    return MaterialTest(sand,
                        StrainMeasure::small,
                        -pressure * unit_symmetric_tensor<3>());
  };
  root_output() << "sigma_3 [kPa]   largest q [kPa]   Mohr-Coulomb\n";
  for (const Point<2> &peak : peaks)
    {
      MaterialTest test = start(peak[0]);
      compress(test, 0.02);
      root_output() << std::setw(13) << peak[0] << std::setw(18) << peak[1]
                    << std::setw(15)
                    << test.stress()[0][0] - test.stress()[2][2] << std::endl;
    }
  root_output() << "eps_1 [%]       eps_v [%]         Mohr-Coulomb\n";
  MaterialTest test = start(pressure_of_volumes);
  for (const Point<2> &volume : volumes)
    {
      compress(test, volume[0] / 100);
      const SixNumbers &strain = test.strain();
      root_output() << std::setprecision(2) << std::setw(13) << volume[0]
                    << std::setw(18) << volume[1] << std::setw(15)
                    << -100 * (strain[0] + strain[1] + strain[2]) << std::endl;
    }
}



// @sect3{What acts on the ground}
//
// By symmetry we compute the right half. The footing is rough: the nodes under
// it move down and not sideways. Its edge is in the middle of a cell, because
// the last node under it also carries half of the next cell.
std::vector<GridCondition<dim>>
make_conditions(const BackgroundMesh<dim> &mesh)
{
  std::vector<GridCondition<dim>> conditions;
  for (const std::string name : {"left", "right", "bottom", "footing"})
    {
      const bool         is_footing = name == "footing";
      GridCondition<dim> condition;
      condition.name      = name;
      condition.component = {{true, is_footing || name == "bottom"}};
      if (is_footing)
        condition.region = BoundingBox<dim>({{0, 0}, {width / 2, 0}});
      else
        condition.side = mesh.boundary_id(name, "step-11");
      condition.displacement = [=](const Point<dim> &, const double t) {
        return Tensor<1, dim>(Point<dim>(0, is_footing ? -settlement * t : 0));
      };
      conditions.push_back(condition);
    }
  return conditions;
}



// The weight acts from the start, and the initial stress is in equilibrium with
// it. Without this stress, sand without cohesion would have no strength.
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



void
set_geostatic_stress(const PointSet<dim> &points, State<dim> &state)
{
  for (unsigned int p = 0; p < points.n_local(); ++p)
    {
      SymmetricTensor<2, 3> stress;
      stress[1][1] = density * gravity * points.position(p)[1];
      stress[0][0] = stress[2][2] = K0 * stress[1][1];
      state.set_initial_stress(p, stress);
    }
}



// @sect3{The footing is pressed down}
//
// Mohr-Coulomb ties the change of volume to the shear strain. Cells of degree 1
// lock on this, also if only the volumetric strain is averaged over the cell;
// cell_mean_with_shear averages most of the shear strain, too. The mesh and the
// points stay where they are (keep): the formula is for the undeformed ground.
//
// Returns the force on the whole footing after each step.
std::vector<double>
press_footing(const std::shared_ptr<const Material> &sand)
{
  MeshParameters<dim> box;
  box.lower_corner = Point<dim>(0, -depth);
  box.upper_corner = Point<dim>(half_of_ground, mesh_size);
  box.cell_size    = mesh_size;
  const BackgroundMesh<dim> mesh(box, MPI_COMM_WORLD);
  GridSpace<dim>            space(mesh, /* degree = */ 1);

  PointFields fields;
  GimpBasis<dim>::request_fields(fields, DomainUpdate::frozen);
  StateFields<dim>(fields, StrainMeasure::small, {sand});
  PointSet<dim>         points(mesh, fields);
  const CellSeeder<dim> seeder(2, PointLayout::equal);
  const auto            ground =
    make_box<dim>(Point<dim>(0, -depth), Point<dim>(half_of_ground, 0));
  seed_bodies({{"ground", ground}}, seeder, points);
  GimpBasis<dim> basis(space, points, seeder);
  basis.initialise_points(points);
  State<dim> state(space,
                   points,
                   basis,
                   {sand},
                   MeshAfterStep::keep,
                   StrainMeasure::small,
                   PointWeights::volumes,
                   VolumetricStrain::cell_mean_with_shear);
  set_geostatic_stress(points, state);

  const auto                         conditions = make_conditions(mesh);
  Loads<dim>                         weight     = make_weight();
  std::vector<ImplicitBoundary<dim>> no_boundaries;
  MechanicsSystem<dim>               system(state,
                              make_terms(no_boundaries, conditions, weight),
                              {"ground"});

  Newton         newton{NewtonParameters()};
  LinearSolver   linear_solver(LinearSolverParameters(), dim);
  TimeParameters steps;
  steps.n_steps = 40;
  TimeControl time(steps);

  std::vector<double> forces;
  root_output() << "settlement [mm]   force [kN/m]\n" << std::setprecision(1);
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
      const double force = -2 * system.accept(increment).back().reaction[1];
      if (!time.at_step_end())
        continue;
      forces.push_back(force);
      if (forces.size() % 5 == 0)
        root_output() << std::setw(15) << 1000 * settlement * time.time()
                      << std::setw(15) << force << std::endl;
    }
  return forces;
}



// @sect3{The formula}
//
// Between the angles of the table we interpolate the logarithm of N_gamma.
double
N_gamma(const double phi)
{
  AssertThrow(phi >= exact_N_gamma.front()[0] && phi <= exact_N_gamma.back()[0],
              ExcMessage("the table of N_gamma does not contain this phi"));
  std::vector<Point<1>> angles;
  for (const Point<2> &exact : exact_N_gamma)
    angles.emplace_back(exact[0]);
  const auto basis = Polynomials::generate_complete_Lagrange_basis(angles);
  double     sum   = 0;
  for (unsigned int i = 0; i < basis.size(); ++i)
    sum += std::log(exact_N_gamma[i][1]) * basis[i].value(phi);
  return std::exp(sum);
}



// The force on a strip of width B without surcharge is
//
//   Q = B (c N_c + gamma B/2 N_gamma) ,
//
// exact for c = 0 and psi = phi. N_c is Prandtl's.
double
bearing_capacity(const Strength &strength)
{
  const double phi = strength.phi * numbers::PI / 180;
  const double N_q = std::exp(numbers::PI * std::tan(phi)) *
                     std::pow(std::tan(numbers::PI / 4 + phi / 2), 2);
  const double N_c = (N_q - 1) / std::tan(phi);
  return width * (strength.c * N_c +
                  density * gravity * width / 2 * N_gamma(strength.phi));
}



int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  root_output() << std::fixed << std::setprecision(1);

  const Strength measured = measured_strength();
  root_output() << "c = " << measured.c << " kPa, phi = " << measured.phi
                << ", psi = " << measured.psi << std::endl;
  const Strength strength = rounded(measured);
  const double   formula  = bearing_capacity(strength);
  const auto     sand     = make_sand(strength);
  compare_tests(sand);

  // On a plateau, the force hardly grows in the last quarter of the way.
  const std::vector<double> forces = press_footing(sand);
  const double              before = forces[forces.size() * 3 / 4 - 1];
  root_output() << "force at the end " << forces.back() << ", "
                << 100 * (forces.back() / before - 1)
                << " % more than at 3/4 of the settlement\n"
                << "formula " << formula << " for psi = phi = " << strength.phi
                << ", ratio " << std::setprecision(3) << forces.back() / formula
                << std::endl;
}
