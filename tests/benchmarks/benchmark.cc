// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// Times one step of a block under gravity, by our points and by a plain
// deal.II program; run_benchmarks.py calls it and judges the numbers. Prints
// lines 'name value'.

#include <moraine/assembly/mechanics_system.h>
#include <moraine/basis/cpdi1_basis.h>
#include <moraine/basis/cpdi2_basis.h>
#include <moraine/basis/gimp_basis.h>
#include <moraine/core/expression.h>
#include <moraine/core/memory.h>
#include <moraine/material/linear_elastic.h>
#include <moraine/material/von_mises.h>
#include <moraine/points/bodies.h>
#include <moraine/geometry/shapes.h>
#include <moraine/solver/newton.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

#include <deal.II/dofs/dof_tools.h>

#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_values.h>

#include <deal.II/numerics/vector_tools.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <iostream>
#include <map>

namespace
{
  using namespace dealii;
  using namespace moraine;

  constexpr double young_modulus = 1e7;
  constexpr double poisson_ratio = 0.3;
  constexpr double tolerance     = 1e-8;

  /** What the command line says. */
  struct Options
  {
    std::string  benchmark;
    std::string  method     = "mpm";     ///< fe, mpm, gimp, cpdi1 or cpdi2
    std::string  strain     = "small";   ///< small or finite
    std::string  material   = "elastic"; ///< elastic or plastic
    unsigned int dimension  = 2;
    unsigned int cells      = 100; ///< edge of the body
    unsigned int height     = 0;   ///< height of the body, 0 for the edge
    unsigned int mesh_cells = 0;   ///< height of the mesh, 0 for the body's
    unsigned int points     = 2;   ///< points of a cell, per direction
    unsigned int repeats    = 3;
    unsigned int wall       = 0;     ///< wall seconds also of one process
    bool         room       = false; ///< a cell of mesh more than the body
    bool         cell_means = false; ///< of the volumetric strain

    Options(const int argc, char **argv)
      : benchmark(argc > 1 ? argv[1] : "")
    {
      const std::map<std::string, unsigned int *> numbers = {
        {"--dimension", &dimension},
        {"--cells", &cells},
        {"--height", &height},
        {"--mesh-cells", &mesh_cells},
        {"--points", &points},
        {"--repeats", &repeats},
        {"--wall", &wall}};
      const std::map<std::string, std::string *> words = {{"--method", &method},
                                                          {"--strain", &strain},
                                                          {"--material",
                                                           &material}};
      for (int i = 2; i + 1 < argc; i += 2)
        {
          if (words.count(argv[i]) > 0)
            {
              *words.at(argv[i]) = argv[i + 1];
              continue;
            }
          if (numbers.count(argv[i]) == 0)
            throw std::runtime_error("unknown option " + std::string(argv[i]));
          *numbers.at(argv[i]) = std::atoi(argv[i + 1]);
        }
      if (height == 0)
        height = cells;
      if (mesh_cells == 0)
        mesh_cells = height;
    }
  };



  /**
   * Seconds of named parts, one entry per repeat. Of one process they are
   * processor seconds, which other programs on the machine disturb less; of
   * several ranks, or if asked for, wall seconds.
   */
  class Clock
  {
  public:
    template <class Part>
    void
    time(const std::string &name, const Part &part)
    {
      const double start = now();
      part();
      add(name, now() - start);
    }

    void
    add(const std::string &name, const double seconds)
    {
      entries[name].push_back(seconds);
    }

    double
    last(const std::string &name) const
    {
      return entries.at(name).back();
    }

    double
    median(const std::string &name) const
    {
      std::vector<double> sorted = entries.at(name);
      std::sort(sorted.begin(), sorted.end());
      return sorted[sorted.size() / 2];
    }

    void
    print(const std::string &prefix) const
    {
      for (const auto &entry : entries)
        std::cout << prefix << entry.first << ' ' << median(entry.first)
                  << '\n';
    }

    static double
    now()
    {
      if (!wall && Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) == 1)
        return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
      MPI_Barrier(MPI_COMM_WORLD);
      return MPI_Wtime();
    }

