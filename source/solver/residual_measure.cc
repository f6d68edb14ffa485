// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/solver/residual_measure.h>

#include <deal.II/base/mpi.h>

#include <moraine/solver/linear_report.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** What round-off leaves of the forces at the start of a step, which cancel
     * altogether where a step ends without stress. */
    constexpr double cancelled = 1e-14;

    /** Rounding errors of a residual, over those of its largest products. */
    constexpr double rounding = 4 * std::numeric_limits<double>::epsilon();

    /** Of the forces: less is not looked at, and with more there are none. */
    constexpr double forgiven = 1e-6, without_forces = 1e-2;

    /** Stiffness over the geometric mean of a part, beyond which it is none of
     * a body or a boundary but of what is torn or turned inside out. */
    constexpr double largest_contrast = 1e10;



    /** What goes beyond a goal of zero is infinitely far away. */
    double
    over_goal(const double norm, const double goal)
    {
      return norm == 0. ? 0. : norm / goal;
    }



    double
    distance_of(const std::vector<double> &norms,
                const std::vector<double> &goals)
    {
      double sum = 0.;
      for (unsigned int p = 0; p < norms.size(); ++p)
        sum += std::pow(over_goal(norms[p], goals[p]), 2);
      return std::sqrt(sum);
    }
  } // namespace



  std::vector<double>
  ResidualMeasure::norms_of_parts(const LA::Vector &v) const
  {
    const auto         &part = system.part_of_unknown();
    std::vector<double> sums(scales.size(), 0.);
    const double       *values = v.trilinos_vector()[0];
    for (unsigned int k = 0; k < v.locally_owned_size(); ++k)
      sums[part.empty() ? 0 : part[k]] += values[k] * values[k];
    Utilities::MPI::sum(sums, v.get_mpi_communicator(), sums);
    for (double &sum : sums)
      sum = std::sqrt(sum);
    return sums;
  }



  void
  ResidualMeasure::take_diagonal(const LA::Vector &x)
  {
    diagonal.reinit(x, true);
    system.tangent()->trilinos_matrix().ExtractDiagonalCopy(
      *diagonal.trilinos_vector()(0));
    const auto         &part   = system.part_of_unknown();
    double             *values = diagonal.trilinos_vector()[0];
    const unsigned int  n      = diagonal.locally_owned_size();
    std::vector<double> sums(2 * scales.size(), 0.);
    for (unsigned int k = 0; k < n; ++k)
      if (std::isfinite(values[k]) && values[k] != 0.)
        {
          const unsigned int p = part.empty() ? 0 : part[k];
          sums[2 * p] += std::log(std::abs(values[k]));
          sums[2 * p + 1] += 1;
        }
    Utilities::MPI::sum(sums, x.get_mpi_communicator(), sums);
    std::vector<double> largest(scales.size(), 0.);
    for (unsigned int p = 0; p < largest.size(); ++p)
      if (sums[2 * p + 1] > 0)
        largest[p] = largest_contrast * std::exp(sums[2 * p] / sums[2 * p + 1]);
    for (unsigned int k = 0; k < n; ++k)
      values[k] =
        std::min(std::abs(values[k]), largest[part.empty() ? 0 : part[k]]);
  }



  void
  ResidualMeasure::update(const LA::Vector &x, const bool tangent)
  {
    scales = system.force_scales();
    if (tangent)
      take_diagonal(x);
    LA::Vector    products(x);
    double       *values = products.trilinos_vector()[0];
    const double *K      = diagonal.trilinos_vector()[0];
    const double  scale  = system.displacement_scale();
    for (unsigned int k = 0; k < x.locally_owned_size(); ++k)
      values[k] = K[k] * (std::abs(values[k]) + scale);

    now.norms = norms_of_parts(system.residual());
    now.goals = norms_of_parts(products);
    for (unsigned int p = 0; p < now.goals.size(); ++p)
      now.goals[p] =
        std::max({tolerance * scales[p],
                  absolute_tolerance,
                  scales_at_start.empty() ? 0. : cancelled * scales_at_start[p],
                  rounding * now.goals[p]});
    // A part without forces as yet; what meets it now comes from the others.
    const double largest =
      *std::max_element(now.goals.begin(), now.goals.end());
    for (double &goal : now.goals)
      if (goal == 0.)
        goal = largest;
  }



  bool
  ResidualMeasure::finite() const
  {
    return std::all_of(now.norms.begin(), now.norms.end(), [](const double n) {
      return std::isfinite(n);
    });
  }



  double
  ResidualMeasure::distance() const
  {
    return distance_of(now.norms, now.goals);
  }



  bool
  ResidualMeasure::much_is_forgiven() const
  {
    for (unsigned int p = 0; p < now.norms.size(); ++p)
      if (now.norms[p] > absolute_tolerance &&
          now.norms[p] > std::max(forgiven, tolerance) * scales[p] &&
          now.norms[p] < without_forces * scales[p])
        return true;
    return false;
  }



  double
  ResidualMeasure::ratio_to(const ResidualParts &before) const
  {
    std::vector<double> goals(now.goals);
    for (unsigned int p = 0; p < goals.size(); ++p)
      goals[p] = std::max(goals[p], before.goals[p]);
    return distance_of(now.norms, goals) / distance_of(before.norms, goals);
  }



  double
  ResidualMeasure::relative() const
  {
    double sum = 0.;
    for (unsigned int p = 0; p < now.norms.size(); ++p)
      sum += std::pow(relative_to(now.norms[p], scales[p]), 2);
    return std::sqrt(sum);
  }



  const LA::Vector *
  ResidualMeasure::weights()
  {
    if (now.goals.size() == 1)
      return nullptr;
    const auto &part = system.part_of_unknown();
    weight.reinit(system.residual(), true);
    double *values = weight.trilinos_vector()[0];
    for (unsigned int k = 0; k < weight.locally_owned_size(); ++k)
      values[k] = 1. / now.goals[part[k]];
    return &weight;
  }
} // namespace moraine
