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

#include <cmath>
#include <iomanip>
#include <iostream>

using namespace dealii;
using namespace moraine;

// @sect3{What the laboratory found}
//
// Three drained triaxial tests of sand; the numbers are made up. First the cell
// pressure sigma_3 and the largest q = sigma_1 - sigma_3. (m, kPa, t)
const std::vector<Point<2>> peaks{{50, 97}, {100, 208}, {200, 399}};

// Then the test at 100 kPa after its peak: the strain along the axis and that
// of the volume, in per cent, compression positive.
constexpr double            pressure_of_volumes = 100;
const std::vector<Point<2>> volumes{{0.8, -0.61},
                                    {1.2, -1.47},
                                    {1.6, -2.21},
                                    {2.0, -3.03}};

// The limit load does not depend on the stiffness.
constexpr double young_modulus = 50e3;
constexpr double poisson_ratio = 0.3;
constexpr double density       = 1.8;

// @sect3{The footing}
//
// A rough strip of 2 m on the ground. K0 is the horizontal stress of the ground
// over the vertical one; N_gamma is by slip lines, for phi = psi = 30 degrees
// (Martin 2005).
constexpr int    dim            = 2;
constexpr double width          = 2;
constexpr double depth          = 4;
constexpr double half_of_ground = 6;
constexpr double mesh_size      = 2. / 7;
constexpr double gravity        = 10;
constexpr double K0             = 0.5;
constexpr double N_gamma        = 14.754;
constexpr double settlement     = 0.08;



std::ostream &
root_output()
{
  static std::ostream nothing(nullptr);
  return Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0 ? std::cout :
                                                                 nothing;
}



// @sect3{A line through points}
//
// The line from which the points differ least along y: its value at zero, and
// its slope.
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
// At the peaks, the radii of Mohr's circles lie on a line over their centres,
//
//   (sigma_1 - sigma_3)/2 = c cos(phi) + sin(phi) (sigma_1 + sigma_3)/2 .
//
// After the peak only plastic strain grows, and the dilation angle follows from
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



// Such tests tell no more than whole kPa and degrees; less than half a kPa is
// scatter. By default the sand bears no tension.
std::shared_ptr<const Material>
make_sand(const Strength &measured)
{
  SoilParameters sand;
  sand.elasticity     = {young_modulus, poisson_ratio, density};
  sand.cohesion       = {{0., std::round(measured.c)}};
  sand.friction_angle = {{0., std::round(measured.phi)}};
  sand.dilation_angle = {{0., std::round(measured.psi)}};
  return std::make_shared<MohrCoulomb>(sand);
}



// @sect3{The same tests of one point}
//
// A leg of a test prescribes six components, in the order xx, yy, zz, xy, xz,
// yz. Here the stress at the sides stays what it was, the strain along z goes
// to its value, and there is no shear. In the library tension is positive.
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
// Half of the ground is enough. The footing is rough: nodes under it go down
// and not aside. It ends in the middle of a cell, because the last node that it
// holds works for half a cell more.
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



// The weight is there from the start, and so is the stress that carries it.
// Sand without cohesion has no strength but by this stress.
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



// @sect3{The footing goes down}
//
// Dilation ties the volume to the shear at each point, which cells of degree 1
// cannot follow everywhere: they get the mean of most of their strain. The
// ground keeps its shape (keep), as in the formula.
//
// It returns the largest force on both halves.
double
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
  double      largest = 0;
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
      largest            = std::max(largest, force);
      if (time.at_step_end() && time.n_completed_steps() % 5 == 0)
        root_output() << std::setw(15) << 1000 * settlement * time.time()
                      << std::setw(15) << force << std::endl;
    }
  return largest;
}



int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  root_output() << std::fixed << std::setprecision(1);

  const Strength measured = measured_strength();
  root_output() << "c = " << measured.c << " kPa, phi = " << measured.phi
                << ", psi = " << measured.psi << std::endl;
  const auto sand = make_sand(measured);
  compare_tests(sand);

  // The formula for the force on a strip of width B without cohesion and
  // surcharge.
  const double found   = press_footing(sand);
  const double formula = density * gravity * width * width / 2 * N_gamma;
  root_output() << "largest force " << found << ", gamma B^2/2 N_gamma "
                << formula << ", ratio " << std::setprecision(3)
                << found / formula << std::endl;
}
