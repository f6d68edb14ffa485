// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/material/von_mises.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /**
     * A stress that exceeds the yield radius by less than this fraction is
     * elastic. So a point that yielded and rests has the elastic tangent
     * whatever round-off did to its strain.
     */
    constexpr double yield_tolerance = 1e-12;
  } // namespace



  VonMises::VonMises(const double                                  E,
                     const double                                  nu,
                     const double                                  rho,
                     const std::vector<std::pair<double, double>> &yield_radius)
    : IsotropicMaterial(E, nu, rho)
  {
    Assert(!yield_radius.empty() && yield_radius.front().first == 0,
           ExcMessage("The yield radius is not given from kappa = 0 on."));
    for (std::size_t i = 0; i < yield_radius.size(); ++i)
      {
        const auto &[kappa, radius] = yield_radius[i];
        double slope                = 0;
        if (i + 1 < yield_radius.size())
          slope = (yield_radius[i + 1].second - radius) /
                  (yield_radius[i + 1].first - kappa);
        segments.push_back({kappa, radius, slope});
      }
  }



  std::shared_ptr<const Material>
  VonMises::with_strength_over(const double factor) const
  {
    auto weaker = std::make_shared<VonMises>(*this);
    for (Segment &segment : weaker->segments)
      {
        segment.radius /= factor;
        segment.slope /= factor;
      }
    return weaker;
  }



  std::vector<VonMises::Segment>::const_iterator
  VonMises::segment_at(const double kappa) const
  {
    const auto next = std::upper_bound(segments.begin() + 1,
                                       segments.end(),
                                       kappa,
                                       [](const double k, const Segment &s) {
                                         return k < s.kappa;
                                       });
    return next - 1;
  }



  std::vector<VonMises::Segment>::const_iterator
  VonMises::find_return(const double trial_radius, double &kappa) const
  {
    auto   segment = segment_at(kappa);
    double excess  = trial_radius - yield_radius(kappa);
    while (true)
      {
        const double decrease = std::sqrt(6.) * stiffness.mu + segment->slope;
        if (!(decrease > 0))
          {
            kappa = std::numeric_limits<double>::quiet_NaN();
            return segment;
          }
        const double end  = kappa + excess / decrease;
        const auto   next = segment + 1;
        if (next == segments.end() || end < next->kappa)
          {
            kappa = end;
            return segment;
          }
        excess -= decrease * (next->kappa - kappa);
        kappa   = next->kappa;
        segment = next;
      }
  }



  void
  VonMises::respond(const StepTime &,
                    const ArrayView<PrincipalState> &points) const
  {
    const double G = stiffness.mu;
    const double K = stiffness.lambda + 2. / 3. * G;
    for (PrincipalState &point : points)
      {
        const double volumetric =
          point.strain[0] + point.strain[1] + point.strain[2];
        Tensor<1, 3> s;
        for (unsigned int A = 0; A < 3; ++A)
          s[A] = 2 * G * (point.strain[A] - volumetric / 3);

        double      &kappa        = point.internal[0];
        const double trial_radius = s.norm();
        double       theta = 1, along_flow = 1;
        Tensor<1, 3> n;
        if (!(trial_radius <= (1 + yield_tolerance) * yield_radius(kappa)))
          {
            const auto segment = find_return(trial_radius, kappa);
            // nan if there is no return, and so all that follows.
            const double radius =
              segment->radius + segment->slope * (kappa - segment->kappa);
            const double H = std::sqrt(1.5) * segment->slope;
            n              = s / trial_radius;
            theta          = radius / trial_radius;
            along_flow     = H / (3 * G + H);
            s *= theta;
            for (unsigned int A = 0; A < 3; ++A)
              point.strain[A] = s[A] / (2 * G) + volumetric / 3;
          }

        for (unsigned int A = 0; A < 3; ++A)
          {
            point.stress[A] = s[A] + K * volumetric;
            for (unsigned int B = 0; B < 3; ++B)
              point.tangent[A][B] =
                K + 2 * G *
                      (theta * ((A == B ? 1. : 0.) - 1. / 3.) +
                       (along_flow - theta) * n[A] * n[B]);
          }
      }
  }
} // namespace moraine
