// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/assembly/conserving_force.h>
#include <moraine/assembly/internal_force.h>

#include <limits>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** In the plane of two dimensions. */
    template <int dim>
    SymmetricTensor<2, dim>
    of_plane(const SymmetricTensor<2, 3> &a)
    {
      SymmetricTensor<2, dim> result;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = i; j < dim; ++j)
          result[i][j] = a[i][j];
      return result;
    }



    /** Components that pair with those of another such vector by their sum of
     * products: of a strain, with doubled shear, if @p shear is 2. */
    template <int dim>
    std::array<double, n_voigt<dim>>
    voigt(const SymmetricTensor<2, dim> &a, const double shear)
    {
      constexpr auto                   pairs = voigt_pairs<dim>();
      std::array<double, n_voigt<dim>> result;
      for (unsigned int I = 0; I < n_voigt<dim>; ++I)
        result[I] = (I < dim ? 1. : shear) * a[pairs[I][0]][pairs[I][1]];
      return result;
    }



    /** One point: its deformation in the step, its stress and their
     * derivative, everything from the start of the step. */
    template <int dim>
    struct ConservingPoint
    {
      Tensor<2, dim>          dF;     ///< @f$\Delta F@f$
      Tensor<2, dim>          middle; ///< @f$1 + H/2@f$
      SymmetricTensor<2, dim> stress; ///< @f$\Sigma@f$
      VoigtMatrix<dim>        tangent;
    };



    /**
     * @f$b^T c\, b@f$ with the matrix b that takes strains of the start of a
     * step to those at its end, @f$\Delta F^{-T} \varepsilon\, \Delta
     * F^{-1}@f$, with doubled shear.
     */
    template <int dim>
    VoigtMatrix<dim>
    pull_back(const VoigtMatrix<dim> &c, const Tensor<2, dim> &inverse)
    {
      constexpr unsigned int n     = n_voigt<dim>;
      constexpr auto         pairs = voigt_pairs<dim>();
      VoigtMatrix<dim>       b;
      for (unsigned int I = 0; I < n; ++I)
        for (unsigned int J = 0; J < n; ++J)
          {
            const auto [i, j] = pairs[I];
            const auto [k, l] = pairs[J];
            b[I][J] = (I < dim ? 0.5 : 1.) * (inverse[k][i] * inverse[l][j] +
                                              inverse[l][i] * inverse[k][j]);
          }
      VoigtMatrix<dim> c_b{}, result{};
      for (unsigned int I = 0; I < n; ++I)
        for (unsigned int K = 0; K < n; ++K)
          for (unsigned int J = 0; J < n; ++J)
            c_b[I][J] += c[I][K] * b[K][J];
      for (unsigned int I = 0; I < n; ++I)
        for (unsigned int K = 0; K < n; ++K)
          for (unsigned int J = 0; J < n; ++J)
            result[I][J] += b[K][I] * c_b[K][J];
      return result;
    }



    /** At finite strain, of the i-th of the points after find_energies(). */
    template <int dim>
    ConservingPoint<dim>
    finite_point(const TrialPoints<dim> &trial,
                 const unsigned int      i,
                 const bool              tangent,
                 const LameConstants    &C)
    {
      constexpr unsigned int n = n_voigt<dim>;
      ConservingPoint<dim>   at;
      const Tensor<2, dim>  &H = trial.increment_gradient(i);
      at.dF                    = H;
      at.middle                = 0.5 * H;
      for (unsigned int d = 0; d < dim; ++d)
        {
          at.dF[d][d] += 1;
          at.middle[d][d] += 1;
        }
      const Tensor<2, dim> inverse     = invert(at.dF);
      const auto           pulled_back = [&](const SymmetricTensor<2, 3> &a) {
        return symmetrize(inverse * Tensor<2, dim>(of_plane<dim>(a)) *
                          transpose(inverse));
      };
      // Without cancellation where H is small.
      const SymmetricTensor<2, dim> dE =
        symmetrize(H) + 0.5 * symmetrize(transpose(H) * H);
      const SymmetricTensor<2, dim> mean =
        0.5 * (of_plane<dim>(trial.stress_at_start(i)) +
               pulled_back(trial.stress(i)));
      const StepEnergies &energies = trial.energies(i);
      const double        square   = dE * dE;
      // The correction c dE changes energies by about C |dE|^3.
      const bool corrected =
        (C.lambda + 2 * C.mu) * square * std::sqrt(square) >
        std::numeric_limits<double>::epsilon() *
          (energies.stored_at_start + energies.stored);
      double c = 0;
      if (corrected)
        c = (energies.stored - energies.stored_at_start + energies.dissipated -
             mean * dE) /
            square;
      at.stress = mean + c * dE;
      if (!tangent)
        return at;

      at.tangent        = pull_back<dim>(trial.tangent(i), inverse);
      const auto strain = voigt<dim>(dE, 2.);
      const auto of_dE  = voigt<dim>(dE, 1.);
      auto       gradient =
        voigt<dim>(pulled_back(trial.energy_gradient(i)) - mean - 2 * c * dE,
                   1.);
      for (unsigned int I = 0; I < n; ++I)
        for (unsigned int J = 0; J < n; ++J)
          {
            at.tangent[I][J] *= 0.5;
            gradient[J] -= strain[I] * at.tangent[I][J];
          }
      for (unsigned int I = 0; I < n && corrected; ++I)
        {
          at.tangent[I][I] += c * (I < dim ? 1. : 0.5);
          for (unsigned int J = 0; J < n; ++J)
            at.tangent[I][J] += of_dE[I] * gradient[J] / square;
        }
      return at;
    }



    template <int dim>
    VoigtMatrix<dim>
    elastic_tangent(const LameConstants &C)
    {
      VoigtMatrix<dim> result{};
      for (unsigned int I = 0; I < n_voigt<dim>; ++I)
        {
          for (unsigned int J = 0; I < dim && J < dim; ++J)
            result[I][J] = C.lambda;
          result[I][I] += (I < dim ? 2 : 1) * C.mu;
        }
      return result;
    }



    template <int dim>
    ConservingPoint<dim>
    small_point(const TrialPoints<dim> &trial,
                const unsigned int      i,
                const bool              tangent,
                const Material         &material)
    {
      ConservingPoint<dim> at;
      at.dF = at.middle = unit_symmetric_tensor<dim>();
      at.stress =
        0.5 * of_plane<dim>(trial.stress_at_start(i) + trial.stress(i));
      if (!tangent)
        return at;
      at.tangent = material.is_linear() ?
                     elastic_tangent<dim>(material.elastic_stiffness()) :
                     trial.tangent(i);
      for (auto &row : at.tangent)
        for (double &value : row)
          value *= 0.5;
      return at;
    }



    template <int dim>
    void
    add_force(const ConservingPoint<dim> &at,
              const double                w,
              const Tensor<1, dim>       *grad_N,
              const unsigned int          n_nodes,
              Vector<double>             &force)
    {
      const Tensor<2, dim> P = at.middle * Tensor<2, dim>(at.stress);
      for (unsigned int a = 0; a < n_nodes; ++a)
        {
          const Tensor<1, dim> f = P * grad_N[a];
          for (unsigned int i = 0; i < dim; ++i)
            force[dim * a + i] -= w * f[i];
        }
    }



    /** Column k is the strain @f$\mathrm{sym}(F^T e_k \otimes g)@f$ with
     * doubled shear. */
    template <int dim>
    std::array<std::array<double, dim>, n_voigt<dim>>
    strains_of_node(const Tensor<2, dim> &F, const Tensor<1, dim> &g)
    {
      constexpr auto pairs = voigt_pairs<dim>();
      std::array<std::array<double, dim>, n_voigt<dim>> B;
      for (unsigned int I = 0; I < n_voigt<dim>; ++I)
        for (unsigned int k = 0; k < dim; ++k)
          {
            const auto [i, j] = pairs[I];
            B[I][k]           = F[k][i] * g[j];
            if (I >= dim)
              B[I][k] += F[k][j] * g[i];
          }
      return B;
    }



    /** Minus the derivative of add_force(). */
    template <int dim>
    void
    add_tangent(const ConservingPoint<dim> &at,
                const double                w,
                const bool                  finite,
                const Tensor<1, dim>       *grad_N,
                const unsigned int          n_nodes,
                FullMatrix<double>         &matrix)
    {
      constexpr unsigned int n = n_voigt<dim>;
      for (unsigned int b = 0; b < n_nodes; ++b)
        {
          // A node of other points of the block only.
          if (grad_N[b].norm_square() == 0.)
            continue;
          const auto     B = strains_of_node<dim>(at.dF, w * grad_N[b]);
          double         A_B[n][dim]{};
          Tensor<1, dim> stress_g;
          if (finite)
            stress_g = 0.5 * w * (at.stress * grad_N[b]);
          for (unsigned int I = 0; I < n; ++I)
            for (unsigned int J = 0; J < n; ++J)
              for (unsigned int k = 0; k < dim; ++k)
                A_B[I][k] += at.tangent[I][J] * B[J][k];
          for (unsigned int a = 0; a < n_nodes; ++a)
            {
              const auto   B_a = strains_of_node<dim>(at.middle, grad_N[a]);
              const double geometric = grad_N[a] * stress_g;
              for (unsigned int i = 0; i < dim; ++i)
                {
                  for (unsigned int k = 0; k < dim; ++k)
                    {
                      double sum = 0;
                      for (unsigned int I = 0; I < n; ++I)
                        sum += B_a[I][i] * A_B[I][k];
                      matrix(dim * a + i, dim * b + k) += sum;
                    }
                  matrix(dim * a + i, dim * b + i) += geometric;
                }
            }
        }
    }
  } // namespace



  template <int dim>
  std::vector<Effect>
  ConservingForce<dim>::effects(const StepContext<dim> &) const
  {
    return {{"conserving internal force", "", ""}};
  }



  template <int dim>
  void
  ConservingForce<dim>::add(const StepContext<dim>  &context,
                            const StencilBlock<dim> &block,
                            const bool               tangent,
                            LocalSystem<dim>        &local) const
  {
    const State<dim> &state  = context.state;
    const bool        finite = state.strain_measure() == StrainMeasure::finite;
    TrialPoints<dim> &trial  = local.trial_points;
    for (unsigned int begin = 0, end = 0; begin < block.n_points; begin = end)
      {
        end = state.end_of_body(block, begin);
        trial.evaluate(state, block, begin, end, local.nodal_increments.data());
        const Material &material =
          state.material(state.material_points().body(block.points[begin]));
        if (trial.first_failure() < trial.n_points())
          {
            if (local.failure.empty())
              local.failure =
                why_no_stress(state,
                              trial,
                              material,
                              block.points[begin + trial.first_failure()]);
            continue;
          }
        trial.find_energies(state, block, begin);
        const LameConstants C = material.elastic_stiffness();
        for (unsigned int i = 0; i < trial.n_points(); ++i)
          {
            const ConservingPoint<dim> at =
              finite ? finite_point(trial, i, tangent, C) :
                       small_point(trial, i, tangent, material);
            const auto *grad_N = block.grad_N(begin + i);
            add_force(at, trial.weight(i), grad_N, block.n_nodes, local.force);
            if (tangent)
              add_tangent(at,
                          trial.weight(i),
                          finite,
                          grad_N,
                          block.n_nodes,
                          local.matrix);
          }
      }
  }



  template class ConservingForce<2>;
  template class ConservingForce<3>;
} // namespace moraine
