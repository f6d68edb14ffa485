// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/assembly/boundary_force.h>

#include <array>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /**
     * @f$M\,(C : \mathrm{sym}(w \otimes g))\,n@f$: the flux of a displacement
     * gradient of rank one, whose change of volume is that of
     * @f$\bar w \otimes \bar g@f$.
     */
    template <int dim>
    Tensor<1, dim>
    flux(const Tensor<1, dim>          &w,
         const Tensor<1, dim>          &g,
         const Tensor<1, dim>          &mean_w,
         const Tensor<1, dim>          &mean_g,
         const Tensor<1, dim>          &n,
         const SymmetricTensor<2, dim> &M,
         const LameConstants           &C)
    {
      const double change = mean_w * mean_g;
      return M * ((C.lambda * change + 2. * C.mu / dim * (change - w * g)) * n +
                  C.mu * ((g * n) * w + (w * n) * g));
    }



    /** @f$W = w_c M + w_f (1 - M)@f$ */
    template <int dim>
    SymmetricTensor<2, dim>
    weights(const Enforcement &how, const SymmetricTensor<2, dim> &M)
    {
      return how.w_constrained * M +
             how.w_free * (unit_symmetric_tensor<dim>() - M);
    }



    /**
     * @f$B = (1 + A/2)^{-1}@f$ at finite strain, else 1: the gradient of a step
     * with respect to its middle is @f$A B@f$, and a change of A changes it by
     * @f$B\, dA\, B@f$.
     */
    template <int dim>
    Tensor<2, dim>
    to_middle(const Tensor<2, dim> &A, const StrainMeasure measure)
    {
      const Tensor<2, dim> one = unit_symmetric_tensor<dim>();
      return measure == StrainMeasure::finite ? invert(one + 0.5 * A) : one;
    }



    /** A traction along the normal of a roller, turned to where it pushes. */
    template <int dim>
    Tensor<1, dim>
    pushed(const Tensor<1, dim> &traction, const ConstraintState<dim> &state)
    {
      return traction + (traction * state.normal) * (state.push - state.normal);
    }



    /** @f$c_3\, M Q M@f$ with @f$Q = n\cdot C\cdot n@f$, of which @p how may
     * leave out @f$\lambda@f$, and c_3 by @p depth. */
    template <int dim>
    SymmetricTensor<2, dim>
    penalty(const Enforcement             &how,
            const double                   depth,
            const Tensor<1, dim>          &n,
            const SymmetricTensor<2, dim> &M,
            const LameConstants           &C)
    {
      const Tensor<1, dim> Mn = M * n;
      return how.stiffness_factor / depth *
             ((how.lambda_share * C.lambda + C.mu) *
                symmetrize(outer_product(Mn, Mn)) +
              C.mu * M);
    }
  } // namespace



  template <int dim>
  Tensor<1, dim>
  boundary_traction(const BoundaryPoint<dim>   &point,
                    const ConstraintState<dim> &constraint,
                    const Enforcement          &how,
                    const LameConstants        &C,
                    const StrainMeasure         measure,
                    const Tensor<2, dim>       &grad_du,
                    const Tensor<2, dim>       &mean_grad_du)
  {
    const Tensor<1, dim> &n = constraint.normal;
    const auto           &M = constraint.M;
    // A normal multiplier follows the normal of a curved wall.
    Tensor<1, dim> traction = point.multiplier;
    if (&n != &point.normal && n != point.normal)
      traction = (point.multiplier * point.normal) * n;
    const Tensor<2, dim>    W      = weights(how, M);
    const Tensor<2, dim>    A      = W * grad_du;
    const Tensor<2, dim>    mean_A = W * mean_grad_du;
    SymmetricTensor<2, dim> strain = symmetrize(A * to_middle(A, measure));
    const double            change =
      trace(mean_A * to_middle(mean_A, measure)) - trace(strain);
    for (unsigned int d = 0; d < dim; ++d)
      strain[d][d] += change / dim;
    traction += M * (C.lambda * trace(strain) * n + 2. * C.mu * (strain * n));
    traction -= penalty(how, point.depth, n, M, C) * constraint.violation;
    traction -=
      how.mean_factor * C.lambda * constraint.mean_violation * (M * n);
    return pushed(traction, constraint);
  }



  template <int dim>
  void
  add_boundary_point(const BoundaryPoint<dim>    &point,
                     const ConstraintState<dim>  &constraint,
                     const double                 of_start,
                     const Enforcement           &how,
                     const LameConstants         &C,
                     const StrainMeasure          measure,
                     const double                *N,
                     const Tensor<1, dim>        *grad_N,
                     const Tensor<1, dim>        *mean_grad_N,
                     const Tensor<2, dim>        &grad_du,
                     const Tensor<2, dim>        &mean_grad_du,
                     const bool                   tangent,
                     std::vector<Tensor<1, dim>> &fluxes,
                     LocalSystem<dim>            &local)
  {
    const Tensor<1, dim> &n        = constraint.normal;
    const auto           &M        = constraint.M;
    const Tensor<2, dim>  W        = weights(how, M);
    const unsigned int    n_nodes  = local.dofs.size() / dim;
    Tensor<1, dim>        traction = boundary_traction(
      point, constraint, how, C, measure, grad_du, mean_grad_du);
    Tensor<1, dim> violation =
      point.accumulated_violation + constraint.violation;
    if (of_start > 0)
      {
        traction += of_start * (point.multiplier_at_start * point.normal) *
                    constraint.push;
        violation += of_start * point.accumulated_violation;
      }

    // f[b*dim+j] = flux of the unit displacement j of node b
    std::vector<Tensor<1, dim>> &f        = fluxes;
    const auto                   evaluate = [&](const Tensor<2, dim> &B,
                              const Tensor<2, dim> &mean_B) {
      const Tensor<2, dim> W_columns      = transpose(B * W);
      const Tensor<2, dim> mean_W_columns = transpose(mean_B * W);
      for (unsigned int b = 0; b < n_nodes; ++b)
        for (unsigned int j = 0; j < dim; ++j)
          f[dim * b + j] = flux(W_columns[j],
                                grad_N[b] * B,
                                mean_W_columns[j],
                                mean_grad_N[b] * mean_B,
                                n,
                                M,
                                C);
    };
    f.resize(dim * n_nodes);
    evaluate(unit_symmetric_tensor<dim>(), unit_symmetric_tensor<dim>());

    for (unsigned int a = 0; a < n_nodes; ++a)
      for (unsigned int i = 0; i < dim; ++i)
        local.force[dim * a + i] +=
          point.JxW * (N[a] * traction[i] +
                       how.adjoint_sign * (f[dim * a + i] * violation));
    if (!tangent)
      return;

    // f lies in the range of M, so M e_j acts as e_j on it.
    const SymmetricTensor<2, dim> symmetric_beta =
      penalty(how, point.depth, n, M, C);
    Tensor<2, dim> beta; // its columns
    for (unsigned int j = 0; j < dim; ++j)
      beta[j] = pushed(Tensor<2, dim>(symmetric_beta)[j], constraint);
    for (unsigned int a = 0; a < n_nodes; ++a)
      for (unsigned int b = 0; b < n_nodes; ++b)
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < dim; ++j)
            local.matrix(dim * a + i, dim * b + j) +=
              point.JxW * (N[a] * N[b] * beta[j][i] -
                           how.adjoint_sign * f[dim * a + i][j] * N[b]);
    if (measure == StrainMeasure::finite)
      evaluate(to_middle(W * grad_du, measure),
               to_middle(W * mean_grad_du, measure));
    for (Tensor<1, dim> &flux_of_node : f)
      flux_of_node = pushed(flux_of_node, constraint);
    for (unsigned int a = 0; a < n_nodes; ++a)
      for (unsigned int b = 0; b < n_nodes; ++b)
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < dim; ++j)
            local.matrix(dim * a + i, dim * b + j) -=
              point.JxW * N[a] * f[dim * b + j][i];
  }



  template <int dim>
  void
  add_turn_of_normal(const double                   traction_by_normal,
                     const SymmetricTensor<2, dim> &normal_gradient,
                     const double                  *N,
                     LocalSystem<dim>              &local)
  {
    const unsigned int            n_nodes = local.dofs.size() / dim;
    const SymmetricTensor<2, dim> turn = traction_by_normal * normal_gradient;
    for (unsigned int a = 0; a < n_nodes; ++a)
      for (unsigned int b = 0; b < n_nodes; ++b)
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < dim; ++j)
            local.matrix(dim * a + i, dim * b + j) -= N[a] * N[b] * turn[i][j];
  }



  template <int dim>
  void
  add_mean_penalty(const ImplicitBoundary<dim> &boundary,
                   const BoundaryPiece<dim>    &piece,
                   const Enforcement           &how,
                   const LameConstants         &C,
                   LocalSystem<dim>            &local)
  {
    constexpr unsigned int n_nodes = GeometryInfo<dim>::vertices_per_cell;
    // Of the functions of nodes along the normal, and where it pushes.
    std::array<Tensor<1, dim>, n_nodes> normals, pushes;
    double                              area = 0;
    for (unsigned int q = piece.begin(); q < piece.end(); ++q)
      {
        const ConstraintState<dim> &state = piece.constraint(q);
        const Tensor<1, dim>        Mn    = state.M * state.normal;
        const Tensor<1, dim>        push  = pushed(Mn, state);
        const double                JxW   = boundary.points()[q].JxW;
        area += JxW;
        for (unsigned int a = 0; a < n_nodes; ++a)
          {
            normals[a] += JxW * boundary.N(q)[a] * Mn;
            pushes[a] += JxW * boundary.N(q)[a] * push;
          }
      }
    const double factor = how.mean_factor * C.lambda / area;
    for (unsigned int a = 0; a < n_nodes; ++a)
      for (unsigned int b = 0; b < n_nodes; ++b)
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < dim; ++j)
            local.matrix(dim * a + i, dim * b + j) +=
              factor * pushes[a][i] * normals[b][j];
  }



#define INSTANTIATE(dim)                                              \
  template decltype(boundary_traction<dim>)  boundary_traction<dim>;  \
  template decltype(add_boundary_point<dim>) add_boundary_point<dim>; \
  template decltype(add_mean_penalty<dim>)   add_mean_penalty<dim>;   \
  template decltype(add_turn_of_normal<dim>) add_turn_of_normal<dim>;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
