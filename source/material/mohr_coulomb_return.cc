// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/material/mohr_coulomb_return.h>

#include <algorithm>
#include <limits>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** A sign is wrong beyond this fraction of the trial stress. */
    constexpr double sign_tolerance = 1e-12;

    double
    size_of(const Tensor<1, 3> &stress)
    {
      return std::max(std::abs(stress[0]), std::abs(stress[2]));
    }
  } // namespace



  MohrCoulombReturn::MohrCoulombReturn(const SoilStrength  &strength,
                                       const LameConstants &C)
    : C(C)
    , strength(strength)
  {
    const double s = strength.sin_phi, t = strength.sin_psi;
    cohesion    = 2 * strength.cohesion * strength.cos_phi;
    along_plane = {{1 + s, 1 - s}};
    const double apex =
      s > 0 ? cohesion / (2 * s) : std::numeric_limits<double>::infinity();
    cut_off = strength.tension < apex;
    limit   = std::min(strength.tension, apex);
    corner  = cut_off ? ((1 + s) * limit - cohesion) / (1 - s) : limit;

    const auto stress_of = [&](const double x, const double y, const double z) {
      return principal_stress(C, Tensor<1, 3>({x, y, z}));
    };
    planes = {
      {{Tensor<1, 3>({1 + s, 0, s - 1}), stress_of(1 + t, 0, t - 1), cohesion},
       {Tensor<1, 3>({0, 1 + s, s - 1}), stress_of(0, 1 + t, t - 1), cohesion},
       {Tensor<1, 3>({1 + s, s - 1, 0}), stress_of(1 + t, t - 1, 0), cohesion},
       {Tensor<1, 3>({1, 0, 0}), stress_of(1, 0, 0), limit},
       {Tensor<1, 3>({0, 1, 0}), stress_of(0, 1, 0), limit}}};

    const Tensor<2, 3> D({{C.lambda + 2 * C.mu, C.lambda, C.lambda},
                          {C.lambda, C.lambda + 2 * C.mu, C.lambda},
                          {C.lambda, C.lambda, C.lambda + 2 * C.mu}});
    tangents[n_regions]                  = D;
    const unsigned int all[n_regions][3] = {{1, 0, 0},
                                            {2, 0, 1},
                                            {0, 0, 0},
                                            {2, 3, 4},
                                            {0, 0, 0},
                                            {1, 3, 3},
                                            {2, 3, 0},
                                            {0, 0, 0},
                                            {2, 0, 2}};
    for (unsigned int i = 0; i < n_regions; ++i)
      {
        const unsigned int n = all[i][0];
        active[i].n_planes   = n;
        active[i].planes     = {{all[i][1], all[i][2]}};
        if (n == 0)
          continue;
        const Plane &a = planes[all[i][1]], &b = planes[all[i][2]];
        if (n == 1)
          active[i].inverse[0][0] = 1 / (a.normal * a.stress);
        else
          active[i].inverse =
            invert(Tensor<2, 2>({{a.normal * a.stress, a.normal * b.stress},
                                 {b.normal * a.stress, b.normal * b.stress}}));
        tangents[i] = D;
        for (unsigned int p = 0; p < n; ++p)
          for (unsigned int q = 0; q < n; ++q)
            tangents[i] -= active[i].inverse[p][q] *
                           outer_product(planes[all[i][1 + p]].stress,
                                         planes[all[i][1 + q]].normal * D);
      }
  }



  inline Tensor<1, 2>
  MohrCoulombReturn::subtract(const ActivePlanes &active,
                              Tensor<1, 3>       &stress) const
  {
    const Plane &a = planes[active.planes[0]], &b = planes[active.planes[1]];
    const auto  &M = active.inverse;
    double       f = -a.strength, g = -b.strength;
    for (unsigned int A = 0; A < 3; ++A)
      {
        f += a.normal[A] * stress[A];
        g += b.normal[A] * stress[A];
      }
    // With one plane the rest of the inverse is 0.
    Tensor<1, 2> multipliers;
    multipliers[0] = M[0][0] * f + M[0][1] * g;
    multipliers[1] = M[1][0] * f + M[1][1] * g;
    for (unsigned int A = 0; A < 3; ++A)
      stress[A] -= multipliers[0] * a.stress[A] + multipliers[1] * b.stress[A];
    return multipliers;
  }



  inline double
  MohrCoulombReturn::violation(const Region        region,
                               const Tensor<1, 3> &trial,
                               Tensor<1, 3>       &stress) const
  {
    if (active[region].n_planes > 0)
      {
        stress                         = trial;
        const Tensor<1, 2> multipliers = subtract(active[region], stress);
        return std::max(std::max(yield_function(stress[0], stress[2]),
                                 -2 * C.mu *
                                   std::min(multipliers[0], multipliers[1])),
                        std::max(stress[1] - stress[0], stress[2] - stress[1]));
      }
    stress = Tensor<1, 3>({limit,
                           region == corner_23 ? corner : limit,
                           region == vertex ? limit : corner});
    return violation_at_point(region, trial, stress);
  }



  inline double
  MohrCoulombReturn::violation_at_point(const Region        region,
                                        const Tensor<1, 3> &trial,
                                        const Tensor<1, 3> &stress) const
  {
    const Tensor<1, 3> e = 2 * C.mu * principal_strain(C, trial - stress);
    const double       t = strength.sin_psi;
    // Inside of the flows of f_13 and f_23, and of f_13 and f_12.
    const double in_12 = (1 - t) * (e[0] + e[1]) + (1 + t) * e[2];
    const double in_23 = (1 - t) * e[0] + (1 + t) * (e[1] + e[2]);
    switch (region)
      {
        case corner_12:
          return -std::min(std::min(e[0], e[1]), std::min(-e[2], in_12));
        case corner_23:
          return -std::min(std::min(-e[1], -e[2]), in_23);
        default:
          return cut_off ? -std::min(std::min(e[0], e[1]), e[2]) :
                           -std::min(in_12, in_23);
      }
  }



  MohrCoulombReturn::Region
  MohrCoulombReturn::project(Tensor<1, 3> &stress) const
  {
    const Tensor<1, 3> trial     = stress;
    const double       size      = size_of(trial) + cohesion;
    const double       tolerance = sign_tolerance * size;

    // As in violation(), written out: it is the answer most often.
    const Plane &f = planes[plane];
    const double multiplier =
      active[plane].inverse[0][0] *
      (along_plane[0] * trial[0] - along_plane[1] * trial[2] - cohesion);
    for (unsigned int A = 0; A < 3; ++A)
      stress[A] -= multiplier * f.stress[A];
    const double beyond_12      = stress[1] - stress[0],
                 beyond_23      = stress[2] - stress[1],
                 beyond_tension = std::max(stress[0] - limit, -multiplier);
    double least = std::max(beyond_tension, std::max(beyond_12, beyond_23));
    Region found = plane;
    if (!(least <= tolerance))
      {
        // Any order would do. To save time: around, first the likely one.
        constexpr unsigned int n        = n_regions - 1;
        const bool             tensile  = cut_off && beyond_tension == least;
        const bool             forwards = !tensile && beyond_12 > beyond_23;
        for (unsigned int i = 0; i < n && !(least <= tolerance); ++i)
          {
            const unsigned int step =
              forwards ? i : (tensile ? tension_plane : edge_23) + n - 1 - i;
            const Region region = static_cast<Region>(1 + step % n);
            if (!cut_off && region > edge_12 && region < edge_23 &&
                region != vertex)
              continue;
            Tensor<1, 3> candidate;
            const double wrong = violation(region, trial, candidate);
            if (!(wrong >= least))
              {
                found  = region;
                least  = wrong;
                stress = candidate;
              }
          }
      }
    // What round-off left of a trial stress far away.
    if (active[found].n_planes > 0 && size_of(stress) < 1e-3 * size)
      subtract(active[found], stress);
    return found;
  }



  Tensor<1, 3>
  MohrCoulombReturn::derivative(const Region        region,
                                const Tensor<1, 3> &trial,
                                const Tensor<1, 3> &stress,
                                const SoilStrength &change) const
  {
    const double s = strength.sin_phi, ds = change.sin_phi;
    const double dk = 2 * (change.cohesion * strength.cos_phi +
                           strength.cohesion * change.cos_phi);
    if (active[region].n_planes == 0)
      {
        const double d_limit =
          cut_off ? change.tension : (dk - 2 * limit * ds) / (2 * s);
        const double d_corner =
          ((1 + s) * d_limit + (limit + corner) * ds - dk) / (1 - s);
        return Tensor<1, 3>({d_limit,
                             region == corner_23 ? d_corner : d_limit,
                             region == vertex ? d_limit : d_corner});
      }

    // F ds = dh - dF s, where ds = -D (dG^T lambda + G^T d lambda).
    Tensor<1, 3>       again  = trial;
    const Tensor<1, 2> lambda = subtract(active[region], again);
    const auto         ones   = [&](const unsigned int plane) {
      return plane == 0 ? Tensor<1, 3>({1, 0, 1}) :
                       plane == 1 ? Tensor<1, 3>({0, 1, 1}) :
                       plane == 2 ? Tensor<1, 3>({1, 1, 0}) :
                                    Tensor<1, 3>();
    };
    const auto  &r = active[region];
    Tensor<1, 3> result;
    for (unsigned int p = 0; p < r.n_planes; ++p)
      result -=
        lambda[p] * change.sin_psi * principal_stress(C, ones(r.planes[p]));
    Tensor<1, 2> rest;
    for (unsigned int p = 0; p < r.n_planes; ++p)
      rest[p] = (r.planes[p] < 3 ? dk : change.tension) -
                ds * (ones(r.planes[p]) * stress) -
                planes[r.planes[p]].normal * result;
    rest = r.inverse * rest;
    for (unsigned int p = 0; p < r.n_planes; ++p)
      result += rest[p] * planes[r.planes[p]].stress;
    return result;
  }
} // namespace moraine
