// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/run/geometric_stiffness.h>

#include <algorithm>
#include <cmath>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int most_power_iterations = 8;

    /** Growth of the eigenvalue in an iteration that ends them. */
    constexpr double power_growth = 0.01;

    /** Of an iterative solver: of the right-hand side. */
    constexpr double power_residual = 1e-3;

    /** @f$K_g@f$ of the stresses of the trial state, which it does not keep as
     * a matrix. */
    template <int dim>
    class GeometricStiffness
    {
    public:
      explicit GeometricStiffness(const State<dim> &state);

      /** @f$K_g v@f$. Collective. */
      LA::Vector
      times(const LA::Vector &v) const;

    private:
      const State<dim> &state;
      /** Times volume, in the order of the batches and their points. */
      std::vector<SymmetricTensor<2, dim>> stresses;
    };



    template <int dim>
    GeometricStiffness<dim>::GeometricStiffness(const State<dim> &state)
      : state(state)
    {
      StencilBlock<dim>           block;
      TrialPoints<dim>            trial;
      std::vector<Tensor<1, dim>> increments;
      for (unsigned int g = 0; g < state.point_basis().n_batches(); ++g)
        {
          state.evaluate(g, block);
          increments.resize(block.n_nodes);
          for (unsigned int a = 0; a < block.n_nodes; ++a)
            increments[a] = state.nodal_increments()[block.nodes[a]];
          for (unsigned int begin = 0, end = 0; begin < block.n_points;
               begin = end)
            {
              end = state.end_of_body(block, begin);
              trial.evaluate(state, block, begin, end, increments.data());
              for (unsigned int p = 0; p < trial.n_points(); ++p)
                {
                  SymmetricTensor<2, dim> stress;
                  for (unsigned int i = 0; i < dim; ++i)
                    for (unsigned int j = i; j < dim; ++j)
                      stress[i][j] = trial.weight(p) * trial.stress(p)[i][j];
                  stresses.push_back(stress);
                }
            }
        }
    }



    template <int dim>
    LA::Vector
    GeometricStiffness<dim>::times(const LA::Vector &v) const
    {
      const GridSpace<dim>       &space = state.grid();
      std::vector<Tensor<1, dim>> values, forces(space.n_nodes());
      space.node_values(v, values);
      StencilBlock<dim> block;
      auto              stress = stresses.begin();
      for (unsigned int g = 0; g < state.point_basis().n_batches(); ++g)
        {
          state.evaluate(g, block);
          for (unsigned int p = 0; p < block.n_points; ++p, ++stress)
            {
              const Tensor<1, dim> *grad_N = block.grad_N(p);
              Tensor<2, dim>        gradient;
              for (unsigned int a = 0; a < block.n_nodes; ++a)
                gradient += outer_product(values[block.nodes[a]], grad_N[a]);
              const Tensor<2, dim> s(*stress), d(symmetrize(gradient));
              // Of the gradient times stress, less what strain has of it.
              const Tensor<2, dim> P = (gradient - d) * s - s * d;
              for (unsigned int a = 0; a < block.n_nodes; ++a)
                forces[block.nodes[a]] += P * grad_N[a];
            }
        }
      LA::Vector product(v);
      space.sum_node_values(forces, product);
      return product;
    }



    /** Forces on the nodes that have all directions and lengths in them, the
     * same on any number of ranks. */
    template <int dim>
    LA::Vector
    irregular_forces(const Model<dim> &model)
    {
      const GridSpace<dim>       &space = *model.space;
      const double                h     = model.mesh->cell_size();
      std::vector<Tensor<1, dim>> forces(space.n_nodes());
      for (unsigned int node = 0; node < space.n_nodes(); ++node)
        {
          const Point<dim> X     = space.node_position(node);
          double           phase = 0;
          for (unsigned int d = 0; d < dim; ++d)
            phase += (1.9 + 0.83 * d) * X[d] / h;
          for (unsigned int d = 0; d < dim; ++d)
            forces[node][d] =
              std::sin(12.9898 * std::sin(phase + d) + 78.233 * (phase - d));
        }
      // Nodes that hardly any material has would move most.
      LA::Vector all = space.vector_of(forces);
      all.scale(model.system->path_weights());
      return all;
    }



    /** K with what solves for it. */
    template <int dim>
    class StiffnessOfStep
    {
    public:
      /** The tangent is assembled. Collective. */
      StiffnessOfStep(const Model<dim>             &model,
                      const LinearSolverParameters &parameters);

      /** Condense the force f and find u, K u = f.
       * @return u f, twice the energy; not positive if there is no u.
       * Collective. */
      double
      solve(LA::Vector &f, LA::Vector &u);

    private:
      /** That of the model, or if it is not set up with this K or does not do
       * it, another. */
      bool
      solve_for(LA::Vector &u, const LA::Vector &f, const double enough);

      const Model<dim>           &model;
      const MechanicsSystem<dim> &system;
      LinearSolver                own;
    };



    template <int dim>
    StiffnessOfStep<dim>::StiffnessOfStep(
      const Model<dim>             &model,
      const LinearSolverParameters &parameters)
      : model(model)
      , system(*model.system)
      , own(parameters, dim)
    {}



    template <int dim>
    bool
    StiffnessOfStep<dim>::solve_for(LA::Vector       &u,
                                    const LA::Vector &f,
                                    const double      enough)
    {
      LinearSolver &of_model = *model.linear_solver;
      if (model.state->is_linear() && of_model.is_set_up() &&
          of_model.solve_aside(u, f, enough).converged)
        return true;
      of_model.clear(); // two would take twice the memory
      if (own.n_set_ups() == 0)
        own.set_up(system.tangent(),
                   system.symmetric(),
                   system.near_null_space());
      return own.solve(u, f, enough).converged;
    }



    template <int dim>
    double
    StiffnessOfStep<dim>::solve(LA::Vector &f, LA::Vector &u)
    {
      system.condense(f);
      const double size = f.l2_norm();
      if (!(size > 0) || !std::isfinite(size))
        return 0.;
      u = f;
      if (!solve_for(u, f, power_residual * size))
        return 0.;
      const double work = u * f;
      system.apply_constraints(u);
      return work;
    }



    /** The largest eigenvalue as K measures what @f$K^{-1} K_g@f$ makes of a
     * field, where it may have either sign. */
    template <int dim>
    double
    power_iterations(const GeometricStiffness<dim> &K_g,
                     StiffnessOfStep<dim>          &K,
                     LA::Vector                     f)
    {
      LA::Vector u(f);
      double     share = 0;
      double     work  = K.solve(f, u);
      for (unsigned int i = 0; i < most_power_iterations && work > 0; ++i)
        {
          u /= std::sqrt(work);
          f                   = K_g.times(u);
          work                = K.solve(f, u);
          const double before = share;
          share               = work > 0 ? std::sqrt(work) : share;
          if (i > 1 && share < (1. + power_growth) * before)
            break;
        }
      return share;
    }
  } // namespace



  template <int dim>
  double
  geometric_share(const Model<dim>             &model,
                  const LA::Vector             &x,
                  const LinearSolverParameters &solver)
  {
    MechanicsSystem<dim> &system = *model.system;
    State<dim>           &state  = *model.state;
    // Who lets nothing move wants what is linear.
    if (state.strain_measure() != StrainMeasure::small ||
        state.mesh_after_step() == MeshAfterStep::keep)
      return 0.;
    state.set_trial(x);
    const GeometricStiffness<dim> K_g(state);
    const bool                    is_linear = state.is_linear();
    // Material that yields has next to no stiffness, and moves without stress
    // that bends it.
    if (!is_linear)
      {
        LA::Vector start(x);
        start = 0.;
        system.assemble(start, true);
      }
    double share = 0;
    if (system.tangent() && system.failure().empty())
      {
        StiffnessOfStep<dim> K(model, solver);
        share = power_iterations(K_g, K, irregular_forces(model));
      }
    if (!is_linear)
      system.assemble(x, false);
    return std::isfinite(share) ? share : 0.;
  }



#define INSTANTIATE(dim)                              \
  template double geometric_share(const Model<dim> &, \
                                  const LA::Vector &, \
                                  const LinearSolverParameters &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
