// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// Nothing is new but the material; loads, sides and points are those of step-8.
#include <moraine/assembly/mechanics_system.h>
#include <moraine/basis/gimp_basis.h>
#include <moraine/geometry/shapes.h>
#include <moraine/material/von_mises.h>
#include <moraine/mesh/background_mesh.h>
#include <moraine/mesh/grid_space.h>
#include <moraine/points/bodies.h>
#include <moraine/solver/linear_solver.h>
#include <moraine/solver/newton.h>
#include <moraine/state/state.h>
#include <moraine/time/time_control.h>

#include <deal.II/base/mpi.h>

#include <cmath>
#include <functional>
#include <iomanip>
#include <iostream>

using namespace dealii;
using namespace moraine;

// @sect3{The sketch}
//
// Half an embankment, 8 m high with a slope of 2:1, on 4 m of the same clay
// above firm ground. (m, kPa, t)
//
//     12  o---------o
//         |           `-.
//         |               `-.
//      4  |                   `-o-----------o
//         |            clay                 |
//      0  o---------------------------------o
//         0        10          26          40
constexpr int    dim                = 2;
constexpr double young_modulus      = 10e3;
constexpr double poisson_ratio      = 0.49;
constexpr double density            = 2;
constexpr double gravity            = 9.81;
constexpr double undrained_strength = 32;

// Taylor's stability number of this slope and depth: with c_u over the factor
// of safety, one slip circle is at its limit.
constexpr double stability_number = 0.1594;
constexpr double height           = 8;

constexpr double lower_factor = 1;
constexpr double upper_factor = 1.5;
constexpr double tolerance    = 0.01;



std::vector<Point<dim>>
sketch()
{
  return {Point<dim>(0, 0),
          Point<dim>(40, 0),
          Point<dim>(40, 4),
          Point<dim>(26, 4),
          Point<dim>(10, 12),
          Point<dim>(0, 12)};
}



std::ostream &
root_output()
{
  static std::ostream nothing(nullptr);
  return Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0 ? std::cout :
                                                                 nothing;
}



// @sect3{The material}
//
// Undrained, clay has a shear strength c_u whatever its pressure: von Mises
// with the yield radius sqrt(2) c_u. What a factor F does to its strength it
// says itself; of soil with friction the tangent of its angle would be divided,
// too.
std::shared_ptr<const Material>
clay_with_strength_over(const double factor)
{
  const VonMises clay(young_modulus,
                      poisson_ratio,
                      density,
                      {{0., std::sqrt(2.) * undrained_strength}});
  return clay.with_strength_over(factor);
}



// @sect3{Supports and weight}
//
// Symmetry on the left, a smooth wall far away on the right, firm ground below.
std::vector<GridCondition<dim>>
make_supports(const BackgroundMesh<dim> &mesh)
{
  const std::vector<std::string>  sides{"left", "right", "bottom"};
  std::vector<GridCondition<dim>> supports(sides.size());
  for (unsigned int i = 0; i < supports.size(); ++i)
    {
      supports[i].name         = sides[i];
      supports[i].side         = mesh.boundary_id(sides[i], "step-9");
      supports[i].component[0] = true;
      supports[i].component[1] = sides[i] == "bottom";
      supports[i].displacement = [](const Point<dim> &, const double) {
        return Tensor<1, dim>();
      };
    }
  return supports;
}



// Gravity is turned on while t goes from 0 to 1.
Loads<dim>
make_weight()
{
  Loads<dim> loads;
  loads.body_forces.push_back({"weight",
                               [](const Point<dim> &, const double t) {
                                 return Tensor<1, dim>(
                                   Point<dim>(0, -gravity * t));
                               },
                               /* times_density = */ true,
                               /* acts_on = */ {true}});
  return loads;
}



// The largest settlement of all points.
double
settlement(const PointSet<dim> &points)
{
  double largest = 0;
  for (unsigned int p = 0; p < points.n_local(); ++p)
    largest =
      std::max(largest,
               -points.values(p)[points.displacement_offset() + dim - 1]);
  return Utilities::MPI::max(largest, MPI_COMM_WORLD);
}



// @sect3{One path}
//
// From no weight to all of it, with the strength over some factor. Everything
// is made anew, so that no trial knows of another. Displacements are small up
// to failure, so nothing moves (keep). Clay that flows keeps its volume, on
// which bilinear cells would lock: they get the mean of their volumetric
// strain.
//
// A step that does not converge is cut by half, and again, down to a thousandth
// of a step. If that does not converge either, we say that there is no
// equilibrium.
struct Path
{
  double       time; ///< part of the weight that it bears
  double       settlement;
  unsigned int n_iterations;
};



