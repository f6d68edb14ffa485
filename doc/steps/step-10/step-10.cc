// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// New are the archive and the state of a simulation.
#include <moraine/assembly/mechanics_system.h>
#include <moraine/basis/cpdi2_basis.h>
#include <moraine/boundary/mesh_motion.h>
#include <moraine/core/archive.h>
#include <moraine/core/simulation_state.h>
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

// The ring of step-5.
constexpr int           dim           = 2;
constexpr double        inner_radius  = 5;
constexpr double        young_modulus = 1e6;
constexpr double        angle_of_step = 5; // degrees
constexpr StrainMeasure measure       = StrainMeasure::finite;



MeshParameters<dim>
make_ring()
{
  MeshParameters<dim> ring;
  ring.type       = "generator";
  ring.generator  = "concentric_hyper_shells";
  ring.arguments  = "0, 0 : 5 : 10 : 5 : 0 : 18 : true";
  ring.side_names = "hole: 0, outer: 1";
  return ring;
}



PointFields
make_fields()
{
  PointFields fields;
  Cpdi2Basis<dim>::request_fields(fields);
  StateFields<dim>(fields, measure);
  return fields;
}



// On several ranks the direct solver (MUMPS) sums in an order that changes from
// run to run; multigrid does not.
LinearSolverParameters
make_solver()
{
  LinearSolverParameters parameters;
  parameters.solver = "gmres";
  return parameters;
}



// The hole turns clockwise, the outer side is held.
std::vector<GridCondition<dim>>
make_conditions(const BackgroundMesh<dim> &mesh)
{
  std::vector<GridCondition<dim>> conditions(2);
  for (unsigned int i = 0; i < 2; ++i)
    {
      conditions[i].name      = i == 0 ? "hole" : "outer";
      conditions[i].side      = mesh.boundary_id(conditions[i].name, "step-10");
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



// @sect3{A simulation that can be written}
//
// Everything a run has is a member, so that it is gone when the object is.
class Twist
{
public:
  Twist()
    : mesh(make_ring(), MPI_COMM_WORLD)
    , space(mesh, /* degree = */ 1)
    , points(mesh, make_fields())
    , bodies{{"ring", make_space<dim>()}}
    , seeder(2, PointLayout::equal)
    , linear_solver(make_solver(), dim)
  {
    seed_bodies(bodies, seeder, points);
    basis = std::make_unique<Cpdi2Basis<dim>>(space, points, seeder, bodies);
    basis->initialise_points(points);
    state = std::make_unique<State<dim>>(
      space,
      points,
      *basis,
      std::vector<std::shared_ptr<const Material>>{
        std::make_shared<LinearElastic>(young_modulus, 0., 0.)},
      MeshAfterStep::reset,
      measure);
    conditions = make_conditions(mesh);
    system     = std::make_unique<MechanicsSystem<dim>>(
      *state,
      make_terms(no_boundaries, conditions, no_loads),
      std::vector<std::string>{"ring"});
    typename MeshMotion<dim>::Master hole;
    hole.motion = conditions[0].motion;
    system->move_mesh_by(MeshMotion<dim>(hole), mesh);

    // What outlives a step, in the order in which it is written and read: the
    // mesh first, because points look for their cells in it.
    lasting.add(mesh);
    lasting.add(points);
  }

  // @sect3{A step}
  //
  // As in step-5. It returns the moment at the hole over $2\pi R_i^2 E$.
  double
  advance()
  {
    LA::Vector increment;
    system->begin_step(step * angle_of_step);
    ++step;
    system->set_target(step * angle_of_step);
    const NewtonReport report =
      Newton(NewtonParameters()).solve(*system, linear_solver, increment);
    AssertThrow(report.converged(), ExcMessage(report.message));
    const std::string reason = system->reason_to_reject(increment);
    AssertThrow(reason.empty(), ExcMessage(reason));
    return -system->accept(increment)[0].moment /
           (2 * numbers::PI * inner_radius * inner_radius * young_modulus);
  }

  // @sect3{The file}
  //
  // Besides the parts, the number of steps. The file appears complete or not
  // at all: it is written beside its place, read back, and moved there.
  //
  // A direct solver may keep its factors, and a system its couplings, from
  // one step to the next. A run that reads the file has neither, so the one
  // that writes it forgets them: both find them anew.
  void
  write(const std::string &file)
  {
    Archive archive;
    lasting.write(archive);
    archive.write("step", step);
    write_file(archive, file, MPI_COMM_WORLD);
    system->forget_couplings();
    linear_solver.clear();
  }

  // The ring of the constructor is that of the start; its mesh and points get
  // the values of the file.
  void
  read(const std::string &file)
  {
    const Archive archive = read_file(file, MPI_COMM_WORLD);
    lasting.read(archive);
    step = archive.integer("step");
  }

private:
  BackgroundMesh<dim>                   mesh;
  GridSpace<dim>                        space;
  PointSet<dim>                         points;
  const std::vector<Body<dim>>          bodies;
  const CellSeeder<dim>                 seeder;
  std::unique_ptr<Basis<dim>>           basis;
  std::unique_ptr<State<dim>>           state;
  std::vector<ImplicitBoundary<dim>>    no_boundaries;
  Loads<dim>                            no_loads;
  std::vector<GridCondition<dim>>       conditions;
  std::unique_ptr<MechanicsSystem<dim>> system;
  LinearSolver                          linear_solver;
  SimulationState                       lasting;
  unsigned int                          step = 0;
};



// @sect3{The program}
//
// Four steps in one piece, with a file after the second; then the last two
// again, from the file.
int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);

  const std::string   file = "step-10.h5";
  std::vector<double> in_one_piece, from_the_file;
  {
    Twist twist;
    for (unsigned int step = 1; step <= 4; ++step)
      {
        in_one_piece.push_back(twist.advance());
        if (step == 2)
          twist.write(file);
      }
  }
  {
    Twist twist;
    twist.read(file);
    for (unsigned int step = 3; step <= 4; ++step)
      from_the_file.push_back(twist.advance());
  }

  if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) != 0)
    return 0;
  std::cout << "angle in one piece from the file" << std::endl;
  for (unsigned int step = 1; step <= 4; ++step)
    {
      std::cout << std::fixed << std::setprecision(0) << std::setw(5)
                << step * angle_of_step << std::setprecision(6) << std::setw(13)
                << in_one_piece[step - 1];
      if (step > 2)
        std::cout << std::setw(14) << from_the_file[step - 3]
                  << (from_the_file[step - 3] == in_one_piece[step - 1] ?
                        "  the same bits" :
                        "  not the same");
      std::cout << std::endl;
    }
}
