// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// New are the water, and bodies that are taken out; the rest is that of step-9
// and step-11.
#include <moraine/assembly/mechanics_system.h>
#include <moraine/assembly/water_term.h>
#include <moraine/basis/gimp_basis.h>
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

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <memory>

using namespace dealii;
using namespace moraine;

// @sect3{The sketch}
//
// A slope of 2:1, 10 m high, on firm ground, beside a reservoir. (m, kPa, t)
//
//     10  o--------------o ~ ~ ~ ~ ~ ~ ~ ~ ~ ~ ~ ~ ~ ~
//         |                 `-.        reservoir
//      4  |       soil          `-o.
//      2  |                         \ `-o.
//         |                           \ 2  \1`-.
//      0  o----------------------------o-----o---o
//         0              12       24  28    30  32
constexpr int    dim           = 2;
constexpr double height        = 10;
constexpr double crest         = 12;
constexpr double toe           = 32;
constexpr double density       = 2;
constexpr double gravity       = 10;
constexpr double gamma_w       = 9.81; // unit weight of water
constexpr double weight_of_all = density * gravity * height * (crest + toe) / 2;

// Three bodies of one soil: the slope, and what will be dug at its toe in two
// stages, each with a face of 1:1.
std::vector<Body<dim>>
make_bodies()
{
  using Corners = std::vector<Point<2>>;
  const Corners slope{{0, 0}, {28, 0}, {24, 4}, {crest, height}, {0, height}};
  const Corners first{{30, 0}, {toe, 0}, {28, 2}};
  const Corners second{{28, 0}, {30, 0}, {28, 2}, {24, 4}};
  return {{"slope", make_polygon<dim>(slope)},
          {"toe 1", make_polygon<dim>(first)},
          {"toe 2", make_polygon<dim>(second)}};
}



std::ostream &
root_output()
{
  static std::ostream nothing(nullptr);
  return Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0 ? std::cout :
                                                                 nothing;
}



// c' = 10 kPa and tan(20 degrees) over a factor. The soil neither dilates nor
// bears tension.
std::shared_ptr<const Material>
soil_with_strength_over(const double factor)
{
  SoilParameters soil;
  soil.elasticity     = {100e3, 0.3, density};
  soil.cohesion       = {{0., 10.}};
  soil.friction_angle = {{0., 20.}};
  soil.dilation_angle = {{0., 0.}};
  return MohrCoulomb(soil).with_strength_over(factor);
}



