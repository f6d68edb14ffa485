// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <deal.II/base/parameter_handler.h>

#include <deal.II/base/timer.h>

#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/solver_gmres.h>
#include <deal.II/lac/trilinos_precondition.h>

#include <moraine/solver/linear_solver.h>

#include <Amesos.h>
#include <Epetra_LinearProblem.h>
#include <Epetra_MultiVector.h>
#include <Teuchos_ParameterList.hpp>

#include <array>
#include <cmath>
#include <iostream>
#include <limits>
#include <optional>
#include <random>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /**
     * Refinement stops when the residual is this small relative to b, or no
     * longer falls.
     */
    constexpr double       refinement_goal     = 1e-14;
    constexpr unsigned int maximum_refinements = 3;

    /**
     * The backward error |b - A x| / (|A| |x| + |b|) that a stable
     * factorisation keeps far below.
     */
    constexpr double backward_error_limit = 1e-11;

    /**
     * A matrix is singular to working precision if rounding changes a solution
     * by this much relative to itself, up to sqrt(n).
     */
    constexpr double singular_change = 0.01;

    /** Power iterations end when a step changes a singular value by less. */
    constexpr double       power_tolerance          = 1e-4;
    constexpr unsigned int maximum_power_iterations = 200;



    double
    relative_to(const double value, const double reference)
    {
      return reference > 0. ? value / reference : value;
    }



    /**
     * Amesos writes its error codes to the terminal whatever its options say;
     * ours are in the report.
     */
    class SilenceErrors
    {
    public:
      SilenceErrors()
        : buffer(std::cerr.rdbuf(nullptr))
      {}

      ~SilenceErrors()
      {
        std::cerr.rdbuf(buffer);
      }

      SilenceErrors(const SilenceErrors &) = delete;

    private:
      std::streambuf *const buffer;
    };



    /**
     * A factorisation by Amesos, kept for many right hand sides.
     */
    class DirectSolver
    {
    public:
      /** @p transposed: solve with the transpose of the matrix. */
      explicit DirectSolver(const LA::SparseMatrix &matrix,
                            const bool              transposed = false);

      LinearReport
      solve(LA::Vector &x, const LA::Vector &b);

      double
      condition_number();

    private:
      const LA::SparseMatrix            &matrix;
      const double                       matrix_norm;
      std::string                        package;
      Epetra_LinearProblem               problem;
      std::unique_ptr<Amesos_BaseSolver> factors;
      std::string                        failure;

      void
      factorise();

      bool
      back_substitute(LA::Vector &x, const LA::Vector &b);

      bool
      singular();

      LA::Vector
      arbitrary_vector() const;
    };



    DirectSolver::DirectSolver(const LA::SparseMatrix &matrix,
                               const bool              transposed)
      : matrix(matrix)
      , matrix_norm(matrix.linfty_norm())
    {
      // deal.II's SolverDirect throws where we want a status, and hands no
      // options to Amesos; hence Amesos itself.
      problem.SetOperator(
        const_cast<Epetra_CrsMatrix *>(&matrix.trilinos_matrix()));
      Amesos                            factory;
      const std::array<const char *, 3> choices{{"Mumps", "Umfpack", "Klu"}};
      for (const char *choice : choices)
        if (factory.Query(std::string("Amesos_") + choice))
          {
            package = choice;
            factors.reset(
              factory.Create(std::string("Amesos_") + choice, problem));
            break;
          }
      // Before the factorisation: MUMPS looks at it there only.
      factors->SetUseTranspose(transposed);
      factorise();
      if (failure.empty() && !transposed && singular())
        failure = "the matrix is singular to working precision";
    }



    void
    DirectSolver::factorise()
    {
      Teuchos::ParameterList options;
      options.set("OutputLevel", 0);
      options.set("PrintTiming", false);
      options.set("PrintStatus", false);
      factors->SetParameters(options);
      const SilenceErrors silence;
      if (factors->SymbolicFactorization() != 0 ||
          factors->NumericFactorization() != 0)
        failure = "the factorisation failed; the matrix is singular";
    }



    bool
    DirectSolver::back_substitute(LA::Vector &x, const LA::Vector &b)
    {
      const SilenceErrors silence;
      problem.SetLHS(&x.trilinos_vector());
      problem.SetRHS(const_cast<Epetra_MultiVector *>(&b.trilinos_vector()));
      return factors->Solve() == 0;
    }



    /**
     * Solve for an arbitrary right hand side; then ask how much the answer x
     * changes if every product in A x has a relative error of epsilon:
     * A^-1 s A(s' x), s and s' arbitrary factors of each row and each unknown.
     * For a singular matrix x is a null vector magnified to |A x| ~ epsilon |A|
     * |x|, so that the change is of the size of x, but for the part 1/sqrt(n)
     * of an arbitrary vector that lies along it. Bad scaling of rows alone, as
     * from stiff boundary terms, does not raise it.
     */
    bool
    DirectSolver::singular()
    {
      const LA::Vector probe = arbitrary_vector();
      LA::Vector       x(probe), w(probe), change(probe);
      if (!back_substitute(x, probe))
        return true;
      const double relative = matrix.residual(w, x, probe) / probe.l2_norm();
      // The part of the probe along k null vectors of n cannot be balanced:
      // sqrt(k/n) of it is left.
      if (relative < 1e-6)
        return false;
      LA::Vector perturbed(x);
      perturbed.scale(probe);
      matrix.vmult(w, perturbed);
      // Factors that do not follow the first ones.
      LA::Vector other(probe);
      other.scale(probe);
      other.add(-1. / 3.);
      w.scale(other);
      if (!std::isfinite(relative) || !back_substitute(change, w))
        return true;
      const double epsilon = std::numeric_limits<double>::epsilon();
      return !(epsilon * std::sqrt(1. * matrix.m()) * change.l2_norm() <
               singular_change * x.l2_norm());
    }



    /** The same on any number of ranks. */
    LA::Vector
    DirectSolver::arbitrary_vector() const
    {
      LA::Vector vector(matrix.locally_owned_range_indices(),
                        matrix.get_mpi_communicator());
      for (const auto i : vector.locally_owned_elements())
        {
          std::minstd_rand generator(i + 1);
          generator.discard(4);
          vector(i) = 2. * std::generate_canonical<double, 32>(generator) - 1.;
        }
      vector.compress(VectorOperation::insert);
      return vector;
    }



    /**
     * The largest singular value of an operator, by power iteration: apply(y,
     * x) is y = A^T A x.
     */
    template <typename Apply>
    double
    largest_singular_value(LA::Vector x, const Apply &apply)
    {
      LA::Vector y(x);
      double     value = 0, before;
      x *= 1. / x.l2_norm();
      for (unsigned int i = 0; i < maximum_power_iterations; ++i)
        {
          apply(y, x);
          before = value;
          value  = y.l2_norm();
          if (!(value > 0.) ||
              std::abs(value - before) < power_tolerance * value)
            break;
          x = y;
          x *= 1. / value;
        }
      return std::sqrt(value);
    }



    double
    DirectSolver::condition_number()
    {
      if (!failure.empty())
        return std::numeric_limits<double>::infinity();
      DirectSolver     adjoint(matrix, true);
      const LA::Vector start = arbitrary_vector();
      LA::Vector       between(start);
      const double     largest =
        largest_singular_value(start, [&](LA::Vector &y, const LA::Vector &x) {
          matrix.vmult(between, x);
          matrix.Tvmult(y, between);
        });
      const double of_inverse =
        largest_singular_value(start, [&](LA::Vector &y, const LA::Vector &x) {
          adjoint.back_substitute(between, x);
          back_substitute(y, between);
        });
      return largest * of_inverse;
    }



    LinearReport
    DirectSolver::solve(LA::Vector &x, const LA::Vector &b)
    {
      LinearReport report;
      report.solver            = "direct (" + package + ")";
      report.message           = failure;
      const double norm_b      = b.l2_norm();
      x                        = 0.;
      report.relative_residual = relative_to(norm_b, norm_b);
      if (!failure.empty())
        return report;
      if (!back_substitute(x, b))
        {
          report.message = "the back substitution failed";
          return report;
        }

      LA::Vector residual(b), correction(b), better(b);
      double     norm = matrix.residual(residual, x, b);
      for (unsigned int i = 0;
           i < maximum_refinements && norm > refinement_goal * norm_b;
           ++i)
        {
          if (!back_substitute(correction, residual))
            break;
          better = x;
          better += correction;
          const double better_norm = matrix.residual(residual, better, b);
          if (!(better_norm < norm))
            break;
          const bool worth_another = better_norm < 0.5 * norm;
          x                        = better;
          norm                     = better_norm;
          if (!worth_another)
            break;
        }
      report.relative_residual = relative_to(norm, norm_b);
      report.converged =
        std::isfinite(norm) &&
        norm <= backward_error_limit * (matrix_norm * x.l2_norm() + norm_b);
      if (!report.converged)
        report.message = "the solution does not satisfy the equations";
      return report;
    }



    /**
     * ML's options for elasticity, and the modes it needs while they are used.
     */
    class MultigridOptions
    {
    public:
      Teuchos::ParameterList list;

      MultigridOptions(const LA::SparseMatrix        &matrix,
                       const bool                     symmetric,
                       const std::vector<LA::Vector> &near_null_space,
                       const unsigned int             dim);

    private:
      std::unique_ptr<Epetra_MultiVector> modes;
    };



    /**
     * Whether the unknowns of a node follow each other, component by
     * component, on every rank. The first dim modes are the translations, so
     * they tell the component of an unknown.
     */
    bool
    unknowns_come_by_node(const std::vector<LA::Vector> &near_null_space,
                          const unsigned int             dim)
    {
      const auto         n_owned = near_null_space[0].locally_owned_size();
      const unsigned int n_modes = near_null_space.size();
      bool               by_node = n_modes >= dim && n_owned % dim == 0;
      for (unsigned int c = 0; by_node && c < dim; ++c)
        {
          const double *values = near_null_space[c].trilinos_vector()[0];
          for (unsigned int i = 0; by_node && i < n_owned; ++i)
            by_node = (values[i] == 0. || i % dim == c);
        }
      return Utilities::MPI::min(by_node ? 1 : 0,
                                 near_null_space[0].get_mpi_communicator()) ==
             1;
    }



    MultigridOptions::MultigridOptions(
      const LA::SparseMatrix        &matrix,
      const bool                     symmetric,
      const std::vector<LA::Vector> &near_null_space,
      const unsigned int             dim)
    {
      TrilinosWrappers::PreconditionAMG::AdditionalData data;
      data.elliptic              = symmetric;
      data.aggregation_threshold = 1e-4;
      data.smoother_sweeps       = 2;
      data.smoother_type = symmetric ? "Chebyshev" : "symmetric Gauss-Seidel";
      data.set_parameters(list, modes, matrix);
      list.set("ML output", 0);
      if (near_null_space.empty())
        return;

      const Epetra_Map &map = matrix.trilinos_matrix().DomainMap();
      modes = std::make_unique<Epetra_MultiVector>(map, near_null_space.size());
      for (unsigned int m = 0; m < near_null_space.size(); ++m)
        *(*modes)(m) = *near_null_space[m].trilinos_vector()(0);
      list.set("null space: type", "pre-computed");
      list.set("null space: dimension", modes->NumVectors());
      list.set("null space: vectors", modes->Values());
      if (unknowns_come_by_node(near_null_space, dim))
        list.set("PDE equations", static_cast<int>(dim));
    }
  } // namespace



  namespace
  {
    /** Adds the wall time of its life to a sum. */
    class AddTime
    {
    public:
      explicit AddTime(double &sum)
        : sum(sum)
      {}

      ~AddTime()
      {
        sum += timer.wall_time();
      }

    private:
      Timer   timer;
      double &sum;
    };
  } // namespace



  struct LinearSolver::Implementation
  {
    enum class Method
    {
      direct,
      amg_cg,
      gmres
    };

    const LinearSolverParameters                       parameters;
    const unsigned int                                 dim;
    unsigned int                                       n_set_ups      = 0;
    double                                             set_up_seconds = 0;
    double                                             solve_seconds  = 0;
    double                                             condition_seconds = 0;
    const LA::SparseMatrix                            *matrix         = nullptr;
    Method                                             method = Method::direct;
    bool                                               is_finite = true;
    std::string                                        fall_back_reason;
    std::optional<DirectSolver>                        direct;
    std::unique_ptr<TrilinosWrappers::PreconditionAMG> multigrid;

    Implementation(const LinearSolverParameters &parameters,
                   const unsigned int            dim)
      : parameters(parameters)
      , dim(dim)
    {}

    Method
    choose(const bool symmetric) const;

    LinearReport
    solve_iteratively(LA::Vector &x, const LA::Vector &b);
  };



  LinearSolver::Implementation::Method
  LinearSolver::Implementation::choose(const bool symmetric) const
  {
    const unsigned int limit =
      dim == 2 ? parameters.direct_limit_2d : parameters.direct_limit_3d;
    if (parameters.solver == "direct" ||
        (parameters.solver == "auto" && matrix->m() <= limit))
      return Method::direct;
    if (parameters.solver == "amg-cg" ||
        (parameters.solver == "auto" && symmetric))
      return Method::amg_cg;
    return Method::gmres;
  }



  LinearReport
  LinearSolver::Implementation::solve_iteratively(LA::Vector       &x,
                                                  const LA::Vector &b)
  {
    LinearReport report;
    report.solver        = method == Method::amg_cg ? "amg-cg" : "gmres";
    const double  norm_b = b.l2_norm();
    SolverControl control(parameters.maximum_iterations,
                          parameters.relative_tolerance * norm_b,
                          false,
                          false);
    x = 0.;
    try
      {
        if (method == Method::amg_cg)
          SolverCG<LA::Vector>(control).solve(*matrix, x, b, *multigrid);
        else
          SolverGMRES<LA::Vector>(control,
                                  SolverGMRES<LA::Vector>::AdditionalData(102,
                                                                          true))
            .solve(*matrix, x, b, *multigrid);
      }
    catch (const SolverControl::NoConvergence &)
      {
        report.message = report.solver + " did not converge in " +
                         std::to_string(control.last_step()) + " iterations";
      }
    report.iterations = control.last_step();
    LA::Vector   residual(b);
    const double norm        = matrix->residual(residual, x, b);
    report.relative_residual = relative_to(norm, norm_b);
    // The residual that the iteration carries along drifts from the true one.
    report.converged = report.message.empty() &&
                       norm <= 10. * parameters.relative_tolerance * norm_b;
    if (!report.converged && report.message.empty())
      report.message = report.solver + " lost its residual to round-off";
    return report;
  }



  LinearSolver::LinearSolver(const LinearSolverParameters &parameters,
                             const unsigned int            dim)
    : implementation(std::make_unique<Implementation>(parameters, dim))
  {}



  LinearSolver::~LinearSolver() = default;



  void
  LinearSolver::set_up(const LA::SparseMatrix        &matrix,
                       const bool                     symmetric,
                       const std::vector<LA::Vector> &near_null_space)
  {
    auto         &s = *implementation;
    const AddTime timing(s.set_up_seconds);
    ++s.n_set_ups;
    clear();
    s.matrix = &matrix;
    s.method = s.choose(symmetric);
    s.fall_back_reason.clear();
    s.is_finite = std::isfinite(matrix.frobenius_norm());
    if (!s.is_finite)
      return;
    if (s.method == Implementation::Method::direct)
      {
        s.direct.emplace(matrix);
        return;
      }
    const MultigridOptions options(matrix, symmetric, near_null_space, s.dim);
    s.multigrid = std::make_unique<TrilinosWrappers::PreconditionAMG>();
    s.multigrid->initialize(matrix, options.list);
  }



  LinearReport
  LinearSolver::solve(LA::Vector &x, const LA::Vector &b)
  {
    auto         &s = *implementation;
    const AddTime timing(s.solve_seconds);
    Assert(s.matrix != nullptr, ExcMessage("set_up() comes before solve()."));
    if (!s.is_finite || !std::isfinite(b.l2_norm()))
      {
        LinearReport report;
        report.message = s.is_finite ?
                           "the right hand side is not a number" :
                           "the matrix has entries that are not numbers";
        x              = 0.;
        return report;
      }
    if (!s.direct)
      {
        const LinearReport report = s.solve_iteratively(x, b);
        if (!report.converged)
          x = 0.;
        if (report.converged || s.parameters.solver != "auto")
          return report;
        s.fall_back_reason = report.message + "; solved directly";
        s.multigrid.reset();
        s.direct.emplace(*s.matrix);
      }
    LinearReport report = s.direct->solve(x, b);
    if (!report.converged)
      x = 0.;
    if (report.message.empty())
      report.message = s.fall_back_reason;
    return report;
  }



  std::optional<double>
  LinearSolver::condition_number() const
  {
    auto &s = *implementation;
    if (!s.parameters.estimate_condition_number || s.matrix == nullptr ||
        !s.is_finite)
      return {};
    const AddTime timing(s.condition_seconds);
    return s.direct ? s.direct->condition_number() :
                      DirectSolver(*s.matrix).condition_number();
  }



  void
  LinearSolver::clear()
  {
    implementation->direct.reset();
    implementation->multigrid.reset();
    implementation->matrix = nullptr;
  }



  unsigned int
  LinearSolver::n_set_ups() const
  {
    return implementation->n_set_ups;
  }



  double
  LinearSolver::set_up_seconds() const
  {
    return implementation->set_up_seconds;
  }



  double
  LinearSolver::solve_seconds() const
  {
    return implementation->solve_seconds;
  }



  double
  LinearSolver::condition_seconds() const
  {
    return implementation->condition_seconds;
  }



  void
  LinearSolverParameters::add_parameters(ParameterHandler &prm)
  {
    prm.add_parameter("Solver",
                      solver,
                      "direct factorises; amg-cg is for symmetric tangents, "
                      "gmres for unsymmetric ones; auto chooses by size and "
                      "falls back to direct",
                      Patterns::Selection("auto|direct|amg-cg|gmres"));
    prm.add_parameter("Relative tolerance",
                      relative_tolerance,
                      "of iterative solvers: residual over right hand side",
                      Patterns::Double(1e-16, 1e-2));
    prm.add_parameter("Maximum linear iterations",
                      maximum_iterations,
                      "of iterative linear solvers",
                      Patterns::Integer(1));
    prm.add_parameter("Direct limit 2D",
                      direct_limit_2d,
                      "auto solves directly up to this many unknowns in 2D",
                      Patterns::Integer(0));
    prm.add_parameter("Direct limit 3D",
                      direct_limit_3d,
                      "auto solves directly up to this many unknowns in 3D",
                      Patterns::Integer(0));
    prm.add_parameter("Estimate condition number",
                      estimate_condition_number,
                      "of each step's last tangent, in the 2-norm; the largest "
                      "goes to summary.json. Costs many solves a step");
  }
} // namespace moraine
