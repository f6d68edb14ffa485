// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/solver/linear_solver.h>

#include <deal.II/base/parameter_handler.h>

#include <deal.II/base/timer.h>

#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/solver_gmres.h>
#include <deal.II/lac/trilinos_precondition.h>

#include <moraine/solver/direct_solver.h>
#include <moraine/solver/multigrid_options.h>
#include <moraine/solver/solver_choice.h>

#include <cmath>
#include <limits>
#include <sstream>

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
      {
        if (inverse)
          for (unsigned int k = 0; k < w.locally_owned_size(); ++k)
            w.trilinos_vector()[0][k] = 1. / w.trilinos_vector()[0][k];
      }

      void
      vmult(LA::Vector &y, const LA::Vector &x) const
      {
        LA::Vector scaled(x);
        scaled.scale(w);
        A.vmult(y, scaled);
        y.scale(w);
      }

    private:
      const Operator &A;
      LA::Vector      w;
    };



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

    const LinearSolverParameters            parameters;
    const unsigned int                      dim;
    unsigned int                            n_set_ups         = 0;
    double                                  set_up_seconds    = 0;
    double                                  solve_seconds     = 0;
    double                                  condition_seconds = 0;
    std::shared_ptr<const LA::SparseMatrix> matrix;
    Method                                  method       = Method::direct;
    bool                                    is_symmetric = true;
    bool                                    is_finite    = true;
    std::vector<LA::Vector>                 near_null_space;
    SolverChoice                            choice;
    std::vector<std::string>                choices;
    std::string                             fall_back_reason;
    std::string unsaid; ///< change of choice for the next report
    std::optional<DirectSolver>                        direct;
    std::unique_ptr<TrilinosWrappers::PreconditionAMG> multigrid;
    bool hierarchy_is_new = false; ///< made of the values of the matrix
    /** Iterations for a digit with the values of its set-up; 0: not known. */
    double iterations_per_digit = 0;
    /** Iterations that later values took on top of that. */
    double extra_iterations = 0;

    Implementation(const LinearSolverParameters &parameters,
                   const unsigned int            dim)
      : parameters(parameters)
      , dim(dim)
      , choice(dim == 2 ? parameters.direct_limit_2d :
                          parameters.direct_limit_3d,
               dim)
    {}

    Method
    choose(const bool symmetric);

    /** Write down what solves from now on, unless it is what did. */
    void
    note_choice();

    /** What solves, as a word of the input. */
    std::string
    method_name() const
    {
      return method == Method::direct ? "direct" :
             method == Method::amg_cg ? "amg-cg" :
                                        "gmres";
    }

    void
    make_multigrid();

    /** Compare with the iterations that a new hierarchy took. */
    void
    watch_multigrid(const LinearReport &report);

    /** An old hierarchy has to do it at about what a new one would cost. */
    unsigned int
    allowed_iterations(const double reduction) const;

    /** @p counts: for the choice of auto. */
    LinearReport
    solve_iteratively(LA::Vector       &x,
                      const LA::Vector &b,
                      const double      enough,
                      const LA::Vector *weights,
                      const bool        counts = true);

    /** CG or GMRES. @throws SolverControl::NoConvergence */
    template <typename Matrix, typename Preconditioner>
    void
    iterate(SolverControl        &control,
            const Matrix         &A,
            const Preconditioner &P,
            LA::Vector           &x,
            const LA::Vector     &b) const;

    /** What rounding in A x leaves of a residual. */
    LA::Vector
    round_off(const LA::Vector &x) const;
  };



  void
  LinearSolver::Implementation::make_multigrid()
  {
    multigrid.reset();
    const MultigridOptions options(*matrix, is_symmetric, near_null_space, dim);
    multigrid = std::make_unique<TrilinosWrappers::PreconditionAMG>();
    multigrid->initialize(*matrix, options.list);
    hierarchy_is_new     = true;
    iterations_per_digit = extra_iterations = 0;
    choice.spend(SolverChoice::hierarchy_cost);
  }



  void
  LinearSolver::Implementation::watch_multigrid(const LinearReport &report)
  {
    const double digits = -std::log10(report.relative_residual);
    if (!(digits >= 1) || !std::isfinite(digits))
      return;
    if (hierarchy_is_new)
      iterations_per_digit = report.iterations / digits;
    else if (iterations_per_digit > 0)
      extra_iterations +=
        std::max(0., report.iterations - iterations_per_digit * digits);
  }



  LinearSolver::Implementation::Method
  LinearSolver::Implementation::choose(const bool symmetric)
  {
    if (parameters.solver == "direct" ||
        (parameters.solver == "auto" && choice.directly(matrix->m())))
      return Method::direct;
    fall_back_reason.clear();
    if (parameters.solver == "amg-cg" ||
        (parameters.solver == "auto" && symmetric))
      return Method::amg_cg;
    return Method::gmres;
  }



  unsigned int
  LinearSolver::Implementation::allowed_iterations(const double reduction) const
  {
    const unsigned int most =
      parameters.solver == "auto" ?
        std::min(parameters.maximum_iterations, choice.allowed_iterations()) :
        parameters.maximum_iterations;
    if (hierarchy_is_new)
      return most;
    const double as_new =
      iterations_per_digit * std::max(1., -std::log10(reduction));
    return std::min(most,
                    static_cast<unsigned int>(as_new +
                                              SolverChoice::hierarchy_cost));
  }



  template <typename Matrix, typename Preconditioner>
  void
  LinearSolver::Implementation::iterate(SolverControl        &control,
                                        const Matrix         &A,
                                        const Preconditioner &P,
                                        LA::Vector           &x,
                                        const LA::Vector     &b) const
  {
    using Gmres = SolverGMRES<LA::Vector>;
    if (method == Method::amg_cg)
      SolverCG<LA::Vector>(control).solve(A, x, b, P);
    else
      Gmres(control, Gmres::AdditionalData(102, true)).solve(A, x, b, P);
  }



  LA::Vector
  LinearSolver::Implementation::round_off(const LA::Vector &x) const
  {
    LA::Vector products(x), diagonal(x);
    matrix->trilinos_matrix().ExtractDiagonalCopy(
      *diagonal.trilinos_vector()(0));
    products.scale(diagonal);
    products *= 4. * std::numeric_limits<double>::epsilon();
    return products;
  }



  void
  LinearSolver::Implementation::note_choice()
  {
    std::ostringstream text;
    text << method_name();
    if (!choices.empty() &&
        choices.back().substr(0, text.str().size()) == text.str())
      return;
    text << " from linear system " << n_set_ups << " on, " << matrix->m()
         << " unknowns";
    if (method == Method::direct && !choices.empty())
      text << ": "
           << (fall_back_reason.empty() ? "cheaper than the iterations so far" :
                                          fall_back_reason);
    if (!choices.empty())
      unsaid = text.str();
    choices.push_back(text.str());
  }



  LinearReport
  LinearSolver::Implementation::solve_iteratively(LA::Vector       &x,
                                                  const LA::Vector &b,
                                                  const double      enough,
                                                  const LA::Vector *weights,
                                                  const bool        counts)
  {
    LinearReport report;
    report.solver   = method_name();
    const auto norm = [weights](LA::Vector r) {
      if (weights)
        r.scale(*weights);
      return r.l2_norm();
    };
    const double norm_b = norm(b);
    const double goal =
      std::max(parameters.relative_tolerance * norm_b, enough);
    SolverControl control(counts ? allowed_iterations(goal / norm_b) :
                                   parameters.maximum_iterations,
                          goal,
                          false,
                          false);
    x = 0.;
    try
      {
        if (weights)
          {
            // W A W y = W b, x = W y, has the residual W r.
            const Scaled<LA::SparseMatrix> A(*matrix, *weights, false);
            const Scaled<TrilinosWrappers::PreconditionAMG> P(*multigrid,
                                                              *weights,
                                                              true);
            LA::Vector                                      scaled_b(b);
            scaled_b.scale(*weights);
            iterate(control, A, P, x, scaled_b);
            x.scale(*weights);
          }
        else
          iterate(control, *matrix, *multigrid, x, b);
      }
    catch (const SolverControl::NoConvergence &)
      {
        report.message = report.solver + " did not converge in " +
                         std::to_string(control.last_step()) + " iterations";
        report.ran_out_of_iterations =
          control.last_step() >= control.max_steps();
      }
    report.iterations = control.last_step();
    if (counts)
      choice.spend(report.iterations);
    LA::Vector residual(b);
    matrix->residual(residual, x, b);
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



  LinearSolver::LinearSolver(const LinearSolverParameters &parameters,
                             const unsigned int            dim)
    : implementation(std::make_unique<Implementation>(parameters, dim))
  {}



  LinearSolver::~LinearSolver() = default;



  void
  LinearSolver::set_up(const std::shared_ptr<const LA::SparseMatrix> &matrix,
                       const bool                                     symmetric,
                       const std::vector<LA::Vector> &near_null_space)
  {
    auto         &s = *implementation;
    const AddTime timing(s.set_up_seconds);
    ++s.n_set_ups;
    if (matrix != s.matrix || symmetric != s.is_symmetric)
      clear();
    s.matrix       = matrix;
    s.is_symmetric = symmetric;
    s.method       = s.choose(symmetric);
    s.note_choice();
    s.is_finite = std::isfinite(matrix->frobenius_norm());
    if (!s.is_finite)
      return;
    if (s.method == Implementation::Method::direct)
      {
        if (s.direct)
          s.direct->refactorise();
        else
          s.direct.emplace(*matrix);
        return;
      }
    s.direct.reset();
    s.near_null_space = near_null_space;
    if (!s.multigrid || s.iterations_per_digit == 0 ||
        s.extra_iterations > SolverChoice::hierarchy_cost)
      s.make_multigrid();
    else
      {
        renew_smoother(*s.multigrid);
        s.hierarchy_is_new = false;
      }
  }



  LinearReport
  LinearSolver::solve(LA::Vector       &x,
                      const LA::Vector &b,
                      const double      enough,
                      const LA::Vector *weights)
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
    unsigned int in_vain = 0;
    if (!s.direct)
      {
        LinearReport report = s.solve_iteratively(x, b, enough, weights);
        if (!report.converged && !s.hierarchy_is_new)
          {
            in_vain = report.iterations;
            s.make_multigrid();
            report = s.solve_iteratively(x, b, enough, weights);
          }
        s.watch_multigrid(report);
        report.iterations += in_vain;
        if (!report.converged)
          x = 0.;
        if (report.converged)
          report.message.swap(s.unsaid);
        if (report.converged || s.parameters.solver != "auto")
          return report;
        in_vain            = report.iterations;
        s.fall_back_reason = report.message;
        s.choice.give_up();
        s.method = Implementation::Method::direct;
        s.note_choice();
        s.multigrid.reset();
        s.direct.emplace(*s.matrix);
      }
    LinearReport report = s.direct->solve(x, b);
    report.iterations += in_vain;
    if (!report.converged)
      x = 0.;
    if (report.message.empty())
      report.message.swap(s.unsaid);
    return report;
  }



  LinearReport
  LinearSolver::solve_aside(LA::Vector       &x,
                            const LA::Vector &b,
                            const double      enough)
  {
    auto         &s = *implementation;
    const AddTime timing(s.solve_seconds);
    Assert(is_set_up(), ExcMessage("set_up() comes before solve_aside()."));
    return s.direct ? s.direct->solve(x, b) :
                      s.solve_iteratively(x, b, enough, nullptr, false);
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



  bool
  LinearSolver::solves_directly() const
  {
    return implementation->is_finite && implementation->direct.has_value();
  }



  bool
  LinearSolver::is_set_up() const
  {
    const auto &s = *implementation;
    return s.is_finite && (s.direct || s.multigrid);
  }



  void
  LinearSolver::clear()
  {
    implementation->direct.reset();
    implementation->multigrid.reset();
    implementation->matrix.reset();
    // Of another layout, a Trilinos vector cannot be assigned to.
    implementation->near_null_space.clear();
  }



  void
  LinearSolver::write(Archive &archive) const
  {
    const auto &s = *implementation;
    s.choice.write(archive);
    archive.write_lines("solver/choices", s.choices);
    archive.write_text("solver/change_to_tell", s.unsaid);
    archive.write_text("solver/reason", s.fall_back_reason);
    archive.write("solver/set_ups", s.n_set_ups);
  }



  void
  LinearSolver::read(const Archive &archive)
  {
    clear();
    auto &s = *implementation;
    s.choice.read(archive);
    s.choices          = archive.lines("solver/choices");
    s.unsaid           = archive.text("solver/change_to_tell");
    s.fall_back_reason = archive.text("solver/reason");
    s.n_set_ups        = archive.integer("solver/set_ups");
  }



  const std::vector<std::string> &
  LinearSolver::choices() const
  {
    return implementation->choices;
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
                      "falls back to direct where they fail",
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
