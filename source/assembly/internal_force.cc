// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/assembly/term.h>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  void
  LocalSystem<dim>::reinit(const State<dim>   &state,
                           const unsigned int *nodes,
                           const unsigned int  n_nodes,
                           const bool          tangent)
  {
    const unsigned int n = dim * n_nodes;
    this->nodes          = nodes;
    if (dofs.size() != n)
      {
        dofs.resize(n);
        nodal_increments.resize(n_nodes);
        force.reinit(n);
        matrix.reinit(n, n);
      }
    else
      {
        force = 0;
        if (tangent)
          matrix = 0;
      }
    for (unsigned int a = 0; a < n_nodes; ++a)
      {
        nodal_increments[a] = state.nodal_increments()[nodes[a]];
        const auto first    = state.grid().node_dof(nodes[a]);
        for (unsigned int c = 0; c < dim; ++c)
          dofs[dim * a + c] = first + c;
      }
  }



  namespace
  {
    /**
     * Add the force @f$-v\,\sigma \nabla N_a@f$ of a run of points of one body.
     */
    template <int dim>
    void
    add_stress_force(const State<dim>        &state,
                     const StencilBlock<dim> &block,
                     const unsigned int       begin,
                     const unsigned int       end,
                     LocalSystem<dim>        &local)
    {
      const PointSet<dim> &points   = state.material_points();
      const auto          &stresses = local.trial_stresses.evaluate(
        state, block, begin, end, local.nodal_increments.data());
      for (unsigned int p = begin; p < end; ++p)
        {
          const double v      = points.volume(block.points[p]);
          const auto  &sigma  = stresses[p - begin];
          const auto  *grad_N = block.grad_N(p);
          for (unsigned int a = 0; a < block.n_nodes; ++a)
            for (unsigned int i = 0; i < dim; ++i)
              {
                double f = 0;
                for (unsigned int j = 0; j < dim; ++j)
                  f += sigma[i][j] * grad_N[a][j];
                local.force[dim * a + i] -= v * f;
              }
        }
    }



    /**
     * @f$G = \sum_p v_p\, g_p g_p^T@f$ of a run of points. A size known to the
     * compiler (0 if not) lets it unroll the loops.
     */
    template <int dim, unsigned int fixed_n_nodes>
    void
    sum_moments(const PointSet<dim>     &points,
                const StencilBlock<dim> &block,
                const unsigned int       begin,
                const unsigned int       end,
                double *DEAL_II_RESTRICT G)
    {
      const unsigned int n =
        dim * (fixed_n_nodes > 0 ? fixed_n_nodes : block.n_nodes);
      for (unsigned int p = begin; p < end; ++p)
        {
          const double                   v = points.volume(block.points[p]);
          const double *DEAL_II_RESTRICT g = block.grad_N(p)->begin_raw();
          for (unsigned int r = 0; r < n; ++r)
            {
              const double v_g_r = v * g[r];
              for (unsigned int s = 0; s < n; ++s)
                G[r * n + s] += v_g_r * g[s];
            }
        }
    }



    template <int dim>
    void
    sum_moments(const PointSet<dim>     &points,
                const StencilBlock<dim> &block,
                const unsigned int       begin,
                const unsigned int       end,
                std::vector<double>     &moments)
    {
      moments.assign(dim * block.n_nodes * dim * block.n_nodes, 0.);
      if (block.n_nodes == 1 << dim)
        sum_moments<dim, 1 << dim>(points, block, begin, end, moments.data());
      else
        sum_moments<dim, 0>(points, block, begin, end, moments.data());
    }



    /** Add the stiffness that the moments give with an isotropic C. */
    template <int dim>
    void
    add_stiffness(const std::vector<double> &moments,
                  const unsigned int         n_nodes,
                  const LameConstants       &C,
                  FullMatrix<double>        &matrix)
    {
      const unsigned int n = dim * n_nodes;
      for (unsigned int a = 0; a < n_nodes; ++a)
        for (unsigned int b = 0; b < n_nodes; ++b)
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
  } // namespace



  template <int dim>
  void
  InternalForce<dim>::add(const State<dim>        &state,
                          const StencilBlock<dim> &block,
                          const bool               tangent,
                          LocalSystem<dim>        &local) const
  {
    const PointSet<dim> &points = state.material_points();
    for (unsigned int begin = 0, end = 0; begin < block.n_points; begin = end)
      {
        end = state.end_of_body(block, begin);
        add_stress_force(state, block, begin, end, local);
        if (tangent)
          {
            sum_moments(points, block, begin, end, local.moments);
            add_stiffness<dim>(local.moments,
                               block.n_nodes,
                               state.material(points.body(block.points[begin]))
                                 .elastic_stiffness(),
                               local.matrix);
          }
      }
  }



  template struct LocalSystem<2>;
  template struct LocalSystem<3>;
  template class InternalForce<2>;
  template class InternalForce<3>;
} // namespace moraine
