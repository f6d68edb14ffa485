// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// The headers of step-1 and one more: somebody who decides how far the next
// step goes.
#include <moraine/assembly/mechanics_system.h>
#include <moraine/basis/basis.h>
#include <moraine/core/exceptions.h>
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
#include <moraine/time/time_control.h>

#include <deal.II/base/mpi.h>

#include <iomanip>
#include <iostream>

using namespace dealii;
using namespace moraine;

// A slender beam, clamped at its left end, with a force P at the other that
// bends it through nearly a right angle. (mm, N; 1 mm thick, plane strain)
constexpr int    dim           = 2;
constexpr double length        = 10;
constexpr double height        = 0.25;
constexpr double young_modulus = 1000;
constexpr double poisson_ratio = 0.3;

// The line this program is about. With <code>small</code>, this is a program
// like step-1.
constexpr StrainMeasure measure = StrainMeasure::finite;

// A plate in plane strain bends like a beam with $E' = E/(1-\nu^2)$. The load
// factor $P L^2/(E' I)$ says how far a beam bends, whatever it is made of. It
// serves as our time.
constexpr double bending_stiffness = young_modulus /
                                     (1 - poisson_ratio * poisson_ratio) *
                                     height * height * height / 12;
constexpr double largest_factor = 10;

// Where the end of a beam without thickness is at some of the factors, $v/L$
// down and $u/L$ back: the elastica.
struct Elastica
{
  double factor, down, back;
};
constexpr Elastica elastica[] = {{2, 0.49345748, 0.16064172},
                                 {5, 0.71379152, 0.38762836},
                                 {10, 0.81060902, 0.55499560}};



// @sect3{What holds and what pulls}
//
// The nodes of the left side of the mesh stay where they are.
std::vector<GridCondition<dim>>
make_clamp(const BackgroundMesh<dim> &mesh)
{
  GridCondition<dim> clamp;
  clamp.name         = "clamp";
  clamp.side         = mesh.boundary_id("left", "step-4");
  clamp.component    = {{true, true}};
  clamp.displacement = [](const Point<dim> &, const double) {
    return Tensor<1, dim>();
  };
  return {clamp};
}



// The force is spread over the end of the beam and points down however the end
// turns: places that are carried by the material keep the weight they had at
// first.
Loads<dim>
make_loads(const BackgroundMesh<dim> &mesh)
{
  const auto end =
    make_flat_face<dim>({Point<dim>(length, 0), Point<dim>(length, height)});
  Loads<dim> loads;
  loads.carried.emplace_back(
    "end force",
    "surface traction",
    [](const Point<dim> &, const double factor) {
      const double P = factor * bending_stiffness / (length * length);
      return Tensor<1, dim>(Point<dim>(0, -P / height));
    },
    places_on<dim>(*end, mesh));
  return loads;
}



// The places of the load are at the end of the beam, move with it, and every
// process knows them: their mean tells where the end is.
Point<dim>
end_of_beam(const Loads<dim> &loads)
{
  Tensor<1, dim> sum;
  for (const auto &place : loads.carried[0].places())
    sum += place.weight / height * place.x;
  return Point<dim>(sum);
}



// @sect3{What we print}
//
// One line for a step that was accepted, with the end of the beam and what
// Newton's method did: the number of corrections, the order with which the
// residual fell in the end, and the last of the residuals, over the norm of the
// forces that balance. What is left of round-off is shown as zero.
void
print_step(const double        factor,
           const Point<dim>   &end,
           const NewtonReport &report)
{
  if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) != 0)
    return;
  std::cout << std::fixed << std::setprecision(3) << std::setw(6) << factor
            << std::setprecision(5) << std::setw(10)
            << (height / 2 - end[1]) / length << std::setw(10)
            << (length - end[0]) / length << std::setw(6) << report.iterations
            << std::setprecision(1) << std::setw(7) << report.observed_order
            << " ";
  constexpr unsigned int n_shown = 5;
  const unsigned int     n       = report.residuals.size();
  for (unsigned int i = n > n_shown ? n - n_shown : 0; i < n; ++i)
    std::cout << std::scientific << std::setprecision(0) << ' '
              << (report.residuals[i] < 1e-10 ? 0. : report.residuals[i]);
  std::cout << std::endl;
  for (const Elastica &known : elastica)
    if (std::abs(factor - known.factor) < 1e-9)
      std::cout << std::fixed << std::setprecision(5) << std::setw(16)
                << known.down << std::setw(10) << known.back << "  elastica"
                << std::endl;
}



