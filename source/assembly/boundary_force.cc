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



    /** Adds the flux of point @p q: its part of the traction to the derivative,
     * its adjoint to both. @p f is scratch. */
    template <int dim>
    void
    add_flux(const BoundaryPiece<dim>    &piece,
             const unsigned int           q,
             const Tensor<1, dim>        &violation,
             const Enforcement           &how,
             const LameConstants         &C,
             const StrainMeasure          measure,
             const bool                   tangent,
             std::vector<Tensor<1, dim>> &f,
             LocalSystem<dim>            &local)
    {
      const ConstraintState<dim> &constraint = piece.constraint(q);
      const auto                 &du         = piece.increment(q);
      const auto                 &N          = piece.N;
      const Tensor<2, dim>        W          = weights(how, constraint.M);
      const unsigned int          n_nodes    = piece.nodes().size();
      const double                JxW        = piece.point(q).JxW;
      // f[b*dim+j] = flux of the unit displacement j of node b
      const auto evaluate = [&](const Tensor<2, dim> &B,
                                const Tensor<2, dim> &mean_B) {
        const Tensor<2, dim> W_columns      = transpose(B * W);
        const Tensor<2, dim> mean_W_columns = transpose(mean_B * W);
        for (unsigned int b = 0; b < n_nodes; ++b)
          for (unsigned int j = 0; j < dim; ++j)
            f[dim * b + j] = flux(W_columns[j],
                                  piece.grad_N[b] * B,
                                  mean_W_columns[j],
                                  piece.mean_grad_N[b] * mean_B,
                                  constraint.normal,
                                  constraint.M,
                                  C);
      };
      f.resize(dim * n_nodes);
      evaluate(unit_symmetric_tensor<dim>(), unit_symmetric_tensor<dim>());
      for (unsigned int k = 0; k < f.size(); ++k)
        local.force[k] += JxW * how.adjoint_sign * (f[k] * violation);
      if (!tangent)
        return;
      // f lies in the range of M, so M e_j acts as e_j on it.
      for (unsigned int k = 0; k < f.size(); ++k)
        for (unsigned int b = 0; b < n_nodes; ++b)
          for (unsigned int j = 0; j < dim; ++j)
            local.matrix(k, dim * b + j) -=
              JxW * how.adjoint_sign * f[k][j] * N[b];
      if (measure == StrainMeasure::finite)
        evaluate(to_middle(W * du.gradient, measure),
                 to_middle(W * du.mean_gradient, measure));
      for (Tensor<1, dim> &flux_of_node : f)
        flux_of_node = pushed(flux_of_node, constraint);
      for (unsigned int a = 0; a < n_nodes; ++a)
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int k = 0; k < f.size(); ++k)
            local.matrix(dim * a + i, k) -= JxW * N[a] * f[k][i];
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
    if (how.has_flux())
      {
        const Tensor<2, dim>    W      = weights(how, M);
        const Tensor<2, dim>    A      = W * grad_du;
        const Tensor<2, dim>    mean_A = W * mean_grad_du;
        SymmetricTensor<2, dim> strain = symmetrize(A * to_middle(A, measure));
        const double            change =
          trace(mean_A * to_middle(mean_A, measure)) - trace(strain);
        for (unsigned int d = 0; d < dim; ++d)
          strain[d][d] += change / dim;
        traction +=
          M * (C.lambda * trace(strain) * n + 2. * C.mu * (strain * n));
      }
    traction -= penalty(how, point.depth, n, M, C) * constraint.violation;
    traction -=
      how.mean_factor * C.lambda * constraint.mean_violation * (M * n);
    return pushed(traction, constraint);
  }



  template <int dim>
  Tensor<1, dim>
  boundary_traction(const BoundaryPiece<dim> &piece,
                    const unsigned int        q,
                    const Enforcement        &how,
                    const LameConstants      &C,
                    const StrainMeasure       measure)
  {
    return boundary_traction(piece.point(q),
                             piece.constraint(q),
                             how,
                             C,
                             measure,
                             piece.increment(q).gradient,
                             piece.increment(q).mean_gradient);
  }



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



  template <int dim>
  void
  add_boundary_point(const BoundaryPiece<dim>    &piece,
                     const unsigned int           q,
                     const double                 of_start,
                     const Enforcement           &how,
                     const LameConstants         &C,
                     const StrainMeasure          measure,
                     const bool                   tangent,
                     std::vector<Tensor<1, dim>> &fluxes,
                     LocalSystem<dim>            &local)
  {
    const BoundaryPoint<dim>   &point      = piece.point(q);
    const ConstraintState<dim> &constraint = piece.constraint(q);
    Tensor<1, dim> traction = boundary_traction(piece, q, how, C, measure);
    Tensor<1, dim> violation =
      point.accumulated_violation + constraint.violation;
    if (of_start > 0)
      {
        traction += of_start * (point.multiplier_at_start * point.normal) *
                    constraint.push;
        violation += of_start * point.accumulated_violation;
      }
    local.add_force(piece.N.data(), point.JxW * traction);
    if (tangent)
      {
        const Tensor<2, dim> beta =
          penalty(how, point.depth, constraint.normal, constraint.M, C);
        Tensor<2, dim> columns;
        for (unsigned int j = 0; j < dim; ++j)
          columns[j] = pushed(beta[j], constraint);
        local.add_stiffness(piece.N.data(), point.JxW * transpose(columns));
      }
    if (how.has_flux())
      add_flux(piece, q, violation, how, C, measure, tangent, fluxes, local);
  }



  template <int dim>
  void
  add_mean_penalty(const BoundaryPiece<dim> &piece,
                   const Enforcement        &how,
                   const LameConstants      &C,
                   LocalSystem<dim>         &local)
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
        const double                JxW   = piece.point(q).JxW;
        area += JxW;
        for (unsigned int a = 0; a < n_nodes; ++a)
          {
            normals[a] += JxW * piece.functions(q)[a] * Mn;
            pushes[a] += JxW * piece.functions(q)[a] * push;
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



#define INSTANTIATE(dim)                                                          \
  template Tensor<1, dim>         boundary_traction(const BoundaryPoint<dim> &,   \
                                                    const ConstraintState<dim> &, \
                                                    const Enforcement &,          \
                                                    const LameConstants &,        \
                                                    const StrainMeasure,          \
                                                    const Tensor<2, dim> &,       \
                                                    const Tensor<2, dim> &);      \
  template Tensor<1, dim>         boundary_traction(const BoundaryPiece<dim> &,   \
                                                    const unsigned int,           \
                                                    const Enforcement &,          \
                                                    const LameConstants &,        \
                                                    const StrainMeasure);         \
  template decltype(penalty<dim>) penalty<dim>;                                   \
  template decltype(add_boundary_point<dim>) add_boundary_point<dim>;             \
  template decltype(add_mean_penalty<dim>)   add_mean_penalty<dim>;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
