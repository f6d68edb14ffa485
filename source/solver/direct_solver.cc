// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/solver/direct_solver.h>

#include <moraine/core/silent_errors.h>

#include <deal.II/base/mpi.h>

#include <Amesos.h>
#include <Epetra_CrsMatrix.h>
#include <Epetra_LinearProblem.h>
#include <Epetra_MultiVector.h>
#include <Teuchos_ParameterList.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** Refinement stops when the residual is this small relative to b, or no
     * longer falls. */
    constexpr double       refinement_goal     = 1e-14;
    constexpr unsigned int maximum_refinements = 3;

    /** The backward error |b - A x| / (|A| |x| + |b|) that a stable
     * factorisation keeps far below. */
    constexpr double backward_error_limit = 1e-11;

    /** A matrix is singular to working precision if rounding changes a solution
     * by this much relative to itself, up to sqrt(n). */
    constexpr double singular_change = 0.01;

    /**
     * Up to this many unknowns KLU: against MUMPS it is 8 times as quick at
     * 130, on two ranks, where it works on one of them, 16 times at 324 and 2
     * at 500, and 18 times for a narrow band of 2000. Where much fills in it
     * loses near the limit: on two ranks 1.4 times at 1900 in 2D, on one or two
     * 1.6 to 2 times at 1350 in 3D.
     */
    constexpr unsigned int klu_limit = 2000;

    /** Steps of a time that is summed change the values of a matrix by less
     * than this part of the largest in the row. Refinement cures that. */
    constexpr double same_value = 1e-12;

    /** Power iterations end when a step changes a singular value by less. */
    constexpr double       power_tolerance          = 1e-4;
    constexpr unsigned int maximum_power_iterations = 200;



    /** The largest singular value of an operator, by power iteration: apply(y,
     * x) is y = A^T A x. */
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
  } // namespace



  struct DirectSolver::Factors
  {
    Epetra_LinearProblem               problem;
    std::unique_ptr<Amesos_BaseSolver> solver;
  };



  DirectSolver::DirectSolver(const LA::SparseMatrix &matrix,
                             const bool              transposed)
    : matrix(matrix)
    , transposed(transposed)
    , matrix_norm(matrix.linfty_norm())
    , factors(std::make_unique<Factors>())
  {
    // deal.II's SolverDirect throws where we want a status, and hands no
    // options to Amesos; hence Amesos itself.
    factors->problem.SetOperator(
      const_cast<Epetra_CrsMatrix *>(&matrix.trilinos_matrix()));
    choose_package();
  }



  void
  DirectSolver::choose_package()
  {
    Amesos                         factory;
    const std::vector<std::string> choices =
      matrix.m() <= klu_limit && !transposed ?
        std::vector<std::string>{"Klu", "Mumps", "Umfpack"} :
        std::vector<std::string>{"Mumps", "Umfpack", "Klu"};
    for (const std::string &choice : choices)
      if (factory.Query("Amesos_" + choice))
        {
          package = choice;
          factors->solver.reset(
            factory.Create("Amesos_" + choice, factors->problem));
          // Before the factorisation: MUMPS looks at it there only.
          factors->solver->SetUseTranspose(transposed);
          factorise(true);
          // KLU is less careful with its pivots.
          if (check_factors(choice != choices.back()) || choice != "Klu")
            break;
        }
  }



  bool
  DirectSolver::check_factors(const bool may_try_another)
  {
    if (failure.empty() && !transposed &&
        singular(package == "Klu" && may_try_another))
      failure = "the matrix is singular to working precision";
    return failure.empty();
  }



  bool
  DirectSolver::has_changed() const
  {
    const Epetra_CrsMatrix &A       = matrix.trilinos_matrix();
    bool                    changed = factorised.empty() && A.NumMyRows() > 0;
    const double           *before  = factorised.data();
    for (int row = 0; row < A.NumMyRows() && !changed; ++row)
      {
        int     n_entries;
        double *values;
        A.ExtractMyRowView(row, n_entries, values);
        double largest = 0, change = 0;
        for (int k = 0; k < n_entries; ++k)
          {
            largest = std::max(largest, std::abs(before[k]));
            change  = std::max(change, std::abs(values[k] - before[k]));
          }
        changed = !(change <= same_value * largest);
        before += n_entries;
      }
    return Utilities::MPI::logical_or(changed, matrix.get_mpi_communicator());
  }



  void
  DirectSolver::refactorise()
  {
    if (failure.empty() && !has_changed())
      return;
    matrix_norm = matrix.linfty_norm();
    if (failure.empty())
      {
        factorise(false);
        if (check_factors(true))
          return;
      }
    choose_package();
  }



  DirectSolver::~DirectSolver() = default;



  void
  DirectSolver::factorise(const bool is_new)
  {
    Teuchos::ParameterList options;
    options.set("OutputLevel", 0);
    options.set("PrintTiming", false);
    options.set("PrintStatus", false);
    // KLU: the pivots of the last factorisation, as long as they are good.
    options.set("Refactorize", true);
    factors->solver->SetParameters(options);
    factorised.clear();
    const Epetra_CrsMatrix &A = matrix.trilinos_matrix();
    for (int row = 0; row < A.NumMyRows(); ++row)
      {
        int     n_entries;
        double *values;
        A.ExtractMyRowView(row, n_entries, values);
        factorised.insert(factorised.end(), values, values + n_entries);
      }
    // Amesos writes its error codes whatever its options say.
    const SilentErrors silence;
    failure.clear();
    loosest_unknown.reset();
    if ((is_new && factors->solver->SymbolicFactorization() != 0) ||
        factors->solver->NumericFactorization() != 0)
      failure = "the factorisation failed; the matrix is singular";
  }



  bool
  DirectSolver::back_substitute(LA::Vector &x, const LA::Vector &b)
  {
    const SilentErrors silence;
    factors->problem.SetLHS(&x.trilinos_vector());
    factors->problem.SetRHS(
      const_cast<Epetra_MultiVector *>(&b.trilinos_vector()));
    const bool solved = factors->solver->Solve() == 0;
    // The vectors may go before the factors are used again.
    factors->problem.SetLHS(nullptr);
    factors->problem.SetRHS(nullptr);
    return solved;
  }



  /**
   * Solve for an arbitrary right hand side; then ask how much the answer x
   * changes if every product in A x has a relative error of epsilon:
   * A^-1 s A(s' x), s and s' arbitrary factors of each row and each unknown.
   * For a singular matrix x is a null vector magnified to |A x| ~ epsilon |A|
   * |x|, so that the change is of the size of x, but for the part 1/sqrt(n)
   * of an arbitrary vector that lies along it. Bad scaling of rows alone, as
   * from stiff boundary terms, does not raise it. @p or_inaccurate: true also
   * if x is not good to twelve digits.
   */
  bool
  DirectSolver::singular(const bool or_inaccurate)
  {
    const LA::Vector probe = arbitrary_vector();
    LA::Vector       x(probe), w(probe), change(probe);
    if (!back_substitute(x, probe))
      return true;
    const double relative = matrix.residual(w, x, probe) / probe.l2_norm();
    // The part of the probe along k null vectors of n cannot be balanced:
    // sqrt(k/n) of it is left.
    if (relative < (or_inaccurate ? 1e-12 : 1e-6))
      return false;
    if (or_inaccurate)
      return true;
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
    if (epsilon * std::sqrt(1. * matrix.m()) * change.l2_norm() <
        singular_change * x.l2_norm())
      return false;
    loosest_unknown = unknown_of_largest(x);
    return true;
  }



  types::global_dof_index
  DirectSolver::unknown_of_largest(const LA::Vector &x) const
  {
    double                  largest = -1;
    types::global_dof_index unknown = numbers::invalid_dof_index;
    for (const auto i : x.locally_owned_elements())
      if (std::abs(x(i)) > largest)
        {
          largest = std::abs(x(i));
          unknown = i;
        }
    const MPI_Comm communicator = matrix.get_mpi_communicator();
    if (largest < Utilities::MPI::max(largest, communicator))
      unknown = numbers::invalid_dof_index;
    return Utilities::MPI::min(unknown, communicator);
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
    report.loosest_unknown   = loosest_unknown;
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
} // namespace moraine
