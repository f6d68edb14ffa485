// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_output_error_norms_h
#define moraine_output_error_norms_h

#include <moraine/points/point_set.h>

#include <deal.II/base/parameter_handler.h>

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace moraine
{
  /**
   * Displacement and stress known exactly, as functions of the place where the
   * material was at the start, and of time. Either may be missing.
   */
  template <int dim>
  struct ExactSolution
  {
    using Stress = std::array<double, n_stress_components<dim>>;

    std::function<dealii::Tensor<1, dim>(const dealii::Point<dim> &,
                                         const double)>
      displacement;
    std::function<Stress(const dealii::Point<dim> &, const double)> stress;
  };

  /** Section `Exact solution`. */
  template <int dim>
  struct ExactSolutionParameters
  {
    std::string                   displacement;
    std::string                   stress;
    std::map<std::string, double> constants;

    void
    add_parameters(dealii::ParameterHandler &prm);

    /** @throws InputError for text that is not an expression. */
    ExactSolution<dim>
    solution() const;
  };

  /** Names and values; no value where the exact quantity is zero everywhere. */
  using ErrorNorms = std::vector<std::pair<std::string, std::optional<double>>>;

  /**
   * Errors of the points against an exact solution. Collective.
   *
   * | name         | meaning                                                  |
   * |--------------|----------------------------------------------------------|
   * | r_u          | @f$\frac1V\sum_p v_p \|u_p-u_e\|/\|u_e\|@f$              |
   * | l2_u         | @f$(\sum_p v_p\|u_p-u_e\|^2/\sum_p v_p\|u_e\|^2)^{1/2}@f$|
   * | max_u        | largest @f$\|u_p-u_e\|@f$ [length]                       |
   * | r_sigma_xx … | as r_u, for one component of the stress                  |
   * | l2_sigma     | as l2_u, with the Frobenius norm of the stress           |
   * | mean_sigma   | as max_sigma, the mean by volume [stress]                |
   * | max_sigma    | largest Frobenius norm of the error [stress]             |
   *
   * Volumes are those at the start. r_* are equations 29 and 30 of Cortis et
   * al., Int. J. Numer. Meth. Engng (2017). Points where the exact value is
   * zero (below 1e-12 of its largest) are measured against its largest value; a
   * component that is zero everywhere (below 1e-12 of the largest component)
   * has no relative error.
   *
   * The exact solution is evaluated where the point was at the start.
   *
   * @p points_moved says whether positions include the displacement. It is
   * false on a mesh that is kept.
   */
  template <int dim>
  ErrorNorms
  error_norms(const PointSet<dim>      &points,
              const ExactSolution<dim> &exact,
              const double              time,
              const bool                points_moved);
} // namespace moraine

#endif
