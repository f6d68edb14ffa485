// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/solver/iterative_solver.h>

#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/solver_gmres.h>
#include <deal.II/lac/trilinos_precondition.h>

#include <moraine/solver/multigrid_options.h>
#include <moraine/solver/schwarz_preconditioner.h>
#include <moraine/solver/solver_choice.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** A residual above this share of the right hand side is no solution,
     * whatever round-off there may be. */
    constexpr double lost = 1e-6;



    /** W A W with a diagonal W, or with its inverse. */
    template <typename Operator>
    class Scaled
    {
    public:
      Scaled(const Operator &A, const LA::Vector &weights, const bool inverse)
        : A(A)
        , w(weights)
        , scaled(weights)
      {
        if (inverse)
          for (unsigned int k = 0; k < w.locally_owned_size(); ++k)
            w.trilinos_vector()[0][k] = 1. / w.trilinos_vector()[0][k];
      }

      void
      vmult(LA::Vector &y, const LA::Vector &x) const
      {
        scaled = x;
        scaled.scale(w);
        A.vmult(y, scaled);
        y.scale(w);
      }

    private:
      const Operator    &A;
      LA::Vector         w;
      mutable LA::Vector scaled;
    };
  } // namespace



  IterativeSolver::IterativeSolver(
    const LA::SparseMatrix        &matrix,
    const Options                 &options,
    const std::vector<LA::Vector> &near_null_space)
    : matrix(matrix)
    , options(options)
    , near_null_space(near_null_space)
  {
    make_hierarchy();
  }



  IterativeSolver::~IterativeSolver() = default;



  bool
  IterativeSolver::renew(const std::vector<LA::Vector> &new_near_null_space)
  {
    near_null_space = new_near_null_space;
    if (iterations_per_digit == 0 ||
        extra_iterations > SolverChoice::hierarchy_cost)
      {
        make_hierarchy();
        return true;
      }
    if (!options.schwarz)
      renew_smoother(
        static_cast<TrilinosWrappers::PreconditionAMG &>(*preconditioner));
    is_new = false;
    return false;
  }



  void
  IterativeSolver::make_hierarchy()
  {
    preconditioner.reset();
    if (options.schwarz)
      preconditioner =
        std::make_unique<SchwarzPreconditioner>(matrix, options.dim);
    else
      {
        const MultigridOptions multigrid_options(matrix,
                                                 options.symmetric,
                                                 near_null_space,
                                                 options.dim);
        auto multigrid = std::make_unique<TrilinosWrappers::PreconditionAMG>();
        multigrid->initialize(matrix, multigrid_options.list);
        preconditioner = std::move(multigrid);
      }
    is_new               = true;
    iterations_per_digit = extra_iterations = 0;
  }



  void
  IterativeSolver::watch(const LinearReport &report)
  {
    const double digits = -std::log10(report.relative_residual);
    if (!(digits >= 1) || !std::isfinite(digits))
      return;
    if (is_new)
      iterations_per_digit = report.iterations / digits;
    else if (iterations_per_digit > 0)
      extra_iterations +=
        std::max(0., report.iterations - iterations_per_digit * digits);
  }



  unsigned int
  IterativeSolver::allowed_iterations(const double       reduction,
                                      const unsigned int most) const
  {
    if (is_new)
      return most;
    const double as_new =
      iterations_per_digit * std::max(1., -std::log10(reduction));
    return std::min(most,
                    static_cast<unsigned int>(as_new +
                                              SolverChoice::hierarchy_cost));
  }



  template <typename Control, typename Matrix, typename Preconditioner>
  void
  IterativeSolver::iterate(Control              &control,
                           const Matrix         &A,
                           const Preconditioner &P,
                           LA::Vector           &x,
                           const LA::Vector     &b) const
  {
    using Gmres = SolverGMRES<LA::Vector>;
    if (options.conjugate_gradients)
      SolverCG<LA::Vector>(control).solve(A, x, b, P);
    else
      Gmres(control, Gmres::AdditionalData(102, true)).solve(A, x, b, P);
  }



  LA::Vector
  IterativeSolver::round_off(const LA::Vector &x) const
  {
    LA::Vector products(x), diagonal(x);
    matrix.trilinos_matrix().ExtractDiagonalCopy(
      *diagonal.trilinos_vector()(0));
    products.scale(diagonal);
    products *= 4. * std::numeric_limits<double>::epsilon();
    return products;
  }



  LinearReport
  IterativeSolver::solve(LA::Vector        &x,
                         const LA::Vector  &b,
                         const double       enough,
                         const LA::Vector  *weights,
                         const unsigned int most) const
  {
    LinearReport report;
    report.solver   = options.schwarz             ? "schwarz" :
                      options.conjugate_gradients ? "amg-cg" :
                                                    "gmres";
    const auto norm = [weights](LA::Vector r) {
      if (weights)
        r.scale(*weights);
      return r.l2_norm();
    };
    const double  norm_b = norm(b);
    const double  goal = std::max(options.relative_tolerance * norm_b, enough);
    SolverControl control(allowed_iterations(goal / norm_b, most),
                          goal,
                          false,
                          false);
    x = 0.;
    try
      {
        if (weights)
          {
            // W A W y = W b, x = W y, has the residual W r.
            const Scaled<LA::SparseMatrix> A(matrix, *weights, false);
            const Scaled<TrilinosWrappers::PreconditionBase> P(*preconditioner,
                                                               *weights,
                                                               true);
            LA::Vector                                       scaled_b(b);
            scaled_b.scale(*weights);
            iterate(control, A, P, x, scaled_b);
            x.scale(*weights);
          }
        else
          iterate(control, matrix, *preconditioner, x, b);
      }
    catch (const SolverControl::NoConvergence &)
      {
        report.message = report.solver + " did not converge in " +
                         std::to_string(control.last_step()) + " iterations";
        report.ran_out_of_iterations =
          control.last_step() >= control.max_steps();
      }
    report.iterations = control.last_step();
    LA::Vector residual(b);
    matrix.residual(residual, x, b);
    const double left        = norm(residual);
    report.relative_residual = relative_to(left, norm_b);
    // The residual that the iteration carries along drifts from the true one.
    report.converged =
      report.message.empty() &&
      (left <= 10. * goal ||
       left <= std::min(10. * norm(round_off(x)), lost * norm_b));
    if (!report.converged && report.message.empty())
      report.message = report.solver + " lost its residual to round-off";
    return report;
  }
} // namespace moraine
