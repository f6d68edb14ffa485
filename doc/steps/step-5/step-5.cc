// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// New are the convected particle domains, and a mesh that moves.
#include <moraine/assembly/mechanics_system.h>
#include <moraine/basis/basis.h>
#include <moraine/basis/cpdi1_basis.h>
#include <moraine/basis/cpdi2_basis.h>
#include <moraine/boundary/mesh_motion.h>
#include <moraine/material/linear_elastic.h>
#include <moraine/mesh/background_mesh.h>
#include <moraine/mesh/grid_space.h>
#include <moraine/points/bodies.h>
#include <moraine/geometry/shapes.h>
#include <moraine/solver/linear_solver.h>
#include <moraine/solver/newton.h>
#include <moraine/state/state.h>

#include <deal.II/base/mpi.h>

#include <iomanip>
#include <iostream>

using namespace dealii;
using namespace moraine;

// A ring, held at its outer side, whose hole is turned. The ring is made of
// cells of a generator, five by eighteen, all of them full.
constexpr int           dim           = 2;
constexpr double        inner_radius  = 5;
constexpr double        outer_radius  = 10;
constexpr double        young_modulus = 1e6;
constexpr unsigned int  n_steps       = 4;
constexpr double        angle_of_step = 5; // degrees
constexpr StrainMeasure measure       = StrainMeasure::finite;

// The methods of this program. They have all of the rest in common.
enum class Method
{
  finite_element,
  material_point,
  cpdi1,
  cpdi2
};



// @sect3{The one choice}
//
// A method is a basis. That of CPDI keeps what it knows of the domain of a
// point, half edges or corners, with the point: it asks for fields before
// there are points, and gives them their values afterwards.
void
request_fields(const Method method, PointFields &fields)
{
  if (method == Method::cpdi1)
    Cpdi1Basis<dim>::request_fields(fields);
  if (method == Method::cpdi2)
    Cpdi2Basis<dim>::request_fields(fields);
  StateFields<dim>(fields, measure);
}



std::unique_ptr<Basis<dim>>
make_basis(const Method                  method,
           const GridSpace<dim>         &space,
           const CellSeeder<dim>        &seeder,
           const std::vector<Body<dim>> &bodies,
           PointSet<dim>                &points)
{
  std::unique_ptr<Basis<dim>> basis;
  if (method == Method::cpdi1)
    basis = std::make_unique<Cpdi1Basis<dim>>(space, points, seeder, bodies);
  else if (method == Method::cpdi2)
    basis = std::make_unique<Cpdi2Basis<dim>>(space, points, seeder, bodies);
  else
    basis = std::make_unique<CellBasis<dim, 1>>(space, points);
  basis->initialise_points(points);
  return basis;
}



// @sect3{A hole that turns}
//
// What is prescribed at the hole is a rigid motion, here a rotation about the
// origin, clockwise and by as many degrees as the time says. That the outer
// side is held is a motion as well, by nothing: the moment is then reported
// about the same axis.
std::vector<GridCondition<dim>>
make_conditions(const BackgroundMesh<dim> &mesh)
{
  std::vector<GridCondition<dim>> conditions(2);
  for (unsigned int i = 0; i < 2; ++i)
    {
      conditions[i].name      = i == 0 ? "hole" : "outer";
      conditions[i].side      = mesh.boundary_id(conditions[i].name, "step-5");
      conditions[i].component = {{true, true}};
      conditions[i].displacement = [](const Point<dim> &, const double) {
        return Tensor<1, dim>();
      };
    }
  conditions[0].motion =
    RigidMotion<dim>({}, [](const double degrees) { return -degrees; });
  conditions[1].motion = RigidMotion<dim>({}, [](const double) { return 0.; });
  return conditions;
}



