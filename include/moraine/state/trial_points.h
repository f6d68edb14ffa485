// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_state_trial_points_h
#define moraine_state_trial_points_h

#include <moraine/basis/stencil.h>
#include <moraine/core/step_time.h>
#include <moraine/material/spectral.h>
#include <moraine/points/point_fields.h>

#include <memory>
#include <boost/container/small_vector.hpp>

#include <vector>

namespace moraine
{
  template <int dim>
  class State;

  /**
   * What points carry of their state beside volume, displacement and stress. A
   * field that the strain measure and the materials do not need does not exist.
   *
   * | field                     | components | exists                        |
   * |---------------------------|------------|-------------------------------|
   * | deformation_gradient      | dim * dim  | at finite strain: @f$F@f$     |
   * | elastic_left_cauchy_green | 4 or 6     | at finite strain: @f$b^e@f$   |
   * | initial_volume            | 1          | at finite strain: @f$v_0@f$   |
   * | internal variables        | 1 each     | of the materials, by name     |
   */
  template <int dim>
  struct StateFields
  {
    /** Ask for the fields, or find them where they were asked for. */
    StateFields(
      PointFields                                        &fields,
      const StrainMeasure                                 measure,
      const std::vector<std::shared_ptr<const Material>> &materials = {});

    PointField<dim, dealii::Tensor<2, dim>>        F;
    PointField<dim, dealii::SymmetricTensor<2, 3>> b;
    PointField<dim, double>                        v_0;
    /** Of the material of each body; materials share what has one name. */
    std::vector<std::vector<PointField<dim, double>>> internal;

    /** The internal variables of a point of @p body with these @p values. */
    boost::container::small_vector<double, 16>
    internal_of(const unsigned int body, const double *values) const
    {
      boost::container::small_vector<double, 16> result;
      for (const auto &field : internal[body])
        result.push_back(field(values));
      return result;
    }
  };

  /** A deformation gradient, in plane strain with the third direction. */
  template <int dim>
  dealii::Tensor<2, 3>
  in_space(const dealii::Tensor<2, dim> &F)
  {
    dealii::Tensor<2, 3> result;
    result[2][2] = 1;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        result[i][j] = F[i][j];
    return result;
  }

  /** Stored energies at both ends of a step, and what was dissipated in it. Of
   * a point per initial volume, or of points. */
  struct StepEnergies
  {
    double stored_at_start = 0;
    double stored          = 0;
    double dissipated      = 0;
  };



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
   *
   * If a block has means of its cells, b, the material feels their change of
   * volume (B-bar, F-bar): at small strain
   * @f$\hat\varepsilon = \varepsilon + \frac1n (\hat\theta - \theta) 1@f$
   * with @f$\hat\theta = \sum_c s_{pc} \sum_a \Delta u_a \cdot b_{ca}@f$,
   * at finite strain @f$\Delta\hat F = (\hat J/J)^{1/n} \Delta F@f$ with
   * @f$\hat J = \sum_c s_{pc} \det A_c@f$,
   * @f$A_c = 1 + \sum_a \Delta u_a \otimes b_{ca}@f$, n = dim: in plane strain
   * in the plane (de Souza Neto et al. 1996, 2005). Unlike there, forces and
   * tangent are derivatives of the stored energy, so that they are symmetric.
   * Of points that keep a part of their own change, State::mean_part(), it is
   * @f$(\hat J/J)^{a/n}@f$.
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

    /** @f$\sum_a \Delta u_a \otimes \nabla N_a@f$, with what changes the
     * volume as the material feels it. */
    const dealii::Tensor<2, dim> &
    increment_gradient(const unsigned int i) const
    {
      return points[i].gradient;
    }

    bool
    is_finite() const
    {
      return measure == StrainMeasure::finite;
    }

    /** The cells of which means are part of the strain; none at first. */
    unsigned int
    n_means() const
    {
      return means.block ? means.block->n_cells : 0;
    }

    /** a of the i-th point, State::mean_part(). */
    double
    mean_part(const unsigned int i) const
    {
      return means.parts[i];
    }

    /** The means' gradients in the trial state at the corners of the c-th cell,
     * @f$\bar g_{ca} = A_c^{-T} b_{ca}@f$ or @f$b_{ca}@f$. */
    const dealii::Tensor<1, dim> *
    mean_gradients(const unsigned int c) const
    {
      return &means.gradients[c * CellMeanBlock<dim>::n_corners];
    }

    /** Where the corners of the c-th cell are among the nodes. */
    const unsigned int *
    mean_places(const unsigned int c) const
    {
      return &means.block->places[c * CellMeanBlock<dim>::n_corners];
    }

    /** @f$\omega_{pc}@f$, how much of the change of volume of the i-th point
     * is that of the c-th cell. */
    double
    mean_weight(const unsigned int i, const unsigned int c) const
    {
      return means.weights[i * means.block->n_cells + c];
    }

    /** See moraine::spatial_tangent(). Not of linear materials at small strain,
     * whose tangent is the elastic stiffness. */
    VoigtMatrix<dim>
    tangent(const unsigned int i) const
    {
      return isotropic ? spatial_tangent<dim>(points[i].principal,
                                              points[i].trial_strain,
                                              answers[i],
                                              measure) :
                         voigt_matrix<dim>(tensor_answers[i].tangent);
    }

    /** @f$b^e@f$ after a step of finite strain; of a material that is not
     * isotropic b. */
    dealii::SymmetricTensor<2, 3>
    elastic_left_cauchy_green(const unsigned int i) const;

