// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_state_trial_points_h
#define moraine_state_trial_points_h

#include <moraine/basis/stencil.h>
#include <moraine/material/spectral.h>
#include <moraine/points/point_fields.h>

#include <vector>

namespace moraine
{
  template <int dim>
  class State;

  /**
   * What points carry of their state beside volume, displacement and stress
   * (offsets into their values). A field that the strain measure and the
   * materials do not need does not exist.
   *
   * | field                     | components | exists                        |
   * |---------------------------|------------|-------------------------------|
   * | deformation_gradient      | dim * dim  | at finite strain: @f$F@f$     |
   * | elastic_left_cauchy_green | 4 or 6     | at finite strain: @f$b^e@f$   |
   * | initial_volume            | 1          | at finite strain: @f$v_0@f$   |
   * | plastic_strain            | 1          | with plastic materials        |
   */
  template <int dim>
  struct StateFields
  {
    /** Ask for the fields, or find them where they were asked for. */
    StateFields(PointFields        &fields,
                const StrainMeasure measure,
                const bool          plastic);

    static constexpr unsigned int none = -1;

    unsigned int F     = none;
    unsigned int b     = none;
    unsigned int v_0   = none;
    unsigned int kappa = none;
  };

  /** The symmetric tensor stored at a point: xx, yy, zz, xy[, xz, yz]. */
  template <int dim>
  inline dealii::SymmetricTensor<2, 3>
  load_symmetric(const double *components)
  {
    dealii::SymmetricTensor<2, 3> tensor;
    for (unsigned int c = 0; c < n_stress_components<dim>; ++c)
      tensor.access_raw_entry(c) = components[c];
    return tensor;
  }

  template <int dim>
  inline void
  store_symmetric(const dealii::SymmetricTensor<2, 3> &tensor,
                  double                              *components)
  {
    for (unsigned int c = 0; c < n_stress_components<dim>; ++c)
      components[c] = tensor.access_raw_entry(c);
  }

  /**
   * The trial state of points of one body that share their nodes: a function of
   * their committed values and the nodal increments.
   *
   * At small strain @f$\sigma = \sigma_n + C : \Delta\varepsilon@f$ (Cortis et
   * al. 2017, eq. 10), or the return mapping of
   * @f$C^{-1}:\sigma_n + \Delta\varepsilon@f$. At finite strain (Charlton et
   * al. 2017), with
   * @f$\Delta F = 1 + \sum_a \Delta u_a \otimes \nabla N_a@f$ from the start of
   * the step, the return mapping of
   * @f$\frac12\ln(\Delta F\, b^e_n\, \Delta F^T)@f$ gives Kirchhoff's stress
   * @f$\tau@f$; internal forces are
   * @f$\sum_p (v_n/J_n)\, \tau\, \Delta F^{-T} \nabla N_a@f$.
   */
  template <int dim>
  class TrialPoints
  {
  public:
    /** Points [begin, end) of a block; the results are valid until the next
     * call. */
    void
    evaluate(const State<dim>             &state,
             const StencilBlock<dim>      &block,
             const unsigned int            begin,
             const unsigned int            end,
             const dealii::Tensor<1, dim> *nodal_increments);

    /** Of the i-th of the points: Cauchy's or, at finite strain, Kirchhoff's.
     */
    const dealii::SymmetricTensor<2, 3> &
    stress(const unsigned int i) const
    {
      return points[i].stress;
    }

    /** The volume that the stress is integrated over, @f$v@f$ or
     * @f$v_n/J_n@f$. */
    double
    weight(const unsigned int i) const
    {
      return points[i].weight;
    }

    /** Gradients of the functions of the block's nodes in the trial state. */
    const dealii::Tensor<1, dim> *
    grad_N(const unsigned int i) const
    {
      return moved_gradients ? &moved_gradients[i * n_nodes] :
                               &block_gradients[i * n_nodes];
    }

    /** @f$\sum_a \Delta u_a \otimes \nabla N_a@f$ */
    const dealii::Tensor<2, dim> &
    increment_gradient(const unsigned int i) const
    {
      return points[i].gradient;
    }

    /** See moraine::spatial_tangent(). Not of linear materials at small strain,
     * whose tangent is the elastic stiffness. */
    VoigtMatrix<dim>
    tangent(const unsigned int i) const
    {
      return spatial_tangent<dim>(points[i].principal,
                                  points[i].trial_strain,
                                  answers[i],
                                  measure);
    }

    /** Elastic strain (logarithmic at finite strain) after the step. */
    dealii::SymmetricTensor<2, 3>
    elastic_left_cauchy_green(const unsigned int i) const;

    double
    plastic_strain(const unsigned int i) const
    {
      return answers[i].plastic_strain;
    }

    /** The first of the points without a stress; n_points() if there is none.
     */
    unsigned int
    first_fault() const
    {
      return fault;
    }

    unsigned int
    n_points() const
    {
      return points.size();
    }

    /** Whether the i-th point was turned inside out. */
    bool
    inverted(const unsigned int i) const
    {
      return !(points[i].J_increment > 0);
    }

  private:
    struct TrialPoint
    {
      dealii::Tensor<2, dim>        gradient;
      double                        J_increment;
      double                        weight;
      dealii::SymmetricTensor<2, 3> stress;
      Spectrum                      principal;
      dealii::Tensor<1, 3>          trial_strain;
    };

    void
    ask_linear(const State<dim>        &state,
               const StencilBlock<dim> &block,
               const unsigned int       begin);

    void
    ask_small(const State<dim>        &state,
              const StencilBlock<dim> &block,
              const unsigned int       begin);

    void
    ask_finite(const State<dim>        &state,
               const StencilBlock<dim> &block,
               const unsigned int       begin);

    void
    answer(const State<dim>        &state,
           const StencilBlock<dim> &block,
           const unsigned int       begin);

    StrainMeasure                       measure         = StrainMeasure::small;
    unsigned int                        n_nodes         = 0;
    unsigned int                        fault           = 0;
    const dealii::Tensor<1, dim>       *block_gradients = nullptr;
    const dealii::Tensor<1, dim>       *moved_gradients = nullptr;
    std::vector<dealii::Tensor<1, dim>> moved;
    std::vector<TrialPoint>             points;
    std::vector<PrincipalState>         answers;
  };
} // namespace moraine

#endif
