// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/solver/linear_solver.h>

#include <deal.II/base/parameter_handler.h>

#include <deal.II/base/timer.h>

#include <moraine/solver/direct_solver.h>
#include <moraine/solver/iterative_solver.h>
#include <moraine/solver/solver_choice.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace moraine
{
  using namespace dealii;

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
      gmres,
      schwarz
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
    SolverChoice                            choice;
    std::vector<std::string>                choices;
    std::string                             fall_back_reason;
    std::string unsaid; ///< change of choice for the next report
    std::optional<DirectSolver>    direct;
    std::optional<IterativeSolver> iterative;

    Implementation(const LinearSolverParameters &parameters,
                   const unsigned int            dim)
      : parameters(parameters)
      , dim(dim)
      , choice(dim == 2 ? parameters.direct_limit_2d :
                          parameters.direct_limit_3d,
               dim)
    {}

    Method
    choose(const bool symmetric)
    {
      if (parameters.solver == "direct" ||
          (parameters.solver == "auto" && choice.directly(matrix->m())))
        return Method::direct;
      fall_back_reason.clear();
      if (parameters.solver == "schwarz")
        return Method::schwarz;
      if (parameters.solver == "amg-cg" ||
          (parameters.solver == "auto" && symmetric))
        return Method::amg_cg;
      return Method::gmres;
    }

    /** Write down what solves from now on, unless it is what did. */
    void
    note_choice()
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
             << (fall_back_reason.empty() ?
                   "cheaper than the iterations so far" :
                   fall_back_reason);
      if (!choices.empty())
        unsaid = text.str();
      choices.push_back(text.str());
    }

    /** What solves, as a word of the input. */
    std::string
    method_name() const
    {
      return method == Method::direct ? "direct" :
             method == Method::amg_cg ? "amg-cg" :
             method == Method::gmres  ? "gmres" :
                                        "schwarz";
    }

    /** Build the preconditioner, or renew it. */
    void
    set_up_iterative(const std::vector<LA::Vector> &near_null_space)
    {
      if (!iterative)
        iterative.emplace(*matrix,
                          IterativeSolver::Options{
                            method == Method::amg_cg ||
                              (method == Method::schwarz && is_symmetric),
                            method == Method::schwarz,
                            is_symmetric,
                            dim,
                            parameters.relative_tolerance},
                          near_null_space);
      else if (!iterative->renew(near_null_space))
        return;
      choice.spend(SolverChoice::hierarchy_cost);
    }

    /** Iterate, counting for the choice of auto; what an old hierarchy does not
     * do, a new one may. */
    LinearReport
    iterate(LA::Vector       &x,
            const LA::Vector &b,
            const double      enough,
            const LA::Vector *weights)
    {
      const auto attempt = [&]() {
        const unsigned int most = parameters.solver == "auto" ?
                                    std::min(parameters.maximum_iterations,
                                             choice.allowed_iterations()) :
                                    parameters.maximum_iterations;
        const LinearReport report =
          iterative->solve(x, b, enough, weights, most);
        choice.spend(report.iterations);
        return report;
      };
      LinearReport report  = attempt();
      unsigned int in_vain = 0;
      if (!report.converged && !iterative->hierarchy_is_new())
        {
          in_vain = report.iterations;
          iterative->make_hierarchy();
          choice.spend(SolverChoice::hierarchy_cost);
          report = attempt();
        }
      iterative->watch(report);
      report.iterations += in_vain;
      return report;
    }
  };



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
        s.iterative.reset();
        if (s.direct)
          s.direct->refactorise();
        else
          s.direct.emplace(*matrix);
        return;
      }
    s.direct.reset();
    s.set_up_iterative(near_null_space);
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
        LinearReport report = s.iterate(x, b, enough, weights);
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
        s.iterative.reset();
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



  void
  LinearSolver::clear()
  {
    implementation->direct.reset();
    implementation->iterative.reset();
    implementation->matrix.reset();
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
                      "gmres for unsymmetric ones, both with multigrid; "
                      "schwarz is for large ones that keep their volume; auto "
                      "chooses by size and falls back to direct where they "
                      "fail",
                      Patterns::Selection("auto|direct|amg-cg|gmres|schwarz"));
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
