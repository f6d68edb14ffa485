// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// Nothing new: implicit boundaries are those of step-3, domains and the mesh
// that moves those of step-5.
#include <moraine/assembly/mechanics_system.h>
#include <moraine/basis/cpdi2_basis.h>
#include <moraine/boundary/implicit_boundary.h>
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

#include <cmath>
#include <iomanip>
#include <iostream>

using namespace dealii;
using namespace moraine;

// A smooth plate presses a block of material points against a smooth wall,
// until 40 % of its length are gone. Without lateral strain the force is known.
// (m, kN, 1 m thick)
constexpr int           dim           = 2;
constexpr double        length        = 2;
constexpr double        height        = 1;
constexpr double        young_modulus = 1000;
constexpr double        way           = 0.8;
constexpr unsigned int  n_steps       = 8;
constexpr StrainMeasure measure       = StrainMeasure::finite;

// The two ways.
enum class Plate
{
  /** Nodes of the mesh are on the plate, and the mesh shrinks with the body. */
  carries_the_mesh,
  /** The mesh stands still, and the plate passes through its cells. */
  cuts_the_mesh
};



// How far the plate is at time t.
double
position_of_plate(const double t)
{
  return -way * t;
}



// @sect3{The plate as a side of the mesh}
//
// Nodes can be held where they coincide with a boundary: the wall on the left,
// the ground below, and, as long as the right side of the mesh is at the plate,
// the plate.
std::vector<GridCondition<dim>>
make_conditions(const Plate plate, const BackgroundMesh<dim> &mesh)
{
  const std::vector<std::string>  sides{"left", "bottom", "right"};
  std::vector<GridCondition<dim>> conditions(
    plate == Plate::carries_the_mesh ? 3 : 2);
  for (unsigned int i = 0; i < conditions.size(); ++i)
    {
      conditions[i].name               = sides[i];
      conditions[i].side               = mesh.boundary_id(sides[i], "step-6");
      conditions[i].component[i % dim] = true;
      conditions[i].displacement = [i](const Point<dim> &, const double t) {
        return Tensor<1, dim>(
          Point<dim>(i == 2 ? position_of_plate(t) : 0., 0.));
      };
    }
  return conditions;
}



// To keep it there, the mesh is stretched (here: shrunk) after each step
// between two boundaries, the wall, which stands still, and the plate.
MeshMotion<dim>
make_mesh_motion()
{
  typename MeshMotion<dim>::Master wall, plate;
  wall.place         = Point<dim>(0, height / 2);
  plate.place        = Point<dim>(length, height / 2);
  plate.displacement = [](const double t) {
    return Tensor<1, dim>(Point<dim>(position_of_plate(t), 0.));
  };
  return MeshMotion<dim>(wall, plate, /* t_0 = */ 0);
}



// @sect3{The plate as an implicit boundary}
//
// A line that is moved as a rigid body. Of the enforcements of step-3 we take
// the augmented Lagrangian: it carries multipliers, the traction of the plate,
// and has no flux. The flux of Nitsche's methods is that of a small elastic
// strain in every step, which is not all of the traction of a body pressed by
// 40 %.
ImplicitBoundary<dim>
make_plate()
{
  std::array<RigidMotion<dim>::Curve, dim> translation;
  translation[0] = position_of_plate;
  const RigidMotion<dim> motion(translation);
  const auto no_displacement = [](const Point<dim> &, const double) {
    return Tensor<1, dim>();
  };
  Constraint<dim> smooth;
  smooth.kind = Constraint<dim>::roller;
  EnforcementParameters how;
  how.enforcement = "augmented Lagrangian";
  return ImplicitBoundary<dim>(
    "plate",
    make_flat_face<dim>(std::vector<Point<dim>>{Point<dim>(length, 0),
                                                Point<dim>(length, height)}),
    motion,
    no_displacement,
    smooth,
    how.enforcement_of(),
    /* no limit on penetration */ 0);
}



// @sect3{One way}
//
// Press the block and return the force on the plate after each step.
std::vector<double>
press(const Plate plate)
{
  MeshParameters<dim> box;
  box.lower_corner = Point<dim>(0, 0);
  box.upper_corner = Point<dim>(length, height);
  box.cell_size    = 0.25;
  BackgroundMesh<dim> mesh(box, MPI_COMM_WORLD);
  GridSpace<dim>      space(mesh, /* degree = */ 1);

  const std::vector<Body<dim>> bodies{
    {"block", make_box<dim>(box.lower_corner, box.upper_corner)}};
  const CellSeeder<dim> seeder(2, PointLayout::equal);
  PointFields           fields;
  Cpdi2Basis<dim>::request_fields(fields);
  StateFields<dim>(fields, measure);
  PointSet<dim> points(mesh, fields);
  seed_bodies(bodies, seeder, points);
  Cpdi2Basis<dim> basis(space, points, seeder, bodies);
  basis.initialise_points(points);
  State<dim> state(space,
                   points,
                   basis,
                   {std::make_shared<LinearElastic>(young_modulus, 0., 0.)},
                   MeshAfterStep::reset,
                   measure);

  // Here the two ways part: one has a boundary more, the other a condition and
  // a mesh that moves.
  std::vector<ImplicitBoundary<dim>> boundaries;
  if (plate == Plate::cuts_the_mesh)
    boundaries.push_back(make_plate());
  const auto           conditions = make_conditions(plate, mesh);
  Loads<dim>           no_loads;
  MechanicsSystem<dim> system(state,
                              make_terms(boundaries, conditions, no_loads),
                              {"block"});
  if (plate == Plate::carries_the_mesh)
    system.move_mesh_by(make_mesh_motion(), mesh);

  Newton              newton{NewtonParameters()};
  LinearSolver        linear_solver(LinearSolverParameters(), dim);
  std::vector<double> forces;
  for (unsigned int step = 0; step < n_steps; ++step)
    {
      LA::Vector increment;
      system.begin_step(step / double(n_steps));
      system.set_target((step + 1) / double(n_steps));
      const NewtonReport report =
        newton.solve(system, linear_solver, increment);
      AssertThrow(report.converged(), ExcMessage(report.message));

      // Boundaries report first, conditions after them.
      for (const auto &of : system.accept(increment))
        if (of.name == "plate" || of.name == "right")
          forces.push_back(of.reaction[0]);
    }
  return forces;
}



// @sect3{The program}
//
// With the stretch $\lambda$, $\tau = E \ln\lambda$ and
// $\sigma = \tau/\lambda$, as there is no lateral strain with $\nu = 0$: the
// force is $E h \ln\lambda\,/\,\lambda$.
int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);

  const std::vector<double> carried = press(Plate::carries_the_mesh);
  const std::vector<double> cut     = press(Plate::cuts_the_mesh);

  if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) != 0)
    return 0;
  std::cout << "plate at      exact  mesh moves     error  mesh cut     error"
            << std::endl;
  for (unsigned int step = 0; step < n_steps; ++step)
    {
      const double x = length + position_of_plate((step + 1) / double(n_steps));
      const double stretch = x / length;
      const double exact = young_modulus * height * std::log(stretch) / stretch;
      std::cout << std::fixed << std::setprecision(3) << std::setw(8) << x
                << std::setw(11) << exact;
      for (const double force : {carried[step], cut[step]})
        {
          const double error = std::abs(force / exact - 1);
          std::cout << std::fixed << std::setprecision(3) << std::setw(11)
                    << force << std::scientific << std::setprecision(1)
                    << std::setw(10) << (error < 1e-9 ? 0. : error);
        }
      std::cout << std::endl;
    }
}
