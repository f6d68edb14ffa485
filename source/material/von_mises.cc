// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/material/von_mises.h>

#include <moraine/core/words.h>

#include <algorithm>
#include <array>
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

    /** One of the ways to give the yield stress. */
    struct YieldKey
    {
      const char *name;
      double      radius_factor; ///< ||s|| over the value of the key
      const char *meaning;
    };

    const std::array<YieldKey, 3> yield_keys{
      {{"Uniaxial yield stress",
        std::sqrt(2. / 3.),
        "the yield stress sigma_y in uniaxial tension. The yield radius is "
        "||s|| = sqrt(2/3) sigma_y"},
       {"Shear yield stress",
        std::sqrt(2.),
        "the yield stress k in shear. The yield radius is ||s|| = sqrt(2) k, "
        "and sigma_y = sqrt(3) k"},
       {"Yield radius",
        1.,
        "||s|| = sqrt(2 J2) at yield, with the deviator s of the stress. It "
        "is sqrt(2/3) sigma_y and sqrt(2) k"}}};



    /** The key that gives the yield stress. @throw InputError if it is not
     * exactly one. */
    const YieldKey &
    given_yield_key(const MaterialInput &input)
    {
      const YieldKey *given = nullptr;
      for (const YieldKey &key : yield_keys)
        if (input.has(key.name))
          {
            if (given)
              input.refuse(key.name,
                           std::string("nothing; '") + given->name +
                             "' gives the yield stress");
            given = &key;
          }
      if (!given)
        input.refuse(yield_keys[0].name,
                     std::string("a yield stress > 0, in this key, in '") +
                       yield_keys[1].name + "' or in '" + yield_keys[2].name +
                       "'");
      return *given;
    }



    /** Pairs of accumulated plastic strain and yield radius, from @p key.
     * @throw InputError for what cannot be a yield stress, or falls so steeply
     * that no stress returns to it. */
    std::vector<LinearTable::Row>
    read_yield_radius(MaterialInput             &input,
                      const YieldKey            &key,
                      const IsotropicElasticity &elasticity)
    {
      std::vector<LinearTable::Row> rows = input.table(key.name);
      const double G = lame_constants(elasticity.young_modulus.nominal(),
                                      elasticity.poisson_ratio.nominal())
                         .mu;
      const double steepest     = -std::sqrt(6.) * G / key.radius_factor;
      const bool   is_stretched = input.number("Softening length") > 0;
      for (std::size_t i = 0; i < rows.size(); ++i)
        {
          if (!(rows[i].second > 0))
            input.refuse(key.name, "yield stresses > 0");
          if (i == 0)
            continue;
          const double slope = (rows[i].second - rows[i - 1].second) /
                               (rows[i].first - rows[i - 1].first);
          // Unknown before the cells are, if they stretch it.
          if ((!is_stretched || input.place.cell_size > 0) &&
              !elasticity.young_modulus.is_field() &&
              !elasticity.poisson_ratio.is_field() && !(slope > steepest))
            input.refuse(key.name,
                         "a slope above " + text_of(steepest) +
                           ", where sigma_y falls by 3G; between kappa = " +
                           text_of(rows[i - 1].first) + " and " +
                           text_of(rows[i].first) + " it is " + text_of(slope) +
                           (is_stretched ?
                              ", by 'Softening length' in cells of " +
                                text_of(input.place.cell_size) +
                                "; smaller ones soften less" :
                              ""));
        }
      for (LinearTable::Row &row : rows)
        row.second *= key.radius_factor;
      return rows;
    }
  } // namespace



  VonMises::VonMises(const double                                  E,
                     const double                                  nu,
                     const double                                  rho,
                     const std::vector<std::pair<double, double>> &yield_radius)
    : VonMises(IsotropicElasticity{E, nu, rho}, yield_radius)
  {}



  VonMises::VonMises(const IsotropicElasticity                    &elasticity,
                     const std::vector<std::pair<double, double>> &yield_radius,
                     const Parameter                              &scale)
    : IsotropicMaterial(elasticity, {{"plastic_strain", "-"}})
    , scale(scale)
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
  VonMises::find_return(const double trial_radius,
                        const double G,
                        double      &kappa) const
  {
    auto   segment = segment_at(kappa);
    double excess  = trial_radius - yield_radius(kappa);
    while (true)
      {
        const double decrease = std::sqrt(6.) * G + segment->slope;
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
    for (PrincipalState &point : points)
      {
        const auto [lambda, G] = stiffness_at(point.internal);
        const double K         = lambda + 2. / 3. * G;
        const double unit      = scale.at(point.internal + n_history);
        const double volumetric =
          point.strain[0] + point.strain[1] + point.strain[2];
        Tensor<1, 3> s;
        for (unsigned int A = 0; A < 3; ++A)
          s[A] = 2 * G * (point.strain[A] - volumetric / 3);

        double      &kappa        = point.internal[0];
        const double trial_radius = s.norm() / unit;
        double       theta = 1, along_flow = 1;
        Tensor<1, 3> n;
        if (!(trial_radius <= (1 + yield_tolerance) * yield_radius(kappa)))
          {
            const auto segment = find_return(trial_radius, G / unit, kappa);
            // nan if there is no return, and so all that follows.
            const double radius =
              segment->radius + segment->slope * (kappa - segment->kappa);
            const double H = std::sqrt(1.5) * unit * segment->slope;
            n              = s / (unit * trial_radius);
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



  namespace
  {
    std::vector<MaterialKey>
    keys_of_von_mises()
    {
      std::vector<MaterialKey> keys = elastic_keys();
      for (const YieldKey &key : yield_keys)
        keys.push_back(
          {key.name,
           std::string(
             "One of three ways to give the yield stress of von Mises "
             "(stress): ") +
             key.meaning +
             ". A number, an expression in x, y, z, or a table 'kappa: value, "
             "kappa: value, ...' over the plastic strain kappa of uniaxial "
             "tension, from 0 on."});
      keys.push_back(softening_key());
      return keys;
    }



    std::shared_ptr<const Material>
    make_von_mises(MaterialInput &input)
    {
      IsotropicElasticity elasticity = read_elasticity(input);
      const YieldKey     &key        = given_yield_key(input);
      if (input.is_table(key.name))
        {
          const auto rows = read_yield_radius(input, key, elasticity);
          input.check_softening_length();
          return std::make_shared<VonMises>(elasticity, rows);
        }
      const Parameter yield_stress = input.parameter(key.name, {0.}, "stress");
      input.check_softening_length();
      elasticity.fields = input.fields();
      if (!yield_stress.is_field())
        return std::make_shared<VonMises>(
          elasticity,
          std::vector<LinearTable::Row>{
            {0., key.radius_factor * yield_stress.nominal()}});
      return std::make_shared<VonMises>(elasticity,
                                        std::vector<LinearTable::Row>{{0., 1.}},
                                        yield_stress * key.radius_factor);
    }
  } // namespace



  MaterialModel
  von_mises_model()
  {
    return {"von Mises",
            "linear elastic up to a yield stress, then plastic with associated "
            "flow, and hardening or softening if the yield stress is a table. "
            "The stress that yields is Kirchhoff's at finite strain",
            keys_of_von_mises(),
            make_von_mises};
  }
} // namespace moraine