// @sect3{The program}
int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);

  // One layer of square cells. Bilinear functions would
  // lock in bending, so we take those of degree 2.
  MeshParameters<dim> box;
  box.lower_corner = Point<dim>(0, 0);
  box.upper_corner = Point<dim>(length, height);
  box.cells        = {40, 1};
  const BackgroundMesh<dim> mesh(box, MPI_COMM_WORLD);
  GridSpace<dim>            space(mesh, /* degree = */ 2);

  // At finite strain a point carries more: the deformation gradient, the
  // elastic left Cauchy-Green tensor and its volume at the start. The fields
  // must be in the layout before there are points.
  PointFields fields;
  StateFields<dim>(fields, measure);
  PointSet<dim> points(mesh, fields);
  const auto beam = make_box<dim>(Point<dim>(0, 0), Point<dim>(length, height));
  seed_bodies({{"beam", beam}}, CellSeeder<dim>(3, PointLayout::gauss), points);

  // From here on the strain is nobody's business but that of the state. The
  // material is the one of step-1: Hooke's law of the logarithmic strain.
  CellBasis<dim, 2> basis(space, points);
  State<dim>        state(space,
                   points,
                   basis,
                   {std::make_shared<LinearElastic>(young_modulus,
                                                    poisson_ratio,
                                                    /* density = */ 0)},
                   MeshAfterStep::follow_material,
                   measure);

  const auto                         clamp = make_clamp(mesh);
  Loads<dim>                         loads = make_loads(mesh);
  std::vector<ImplicitBoundary<dim>> no_boundaries;
  MechanicsSystem<dim>               system(state,
                              make_terms(no_boundaries, clamp, loads),
                              {"beam"});

  // Round-off in the membrane forces of a slender beam is large against the
  // forces that bend it. We do not try to get below it.
  NewtonParameters how;
  how.tolerance = 1e-8;
  Newton       newton(how);
  LinearSolver linear_solver(LinearSolverParameters(), dim);

  // The equations are nonlinear now, and a step can fail: too many iterations,
  // no correction that makes the residual smaller, a point turned inside out.
  // So we do not say how many steps there are, but where we want to come by:
  // at the factors of the table. TimeControl tries the whole way to the next
  // of these stops, cuts a step that failed by half, and makes steps larger
  // again when they were easy.
  TimeParameters time_parameters;
  time_parameters.end_time = largest_factor;
  TimeControl time(time_parameters, {elastica[0].factor, elastica[1].factor});

  if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    std::cout << "factor       v/L       u/L  its.  order  last residuals"
              << std::endl;

  // begin_step() looks at the committed state, which a failed step has not
  // touched: we need it once per accepted step, and set_target() for every
  // attempt.
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
          if (report.converged())
            {
              time.accept(report.iterations);
              system.accept(increment);
              print_step(time.time(), end_of_beam(loads), report);
              break;
            }
          if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
            std::cout << std::fixed << std::setprecision(3) << std::setw(6)
                      << time.trial_time()
                      << "  rejected: " << to_string(report.status)
                      << std::endl;
          if (!time.reject(report.message))
            throw ComputationError(time.message());
        }
    }

  if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    std::cout << time.n_accepted() << " steps accepted, " << time.n_rejected()
              << " rejected" << std::endl;
  write_point_vtu(points, {"step-4.vtu", time.time(), time.n_accepted()});
}
