// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/material/drucker_prager.h>

#include <moraine/core/patterns.h>

#include <cmath>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    double
    mean_of(const Tensor<1, 3> &stress)
    {
      return (stress[0] + stress[1] + stress[2]) / 3;
    }



    /** Subtract the mean. @return @f$\sqrt{J_2}@f$ */
    double
    make_deviatoric(Tensor<1, 3> &stress)
    {
      const double mean = mean_of(stress);
      for (unsigned int A = 0; A < 3; ++A)
        stress[A] -= mean;
      return std::sqrt(0.5 * (stress * stress));
    }
  } // namespace



  DruckerPrager::DruckerPrager(const SoilParameters &parameters,
                               const Match           match)
    : SoilMaterial(parameters)
    , match(match)
  {
    if (is_constant())
      constant = cone_at(0, 0, nullptr);
  }



  std::shared_ptr<const Material>
  DruckerPrager::with_strength_over(const double factor) const
  {
    auto weaker       = std::make_shared<DruckerPrager>(*this);
    weaker->strengths = strengths.over(factor);
    if (is_constant())
      weaker->constant = weaker->cone_at(0, 0, nullptr);
    return weaker;
  }



  DruckerPrager::ChangingCone
  DruckerPrager::cone_at(const double       kappa,
                         const unsigned int segment,
                         const double      *fields) const
  {
    const auto [value, slope] = strengths.at(kappa, segment, fields);
    const double s = value.sin_phi, ds = slope.sin_phi;
    const double t = value.sin_psi, dt = slope.sin_psi;

    // eta = s / N, k = c cos(phi) / N
    ChangingCone result;
    double      &eta_bar = result.value.eta_bar;
    double      &d_bar   = result.slope.eta_bar;
    double       N, dN;
    if (match == Match::plane_strain)
      {
        const double root = std::sqrt(9 + 3 * t * t);
        eta_bar           = 3 * t / root;
        d_bar             = 27 * dt / (root * root * root);
        const double d    = std::sqrt(1 - eta_bar * eta_bar / 3);
        N                 = d + eta_bar * s / 3;
        dN = -eta_bar * d_bar / (3 * d) + (d_bar * s + eta_bar * ds) / 3;
      }
    else
      {
        eta_bar = 6 / std::sqrt(3.) * t / (3 - t);
        d_bar   = 6 / std::sqrt(3.) * 3 * dt / ((3 - t) * (3 - t));
        N       = std::sqrt(3.) / 6 * (3 - s);
        dN      = -std::sqrt(3.) / 6 * ds;
      }
    result.value.eta = s / N;
    result.slope.eta = (ds - result.value.eta * dN) / N;
    result.value.k   = value.cohesion * value.cos_phi / N;
    result.slope.k   = (slope.cohesion * value.cos_phi +
                      value.cohesion * slope.cos_phi - result.value.k * dN) /
                     N;
    return result;
  }



  double
  DruckerPrager::yield_function(const Tensor<1, 3> &stress,
                                const double       *internal) const
  {
    const Cone cone = cone_at(internal[0],
                              strengths.segment_at(internal[0]),
                              internal + n_history)
                        .value;
    Tensor<1, 3> s = stress;
    return make_deviatoric(s) + cone.eta * mean_of(stress) - cone.k;
  }



  SoilReturn
  DruckerPrager::return_to(const ChangingCone  &changing,
                           const LameConstants &C,
                           const Tensor<1, 3>  &trial_strain) const
  {
    const auto &[cone, change] = changing;
    const double G             = C.mu;
    const double K             = C.lambda + 2. / 3. * G;
    SoilReturn   answer;
    answer.stress  = principal_stress(C, trial_strain);
    answer.elastic = trial_strain;
    answer.tangent = principal_tangent(C);

    const double p = mean_of(answer.stress);
    Tensor<1, 3> m = answer.stress;
    const double q = make_deviatoric(m);
    const double f = q + cone.eta * p - cone.k;
    answer.yields  = !(f <= 0 || f <= yield_round_off(C, trial_strain, cone.k));
    if (!answer.yields)
      return answer;

    const double modulus = G + K * cone.eta * cone.eta_bar;
    const double gamma   = f / modulus;
    if (q < G * gamma)
      {
        const double apex = cone.k / cone.eta;
        const double rate = (change.k - apex * change.eta) / cone.eta;
        for (unsigned int A = 0; A < 3; ++A)
          {
            answer.stress[A] = apex;
            answer.slope[A]  = rate;
          }
        answer.tangent = 0;
        answer.split(C, trial_strain);
        return answer;
      }
    m /= q;
    const double d_gamma = (change.eta * (p - K * cone.eta_bar * gamma) -
                            K * cone.eta * change.eta_bar * gamma - change.k) /
                           modulus;
    const double along = 2 * G * G * gamma / q;
    for (unsigned int A = 0; A < 3; ++A)
      {
        const double flow = G * m[A] + K * cone.eta_bar;
        answer.stress[A] -= gamma * flow;
        answer.slope[A] = -d_gamma * flow - gamma * K * change.eta_bar;
        for (unsigned int B = 0; B < 3; ++B)
          answer.tangent[A][B] -=
            flow * (G * m[B] + K * cone.eta) / modulus +
            along * ((A == B ? 1. : 0.) - 1. / 3. - 0.5 * m[A] * m[B]);
      }
    answer.split(C, trial_strain);
    return answer;
  }



  void
  DruckerPrager::respond(const StepTime &,
                         const ArrayView<PrincipalState> &points) const
  {
    for (PrincipalState &point : points)
      {
        const LameConstants C      = stiffness_at(point.internal);
        double              kappa  = point.internal[0];
        const Tensor<1, 3> &strain = point.strain;
        const auto give = [&](const double k, const unsigned int segment) {
          return return_to(cone_at(k, segment, point.internal + n_history),
                           C,
                           strain);
        };
        SoilReturn answer;
        if (is_constant())
          {
            answer = return_to(constant, C, strain);
            if (answer.yields)
              kappa += answer.plastic_strain();
          }
        else
          answer = close_return(strengths, C, give, kappa);
        point.internal[0] = kappa;
        point.stress      = answer.stress;
        point.tangent     = answer.tangent;
        point.strain      = answer.elastic;
      }
  }



  MaterialModel
  drucker_prager_model()
  {
    std::vector<MaterialKey> keys = soil_keys();
    keys.push_back(
      {"Cone",
       "Where the cone has the strength of Mohr-Coulomb. plane strain: at "
       "collapse in plane strain. outer: in triaxial compression; in plane "
       "strain 30 degrees then act as 44 to 49.",
       "plane strain",
       patterns::selection({"plane strain", "outer"})});
    return {"Drucker-Prager",
            "linear elastic up to a cone that is matched to Mohr-Coulomb, then "
            "plastic with the dilation angle",
            keys,
            [](MaterialInput &input) {
              return std::make_shared<DruckerPrager>(
                read_soil(input, /* has_tension = */ false),
                input.text("Cone") == "outer" ?
                  DruckerPrager::Match::outer_cone :
                  DruckerPrager::Match::plane_strain);
            }};
  }
} // namespace moraine