// @sect3{One method}
//
// Twist the ring and return the moments at the hole, divided by
// $2\pi R_i^2 E$.
std::vector<double>
twist(const Method method)
{
  const bool is_finite_element = method == Method::finite_element;

  MeshParameters<dim> ring;
  ring.type       = "generator";
  ring.generator  = "concentric_hyper_shells";
  ring.arguments  = "0, 0 : 5 : 10 : 5 : 0 : 18 : true";
  ring.side_names = "hole: 0, outer: 1";
  BackgroundMesh<dim> mesh(ring, MPI_COMM_WORLD);
  GridSpace<dim>      space(mesh, /* degree = */ 1);

  // A shape without bounds fills all cells.
  const std::vector<Body<dim>> bodies{{"ring", make_space<dim>()}};
  const CellSeeder<dim>        seeder(2,
                               is_finite_element ? PointLayout::gauss :
                                                          PointLayout::equal);
  PointFields                  fields;
  request_fields(method, fields);
  PointSet<dim> points(mesh, fields);
  seed_bodies(bodies, seeder, points);
  const auto basis = make_basis(method, space, seeder, bodies, points);

  State<dim> state(space,
                   points,
                   *basis,
                   {std::make_shared<LinearElastic>(young_modulus, 0., 0.)},
                   is_finite_element ? MeshAfterStep::follow_material :
                                       MeshAfterStep::reset,
                   measure);

  std::vector<ImplicitBoundary<dim>> no_boundaries;
  Loads<dim>                         no_loads;
  const auto                         conditions = make_conditions(mesh);
  MechanicsSystem<dim>               system(state,
                              make_terms(no_boundaries, conditions, no_loads),
                              {"ring"});

  // Where points move through the mesh, its nodes must still be on the hole
  // when the next step prescribes them, and the hole is a polygon: it has
  // turned. So the mesh turns with it, as a rigid body, once the points have
  // moved. The nodes of finite elements go with the material anyway.
  if (!is_finite_element)
    {
      typename MeshMotion<dim>::Master hole;
      hole.motion = conditions[0].motion;
      system.move_mesh_by(MeshMotion<dim>(hole), mesh);
    }

  Newton              newton{NewtonParameters()};
  LinearSolver        linear_solver(LinearSolverParameters(), dim);
  std::vector<double> moments;
  for (unsigned int step = 0; step < n_steps; ++step)
    {
      LA::Vector increment;
      system.begin_step(step * angle_of_step);
      system.set_target((step + 1) * angle_of_step);
      const NewtonReport report =
        newton.solve(system, linear_solver, increment);
      AssertThrow(report.converged(), ExcMessage(report.message));

      // Equilibrium is not all: a domain of CPDI2 must not turn inside out when
      // its corners move.
      const std::string reason = system.reason_to_reject(increment);
      AssertThrow(reason.empty(), ExcMessage(reason));

      const auto reports = system.accept(increment);
      moments.push_back(-reports[0].moment / (2 * numbers::PI * inner_radius *
                                              inner_radius * young_modulus));
    }
  return moments;
}



// @sect3{The program}
//
// The four methods side by side, and for the first two angles the moment of a
// ring whose stress depends on the radius alone.
int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);

  std::vector<std::vector<double>> moments;
  for (const Method method : {Method::finite_element,
                              Method::material_point,
                              Method::cpdi1,
                              Method::cpdi2})
    moments.push_back(twist(method));

  if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) != 0)
    return 0;
  std::cout << "angle        FE  mat.point     CPDI1     CPDI2 reference"
            << std::endl;
  const std::vector<double> reference{0.115823, 0.228440};
  for (unsigned int step = 0; step < n_steps; ++step)
    {
      std::cout << std::fixed << std::setprecision(0) << std::setw(5)
                << (step + 1) * angle_of_step << std::setprecision(6);
      for (const auto &of_method : moments)
        std::cout << std::setw(10) << of_method[step];
      if (step < reference.size())
        std::cout << std::setw(10) << reference[step];
      std::cout << std::endl;
    }
}