    inline static bool wall = false;

  private:
    std::map<std::string, std::vector<double>> entries;
  };



  LinearSolverParameters
  solver_parameters()
  {
    LinearSolverParameters parameters;
    parameters.solver             = "amg-cg";
    parameters.relative_tolerance = tolerance;
    return parameters;
  }



  template <int dim>
  MeshParameters<dim>
  mesh_parameters(const Options &options)
  {
    MeshParameters<dim> parameters;
    for (unsigned int d = 0; d < dim; ++d)
      parameters.upper_corner[d] =
        (d == dim - 1 ? options.mesh_cells : options.cells) + options.room;
    parameters.cell_size = 1;
    return parameters;
  }



  template <int dim>
  Tensor<1, dim>
  gravity(const double t)
  {
    Tensor<1, dim> b;
    b[dim - 1] = -t;
    return b;
  }



  /** The block by the code of the program: material points under gravity. */
  template <int dim>
  class PointStep
  {
  public:
    explicit PointStep(const Options &options)
      : mesh(mesh_parameters<dim>(options), MPI_COMM_WORLD)
      , space(mesh, 1)
      , points(mesh, fields(options))
      , linear_solver(solver_parameters(), dim)
    {
      Point<dim> corner;
      for (unsigned int d = 0; d < dim; ++d)
        corner[d] = d == dim - 1 ? options.height : options.cells;
      const auto                   block  = make_box<dim>(Point<dim>(), corner);
      const std::vector<Body<dim>> bodies = {{"block", block}};
      const bool                   is_fe  = options.method == "fe";
      const CellSeeder<dim>        seeder(options.points,
                                   is_fe ? PointLayout::gauss :
                                                  PointLayout::equal);
      seed_bodies(bodies, seeder, points);
      make_basis(options, seeder, bodies);
      state = std::make_unique<State<dim>>(
        space,
        points,
        *basis,
        std::vector<std::shared_ptr<const Material>>{material(options)},
        is_fe ? MeshAfterStep::keep : MeshAfterStep::reset,
        measure(options),
        PointWeights::volumes,
        options.cell_means ? VolumetricStrain::cell_mean :
                             VolumetricStrain::pointwise);
      for (unsigned int side = 0; side < 2 * dim - 1; ++side)
        {
          GridCondition<dim> roller;
          roller.name                = "side";
          roller.side                = side;
          roller.component[side / 2] = true;
          roller.displacement        = [](const Point<dim> &, const double) {
            return Tensor<1, dim>();
          };
          conditions.push_back(roller);
        }
      // As a scene would say it: 'Value = 0; -1' with 'Curve = t'.
      const Expression<dim> weight(dim == 2 ? "0; -1" : "0; 0; -1",
                                   "benchmark",
                                   dim);
      const TimeCurve curve("t", "benchmark");
      loads.body_forces.push_back(
        {"weight",
         [weight, curve](const Point<dim> &x, const double t) {
           return curve.value(t) * weight.vector_value(x, t);
         },
         true,
         {true}});
      system = std::make_unique<MechanicsSystem<dim>>(
        *state,
        make_terms(boundaries, conditions, loads),
        std::vector<std::string>{"block"});
    }

    /**
     * Move the block by a third of a cell, so that domains lie across cells as
     * they mostly do, and time the assembly of a strained state: stencils,
     * material and matrix.
     */
    void
    time_assembly(Clock &clock, const unsigned int repeats)
    {
      const LA::Vector x = strained_state();
      for (unsigned int i = 0; i < repeats; ++i)
        clock.time("assembly", [&] { system->assemble(x, true); });
    }

    /** Move the block, and assemble once. @return the state to assemble in. */
    LA::Vector
    strained_state()
    {
      system->begin_step(t);
      system->set_target(t);
      LA::Vector x = space.vector();
      set_increment(x, 0., 0.3);
      system->accept(x);
      system->begin_step(t);
      system->set_target(t);
      x = space.vector();
      set_increment(x, 1e-2, 0.);
      system->assemble(x, true);
      return x;
    }

    /** One step; @p clock may be nothing for one that is not counted. */
    void
    step(Clock *clock)
    {
      Clock  unused;
      Clock &c     = clock ? *clock : unused;
      double start = Clock::now();
      c.time("stencils", [&] { system->begin_step(t); });
      c.time("external forces", [&] { system->set_target(t + 1); });
      NewtonParameters newton_parameters;
      newton_parameters.tolerance = 10 * tolerance;
      Newton     newton(newton_parameters);
      LA::Vector x;
      c.time("newton", [&] {
        const auto report = newton.solve(*system, linear_solver, x);
        if (!report.converged() || report.iterations != 1)
          throw std::runtime_error("the step did not converge at once: " +
                                   report.message);
        linear_iterations = report.linear_iterations;
      });
      largest_increment = x.linfty_norm();
      c.time("update and search", [&] { system->accept(x); });
      c.add("step", Clock::now() - start);
      t += 1;
    }

    /** The assembly alone, which newton contains. */
    void
    assemble(Clock &clock)
    {
      system->begin_step(t);
      system->set_target(t + 1);
      LA::Vector x;
      system->initial_guess(x);
      clock.time("assembly", [&] { system->assemble(x, true); });
    }

    BackgroundMesh<dim>                   mesh;
    GridSpace<dim>                        space;
    PointSet<dim>                         points;
    std::unique_ptr<Basis<dim>>           basis;
    std::unique_ptr<State<dim>>           state;
    std::vector<ImplicitBoundary<dim>>    boundaries;
    std::vector<GridCondition<dim>>       conditions;
    Loads<dim>                            loads;
    LinearSolver                          linear_solver;
    std::unique_ptr<MechanicsSystem<dim>> system;
    double                                t                 = 0;
    unsigned int                          linear_iterations = 0;
    double                                largest_increment = 0;

  private:
    static StrainMeasure
    measure(const Options &options)
    {
      return options.strain == "finite" ? StrainMeasure::finite :
                                          StrainMeasure::small;
    }

    static std::shared_ptr<const Material>
    material(const Options &options)
    {
      if (options.material == "plastic")
        return std::make_shared<VonMises>(
          young_modulus,
          poisson_ratio,
          1.,
          std::vector<std::pair<double, double>>{{0., 1e-3 * young_modulus}});
      return std::make_shared<LinearElastic>(young_modulus, poisson_ratio, 1.);
    }

    static PointFields
    fields(const Options &options)
    {
      PointFields layout;
      if (options.method == "gimp")
        GimpBasis<dim>::request_fields(layout, DomainUpdate::corners);
      else if (options.method == "cpdi1")
        Cpdi1Basis<dim>::request_fields(layout);
      else if (options.method == "cpdi2")
        Cpdi2Basis<dim>::request_fields(layout);
      StateFields<dim>(layout, measure(options), {material(options)});
      return layout;
    }

    void
    make_basis(const Options                &options,
               const CellSeeder<dim>        &seeder,
               const std::vector<Body<dim>> &bodies)
    {
      if (options.method == "gimp")
        basis = std::make_unique<GimpBasis<dim>>(space,
                                                 points,
                                                 seeder,
                                                 std::vector<bool>{true},
                                                 DomainUpdate::corners);
      else if (options.method == "cpdi1")
        basis =
          std::make_unique<Cpdi1Basis<dim>>(space, points, seeder, bodies);
      else if (options.method == "cpdi2")
        basis =
          std::make_unique<Cpdi2Basis<dim>>(space, points, seeder, bodies);
      else
        basis = std::make_unique<CellBasis<dim, 1>>(space, points);
      basis->initialise_points(points);
    }

    /** Displacement @p strain x + @p shift of every node, in x and y. */
    void
    set_increment(LA::Vector &x, const double strain, const double shift) const
    {
      for (unsigned int node = 0; node < space.n_nodes(); ++node)
        for (unsigned int c = 0; c < dim; ++c)
          if (space.locally_owned().is_element(space.node_dof(node) + c))
            x(space.node_dof(node) + c) =
              shift +
              (c == 0 ? strain : -0.5 * strain) * space.node_position(node)[c];
      x.compress(VectorOperation::insert);
    }
  };



  /** The same block as anyone would write it with deal.II's FEValues. */
  template <int dim>
  class FiniteElementStep
  {
  public:
    explicit FiniteElementStep(const BackgroundMesh<dim> &mesh)
      : mesh(mesh)
      , fe(FE_Q<dim>(1), dim)
      , quadrature(2)
      , dof_handler(mesh.triangulation())
      , linear_solver(solver_parameters(), dim)
      , C{young_modulus * poisson_ratio /
            ((1 + poisson_ratio) * (1 - 2 * poisson_ratio)),
          young_modulus / (2 * (1 + poisson_ratio))}
    {
      dof_handler.distribute_dofs(fe);
      const IndexSet owned = dof_handler.locally_owned_dofs();
      IndexSet       relevant;
      DoFTools::extract_locally_relevant_dofs(dof_handler, relevant);
      constraints.reinit(relevant);
      for (unsigned int side = 0; side < 2 * dim - 1; ++side)
        {
          ComponentMask mask(dim, false);
          mask.set(side / 2, true);
          VectorTools::interpolate_boundary_values(dof_handler,
                                                   side,
                                                   Functions::ZeroFunction<dim>(
                                                     dim),
                                                   constraints,
                                                   mask);
        }
      constraints.close();
      LA::SparsityPattern pattern(owned, owned, relevant, MPI_COMM_WORLD);
      DoFTools::make_sparsity_pattern(dof_handler, pattern, constraints, false);
      pattern.compress();
      matrix->reinit(pattern);
      rhs.reinit(owned, MPI_COMM_WORLD);
      solution.reinit(owned, MPI_COMM_WORLD);
      relevant_solution.reinit(owned, relevant, MPI_COMM_WORLD);
      DoFTools::extract_constant_modes(dof_handler,
                                       ComponentMask(dim, true),
                                       constant_modes);
      for (const auto &mode : constant_modes)
        {
          modes.emplace_back(owned, MPI_COMM_WORLD);
          for (unsigned int i = 0; i < owned.n_elements(); ++i)
            modes.back()(owned.nth_index_in_set(i)) = mode[i];
          modes.back().compress(VectorOperation::insert);
        }
      add_rotation(owned);
      stress.resize(mesh.triangulation().n_active_cells() * quadrature.size());
    }

    /** The residual is to be as small as points with @p force_scale need. */
    void
    step(Clock &clock, const double force_scale)
    {
      const double start = Clock::now();
      clock.time("assembly", [&] { assemble(); });
      clock.time("solve", [&] {
        linear_solver.set_up(matrix, true, modes);
        const auto report =
          linear_solver.solve(solution, rhs, tolerance * force_scale);
        linear_iterations = report.iterations;
        if (!report.converged)
          throw std::runtime_error("FE: " + report.message);
        constraints.distribute(solution);
      });
      clock.time("update", [&] { update(); });
      clock.add("step", Clock::now() - start);
    }

    unsigned int linear_iterations = 0;
    LA::Vector   solution;

  private:
    void
    add_rotation(const IndexSet &owned)
    {
      if (dim != 2)
        return;
      modes.emplace_back(owned, MPI_COMM_WORLD);
      std::map<types::global_dof_index, Point<dim>> places;
      DoFTools::map_dofs_to_support_points(mesh.mapping(), dof_handler, places);
      for (const auto &[dof, x] : places)
        if (owned.is_element(dof))
          modes.back()(dof) = modes[0](dof) == 1. ? -x[1] : x[0];
      modes.back().compress(VectorOperation::insert);
    }

    void
    assemble()
    {
      *matrix = 0;
      rhs     = 0;
      FEValues<dim>                        fe_values(mesh.mapping(),
                              fe,
                              quadrature,
                              update_values | update_gradients |
                                update_JxW_values);
      const unsigned int                   n = fe.n_dofs_per_cell();
      FullMatrix<double>                   cell_matrix(n, n);
      Vector<double>                       cell_rhs(n);
      std::vector<types::global_dof_index> dofs(n);
      const Tensor<1, dim>                 b = gravity<dim>(1.);
      std::vector<unsigned int>            component(n);
      for (unsigned int i = 0; i < n; ++i)
        component[i] = fe.system_to_component_index(i).first;
      for (const auto &cell : dof_handler.active_cell_iterators())
        if (cell->is_locally_owned())
          {
            fe_values.reinit(cell);
            cell_matrix = 0;
            cell_rhs    = 0;
            for (unsigned int q = 0; q < quadrature.size(); ++q)
              for (unsigned int i = 0; i < n; ++i)
                {
                  const unsigned int   ci = component[i];
                  const Tensor<1, dim> gi =
                    fe_values.shape_grad(i, q) * fe_values.JxW(q);
                  for (unsigned int j = 0; j < n; ++j)
                    {
                      const unsigned int    cj = component[j];
                      const Tensor<1, dim> &gj = fe_values.shape_grad(j, q);
                      cell_matrix(i, j) += C.lambda * gi[ci] * gj[cj] +
                                           C.mu * gi[cj] * gj[ci] +
                                           (ci == cj ? C.mu * (gi * gj) : 0.);
                    }
                  cell_rhs(i) +=
                    fe_values.shape_value(i, q) * b[ci] * fe_values.JxW(q);
                }
            cell->get_dof_indices(dofs);
            constraints.distribute_local_to_global(
              cell_matrix, cell_rhs, dofs, *matrix, rhs);
          }
      matrix->compress(VectorOperation::add);
      rhs.compress(VectorOperation::add);
    }

    void
    update()
    {
      relevant_solution = solution;
      FEValues<dim> fe_values(mesh.mapping(), fe, quadrature, update_gradients);
      const FEValuesExtractors::Vector     displacement(0);
      std::vector<SymmetricTensor<2, dim>> strain(quadrature.size());
      for (const auto &cell : dof_handler.active_cell_iterators())
        if (cell->is_locally_owned())
          {
            fe_values.reinit(cell);
            fe_values[displacement].get_function_symmetric_gradients(
              relevant_solution, strain);
            for (unsigned int q = 0; q < quadrature.size(); ++q)
              {
                SymmetricTensor<2, 3> full;
                for (unsigned int i = 0; i < dim; ++i)
                  for (unsigned int j = i; j < dim; ++j)
                    full[i][j] = strain[q][i][j];
                stress[cell->active_cell_index() * quadrature.size() + q] +=
                  C * full;
              }
          }
    }

    const BackgroundMesh<dim>              &mesh;
    const FESystem<dim>                     fe;
    const QGauss<dim>                       quadrature;
    DoFHandler<dim>                         dof_handler;
    AffineConstraints<double>               constraints;
    const std::shared_ptr<LA::SparseMatrix> matrix =
      std::make_shared<LA::SparseMatrix>();
    LA::Vector                         rhs;
    LA::Vector                         relevant_solution;
    std::vector<std::vector<bool>>     constant_modes;
    std::vector<LA::Vector>            modes;
    LinearSolver                       linear_solver;
    const LameConstants                C;
    std::vector<SymmetricTensor<2, 3>> stress;
  };



  /** Part by part, our step and the finite element one in turn. */
  template <int dim>
  void
  compare_with_finite_elements(const Options &options)
  {
    PointStep<dim>         points(options);
    FiniteElementStep<dim> elements(points.mesh);
    Clock                  of_points, of_elements, unused;
    points.step(nullptr);
    elements.step(unused, points.system->force_scales()[0]);
    if (std::abs(points.largest_increment / elements.solution.linfty_norm() -
                 1) > 0.02)
      throw std::runtime_error("points and elements do not agree");
    for (unsigned int i = 0; i < options.repeats; ++i)
      {
        points.assemble(of_points);
        points.step(&of_points);
        elements.step(of_elements, points.system->force_scales()[0]);
      }
    of_points.print("points ");
    of_elements.print("elements ");
    std::cout << "points linear_iterations " << points.linear_iterations
              << "\nelements linear_iterations " << elements.linear_iterations
              << '\n';
  }



  template <int dim>
  void
  time_points(const Options &options)
  {
    const double   before = memory_in_use(MPI_COMM_WORLD).current_mib;
    PointStep<dim> points(options);
    Clock          clock;
    clock.time("first step", [&] { points.step(nullptr); });
    for (unsigned int i = 0; i < options.repeats; ++i)
      {
        points.assemble(clock);
        points.step(&clock);
      }
    const double peak = memory_in_use(MPI_COMM_WORLD).peak_mib;
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) != 0)
      return;
    clock.print("points ");
    std::cout << "points linear_iterations " << points.linear_iterations
              << "\nn_points " << points.points.n_global() << "\nn_unknowns "
              << points.space.n_dofs() << "\nbytes_per_point "
              << points.points.bytes_per_point() << "\nmemory_before_mib "
              << before << "\nmemory_peak_mib " << peak << '\n';
  }



  template <int dim>
  void
  time_assembly(const Options &options)
  {
    Options with_room(options);
    with_room.room = true;
    PointStep<dim> points(with_room);
    Clock          clock;
    points.time_assembly(clock, options.repeats);
    const double peak = memory_in_use(MPI_COMM_WORLD).peak_mib;
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) != 0)
      return;
    clock.print("points ");
    std::cout << "n_points " << points.points.n_global() << "\nbytes_per_point "
              << points.points.bytes_per_point() << "\nmemory_peak_mib " << peak
              << '\n';
  }



  /**
   * Assembly and residual with the volumetric strain of points and with means
   * of cells, in turn.
   */
  template <int dim>
  void
  compare_cell_means(const Options &options)
  {
    Options with_room(options);
    with_room.room = true;
    PointStep<dim> pointwise(with_room);
    with_room.cell_means = true;
    PointStep<dim>   means(with_room);
    const LA::Vector x = pointwise.strained_state();
    means.strained_state();
    Clock clock;
    for (unsigned int i = 0; i < options.repeats; ++i)
      for (const bool tangent : {true, false})
        {
          const std::string name = tangent ? " assembly" : " residual";
          clock.time("pointwise" + name,
                     [&] { pointwise.system->assemble(x, tangent); });
          clock.time("means" + name,
                     [&] { means.system->assemble(x, tangent); });
        }
    clock.print("");
    std::cout << "n_points " << means.points.n_global() << "\nn_batches "
              << means.basis->n_batches() << "\npointwise nonzeros "
              << pointwise.system->tangent()->n_nonzero_elements()
              << "\nmeans nonzeros "
              << means.system->tangent()->n_nonzero_elements() << '\n';
  }



  /**
   * Seconds in which all points of full cells are found again after they have
   * moved by 0.3 cells times a sine, there and back, and the share of points
   * that come to another cell, on which the time depends.
   */
  template <int dim>
  void
  time_search(const BackgroundMesh<dim>                               &mesh,
              const std::function<Tensor<1, dim>(const Point<dim> &)> &motion,
              const Options                                           &options,
              const std::string                                       &name)
  {
    PointSet<dim> points(mesh, PointFields());
    seed_bodies<dim>({{"all", make_space<dim>()}},
                     CellSeeder<dim>(options.points, PointLayout::equal),
                     points);
    Clock                     clock;
    std::vector<unsigned int> cell_of(mesh.triangulation().n_active_cells() *
                                      3 * Utilities::pow(options.points, dim));
    double                    n_crossings = 0;
    for (unsigned int i = 0; i < 2 * options.repeats; ++i)
      {
        for (const auto &in_cell : points.cells())
          for (unsigned int p = in_cell.first; p < in_cell.last; ++p)
            cell_of[points.id(p)] = in_cell.cell->active_cell_index();
        for (unsigned int p = 0; p < points.n_local(); ++p)
          points.set_position(p,
                              points.position(p) +
                                (i % 2 == 0 ? 1. : -1.) *
                                  motion(points.position(p)));
        clock.time("search", [&] { points.find_cells(); });
        for (const auto &in_cell : points.cells())
          for (unsigned int p = in_cell.first; p < in_cell.last; ++p)
            n_crossings +=
              cell_of[points.id(p)] != in_cell.cell->active_cell_index();
      }
    clock.print(name + " ");
    std::cout << name << " cells " << mesh.triangulation().n_active_cells()
              << '\n'
              << name << " points " << points.n_global() << '\n'
              << name << " crossings "
              << n_crossings / (2. * options.repeats * points.n_global())
              << '\n';
  }



  /**
   * The search on a box, on the same box with bent cells and, in 2D, on an
   * annulus, all with the same number of cells and points.
   */
  template <int dim>
  void
  compare_searches(const Options &options)
  {
    const double n     = options.cells;
    const auto   shift = [n](const Point<dim> &x) {
      Tensor<1, dim> u;
      u[0] = 0.3 * std::sin(numbers::PI * x[0] / n);
      return u;
    };
    BackgroundMesh<dim> mesh(mesh_parameters<dim>(options), MPI_COMM_WORLD);
    time_search<dim>(mesh, shift, options, "box");
    // Sides stay straight; inside no cell is a parallelogram.
    mesh.move_vertices([n](const Point<dim> &x) {
      Point<dim> y      = x;
      double     bubble = 1;
      for (unsigned int d = 0; d < dim; ++d)
        bubble *= std::sin(numbers::PI * x[d] / n);
      for (unsigned int d = 0; d < dim; ++d)
        y[d] += 0.25 * bubble * std::sin(2.1 * x[d] + 1.3 * x[(d + 1) % dim]);
      return y;
    });
    time_search<dim>(mesh, shift, options, "bent");
    if constexpr (dim == 2)
      {
        MeshParameters<2>  annulus;
        const unsigned int shells = options.cells / 4;
        annulus.type              = "generator";
        annulus.generator         = "concentric_hyper_shells";
        annulus.arguments = "0, 0 : 5 : 10 : " + std::to_string(shells) +
                            " : 0 : " + std::to_string(16 * shells) + " : true";
        const BackgroundMesh<2> ring(annulus, MPI_COMM_WORLD);
        const double            angle = 0.3 * 2 * numbers::PI / (16 * shells);
        time_search<2>(
          ring,
          [angle](const Point<2> &x) {
            return angle * x[1] / x.norm() * Tensor<1, 2>({-x[1], x[0]});
          },
          options,
          "annulus");
      }
  }
} // namespace



