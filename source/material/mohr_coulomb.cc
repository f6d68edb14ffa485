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
    if (is_constant())
      constant =
        MohrCoulombReturn(strengths.at(0, 0, nullptr).value, stiffness);
  }



  std::shared_ptr<const Material>
  MohrCoulomb::with_strength_over(const double factor) const
  {
    auto weaker       = std::make_shared<MohrCoulomb>(*this);
    weaker->strengths = strengths.over(factor);
    if (is_constant())
      weaker->constant =
        MohrCoulombReturn(weaker->strengths.at(0, 0, nullptr).value, stiffness);
    return weaker;
  }



  double
  MohrCoulomb::yield_function(const Tensor<1, 3> &stress,
                              const double       *internal) const
  {
    const double largest = largest_of(stress), least = least_of(stress);
    const auto   strength =
      strength_at(internal, strengths.segment_at(internal[0])).value;
    return MohrCoulombReturn::yield_function(strength, largest, least);
  }



  SoilReturn
  MohrCoulomb::return_to(const SoilStrengthTables::Row &strength,
                         const LameConstants           &C,
                         const Tensor<1, 3>            &trial_strain) const
  {
    const Tensor<1, 3> trial = principal_stress(C, trial_strain);
    SoilReturn         answer;
    answer.stress  = trial;
    answer.tangent = principal_tangent(C);
    answer.elastic = trial_strain;
    answer.yields =
      !(MohrCoulombReturn::yield_function(strength.value, trial[0], trial[2]) <=
        yield_round_off(C, trial_strain, strength.value.cohesion));
    if (!answer.yields)
      return answer;
    const MohrCoulombReturn planes(strength.value, C);
    const auto              region = planes.project(answer.stress);
    answer.tangent                 = planes.tangent(region);
    answer.slope =
      planes.derivative(region, trial, answer.stress, strength.slope);
    answer.split(C, trial_strain);
    return answer;
  }



  SoilReturn
  MohrCoulomb::return_with_dilation(SoilStrengthTables::Row strength,
                                    const LameConstants    &C,
                                    const Tensor<1, 3>     &trial_strain,
                                    const double            dilation) const
  {
    const double left  = largest_dilation - dilation;
    const bool   ended = !(left > 1e-12 * largest_dilation);
    SoilReturn   answer;
    double       f_high = 0;
    if (!ended)
      {
        answer = return_to(strength, C, trial_strain);
        f_high = sum(answer.plastic) - left;
        if (!answer.yields || f_high <= 0)
          return answer;
      }
    const double most      = strength.value.sin_psi;
    strength.slope.sin_psi = 0;
    strength.value.sin_psi = 0;
    answer                 = return_to(strength, C, trial_strain);
    const double f_low     = sum(answer.plastic) - left;
    if (ended || f_low >= 0)
      return answer;

    // The volumetric plastic strain at an angle in between, and its derivative
    const double K_3 = 3 * C.lambda + 2 * C.mu;
    Tensor<1, 3> slope;
    const auto   excess = [&](const double sin_psi) {
      strength.value.sin_psi      = sin_psi;
      SoilStrengthTables::Row row = strength;
      row.slope                   = SoilStrength();
      row.slope.sin_psi           = 1;
      slope                       = return_to(row, C, trial_strain).slope;
      answer                      = return_to(strength, C, trial_strain);
      const double f              = sum(answer.plastic) - left;
      return Residual{std::abs(f) <= 1e-15 * (left + trial_strain.norm()) ? 0. :
                                                                              f,
                      -sum(slope) / K_3};
    };
    excess(zero_between(excess, 0, f_low, most, f_high));
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
    const LameConstants C     = stiffness_at(internal);
    double              kappa = internal[0];
    const auto          give = [&](const double k, const unsigned int segment) {
      internal[0]         = k;
      const auto strength = strength_at(internal, segment);
      return dilation_ends() ?
                        return_with_dilation(strength, C, trial_strain, internal[1]) :
                        return_to(strength, C, trial_strain);
    };
    const SoilReturn answer = close_return(strengths, C, give, kappa);
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
        f <= yield_round_off(stiffness, strain, constant.cohesion_term()))
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
    const bool simple = is_constant() && !dilation_ends();
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



  MaterialModel
  mohr_coulomb_model()
  {
    std::vector<MaterialKey> keys = soil_keys();
    keys.push_back({"Tensile strength",
                    "The largest principal stress (stress): a number up to c "
                    "cot(phi), an expression in x, y, z, or a table over the "
                    "accumulated plastic strain. none: no limit beside the "
                    "apex.",
                    "0"});
    keys.push_back({"Largest plastic dilation",
                    "The volumetric plastic strain from which on the dilation "
                    "angle is 0. Empty: dilation does not end."});
    return {"Mohr-Coulomb",
            "linear elastic up to the friction law |tau| = c - sigma tan(phi) "
            "on any plane and a limit of tension, then plastic with the "
            "dilation angle",
            keys,
            [](MaterialInput &input) {
              return std::make_shared<MohrCoulomb>(
                read_soil(input, /* has_tension = */ true));
            }};
  }



  MaterialModel
  tresca_model()
  {
    return {"Tresca",
            "linear elastic up to the largest shear stress s_u, then plastic "
            "at constant volume: Mohr-Coulomb without friction and without a "
            "limit of tension, for undrained clay",
            undrained_keys(),
            [](MaterialInput &input) {
              return std::make_shared<MohrCoulomb>(read_undrained(input));
            }};
  }
} // namespace moraine
