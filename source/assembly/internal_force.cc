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
                     const Material          &material,
                     LocalSystem<dim>        &local)
    {
      const PointSet<dim> &points = state.material_points();
      local.strains.resize(end - begin);
      local.stresses.resize(end - begin);
      for (unsigned int p = begin; p < end; ++p)
        {
          local.strains[p - begin] =
            strain_increment(local.nodal_increments.data(),
                             block.grad_N(p),
                             block.n_nodes);
          local.stresses[p - begin] = load_stress<dim>(
            points.values(block.points[p]) + points.stress_offset());
        }
      material.update_stress(make_array_view(local.strains),
                             make_array_view(local.stresses));
      for (unsigned int p = begin; p < end; ++p)
        {
          const double v      = points.volume(block.points[p]);
          const auto  &sigma  = local.stresses[p - begin];
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



    /** @f$G = \sum_p v_p\, g_p g_p^T@f$, upper triangle, of a run of points. */
    template <int dim>
    void
    sum_moments(const PointSet<dim>     &points,
                const StencilBlock<dim> &block,
                const unsigned int       begin,
                const unsigned int       end,
                std::vector<double>     &moments)
    {
      const unsigned int n = dim * block.n_nodes;
      moments.assign(n * n, 0.);
      for (unsigned int p = begin; p < end; ++p)
        {
          const double  v = points.volume(block.points[p]);
          const double *g = block.grad_N(p)->begin_raw();
          for (unsigned int r = 0; r < n; ++r)
            {
              const double v_g_r = v * g[r];
              double      *row   = &moments[r * n];
              for (unsigned int s = r; s < n; ++s)
                row[s] += v_g_r * g[s];
            }
        }
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
      const auto         G = [&](const unsigned int r, const unsigned int s) {
        return r <= s ? moments[r * n + s] : moments[s * n + r];
      };
      for (unsigned int a = 0; a < n_nodes; ++a)
        for (unsigned int b = 0; b < n_nodes; ++b)
          {
            double trace = 0;
            for (unsigned int k = 0; k < dim; ++k)
              trace += G(dim * a + k, dim * b + k);
            for (unsigned int i = 0; i < dim; ++i)
              for (unsigned int j = 0; j < dim; ++j)
                matrix(dim * a + i, dim * b + j) +=
                  C.lambda * G(dim * a + i, dim * b + j) +
                  C.mu * (G(dim * a + j, dim * b + i) + (i == j ? trace : 0.));
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
    // Runs of points of the same body; nearly always there is one.
    for (unsigned int begin = 0, end = 0; begin < block.n_points; begin = end)
      {
        const unsigned int body = points.body(block.points[begin]);
        while (end < block.n_points && points.body(block.points[end]) == body)
          ++end;
        const Material &material = state.material(body);
        add_stress_force(state, block, begin, end, material, local);
        if (tangent)
          {
            sum_moments(points, block, begin, end, local.moments);
            add_stiffness<dim>(local.moments,
                               block.n_nodes,
                               material.elastic_stiffness(),
                               local.matrix);
          }
      }
  }



  template struct LocalSystem<2>;
  template struct LocalSystem<3>;
  template class InternalForce<2>;
  template class InternalForce<3>;
} // namespace moraine