Path
bear_weight(
  const double                                                    factor,
  const std::function<void(const double, const PointSet<dim> &)> &after_step)
{
  MeshParameters<dim> box;
  box.lower_corner = Point<dim>(0, 0);
  box.upper_corner = Point<dim>(40, 12);
  box.cell_size    = 1;
  const BackgroundMesh<dim> mesh(box, MPI_COMM_WORLD);
  GridSpace<dim>            space(mesh, /* degree = */ 1);

  PointFields fields;
  GimpBasis<dim>::request_fields(fields, DomainUpdate::frozen);
  StateFields<dim>(fields,
                   StrainMeasure::small,
                   {clay_with_strength_over(factor)});
  PointSet<dim>         points(mesh, fields);
  const CellSeeder<dim> seeder(2, PointLayout::equal);
  seed_bodies({{"embankment", make_polygon<dim>(sketch())}}, seeder, points);
  GimpBasis<dim> basis(space, points, seeder);
  basis.initialise_points(points);
  State<dim> state(space,
                   points,
                   basis,
                   {clay_with_strength_over(factor)},
                   MeshAfterStep::keep,
                   StrainMeasure::small,
                   PointWeights::volumes,
                   VolumetricStrain::cell_mean);

  const std::vector<GridCondition<dim>> supports = make_supports(mesh);
  Loads<dim>                            weight   = make_weight();
  std::vector<ImplicitBoundary<dim>>    no_boundaries;
  MechanicsSystem<dim>                  system(state,
                              make_terms(no_boundaries, supports, weight),
                              {"embankment"});

  Newton         newton{NewtonParameters()};
  LinearSolver   linear_solver(LinearSolverParameters(), dim);
  TimeParameters steps;
  steps.n_steps = 10;
  TimeControl time(steps);
  Path        path{0, 0, 0};
  while (!time.finished())
    {
      LA::Vector increment;
      system.begin_step(time.time());
      for (;;)
        {
          time.next();
          system.set_target(time.trial_time());
          const NewtonReport report =
            newton.solve(system, linear_solver, increment);
          path.n_iterations += report.iterations;
          if (report.converged())
            {
              time.accept(report.iterations);
              system.accept(increment);
              break;
            }
          if (!time.reject(report.message))
            return path;
        }
      path.time       = time.time();
      path.settlement = settlement(points);
      after_step(path.time, points);
    }
  return path;
}



// @sect3{Settlement}
//
// First with all the strength: what the weight does, step by step.
void
settle()
{
  root_output() << "part of the weight   settlement [mm]" << std::endl;
  bear_weight(1, [](const double t, const PointSet<dim> &points) {
    const double found = settlement(points);
    if (std::abs(5 * t - std::round(5 * t)) < 1e-6)
      root_output() << std::fixed << std::setprecision(1) << std::setw(18) << t
                    << std::setw(18) << 1000 * found << std::endl;
  });
}



// @sect3{The factor of safety}
//
// The largest factor by which the strength can be divided, found by halving an
// interval: the embankment stands at its lower end and fails at the upper one.
bool
stands(const double factor)
{
  const Path path =
    bear_weight(factor, [](const double, const PointSet<dim> &) {});
  const bool to_the_end = path.time == 1;
  root_output() << std::fixed << std::setprecision(4) << std::setw(8) << factor;
  if (to_the_end)
    root_output() << "  stood, settlement " << std::setprecision(0)
                  << 1000 * path.settlement << " mm" << std::endl;
  else
    root_output() << "  failed under " << std::setprecision(2) << path.time
                  << " of its weight, F t = " << factor * path.time
                  << std::endl;
  return to_the_end;
}



void
find_factor()
{
  root_output() << "       F" << std::endl;
  double lower = lower_factor, upper = upper_factor;
  AssertThrow(stands(lower), ExcMessage("it fails as it is"));
  AssertThrow(!stands(upper), ExcMessage("it is safer than we can tell"));
  while (upper - lower > tolerance)
    {
      const double middle              = (lower + upper) / 2;
      (stands(middle) ? lower : upper) = middle;
    }
  root_output() << "factor of safety " << std::setprecision(3)
                << (lower + upper) / 2 << ", between " << std::setprecision(4)
                << lower << " and " << upper << std::endl
                << "worst slip circle " << std::setprecision(3)
                << undrained_strength /
                     (stability_number * density * gravity * height)
                << std::endl;
}



int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  settle();
  find_factor();
}
