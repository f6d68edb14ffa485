// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/assembly/internal_force.h>

#include <deal.II/base/mpi.h>

#include <array>
#include <sstream>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** Add the force @f$-w\,\tau g_a@f$ of a run of points of one body; with
     * means of cells all but what their pressure does. */
    template <int dim>
    void
    add_stress_force(const TrialPoints<dim> &points,
                     const unsigned int      n_nodes,
                     LocalSystem<dim>       &local)
    {
      for (unsigned int p = 0; p < points.n_points(); ++p)
        {
          const double w      = points.weight(p);
          const auto   stress = points.n_means() > 0 ?
                                  local.dilatation.take_pressure(p) :
                                  points.stress(p);
          const auto  *grad_N = points.grad_N(p);
          for (unsigned int a = 0; a < n_nodes; ++a)
            for (unsigned int i = 0; i < dim; ++i)
              {
                double f = 0;
                for (unsigned int j = 0; j < dim; ++j)
                  f += stress[i][j] * grad_N[a][j];
                local.force[dim * a + i] -= w * f;
              }
        }
    }



    /** Numbers of the Voigt components of a symmetric tensor's entries. */
    template <int dim>
    constexpr std::array<std::array<unsigned int, dim>, dim>
    voigt_numbers()
    {
      if constexpr (dim == 2)
        return {{{{0, 2}}, {{2, 1}}}};
      else
        return {{{{0, 3, 4}}, {{3, 1, 5}}, {{4, 5, 2}}}};
    }



    /** Add @f$\sum_k D_{kj}\, g_{b,k}@f$ to a row of the matrix, and if there
     * is @f$\hat g@f$ @f$e\, \hat g_{b,j}@f$. */
    template <int dim, bool has_mean>
    inline void
    add_row(const double (&D)[dim][dim],
            const double                           e,
            const Tensor<1, dim> *DEAL_II_RESTRICT g,
            const Tensor<1, dim> *DEAL_II_RESTRICT mean_g,
            const unsigned int                     n_nodes,
            double *DEAL_II_RESTRICT               row)
    {
      for (unsigned int b = 0; b < n_nodes; ++b, row += dim)
        for (unsigned int j = 0; j < dim; ++j)
          {
            double sum = has_mean ? e * mean_g[b][j] : 0.;
            for (unsigned int k = 0; k < dim; ++k)
              sum += D[k][j] * g[b][k];
            row[j] += sum;
          }
    }



    /** Add @f$e\, \hat g_{b,j}@f$ to a row. */
    template <int dim>
    inline void
    add_mean_row(const double                           e,
                 const Tensor<1, dim> *DEAL_II_RESTRICT mean_g,
                 const unsigned int                     n_nodes,
                 double *DEAL_II_RESTRICT               row)
    {
      for (unsigned int b = 0; b < n_nodes; ++b, row += dim)
        for (unsigned int j = 0; j < dim; ++j)
          row[j] += e * mean_g[b][j];
    }



    /** @f$D_{ijk} = c_{iljk}\, w g_l@f$, as i, k, j. */
    template <int dim>
    inline void
    set_material_part(const VoigtMatrix<dim> &c,
                      const Tensor<1, dim>   &w_g,
                      double (&D)[dim][dim][dim])
    {
      constexpr unsigned int n     = n_voigt<dim>;
      constexpr auto         voigt = voigt_numbers<dim>();
      for (unsigned int i = 0; i < dim; ++i)
        {
          std::array<double, n> c_g{};
          for (unsigned int l = 0; l < dim; ++l)
            for (unsigned int I = 0; I < n; ++I)
              c_g[I] += c[voigt[i][l]][I] * w_g[l];
          for (unsigned int k = 0; k < dim; ++k)
            for (unsigned int j = 0; j < dim; ++j)
              D[i][k][j] = c_g[voigt[j][k]];
        }
    }



    /**
     * Add the tangent of one point to the upper triangle of node pairs, or to
     * @p all_pairs, @f$K_{ab,ij} = \sum_k D_{a,ijk}\, g_{b,k}@f$ with
     * @f$D_{a,ijk} = w\, (c_{iljk}\, g_{a,l} + \delta_{ij}\, \tau_{kl}\,
     * g_{a,l})@f$, and what @p coupling says (MeanDilatation), if there is any.
     * Gradients of nodes from @p n_own on, added for groups of cells, are zero.
     */
    template <int dim, bool has_coupling>
    void
    add_tangent(const VoigtMatrix<dim>                       &c,
                const double                                  w,
                const SymmetricTensor<2, 3>                  *tau,
                const typename MeanDilatation<dim>::Coupling *coupling,
                const Tensor<1, dim>                         *g,
                const unsigned int                            n_own,
                const unsigned int                            n_nodes,
                const bool                                    all_pairs,
                FullMatrix<double>                           &matrix)
    {
      const Tensor<1, dim> *mean_g =
        has_coupling ? coupling->mean_gradients : nullptr;
      for (unsigned int a = 0; a < (has_coupling ? n_nodes : n_own); ++a)
        {
          // A node of other points of the block only.
          if (g[a].norm_square() == 0. &&
              (!has_coupling || mean_g[a].norm_square() == 0.))
            continue;
          const unsigned int first      = all_pairs ? 0 : a;
          const unsigned int first_mean = std::max(first, n_own);
          Tensor<1, dim>     e;
          if constexpr (has_coupling)
            e = coupling->T * g[a] + coupling->modulus * mean_g[a];
          if (first < n_own)
            {
              const Tensor<1, dim> w_g = w * g[a];
              double               D[dim][dim][dim]; // i, k, j
              set_material_part<dim>(c, w_g, D);
              for (unsigned int k = 0; tau && k < dim; ++k)
                {
                  double tau_g = 0;
                  for (unsigned int l = 0; l < dim; ++l)
                    tau_g += (*tau)[k][l] * w_g[l];
                  for (unsigned int i = 0; i < dim; ++i)
                    D[i][k][i] += tau_g;
                }
              if constexpr (has_coupling)
                for (unsigned int i = 0; i < dim; ++i)
                  for (unsigned int k = 0; k < dim; ++k)
                    for (unsigned int j = 0; j < dim; ++j)
                      D[i][k][j] += mean_g[a][i] * coupling->T_left[k][j];
              for (unsigned int i = 0; i < dim; ++i)
                add_row<dim, has_coupling>(D[i],
                                           e[i],
                                           g + first,
                                           mean_g + (has_coupling ? first : 0),
                                           n_own - first,
                                           &matrix(dim * a + i, dim * first));
            }
          for (unsigned int i = 0; has_coupling && i < dim; ++i)
            add_mean_row<dim>(e[i],
                              mean_g + first_mean,
                              n_nodes - first_mean,
                              &matrix(dim * a, 0) + i * dim * n_nodes +
                                dim * first_mean);
        }
    }



    /** Add the tangents of a run of points and the @p least stiffness;
     * gradients of nodes from @p n_own on are zero. */
    template <int dim>
    void
    add_tangents(const unsigned int   n_own,
                 const bool           all_pairs,
                 const LameConstants &least,
                 LocalSystem<dim>    &local)
    {
      const TrialPoints<dim> &trial     = local.trial_points;
      const bool              has_means = trial.n_means() > 0;
      const unsigned int      n_nodes   = local.nodal_increments.size();
      SymmetricTensor<2, 3>   rest;
      for (unsigned int p = 0; p < trial.n_points(); ++p)
        {
          VoigtMatrix<dim> c = trial.tangent(p);
          if (least.mu > 0)
            for (unsigned int I = 0; I < n_voigt<dim>; ++I)
              {
                c[I][I] += (I < dim ? 2 : 1) * least.mu;
                for (unsigned int J = 0; I < dim && J < dim; ++J)
                  c[I][J] += least.lambda;
              }
          const SymmetricTensor<2, 3> *tau = nullptr;
          if (trial.is_finite())
            tau = &trial.stress(p);
          const typename MeanDilatation<dim>::Coupling *coupling = nullptr;
          if (has_means)
            {
              c        = local.dilatation.take_volumetric(p, c);
              coupling = local.dilatation.coupling();
              rest     = trial.stress(p);
              take_mean<dim>(rest, trial.mean_part(p));
              if (tau)
                tau = &rest;
            }
          const auto add =
            coupling ? add_tangent<dim, true> : add_tangent<dim, false>;
          add(c,
              trial.weight(p),
              tau,
              coupling,
              trial.grad_N(p),
              n_own,
              n_nodes,
              all_pairs,
              local.matrix);
        }
    }



    /** Fill the lower triangle of node pairs with the upper one's transpose. */
    template <int dim>
    void
    mirror(const unsigned int n_nodes, FullMatrix<double> &matrix)
    {
      for (unsigned int a = 0; a < n_nodes; ++a)
        for (unsigned int b = a + 1; b < n_nodes; ++b)
          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int j = 0; j < dim; ++j)
              matrix(dim * b + j, dim * a + i) =
                matrix(dim * a + i, dim * b + j);
    }



    /**
     * @f$G = \sum_p v_p\, g_p g_p^T@f$ of a run of points. A size known to the
     * compiler (0 if not) lets it unroll the loops.
     */
    template <int dim, unsigned int fixed_n_nodes>
    void
    sum_moments(const State<dim>        &state,
                const StencilBlock<dim> &block,
                const unsigned int       begin,
                const unsigned int       end,
                double *DEAL_II_RESTRICT G)
    {
      const unsigned int n =
        dim * (fixed_n_nodes > 0 ? fixed_n_nodes : block.n_nodes);
      for (unsigned int p = begin; p < end; ++p)
        {
          const double v =
            block.share(p) * state.integration_volume(block.points[p]);
          const double *DEAL_II_RESTRICT g   = block.grad_N(p)->begin_raw();
          double *DEAL_II_RESTRICT       row = G;
          for (unsigned int r = 0; r < n; ++r, row += n)
            {
              // Of a node of other points only.
              if (fixed_n_nodes == 0 && g[r] == 0.)
                continue;
              const double v_g_r = v * g[r];
              for (std::size_t s = 0; s < n; ++s)
                row[s] += v_g_r * g[s];
            }
        }
    }



    template <int dim>
    void
    sum_moments(const State<dim>        &state,
                const StencilBlock<dim> &block,
                const unsigned int       begin,
                const unsigned int       end,
                std::vector<double>     &moments)
    {
      moments.assign(dim * block.n_nodes * dim * block.n_nodes, 0.);
      if (block.n_nodes == 1 << dim)
        sum_moments<dim, 1 << dim>(state, block, begin, end, moments.data());
      else
        sum_moments<dim, 0>(state, block, begin, end, moments.data());
    }



    /** Add the stiffness that the moments give with an isotropic C, to the
     * upper triangle of node pairs or to @p all_pairs. */
    template <int dim>
    void
    add_stiffness(const std::vector<double> &moments,
                  const unsigned int         n_nodes,
                  const LameConstants       &C,
                  const bool                 all_pairs,
                  FullMatrix<double>        &matrix)
    {
      const unsigned int n = dim * n_nodes;
      for (unsigned int a = 0; a < n_nodes; ++a)
        for (unsigned int b = all_pairs ? 0 : a; b < n_nodes; ++b)
          {
            const double *G     = &moments[dim * a * n + dim * b];
            double       *K     = &matrix(dim * a, dim * b);
            double        trace = 0;
            for (unsigned int k = 0; k < dim; ++k)
              trace += G[k * n + k];
            for (unsigned int i = 0; i < dim; ++i)
              {
                for (unsigned int j = 0; j < dim; ++j)
                  K[i * n + j] += C.lambda * G[i * n + j] + C.mu * G[j * n + i];
                K[i * n + i] += C.mu * trace;
              }
          }
    }



    /** The force of a pressure times volume on the means of the cells. */
    template <int dim>
    void
    add_mean_pressure(const double              v_p,
                      const CellMeanBlock<dim> &means,
                      const unsigned int        p,
                      LocalSystem<dim>         &local)
    {
      for (unsigned int c = 0; c < means.n_cells; ++c)
        for (unsigned int a = c * means.n_corners;
             a < (c + 1) * means.n_corners;
             ++a)
          for (unsigned int i = 0; i < dim; ++i)
            local.force[dim * means.places[a] + i] -=
              v_p * means.share(p, c) * means.gradients[a][i];
    }
  } // namespace



  template <int dim>
  std::string
  why_no_stress(const State<dim>       &state,
                const TrialPoints<dim> &trial,
                const Material         &material,
                const unsigned int      point)
  {
    std::ostringstream text;
    text << "point " << state.material_points().id(point) << " at ("
         << state.material_points().position(point) << ") "
         << (trial.inverted(trial.first_failure()) ?
               "would be turned inside out" :
               material.why_no_stress());
    return text.str();
  }



  template <int dim>
  std::vector<Effect>
  InternalForce<dim>::effects(const StepContext<dim> &) const
  {
    return {{"internal force", "", ""}};
  }



  template <int dim>
  void
  InternalForce<dim>::add(const StepContext<dim>  &context,
                          const StencilBlock<dim> &block,
                          const bool               tangent,
                          LocalSystem<dim>        &local) const
  {
    const State<dim>    &state     = context.state;
    const PointSet<dim> &points    = state.material_points();
    TrialPoints<dim>    &trial     = local.trial_points;
    const bool           all_pairs = !state.has_symmetric_tangents();
    for (unsigned int begin = 0, end = 0; begin < block.n_points; begin = end)
      {
        end = state.end_of_body(block, begin);
        trial.evaluate(state, block, begin, end, local.nodal_increments.data());
        const bool has_means = trial.n_means() > 0;
        if (has_means)
          local.dilatation.begin(trial, block.n_nodes, all_pairs);
        add_stress_force(trial, block.n_nodes, local);
        const Material &material =
          state.material(points.body(block.points[begin]));
        if (trial.first_failure() < trial.n_points() && local.failure.empty())
          local.failure =
            why_no_stress(state,
                          trial,
                          material,
                          block.points[begin + trial.first_failure()]);
        const bool with_tangent = tangent && local.failure.empty();
        if (with_tangent && !trial.is_finite() && material.is_linear())
          {
            LameConstants C = material.elastic_stiffness();
            if (has_means)
              {
                local.dilatation.add_modulus(C.lambda + 2. * C.mu / dim,
                                             local.matrix);
                C.lambda = -2. * C.mu / dim;
              }
            sum_moments(state, block, begin, end, local.moments);
            add_stiffness<dim>(
              local.moments, block.n_nodes, C, all_pairs, local.matrix);
          }
        else if (with_tangent)
          {
            const double        part = material.least_stiffness();
            const LameConstants C    = material.elastic_stiffness();
            add_tangents(block.n_own_nodes,
                         all_pairs,
                         {part * C.lambda, part * C.mu},
                         local);
          }
        if (has_means)
          local.dilatation.end(with_tangent, local.force, local.matrix);
        if (with_tangent && !all_pairs)
          mirror<dim>(block.n_nodes, local.matrix);
      }
  }



  template <int dim>
  void
  InternalForce<dim>::add_at_start(const StepContext<dim>  &context,
                                   const StencilBlock<dim> &block,
                                   LocalSystem<dim>        &local) const
  {
    const State<dim>    &state  = context.state;
    const PointSet<dim> &points = state.material_points();
    for (unsigned int p = 0; p < block.n_points; ++p)
      {
        const unsigned int point = block.points[p];
        const double       v = block.share(p) * state.integration_volume(point);
        SymmetricTensor<2, 3> stress =
          points.stress_field()(points.values(point));
        const Tensor<1, dim> *grad_N = block.grad_N(p);
        if (block.means.n_cells > 0)
          add_mean_pressure(
            v *
              take_mean<dim>(stress,
                             state.mean_part(point,
                                             elastic_stiffness(state, point))),
            block.means,
            p,
            local);
        for (unsigned int a = 0; a < block.n_nodes; ++a)
          {
            const Tensor<1, dim> f = force_of_stress(v, stress, grad_N[a]);
            for (unsigned int i = 0; i < dim; ++i)
              local.force[dim * a + i] -= f[i];
          }
      }
  }



#define INSTANTIATE(dim)                                    \
  template decltype(why_no_stress<dim>) why_no_stress<dim>; \
  template class InternalForce<dim>;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
