// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/study/buckling_study.h>

#include <moraine/core/exceptions.h>
#include <moraine/core/json.h>
#include <moraine/core/version.h>

#include <deal.II/base/mpi.h>

#include <deal.II/lac/parpack_solver.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <complex>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int n_modes = 3, n_arnoldi = 30, most_restarts = 300;
    constexpr double       eigenvalue_accuracy = 1e-9;



    /** @f$-K^{-1} K_g@f$ at the end of a run, as ARPACK's wrapper wants it. */
    template <int dim>
    struct BucklingOperator
    {
      /** Set up K, and keep stresses times volume in the order of the batches
       * and their points. Collective. */
      explicit BucklingOperator(Model<dim> &model)
        : model(model)
      {
        MechanicsSystem<dim> &system = *model.system;
        State<dim>           &state  = *model.state;
        const double          t      = system.step_context().t_end;
        model.linear_solver->clear();
        system.begin_step(t);
        system.set_target(t);
        system.initial_guess(zero);
        system.assemble(zero, true);
        model.linear_solver->set_up(system.tangent(),
                                    system.symmetric(),
                                    system.near_null_space());
        StencilBlock<dim>           block;
        TrialPoints<dim>            trial;
        std::vector<Tensor<1, dim>> none;
        for (unsigned int g = 0; g < state.point_basis().n_batches(); ++g)
          {
            state.evaluate(g, block);
            none.resize(block.n_nodes);
            for (unsigned int begin = 0, end = 0; begin < block.n_points;
                 begin = end)
              {
                end = state.end_of_body(block, begin);
                trial.evaluate(state, block, begin, end, none.data());
                for (unsigned int p = 0; p < trial.n_points(); ++p)
                  {
                    auto &stress = stresses.emplace_back();
                    for (unsigned int i = 0; i < dim; ++i)
                      for (unsigned int j = 0; j < dim; ++j)
                        stress[i][j] = trial.weight(p) * trial.stress(p)[i][j];
                  }
              }
          }
      }

      void
      vmult(LA::Vector &u, const LA::Vector &v) const
      {
        std::vector<Tensor<1, dim>> values, forces(model.space->n_nodes());
        LA::Vector                  f(v);
        model.system->apply_constraints(f);
        model.space->node_values(f, values);
        StencilBlock<dim> block;
        auto              s = stresses.begin();
        for (unsigned int g = 0; g < model.state->point_basis().n_batches();
             ++g)
          {
            model.state->evaluate(g, block);
            for (unsigned int p = 0; p < block.n_points; ++p, ++s)
              {
                const Tensor<1, dim> *grad_N = block.grad_N(p);
                Tensor<2, dim>        gradient;
                for (unsigned int a = 0; a < block.n_nodes; ++a)
                  gradient += outer_product(values[block.nodes[a]], grad_N[a]);
                const Tensor<2, dim> d(symmetrize(gradient));
                const Tensor<2, dim> P = *s * d - (gradient - d) * *s;
                for (unsigned int a = 0; a < block.n_nodes; ++a)
                  forces[block.nodes[a]] += P * grad_N[a];
              }
          }
        model.space->sum_node_values(forces, f);
        model.system->condense(f);
        const LinearReport report = model.linear_solver->solve(u, f);
        if (!report.converged)
          throw ComputationError("linear buckling: " +
                                 failure_of(report, *model.system));
      }

      Model<dim>                 &model;
      LA::Vector                  zero;
      std::vector<Tensor<2, dim>> stresses;
    };



    /** The smallest positive @f$\lambda@f$ in increasing order. Collective. */
    template <int dim>
    std::vector<double>
    load_factors(Model<dim> &model)
    {
      const BucklingOperator<dim> A(model);
      const MPI_Comm              communicator = model.space->communicator();
      if (A.zero.size() <= n_arnoldi ||
          Utilities::MPI::min(A.zero.locally_owned_size(), communicator) < 1)
        throw ComputationError("linear buckling needs more than 30 unknowns, "
                               "and some on each rank");
      using Arpack = PArpackSolver<LA::Vector>;
      SolverControl control(most_restarts, eigenvalue_accuracy);
      Arpack        arpack(control,
                    communicator,
                    {n_arnoldi, Arpack::largest_real_part, false, 1});
      arpack.reinit(A.zero);
      std::vector<std::complex<double>> shares(n_modes);
      std::vector<LA::Vector>           modes(n_modes + 1, A.zero);
      try
        {
          arpack.solve(A, A, A, shares, modes, n_modes);
        }
      catch (const ExceptionBase &)
        {
          throw ComputationError("linear buckling: ARPACK found no modes");
        }
      std::vector<double> found;
      for (const auto &share : shares)
        if (share.real() > 0)
          found.push_back(1. / share.real());
      std::sort(found.begin(), found.end());
      return found;
    }



    /** @return whether `Mesh after step` is left to us.
     * @throw InputError if the scene is not for linear buckling. */
    bool
    may_stay(const InputFile &input)
    {
      const auto of = [](const auto &scene) {
        refuse_inertia(scene.stages, "buckling", "bodies must be at rest");
        if (scene.method.strain_measure() != StrainMeasure::small)
          reject("Study", "Kind", "buckling", "with 'Strain = small' only");
        return scene.method.mesh_after_step == "default";
      };
      return dimension_of(input) == 2 ? of(Scene<2>(input)) :
                                        of(Scene<3>(input));
    }



    std::string
    line_of(const StudyResult &row, const std::vector<double> &factors)
    {
      const std::string &label = row.study_case.label;
      const std::string  begin =
        "  " + label + (label.empty() ? "buckling: " : ": buckling: ");
      if (row.summary.status != "ok")
        return begin + row.summary.status + ": " + row.summary.message + "\n";
      if (factors.empty())
        return begin + "at no multiple of the load\n";
      return fmt::format("{}at {:.4g} times the load\n",
                         begin,
                         fmt::join(factors, ", "));
    }
  } // namespace



  int
  find_buckling_loads(const StudySetting &setting)
  {
    std::vector<StudyCase> cases = study_cases(setting.input);
    for (StudyCase &study_case : cases)
      if (may_stay(study_case.input))
        study_case.input.apply_override("Method/Mesh after step = keep");
    make_study_folder(setting, true);

    setting.console << "Moraine " << version << ", linear buckling\n";
    std::vector<StudyResult> rows;
    std::vector<std::string> statuses;
    std::vector<Json>        json;
    for (const StudyCase &study_case : cases)
      {
        std::vector<double> factors;
        const auto find = [&](auto &model) { factors = load_factors(model); };
        const Summary summary =
          summary_of_case(study_case.input, setting.communicator, find, find);
        rows.push_back({study_case, summary, {}, {}});
        setting.console << line_of(rows.back(), factors);
        json.push_back({{"case", study_case.label},
                        {"status", summary.status},
                        {"message", summary.message},
                        {"load_factors", factors},
                        {"unknowns", summary.sizes.unknowns}});
        write_csv(setting, rows);
        write_study_summary(setting, json);
        statuses.push_back(summary.status);
        if (summary.status == "interrupted")
          break;
      }
    setting.console << "  results in " << setting.file("summary.json")
                    << std::endl;
    return exit_code_of(statuses);
  }
} // namespace moraine