int
main(int argc, char **argv)
{
  try
    {
      Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
      const Options                    options(argc, argv);
      Clock::wall = options.wall != 0;
      if (options.benchmark == "compare" && options.dimension == 2)
        compare_with_finite_elements<2>(options);
      else if (options.benchmark == "points" && options.dimension == 2)
        time_points<2>(options);
      else if (options.benchmark == "points" && options.dimension == 3)
        time_points<3>(options);
      else if (options.benchmark == "assembly" && options.dimension == 2)
        time_assembly<2>(options);
      else if (options.benchmark == "assembly" && options.dimension == 3)
        time_assembly<3>(options);
      else if (options.benchmark == "means" && options.dimension == 2)
        compare_cell_means<2>(options);
      else if (options.benchmark == "means" && options.dimension == 3)
        compare_cell_means<3>(options);
      else if (options.benchmark == "search" && options.dimension == 2)
        compare_searches<2>(options);
      else if (options.benchmark == "search" && options.dimension == 3)
        compare_searches<3>(options);
      else
        throw std::runtime_error(
          "usage: benchmark compare|points|assembly|means|search [--dimension 2|3] "
          "[--cells N] [--height N] [--mesh-cells N] [--points N] [--repeats N] "
          "[--method fe|mpm|gimp|cpdi1|cpdi2] [--strain small|finite] "
          "[--material elastic|plastic]");
    }
  catch (const std::exception &error)
    {
      std::cerr << error.what() << '\n';
      return 1;
    }
  return 0;
}
