// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/material/undrained.h>

#include <moraine/core/exceptions.h>
#include <moraine/core/patterns.h>
#include <moraine/core/words.h>
#include <moraine/material/elastic_state.h>
#include <moraine/material/material_input.h>

#include <algorithm>
#include <cmath>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    double
    volume_of(const Tensor<1, 3> &strain)
    {
      return strain[0] + strain[1] + strain[2];
    }
  } // namespace



  Undrained::Undrained(const std::shared_ptr<const Material> &inner,
                       const PoreWaterParameters             &parameters)
    : MaterialDecorator(inner)
    , parameters(parameters)
    , has_one_modulus(
        parameters.modulus > 0 ||
        (inner->has_uniform_stiffness() && inner->has_linear_elasticity()))
    , modulus(modulus_of(inner->elastic_stiffness()))
    , pressure(inner->internal_variables().size())
    , volume(pressure + 1)
    , cavities(pressure + 2)
    , kept_modulus(parameters.has_limit() ? cavities + 1 : cavities)
  {}



  double
  Undrained::modulus_of(const LameConstants &C) const
  {
    if (parameters.modulus > 0)
      return parameters.modulus;
    const double nu = parameters.poisson_ratio;
    return 2. / 3. * C.mu * (1 + nu) / (1 - 2 * nu) -
           (C.lambda + 2. / 3. * C.mu);
  }



  double
  Undrained::modulus_at(const double *internal) const
  {
    return has_one_modulus ? modulus : internal[kept_modulus];
  }



  std::vector<InternalVariable>
  Undrained::internal_variables() const
  {
    std::vector<InternalVariable> variables = inner->internal_variables();
    variables.push_back({"excess_pressure", "stress"});
    variables.push_back({"elastic_volume_strain", "-"});
    if (parameters.has_limit())
      variables.push_back({"cavity_strain", "-"});
    if (!has_one_modulus)
      variables.push_back({"water_modulus", "stress", modulus});
    return variables;
  }



  LameConstants
  Undrained::elastic_stiffness() const
  {
    const LameConstants C = inner->elastic_stiffness();
    return {C.lambda + modulus, C.mu};
  }



  LameConstants
  Undrained::elastic_stiffness_at(const double *internal) const
  {
    const LameConstants C = inner->elastic_stiffness_at(internal);
    return {C.lambda + modulus_at(internal), C.mu};
  }



  SymmetricTensor<2, 3>
  Undrained::elastic_strain_of(const SymmetricTensor<2, 3> &stress,
                               const double                *internal) const
  {
    return inner->elastic_strain_of(stress + internal[pressure] *
                                               unit_symmetric_tensor<3>(),
                                    internal);
  }



  void
  Undrained::initialise(const SymmetricTensor<2, 3> &stress,
                        const unsigned int           vertical,
                        double                      *internal) const
  {
    inner->initialise(stress, vertical, internal);
    internal[pressure]       = 0;
    const auto         large = eigenvalues(stress);
    const ElasticState at =
      elastic_state(*inner,
                    Tensor<1, 3>({large[0], large[1], large[2]}),
                    std::vector<double>(internal, internal + pressure));
    internal[volume] = volume_of(at.strain);
    if (parameters.has_limit())
      internal[cavities] = 0;
    if (has_one_modulus)
      return;
    const LameConstants C  = inner->elastic_stiffness_at(internal);
    internal[kept_modulus] = modulus_of(C);
    if (!(internal[kept_modulus] > 0))
      reject(parameters.section,
             "Undrained Poisson ratio",
             text_of(parameters.poisson_ratio),
             "above that of the skeleton, somewhere " +
               text_of(C.lambda / (2 * (C.lambda + C.mu))));
  }



  Undrained::Change
  Undrained::change_in(const StepTime &time) const
  {
    constexpr double round_off = 1e-10;
    const double     middle    = 0.5 * (time.start + time.end);
    for (const DrainedSpan &span : parameters.drained)
      if (middle > span.start && middle < span.end)
        {
          const double rest = span.released - time.end;
          return {false,
                  rest <= round_off * (span.released - span.start) ?
                    0. :
                    rest / (span.released - time.start)};
        }
    return {!(middle > parameters.frozen_from), 1.};
  }



  void
  Undrained::respond(const StepTime                  &time,
                     const ArrayView<PrincipalState> &points) const
  {
    // The skeleton takes the trial strains away; until then their part of this
    // step waits in place of the elastic volume.
    for (PrincipalState &point : points)
      point.internal[volume] = volume_of(point.strain) - point.internal[volume];
    inner->respond(time, points);
    const Change change    = change_in(time);
    const bool   has_limit = parameters.has_limit();
    for (PrincipalState &point : points)
      {
        double      *internal = point.internal;
        const double K        = modulus_at(internal);
        double       slope    = 0;
        double       p        = change.share * internal[pressure];
        if (change.is_free)
          {
            const double open = has_limit ? internal[cavities] : 0.;
            p = internal[pressure] - K * (internal[volume] + open);
            if (p >= -parameters.suction)
              slope = K;
            if (has_limit)
              internal[cavities] = std::max(0., -(p + parameters.suction) / K);
            p = std::max(p, -parameters.suction);
          }
        else if (has_limit)
          internal[cavities] *= change.share;
        internal[pressure] = p;
        internal[volume]   = volume_of(point.strain);
        for (unsigned int A = 0; A < 3; ++A)
          {
            point.stress[A] -= p;
            for (unsigned int B = 0; B < 3; ++B)
              point.tangent[A][B] += slope;
          }
      }
  }



  double
  Undrained::strain_of_water(const double *internal) const
  {
    return (parameters.has_limit() ? internal[cavities] : 0.) -
           internal[pressure] / modulus_at(internal);
  }



  void
  Undrained::stored_energies(const ArrayView<const ElasticPoint> &points,
                             const ArrayView<double> &energies) const
  {
    inner->stored_energies(points, energies);
    for (unsigned int i = 0; i < energies.size(); ++i)
      {
        const double *internal = points[i].internal;
        const double  p        = internal[pressure];
        energies[i] += 0.5 * p * p / modulus_at(internal);
        if (parameters.has_limit())
          energies[i] += parameters.suction * internal[cavities];
      }
  }



  double
  Undrained::dissipated_by_water(const double        trial_volume,
                                 const ElasticPoint &at_end,
                                 const double       *at_start) const
  {
    const double plastic = trial_volume - volume_of(at_end.strain);
    const double flown   = trial_volume - at_start[volume] -
                         strain_of_water(at_end.internal) +
                         strain_of_water(at_start);
    return 0.5 * (at_start[pressure] + at_end.internal[pressure]) *
           (plastic - flown);
  }



  std::shared_ptr<const Material>
  Undrained::with_strength_over(const double factor) const
  {
    const auto weaker = inner->with_strength_over(factor);
    if (!weaker)
      return nullptr;
    return std::make_shared<Undrained>(weaker, parameters);
  }



  std::shared_ptr<const Material>
  Undrained::with_frozen_water(const double from) const
  {
    PoreWaterParameters frozen = parameters;
    frozen.frozen_from         = from;
    return std::make_shared<Undrained>(inner, frozen);
  }



  const std::vector<MaterialKey> &
  drainage_keys()
  {
    static const std::vector<MaterialKey> keys{
      {"Drainage",
       "drained: water flows at once, and its pressure stays as given. "
       "undrained: it cannot flow, and has an excess pressure by the change of "
       "volume; stiffness and strength of the model are those of effective "
       "stress. Key 'Drained' of a stage lets it flow.",
       "drained",
       patterns::selection({"drained", "undrained"})},
      {"Undrained Poisson ratio",
       "With 'Drainage = undrained': Poisson's ratio of skeleton and water, "
       "above that of the skeleton and below 0.5, which makes water as stiff as "
       "it needs; 0.495 if left out."},
      {"Bulk modulus of water",
       "With 'Drainage = undrained', in place of 'Undrained Poisson ratio': "
       "bulk modulus of the water, with what air it holds (stress)."},
      {"Porosity",
       "With 'Bulk modulus of water': volume of pores over the whole, between "
       "0 and 1."},
      {"Cavitation suction",
       "With 'Drainage = undrained': the excess pressure falls no further below "
       "zero than by this, as water cavitates (stress); no limit if left out."}};
    return keys;
  }



  namespace
  {
    PoreWaterParameters
    read_water(const MaterialInput &input, const LameConstants &C)
    {
      const std::string   ratio = "Undrained Poisson ratio";
      const std::string   bulk  = "Bulk modulus of water";
      const NumberRange   positive{0.};
      PoreWaterParameters result;
      result.section  = input.section;
      result.drained  = input.place.drained;
      const double nu = C.lambda / (2 * (C.lambda + C.mu));
      if (input.has(bulk) && input.has(ratio))
        input.refuse(ratio, "nothing beside '" + bulk + "'");
      if (input.has("Porosity") && !input.has(bulk))
        input.refuse("Porosity", "nothing without '" + bulk + "'");
      if (input.has(bulk) && !input.has("Porosity"))
        input.refuse(bulk, "nothing without 'Porosity'");
      if (input.has(bulk))
        result.modulus =
          input.number(bulk, positive) / input.number("Porosity", {0., 1.});
      else if (input.has(ratio))
        result.poisson_ratio = input.number(ratio, {-1., 0.5});
      if (!input.has(bulk) && result.poisson_ratio <= nu)
        reject(input.section,
               ratio,
               text_of(result.poisson_ratio),
               "a number > " + text_of(nu) +
                 ", that of the skeleton, and < 0.5");
      if (input.has("Cavitation suction"))
        result.suction =
          input.number("Cavitation suction",
                       {0., std::numeric_limits<double>::infinity(), true});
      return result;
    }
  } // namespace



  std::shared_ptr<const Material>
  with_drainage(const std::shared_ptr<const Material> &material,
                const MaterialInput                   &input)
  {
    if (input.text("Drainage") == "undrained")
      return std::make_shared<Undrained>(
        material, read_water(input, material->elastic_stiffness()));
    for (const MaterialKey &key : drainage_keys())
      if (key.name != "Drainage" && input.has(key.name))
        input.refuse(key.name, "nothing; 'Drainage' is 'drained'");
    return material;
  }
} // namespace moraine