// @sect3{Supports and weight}
//
// A smooth wall on the left, far away, and firm ground below. Weight and water
// grow while t goes from 0 to 1.
std::vector<GridCondition<dim>>
make_supports(const BackgroundMesh<dim> &mesh)
{
  std::vector<GridCondition<dim>> supports(2);
  for (unsigned int i = 0; i < 2; ++i)
    {
      supports[i].name         = i == 0 ? "left" : "bottom";
      supports[i].side         = mesh.boundary_id(supports[i].name, "step-12");
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
  const auto value = [](const Point<dim> &, const double t) {
    return Tensor<1, dim>(Point<dim>(0, -gravity * std::min(t, 1.)));
  };
  const std::vector<bool> acts_on(3, true);
  Loads<dim>              loads;
  loads.body_forces.push_back({"weight", value, true, acts_on});
  return loads;
}



// @sect3{The water}
//
// Heights are texts, as in a scene, and may depend on x, y and t: the phreatic
// line, below which the pore pressure p_w is hydrostatic, and the free level of
// the water outside, whose pressure is p_r. Without the second, the first holds
// outside, too.
WaterTexts
make_water(const std::string &level, const std::string &free_level = "")
{
  WaterTexts texts;
  texts.level       = level;
  texts.free_level  = free_level;
  texts.curve       = "min(t, 1)";
  texts.unit_weight = gamma_w;
  texts.section     = "step-12";
  return texts;
}



// From t = 1 to 2 the reservoir is emptied: slowly, so that the soil drains at
// the same time, or so fast that the water stays in the slope, up to its
// surface.
const std::string outside = "min(10, 20 - 10*t)";
const std::string ground  = "max(0, min(10, (32 - x)/2))";
const WaterTexts  slow    = make_water(outside);
const WaterTexts  fast =
  make_water("max(" + outside + ", " + ground + ")", outside);
const WaterTexts dry;



// @sect3{A slope}
//
// All that has to be known between steps. Points and mesh stay where they are
// (keep), and cells have the means of their strains, as in step-11.
using Soils = std::vector<std::shared_ptr<const Material>>;

struct Slope
{
  Slope(const double factor, const WaterTexts &texts);

  double
  advance(const double start, const double end, const unsigned int n_steps);

  void
  dig(const unsigned int body);

  const Soils                           soils;
  const BackgroundMesh<dim>             mesh;
  GridSpace<dim>                        space;
  PointSet<dim>                         points;
  const CellSeeder<dim>                 seeder;
  GimpBasis<dim>                        basis;
  const std::vector<GridCondition<dim>> supports;
  Loads<dim>                            weight;
  std::vector<ImplicitBoundary<dim>>    no_boundaries;
  WaterInBodies<dim>                    water;
  std::vector<bool>                     stays{true, true, true};
  std::unique_ptr<State<dim>>           state;
  std::unique_ptr<MechanicsSystem<dim>> system;
  std::vector<BoundaryReport<dim>>      reactions;
};



MeshParameters<dim>
make_box()
{
  MeshParameters<dim> box;
  box.lower_corner = Point<dim>(0, 0);
  box.upper_corner = Point<dim>(toe, height);
  box.cell_size    = 1;
  return box;
}



// Points carry the pressure of the water and the total stress, too.
PointFields
make_fields(const Soils &soils)
{
  PointFields fields;
  GimpBasis<dim>::request_fields(fields, DomainUpdate::frozen);
  StateFields<dim>(fields, StrainMeasure::small, soils);
  fields.request(FieldNames<dim>::pore_pressure);
  fields.request(FieldNames<dim>::total_stress);
  return fields;
}



// @sect3{The term of the water}
//
// Points carry effective stress. Water adds nodal forces,
//
//   f_a = sum_p v_p [(p_w - p_r) grad S_ap - grad p_r S_ap] :
//
// the pore pressure, which is part of the total stress, and the reservoir on
// the surface, brought inside by the divergence theorem. So no surface has to
// be found, now or when a part of it is dug away.
Slope::Slope(const double factor, const WaterTexts &texts)
  : soils(3, soil_with_strength_over(factor))
  , mesh(make_box(), MPI_COMM_WORLD)
  , space(mesh, /* degree = */ 1)
  , points(mesh, make_fields(soils))
  , seeder(2, PointLayout::equal)
  , basis(space, points, seeder)
  , supports(make_supports(mesh))
  , weight(make_weight())
{
  seed_bodies(make_bodies(), seeder, points);
  basis.initialise_points(points);
  state = std::make_unique<State<dim>>(space,
                                       points,
                                       basis,
                                       soils,
                                       MeshAfterStep::keep,
                                       StrainMeasure::small,
                                       PointWeights::volumes,
                                       VolumetricStrain::cell_mean_with_shear);

  if (!texts.level.empty())
    water.water.emplace(texts);
  water.extra_density = {0, 0, 0};
  water.pore_pressure = points.fields().find(FieldNames<dim>::pore_pressure);
  water.total_stress  = points.fields().find(FieldNames<dim>::total_stress);

  Terms<dim> terms = make_terms(no_boundaries, supports, weight);
  const std::vector<const BodyForce<dim> *> without_extra_weight;
  terms.push_back(std::make_unique<WaterTerm<dim>>(
    water, points, without_extra_weight, StrainMeasure::small));
  const std::vector<std::string> names{"slope", "toe 1", "toe 2"};
  system =
    std::make_unique<MechanicsSystem<dim>>(*state, std::move(terms), names);
}



// A step that does not converge is cut by half, and again, down to a tenth of a
// step. If that does not converge either, we say that there is no equilibrium.
// Returns the time of the last one.
double
Slope::advance(const double start, const double end, const unsigned int n_steps)
{
  Newton         newton{NewtonParameters()};
  LinearSolver   linear_solver(LinearSolverParameters(), dim);
  TimeParameters steps;
  steps.start_time    = start;
  steps.end_time      = end;
  steps.n_steps       = n_steps;
  steps.smallest_step = 0.1;
  TimeControl time(steps);
  while (!time.finished())
    {
      LA::Vector increment;
      system->begin_step(time.time());
      time.next();
      system->set_target(time.trial_time());
      const auto report = newton.solve(*system, linear_solver, increment);
      if (!report.converged())
        {
          if (!time.reject(report.message))
            break;
          continue;
        }
      time.accept(report.iterations);
      reactions = system->accept(increment);
    }
  return time.time();
}



// @sect3{Digging}
//
// The points of a body go, with their weight and stress. The next step finds
// the equilibrium without them. Cells that lose all of their points leave the
// equations, so nodes and couplings have to be found anew.
void
Slope::dig(const unsigned int body)
{
  stays[body] = false;
  points.exchange_bodies(stays, {});
  state->points_changed();
  system->forget_couplings();
}



// @sect3{Equilibrium below the reservoir}
//
// Reactions are what supports bear beside p_r: here the effective forces. The
// total ones also have the water behind the wall and under the base.
void
fill_reservoir()
{
  const auto print = [](const std::string &name, const Tensor<1, dim> &force) {
    root_output() << std::left << std::setw(22) << name << std::right;
    for (unsigned int d = 0; d < dim; ++d)
      root_output() << std::setw(10)
                    << (std::abs(force[d]) < 1e-3 ? 0. : force[d]);
    root_output() << std::endl;
  };
  Slope slope(1, slow);
  slope.advance(0, 1, 10);
  const Tensor<1, dim> soil = Point<dim>(0, -weight_of_all);
  const Tensor<1, dim> water =
    force_of_outer_water(slope.water, 1, *slope.state);
  const Tensor<1, dim> wall = slope.reactions[0].reaction;
  const Tensor<1, dim> base = slope.reactions[1].reaction;
  const double         p    = gamma_w * height;
  root_output() << std::setprecision(1)
                << "full reservoir [kN/m]          x         y" << std::endl;
  print("weight", soil);
  print("water all around", water);
  print("wall, effective", wall);
  print("base, effective", base);
  print("sum", soil + water + wall + base);
  print("wall, total", wall + Point<dim>(p * height / 2, 0));
  print("base, total", base + Point<dim>(0, p * toe));
}



// @sect3{The factor of safety}
//
// The largest factor by which c' and tan(phi') can be divided. We go up from 1
// in wide steps to the first factor that fails, then in small ones from the
// last that stood, because trials that fail take longest. The answer is the
// middle of the last interval.
//
// Each trial is a path of its own, from no weight to all of it. What has been
// dug by then is dug before: near failure, Newton's method may not survive that
// much is missing at once, though there is equilibrium.
bool
stands(const double factor, const WaterTexts &texts, const unsigned int n_dug)
{
  Slope slope(factor, texts);
  for (unsigned int stage = 1; stage <= n_dug; ++stage)
    slope.dig(stage);
  return slope.advance(0, 1, 10) == 1;
}



double
factor_of_safety(const WaterTexts &texts, const unsigned int n_dug = 0)
{
  AssertThrow(stands(1, texts, n_dug), ExcMessage("it fails as it is"));
  double stood = 1;
  for (const double step : {0.2, 0.02})
    while (stands(stood + step, texts, n_dug))
      stood += step;
  return stood + 0.01;
}



// The numbers beside are those of Griffiths and Lane (1999).
void
find_factors()
{
  struct Case
  {
    std::string name;
    WaterTexts  water;
    double      published;
  };
  root_output() << std::setprecision(2)
                << "factor of safety               F published" << std::endl;
  for (const Case &one : {Case{"dry", dry, 1.40},
                          Case{"full reservoir", make_water("10"), 1.85},
                          Case{"drawn down by 0.7 H", make_water("3"), 1.30}})
    root_output() << std::left << std::setw(22) << one.name << std::right
                  << std::setw(10) << factor_of_safety(one.water)
                  << std::setw(10) << one.published << std::endl;
}



// @sect3{Drawdown}
//
// The mean settlement of the points within a metre of the crest.
double
settlement_of_crest(const PointSet<dim> &points)
{
  double sum = 0, volume = 0;
  for (unsigned int p = 0; p < points.n_local(); ++p)
    if (points.position(p).distance(Point<dim>(crest, height)) < 1)
      {
        const double v = points.volume(p);
        sum -= v * points.displacement_field()(points.values(p))[1];
        volume += v;
      }
  return Utilities::MPI::sum(sum, MPI_COMM_WORLD) /
         Utilities::MPI::sum(volume, MPI_COMM_WORLD);
}



// With all the strength. Displacements count from the full reservoir.
void
draw_down(const std::string &name, const WaterTexts &texts)
{
  root_output() << name << " drawdown, level [m]   crest settles [mm]"
                << std::endl;
  Slope slope(1, texts);
  slope.advance(0, 1, 10);
  slope.points.reset_displacements();
  for (double t = 1, end; t < 2; t = end)
    {
      end               = std::round(10 * t + 1) / 10;
      const double last = slope.advance(t, end, 1);
      if (last < end)
        {
          root_output() << "no equilibrium below " << std::setprecision(2)
                        << height * (2 - last) << " m" << std::endl;
          break;
        }
      root_output() << std::setprecision(1) << std::setw(24)
                    << height * (2 - end) << std::setw(21)
                    << 1000 * settlement_of_crest(slope.points) << std::endl;
    }
}



// @sect3{Excavation}
//
// When the reservoir is empty and the slope drained, its toe is dug away.
// Displacements count from there; the largest one is at the new face.
void
excavate()
{
  root_output() << "stages dug   largest displacement [mm]       F"
                << std::endl;
  Slope slope(1, slow);
  slope.advance(0, 2, 20);
  slope.points.reset_displacements();
  for (unsigned int stage = 1; stage <= 2; ++stage)
    {
      slope.dig(stage);
      AssertThrow(slope.advance(stage + 1, stage + 2, 1) == stage + 2,
                  ExcMessage("it does not stand"));
      const auto &u       = slope.points.displacement_field();
      double      largest = 0;
      for (unsigned int p = 0; p < slope.points.n_local(); ++p)
        largest = std::max(largest, u(slope.points.values(p)).norm());
      largest = Utilities::MPI::max(largest, MPI_COMM_WORLD);
      root_output() << std::setprecision(2) << std::setw(10) << stage
                    << std::setw(28) << 1000 * largest << std::setw(8)
                    << factor_of_safety(dry, stage) << std::endl;
    }
}



int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  root_output() << std::fixed;
  fill_reservoir();
  find_factors();
  draw_down("slow", slow);
  draw_down("fast", fast);
  excavate();
}
