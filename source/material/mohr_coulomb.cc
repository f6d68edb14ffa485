// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/material/mohr_coulomb.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    double
    sum(const Tensor<1, 3> &a)
    {
      return a[0] + a[1] + a[2];
    }



    /** nan if the first is. */
    double
    largest_of(const Tensor<1, 3> &a)
    {
      return std::max(std::max(a[0], a[1]), a[2]);
    }



    double
    least_of(const Tensor<1, 3> &a)
    {
      return std::min(std::min(a[0], a[1]), a[2]);
    }



    using Order = std::array<unsigned int, 3>;

    /** Indices of the values from the largest to the least; of any values if
     * some are nan. */
    Order
    descending(const Tensor<1, 3> &a)
    {
      // Ranks without branches, which would be foreseen badly.
      const unsigned int a_b = a[0] < a[1], a_c = a[0] < a[2],
                         b_c = a[1] < a[2];
      Order order{{0, 1, 2}};
      order[a_b + a_c]     = 0;
      order[1 - a_b + b_c] = 1;
      order[2 - a_c - b_c] = 2;
      return order;
    }



    Tensor<1, 3>
    permuted(const Tensor<1, 3> &a, const Order &order)
    {
      return Tensor<1, 3>({a[order[0]], a[order[1]], a[order[2]]});
    }



    /** Write the answer to sorted strains. */
    void
    put(const Tensor<1, 3> &stress,
        const Tensor<2, 3> &tangent,
        const Order        &order,
        PrincipalState     &point)
    {
      for (unsigned int a = 0; a < 3; ++a)
        {
          point.stress[order[a]] = stress[a];
          for (unsigned int b = 0; b < 3; ++b)
            point.tangent[order[a]][order[b]] = tangent[a][b];
        }
    }
  } // namespace



  MohrCoulomb::MohrCoulomb(const SoilParameters &parameters)
    : SoilMaterial(parameters)
    , largest_dilation(parameters.largest_dilation)
  {
    const double at_start = 0;
    constant = MohrCoulombReturn(strength_at(&at_start, 0).value, stiffness);
  }



  std::vector<InternalVariable>
  MohrCoulomb::internal_variables() const
  {
    auto variables = SoilMaterial::internal_variables();
    if (dilation_ends())
      variables.push_back({"plastic_dilation", "-"});
    return variables;
  }



  std::shared_ptr<const Material>
  MohrCoulomb::with_strength_over(const double factor) const
  {
    auto weaker           = std::make_shared<MohrCoulomb>(*this);
    weaker->strengths     = strengths.over(factor);
    const double at_start = 0;
    const auto   strength = weaker->strength_at(&at_start, 0).value;
    weaker->constant      = MohrCoulombReturn(strength, stiffness);
    return weaker;
  }



  double
  MohrCoulomb::yield_function(const Tensor<1, 3> &stress,
                              const double       *internal) const
  {
    const double largest = largest_of(stress), least = least_of(stress);
    const auto   strength =
      strength_at(internal, strengths.segment_at(internal[0])).value;
    return MohrCoulombReturn(strength, stiffness)
      .yield_function(largest, least);
  }



  SoilReturn
  MohrCoulomb::return_to(const SoilStrengthTables::Row &strength,
                         const Tensor<1, 3>            &trial_strain) const
  {
    const MohrCoulombReturn planes(strength.value, stiffness);
    const Tensor<1, 3>      trial = principal_stress(stiffness, trial_strain);
    SoilReturn              answer;
    answer.stress  = trial;
    answer.tangent = planes.elastic_tangent();
    answer.elastic = trial_strain;
    answer.yields =
      !(planes.yield_function(trial[0], trial[2]) <=
        yield_tolerance(stiffness, trial_strain, strength.value.cohesion));
    if (!answer.yields)
      return answer;
    const auto region = planes.project(answer.stress);
    answer.tangent    = planes.tangent(region);
    answer.slope =
      planes.derivative(region, trial, answer.stress, strength.slope);
    answer.split(stiffness, trial_strain);
    return answer;
  }



  SoilReturn
  MohrCoulomb::return_with_dilation(SoilStrengthTables::Row strength,
                                    const Tensor<1, 3>     &trial_strain,
                                    const double            dilation) const
  {
    const double left = largest_dilation - dilation;
    SoilReturn   answer;
    if (left > 1e-12 * largest_dilation)
      {
        answer = return_to(strength, trial_strain);
        if (!answer.yields || sum(answer.plastic) <= left)
          return answer;
      }
    const double most      = strength.value.sin_psi;
    strength.slope.sin_psi = 0;
    const auto with        = [&](const double sin_psi) {
      strength.value.sin_psi = sin_psi;
      answer                 = return_to(strength, trial_strain);
      return sum(answer.plastic) - left;
    };
    if (with(0) >= 0 || !(left > 1e-12 * largest_dilation))
      return answer;

    // The derivative of the stress by sin(psi)
    const auto by_dilation = [&] {
      SoilStrengthTables::Row row = strength;
      row.slope                   = SoilStrength();
      row.slope.sin_psi           = 1;
      return return_to(row, trial_strain).slope;
    };
    const double K_3 = 3 * stiffness.lambda + 2 * stiffness.mu;
    double       low = 0, high = most, sin_psi = 0.5 * most;
    Tensor<1, 3> slope;
    for (unsigned int iteration = 0; iteration < 100; ++iteration)
      {
        const double excess = with(sin_psi);
        slope               = by_dilation();
        if (std::abs(excess) <= 1e-15 * (left + trial_strain.norm()) ||
            high - low <= 1e-16)
          break;
        (excess < 0 ? low : high) = sin_psi;
        sin_psi += excess * K_3 / sum(slope);
        if (!(sin_psi > low && sin_psi < high))
          sin_psi = 0.5 * (low + high);
      }
    // Keep the volumetric plastic strain: tr(d stress) = 3K tr(d strain).
    Tensor<1, 3> rate({K_3, K_3, K_3});
    for (unsigned int B = 0; B < 3; ++B)
      for (unsigned int A = 0; A < 3; ++A)
        rate[B] -= answer.tangent[A][B];
    answer.tangent += outer_product(slope, rate / sum(slope));
    answer.slope -= slope * (sum(answer.slope) / sum(slope));
    return answer;
  }



  SoilReturn
  MohrCoulomb::respond_sorted(const Tensor<1, 3> &trial_strain,
                              double             *internal) const
  {
    const double kappa_n = internal[0];
    double       kappa   = kappa_n;
    const auto   give    = [&](const double k, const unsigned int segment) {
      internal[0]         = k;
      const auto strength = strength_at(internal, segment);
      return dilation_ends() ?
                    return_with_dilation(strength, trial_strain, internal[1]) :
                    return_to(strength, trial_strain);
    };
    const SoilReturn answer = close_return(strengths, stiffness, give, kappa);
    internal[0]             = kappa;
    if (dilation_ends())
      internal[1] += sum(answer.plastic);
    return answer;
  }



  void
  MohrCoulomb::respond_constant(PrincipalState &point) const
  {
    Tensor<1, 3> &strain = point.strain;
    point.stress         = principal_stress(stiffness, strain);
    const double largest = largest_of(point.stress),
                 least   = least_of(point.stress);
    const double f       = constant.yield_function(largest, least);
    if (f <= 0 ||
        f <= yield_tolerance(stiffness, strain, constant.cohesion_term()))
      {
        point.tangent = constant.elastic_tangent();
        return;
      }
    const auto          order   = descending(strain);
    Tensor<1, 3>        stress  = permuted(point.stress, order);
    const Tensor<2, 3> &tangent = constant.tangent(constant.project(stress));
    const double        bulk_3  = 3 * stiffness.lambda + 2 * stiffness.mu;
    const double        inverse = 1 / (2 * stiffness.mu * bulk_3);
    const double        mean    = stiffness.lambda * sum(stress);
    double              square  = 0;
    // One by one: vectors that were just written would have to wait.
    for (unsigned int a = 0; a < 3; ++a)
      {
        double      &value   = strain[order[a]];
        const double elastic = inverse * (bulk_3 * stress[a] - mean);
        square += (value - elastic) * (value - elastic);
        value = elastic;
      }
    put(stress, tangent, order, point);
    point.internal[0] += std::sqrt(2. / 3. * square);
  }



  void
  MohrCoulomb::respond(const StepTime &,
                       const ArrayView<PrincipalState> &points) const
  {
    const bool simple = strengths.are_constant() && !dilation_ends();
    for (PrincipalState &point : points)
      if (simple)
        respond_constant(point);
      else
        {
          const auto       order = descending(point.strain);
          const SoilReturn answer =
            respond_sorted(permuted(point.strain, order), point.internal);
          put(answer.stress, answer.tangent, order, point);
          for (unsigned int a = 0; a < 3; ++a)
            point.strain[order[a]] = answer.elastic[a];
        }
  }
} // namespace moraine