    /**
     * Find energies() of the points evaluated last, @p block and @p begin as
     * then; their material is isotropic. What dissipates is the work on plastic
     * strain of the mean stress of both ends,
     *
     * @f[ \tfrac12 (\tau_n^* + \tau_{n+1}) : \Delta\varepsilon^p , \qquad
     *   \Delta\varepsilon^p = \varepsilon^{tr} - \varepsilon^e , \qquad
     *   \tau_n^* = \mathrm{sym}(\Delta F\, \tau_n\, \Delta F^{-1}) . @f]
     *
     * @f$\tau_n^*@f$ is @f$\tau_n@f$ turned with the material but for terms of
     * second order in the strain of the step. At small strain it is
     * @f$\sigma_n@f$, and then energies and the work of the mean stress agree
     * exactly.
     */
    void
    find_energies(const State<dim>        &state,
                  const StencilBlock<dim> &block,
                  const unsigned int       begin);

    /** find_energies() and add them, weighted, to @p sums. */
    void
    add_energies(const State<dim>        &state,
                 const StencilBlock<dim> &block,
                 const unsigned int       begin,
                 StepEnergies            &sums);

    /** Of the i-th point, per initial volume. */
    const StepEnergies &
    energies(const unsigned int i) const
    {
      return energy_points[i].energies;
    }

    /** Kirchhoff's stress at the start of the step, or Cauchy's, after
     * find_energies(). */
    const dealii::SymmetricTensor<2, 3> &
    stress_at_start(const unsigned int i) const
    {
      return energy_points[i].stress;
    }

    /**
     * G, by which the sum of stored and dissipated energy of the i-th point
     * changes in the trial state: G : d, @f$d = \mathrm{sym}(\delta\Delta F\,
     * \Delta F^{-1})@f$. At finite strain, after find_energies().
     */
    dealii::SymmetricTensor<2, 3>
    energy_gradient(const unsigned int i) const;

    /** Internal variables after the step, in the order of the material. */
    const double *
    internal_variables(const unsigned int i) const
    {
      return internal.data() + i * n_internal;
    }

    /** The first of the points without a stress; n_points() if there is none.
     */
    unsigned int
    first_failure() const
    {
      return failure;
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

    /** The cells of which means are part of the strain. */
    struct MeansOfCells
    {
      const CellMeanBlock<dim> *block = nullptr; ///< none without means
      /** @f$\sum_a \Delta u_a \cdot b_{ca}@f$, or at finite strain
       * @f$\det A_c@f$. */
      std::vector<double>                 changes;
      std::vector<dealii::Tensor<1, dim>> gradients; ///< in the trial state
      std::vector<double>                 weights;   ///< of points and cells
      std::vector<double>                 parts;     ///< a of points
    };

    /** What find_energies() finds. */
    struct EnergyPoint
    {
      StepEnergies                  energies;
      dealii::SymmetricTensor<2, 3> stress; ///< at the start of the step
      dealii::Tensor<2, 3> carried; ///< @f$\Delta F\,\tau_n\,\Delta F^{-1}@f$
    };

    /** What the means are to the points, from the state at the start. */
    void
    find_parts_of_means(const State<dim>        &state,
                        const StencilBlock<dim> &block,
                        const unsigned int       begin);

    /** Change of volume and gradients of the cells in the trial state. */
    void
    find_means(const dealii::Tensor<1, dim> *nodal_increments);

    /** The mean change of volume of the i-th point instead of its own, at small
     * strain. */
    void
    take_mean_strain(const unsigned int begin, const unsigned int i);

    /** @p dF with the mean change of volume instead of its own. */
    dealii::Tensor<2, dim>
    with_mean_volume(const dealii::Tensor<2, dim> &dF,
                     const unsigned int            begin,
                     const unsigned int            i);

    void
    find_small_energies(const State<dim>        &state,
                        const StencilBlock<dim> &block,
                        const unsigned int       begin,
                        const Material          &material);

    void
    find_finite_energies(const State<dim>        &state,
                         const StencilBlock<dim> &block,
                         const unsigned int       begin);

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

    /** Volume, gradients and determinant at the end of a step of finite strain.
     * @return @f$\Delta F@f$ of the i-th point. */
    dealii::Tensor<2, dim>
    deform(const State<dim>        &state,
           const StencilBlock<dim> &block,
           const unsigned int       begin,
           const unsigned int       i);

    /** Copy the committed internal variables into @p values. */
    void
    load_internal(const State<dim>        &state,
                  const StencilBlock<dim> &block,
                  const unsigned int       begin,
                  std::vector<double>     &values);

    void
    answer(const State<dim> &state, const Material &material);

    /** Ask a material that is not isotropic. */
    void
    answer_in_tensors(const State<dim>        &state,
                      const StencilBlock<dim> &block,
                      const unsigned int       begin,
                      const Material          &material);

    StrainMeasure                       measure         = StrainMeasure::small;
    bool                                isotropic       = true;
    unsigned int                        n_nodes         = 0;
    unsigned int                        n_internal      = 0;
    unsigned int                        failure         = 0;
    const dealii::Tensor<1, dim>       *block_gradients = nullptr;
    const dealii::Tensor<1, dim>       *moved_gradients = nullptr;
    MeansOfCells                        means;
    std::vector<dealii::Tensor<1, dim>> moved;
    std::vector<TrialPoint>             points;
    std::vector<PrincipalState>         answers;
    std::vector<TensorState>            tensor_answers;
    std::vector<double>                 internal;

    /** After find_energies(). */
    std::vector<EnergyPoint>   energy_points;
    std::vector<ElasticPoint>  elastic_points;
    std::vector<double>        internal_at_start;
    std::vector<double>        stored;
    std::vector<LameConstants> stiffness;
    bool                       dissipates = false;
  };
} // namespace moraine

#endif
