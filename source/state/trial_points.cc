// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/state/trial_points.h>

#include <moraine/core/words.h>
#include <moraine/material/umat_library.h>
#include <moraine/state/state.h>

#include <deal.II/physics/elasticity/kinematics.h>

#include <cmath>
#include <limits>

namespace moraine
{
  using namespace dealii;
  namespace Kinematics = Physics::Elasticity::Kinematics;

  namespace
  {
    // As a call it stores numbers that are read back in pairs at once, and the
    // processor waits.
    template <int dim>
    [[gnu::always_inline]] inline SymmetricTensor<2, 3>
    symmetric_part(const Tensor<2, dim> &gradient)
    {
      SymmetricTensor<2, 3> strain;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = i; j < dim; ++j)
          strain[i][j] = 0.5 * (gradient[i][j] + gradient[j][i]);
      return strain;
    }



    /** @f$\Delta F\, b\, \Delta F^T@f$; in plane strain zz stays. */
    template <int dim>
    SymmetricTensor<2, 3>
    push_forward(const Tensor<2, dim> &dF, const SymmetricTensor<2, 3> &b)
    {
      Tensor<2, dim> dF_b;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int k = 0; k < dim; ++k)
          for (unsigned int l = 0; l < dim; ++l)
            dF_b[i][k] += dF[i][l] * b[l][k];
      SymmetricTensor<2, 3> result;
      result[2][2] = b[2][2];
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = i; j < dim; ++j)
          {
            double sum = 0;
            for (unsigned int k = 0; k < dim; ++k)
              sum += dF_b[i][k] * dF[j][k];
            result[i][j] = sum;
          }
      return result;
    }
  } // namespace



  template <int dim>
  StateFields<dim>::StateFields(
    PointFields                                        &fields,
    const StrainMeasure                                 measure,
    const std::vector<std::shared_ptr<const Material>> &materials)
  {
    if (measure == StrainMeasure::finite)
      {
        F   = fields.request(FieldNames<dim>::deformation_gradient);
        b   = fields.request(FieldNames<dim>::elastic_left_cauchy_green);
        v_0 = fields.request(FieldNames<dim>::initial_volume);
      }
    for (const auto &material : materials)
      {
        internal.emplace_back();
        for (const InternalVariable &variable : material->internal_variables())
          internal.back().push_back(fields.request(
            typename FieldNames<dim>::Number{variable.name, variable.unit}));
      }
  }



  template <int dim>
  void
  TrialPoints<dim>::evaluate(const State<dim>        &state,
                             const StencilBlock<dim> &block,
                             const unsigned int       begin,
                             const unsigned int       end,
                             const Tensor<1, dim>    *nodal_increments)
  {
    measure         = state.strain_measure();
    n_nodes         = block.n_nodes;
    block_gradients = block.grad_N(begin);
    moved_gradients = nullptr;
    points.resize(end - begin);
    answers.resize(end - begin);
    means.block = block.means.n_cells > 0 ? &block.means : nullptr;
    if (means.block)
      {
        find_parts_of_means(state, block, begin);
        find_means(nodal_increments);
      }
    for (unsigned int i = 0; i < points.size(); ++i)
      {
        const Tensor<1, dim> *grad = block.grad_N(begin + i);
        Tensor<2, dim>        gradient;
        for (unsigned int a = 0; a < n_nodes; ++a)
          for (unsigned int k = 0; k < dim; ++k)
            for (unsigned int l = 0; l < dim; ++l)
              gradient[k][l] += nodal_increments[a][k] * grad[a][l];
        points[i].gradient = gradient;
        if (means.block && measure == StrainMeasure::small)
          take_mean_strain(begin, i);
      }
    const Material &material =
      state.material(state.material_points().body(block.points[begin]));
    isotropic = material.is_isotropic();
    if (isotropic && measure == StrainMeasure::small && material.is_linear())
      {
        n_internal = 0;
        ask_linear(state, block, begin);
        return;
      }
    load_internal(state, block, begin, internal);
    if (!isotropic)
      {
        answer_in_tensors(state, block, begin, material);
        return;
      }
    if (measure == StrainMeasure::finite)
      ask_finite(state, block, begin);
    else
      ask_small(state, block, begin);
    answer(state, material);
  }



  template <int dim>
  void
  TrialPoints<dim>::find_parts_of_means(const State<dim>        &state,
                                        const StencilBlock<dim> &block,
                                        const unsigned int       begin)
  {
    means.parts.resize(points.size());
    const Material &material =
      state.material(state.material_points().body(block.points[begin]));
    const bool    is_uniform = material.has_uniform_stiffness();
    LameConstants C          = material.elastic_stiffness();
    for (unsigned int i = 0; i < points.size(); ++i)
      {
        const unsigned int p = block.points[begin + i];
        if (!is_uniform)
          C = elastic_stiffness(state, p);
        means.parts[i] = state.mean_part(p, C);
      }
  }



  template <int dim>
  void
  TrialPoints<dim>::find_means(const Tensor<1, dim> *nodal_increments)
  {
    constexpr unsigned int n = CellMeanBlock<dim>::n_corners;
    means.changes.resize(means.block->n_cells);
    means.gradients = means.block->gradients;
    means.weights.resize(points.size() * means.block->n_cells);
    for (unsigned int c = 0; c < means.block->n_cells; ++c)
      {
        Tensor<2, dim> A;
        for (unsigned int a = c * n; a < (c + 1) * n; ++a)
          A += outer_product(nodal_increments[means.block->places[a]],
                             means.block->gradients[a]);
        means.changes[c] = trace(A);
        if (measure == StrainMeasure::small)
          continue;
        A                = Kinematics::F(A);
        means.changes[c] = determinant(A);
        // Else the points in it have no stress.
        if (!(means.changes[c] > 0))
          continue;
        const Tensor<2, dim> inverse = invert(A);
        for (unsigned int a = c * n; a < (c + 1) * n; ++a)
          means.gradients[a] = means.block->gradients[a] * inverse;
      }
  }



  template <int dim>
  void
  TrialPoints<dim>::take_mean_strain(const unsigned int begin,
                                     const unsigned int i)
  {
    double theta = 0;
    for (unsigned int c = 0; c < means.block->n_cells; ++c)
      {
        const double share = means.block->share(begin + i, c);
        means.weights[i * means.block->n_cells + c] = share;
        theta += share * means.changes[c];
      }
    Tensor<2, dim> &gradient = points[i].gradient;
    const double    change   = (theta - trace(gradient)) / dim;
    for (unsigned int d = 0; d < dim; ++d)
      gradient[d][d] += change;
  }



  template <int dim>
  Tensor<2, dim>
  TrialPoints<dim>::with_mean_volume(const Tensor<2, dim> &dF,
                                     const unsigned int    begin,
                                     const unsigned int    i)
  {
    const unsigned int m         = means.block->n_cells;
    double            *weights   = &means.weights[i * m];
    TrialPoint        &at        = points[i];
    double             J         = 0;
    bool               has_means = at.J_increment > 0;
    for (unsigned int c = 0; c < m; ++c)
      {
        weights[c] = means.block->share(begin + i, c) * means.changes[c];
        J += weights[c];
        has_means = has_means && weights[c] >= 0;
      }
    if (!has_means || !(J > 0))
      {
        at.J_increment = -1;
        return dF;
      }
    for (unsigned int c = 0; c < m; ++c)
      weights[c] /= J;
    const Tensor<2, dim> mean =
      std::pow(J / at.J_increment, means.parts[i] / dim) * dF;
    at.gradient = mean - Tensor<2, dim>(unit_symmetric_tensor<dim>());
    return mean;
  }



  template <int dim>
  void
  TrialPoints<dim>::ask_linear(const State<dim>        &state,
                               const StencilBlock<dim> &block,
                               const unsigned int       begin)
  {
    const auto         &set = state.material_points();
    const LameConstants C =
      state.material(set.body(block.points[begin])).elastic_stiffness();
    for (unsigned int i = 0; i < points.size(); ++i)
      {
        const unsigned int p  = block.points[begin + i];
        points[i].J_increment = 1;
        points[i].weight = block.share(begin + i) * state.integration_volume(p);
        points[i].stress = set.stress_field()(set.values(p)) +
                           C * symmetric_part(points[i].gradient);
      }
    failure = points.size();
  }



  template <int dim>
  void
  TrialPoints<dim>::ask_small(const State<dim>        &state,
                              const StencilBlock<dim> &block,
                              const unsigned int       begin)
  {
    const auto     &set        = state.material_points();
    const Material &material   = state.material(set.body(block.points[begin]));
    const bool      is_uniform = material.has_uniform_stiffness();
    const bool      is_linear  = material.has_linear_elasticity();
    LameConstants   C          = material.elastic_stiffness();
    for (unsigned int i = 0; i < points.size(); ++i)
      {
        const unsigned int p        = block.points[begin + i];
        TrialPoint        &at       = points[i];
        const double      *of_point = &internal[i * n_internal];
        if (!is_uniform && is_linear)
          C = material.elastic_stiffness_at(of_point);
        at.J_increment = 1;
        at.weight      = block.share(begin + i) * state.integration_volume(p);
        const SymmetricTensor<2, 3> stress = set.stress_field()(set.values(p));
        at.principal                       = spectrum<dim>(
          (is_linear ? C.strain_of(stress) :
                                             material.elastic_strain_of(stress, of_point)) +
          symmetric_part(at.gradient));
        at.trial_strain = at.principal.values;
      }
  }



  template <int dim>
  Tensor<2, dim>
  TrialPoints<dim>::deform(const State<dim>        &state,
                           const StencilBlock<dim> &block,
                           const unsigned int       begin,
                           const unsigned int       i)
  {
    const unsigned int p  = block.points[begin + i];
    TrialPoint        &at = points[i];

    const Tensor<2, dim> dF         = Kinematics::F(at.gradient);
    at.J_increment                  = determinant(dF);
    const Tensor<2, dim>  inverse   = invert(dF);
    const Tensor<1, dim> *gradients = block.grad_N(begin + i);
    for (unsigned int a = 0; a < n_nodes; ++a)
      moved[i * n_nodes + a] = gradients[a] * inverse;
    at.weight = block.share(begin + i) * state.integration_volume(p) /
                state.volume_ratio(p);
    return means.block ? with_mean_volume(dF, begin, i) : dF;
  }



  template <int dim>
  void
  TrialPoints<dim>::ask_finite(const State<dim>        &state,
                               const StencilBlock<dim> &block,
                               const unsigned int       begin)
  {
    if (moved.size() < points.size() * n_nodes)
      moved.resize(points.size() * n_nodes);
    moved_gradients = moved.data();
    for (unsigned int i = 0; i < points.size(); ++i)
      {
        const double *values =
          state.material_points().values(block.points[begin + i]);
        const Tensor<2, dim> dF = deform(state, block, begin, i);
        TrialPoint          &at = points[i];
        at.principal =
          spectrum<dim>(push_forward(dF, state.fields().b(values)));
        for (unsigned int A = 0; A < 3; ++A)
          at.trial_strain[A] = 0.5 * std::log(at.principal.values[A]);
        if (!(at.J_increment > 0))
          at.trial_strain[0] = std::numeric_limits<double>::quiet_NaN();
      }
  }



  template <int dim>
  void
  TrialPoints<dim>::load_internal(const State<dim>        &state,
                                  const StencilBlock<dim> &block,
                                  const unsigned int       begin,
                                  std::vector<double>     &values)
  {
    const auto &set    = state.material_points();
    const auto &fields = state.fields().internal[set.body(block.points[begin])];
    n_internal         = fields.size();
    values.resize(points.size() * n_internal);
    for (unsigned int i = 0; i < points.size() && n_internal > 0; ++i)
      for (unsigned int v = 0; v < n_internal; ++v)
        values[i * n_internal + v] =
          fields[v](set.values(block.points[begin + i]));
  }



  template <int dim>
  void
  TrialPoints<dim>::answer(const State<dim> &state, const Material &material)
  {
    for (unsigned int i = 0; i < points.size(); ++i)
      {
        answers[i].strain   = points[i].trial_strain;
        answers[i].internal = internal.data() + i * n_internal;
      }
    material.respond(state.step_time(), make_array_view(answers));
    failure = points.size();
    for (unsigned int i = points.size(); i-- > 0;)
      {
        points[i].stress = points[i].principal.tensor(answers[i].stress);
        if (!std::isfinite(answers[i].stress[0]))
          failure = i;
      }
  }



  template <int dim>
  void
  TrialPoints<dim>::answer_in_tensors(const State<dim>        &state,
                                      const StencilBlock<dim> &block,
                                      const unsigned int       begin,
                                      const Material          &material)
  {
    const auto &set    = state.material_points();
    const bool  finite = measure == StrainMeasure::finite;
    if (finite)
      {
        if (moved.size() < points.size() * n_nodes)
          moved.resize(points.size() * n_nodes);
        moved_gradients = moved.data();
      }
    tensor_answers.resize(points.size());
    for (unsigned int i = 0; i < points.size(); ++i)
      {
        const unsigned int p  = block.points[begin + i];
        TrialPoint        &at = points[i];
        TensorState       &to = tensor_answers[i];
        if (finite)
          {
            const Tensor<2, dim> dF  = deform(state, block, begin, i);
            const Tensor<2, dim> F_n = state.fields().F(set.values(p));
            to.F_n                   = in_space(F_n);
            to.F                     = in_space(dF * F_n);
          }
        else
          {
            at.J_increment = 1;
            at.weight = block.share(begin + i) * state.integration_volume(p);
            to.strain_increment = symmetric_part(at.gradient);
          }
        to.stress   = set.stress_field()(set.values(p));
        to.internal = internal.data() + i * n_internal;
      }
    try
      {
        material.respond(state.step_time(),
                         measure,
                         make_array_view(tensor_answers));
      }
    catch (const UmatExit &exit)
      {
        const unsigned int p = block.points[begin + exit.point];
        throw ComputationError("point " + std::to_string(set.id(p)) + " at (" +
                               coordinates(set.position(p)) +
                               "): " + exit.what());
      }
    failure = points.size();
    for (unsigned int i = points.size(); i-- > 0;)
      {
        points[i].stress = tensor_answers[i].stress;
        if (!(points[i].J_increment > 0) ||
            !std::isfinite(points[i].stress[0][0]))
          failure = i;
      }
  }



  template <int dim>
  SymmetricTensor<2, 3>
  TrialPoints<dim>::elastic_left_cauchy_green(const unsigned int i) const
  {
    if (!isotropic)
      return symmetrize(tensor_answers[i].F * transpose(tensor_answers[i].F));
    Tensor<1, 3> values;
    for (unsigned int A = 0; A < 3; ++A)
      values[A] = std::exp(2 * answers[i].strain[A]);
    return points[i].principal.tensor(values);
  }



  template struct StateFields<2>;
  template struct StateFields<3>;
  template class TrialPoints<2>;
  template class TrialPoints<3>;
} // namespace moraine
