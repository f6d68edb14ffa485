// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/material/cam_clay.h>

#include <moraine/core/arithmetic.h>
#include <moraine/core/exceptions.h>
#include <moraine/core/patterns.h>
#include <moraine/core/words.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int most_clay_iterations = 25;
    constexpr unsigned int most_approaches      = 40;
    constexpr double       most_compression     = 40; ///< over kappa
    constexpr double       clay_tolerance       = 1e-12;

    double
    sum_of(const Tensor<1, 3> &values)
    {
      return values[0] + values[1] + values[2];
    }



    Tensor<1, 3>
    deviator_of(const Tensor<1, 3> &values)
    {
      Tensor<1, 3> result = values;
      const double mean   = sum_of(values) / 3;
      for (unsigned int A = 0; A < 3; ++A)
        result[A] -= mean;
      return result;
    }



    /** Columns and rows without their mean. */
    Tensor<2, 3>
    deviator_of(const Tensor<2, 3> &a)
    {
      Tensor<2, 3> rows;
      for (unsigned int A = 0; A < 3; ++A)
        rows[A] = deviator_of(a[A]);
      Tensor<2, 3> result = transpose(rows);
      for (unsigned int A = 0; A < 3; ++A)
        result[A] = deviator_of(result[A]);
      return transpose(result);
    }



    double
    ratio_in_compression(const double sin_phi)
    {
      return 6 * sin_phi / (3 - sin_phi);
    }
  } // namespace



  CamClay::CamClay(const CamClayParameters &parameters, const double reduction)
    : parameters(parameters)
    , reduction(reduction)
    , mean(1)
    , swing(0)
  {
    using State      = CamClayParameters::CriticalState;
    const auto state = parameters.critical_state;
    const auto ratio = [state](const double sin_phi) {
      return state == State::circle_in_plane_strain ?
               std::sqrt(3.) * sin_phi :
               ratio_in_compression(sin_phi);
    };
    const double tan_phi = std::tan(parameters.friction_angle);
    const double sin_phi = std::sin(std::atan(tan_phi / reduction));
    M_at_start           = ratio(std::sin(parameters.friction_angle));
    M_compression        = ratio(sin_phi);
    if (state == State::lode_angle)
      {
        const double fourth = std::pow((3 - sin_phi) / (3 + sin_phi), 4);
        mean                = (1 + fourth) / (2 * fourth);
        swing               = (1 - fourth) / (2 * fourth);
      }
  }



  std::shared_ptr<const Material>
  CamClay::with_strength_over(const double factor) const
  {
    return std::make_shared<CamClay>(parameters, reduction * factor);
  }



  LameConstants
  CamClay::stiffness_at_pressure(const double p, const double mu) const
  {
    const double above = std::max(p, parameters.least_pressure);
    return {above / parameters.swelling - 2. / 3. * mu, mu};
  }



  CamClay::Elastic
  CamClay::elastic(const Tensor<1, 3> &strain, const double mu) const
  {
    const double       least  = parameters.least_pressure;
    const double       volume = -sum_of(strain) / parameters.swelling;
    const Tensor<1, 3> e      = deviator_of(strain);
    const double       grown  = volume <= 1 ? 1. : std::exp(volume - 1);
    const double       p      = least * (volume <= 1 ? volume : grown);
    const double       bulk   = least * grown / parameters.swelling;
    Elastic            result;
    for (unsigned int A = 0; A < 3; ++A)
      {
        result.stress[A] = 2 * mu * e[A] - p;
        for (unsigned int B = 0; B < 3; ++B)
          result.tangent[A][B] = bulk + 2 * mu * ((A == B ? 1. : 0.) - 1. / 3.);
      }
    return result;
  }



  SymmetricTensor<2, 3>
  CamClay::elastic_strain_of(const SymmetricTensor<2, 3> &stress,
                             const double                *internal) const
  {
    return deviator(stress) / (2 * shear_modulus(internal)) -
           volume_at(-trace(stress) / 3) / 3 * unit_symmetric_tensor<3>();
  }



  void
  CamClay::stored_energies(const ArrayView<const ElasticPoint> &points,
                           const ArrayView<double>             &energies) const
  {
    const double least = parameters.least_pressure;
    const double kappa = parameters.swelling;
    for (unsigned int i = 0; i < energies.size(); ++i)
      {
        const double       volume = -sum_of(points[i].strain) / kappa;
        const Tensor<1, 3> e      = deviator_of(points[i].strain);
        energies[i] =
          kappa * least *
            (volume <= 1 ? 0.5 * volume * volume : std::exp(volume - 1) - 0.5) +
          shear_modulus(points[i].internal) * (e * e);
      }
  }



  CamClay::Yield
  CamClay::yield(const Tensor<1, 3> &stress, const double p_c) const
  {
    Yield              result;
    const double       p = result.p = -sum_of(stress) / 3;
    const double       inverse      = 1 / (M_compression * M_compression);
    const Tensor<1, 3> s            = -deviator_of(stress);
    const double       Q            = 1.5 * (s * s); // q^2

    // F = Q g(C), C = 27/2 s_1 s_2 s_3 / q^3: 1 in triaxial compression
    double       g = inverse;
    Tensor<1, 3> dF;
    Tensor<2, 3> ddF;
    if (swing > 0 && Q > 0)
      {
        const double q = std::sqrt(Q), q3 = Q * q;
        const double j    = 13.5 * s[0] * s[1] * s[2];
        const double C    = std::max(-1., std::min(1., j / q3));
        const double root = std::sqrt(mean - swing * C);
        g                 = inverse * root;
        const double dg   = -inverse * swing / (2 * root);
        const double ddg  = dg * swing / (2 * root * root);
        Tensor<1, 3> dj, dQ, dC;
        for (unsigned int A = 0; A < 3; ++A)
          {
            dj[A] = 13.5 * s[(A + 1) % 3] * s[(A + 2) % 3];
            dQ[A] = 3 * s[A];
            dC[A] = dj[A] / q3 - 1.5 * j / (q3 * Q) * dQ[A];
          }
        dF = g * dQ + Q * dg * dC;
        for (unsigned int A = 0; A < 3; ++A)
          for (unsigned int B = 0; B < 3; ++B)
            {
              const double ddj = A == B ? 0. : 13.5 * s[3 - A - B];
              const double ddQ = A == B ? 3. : 0.;
              const double ddC =
                ddj / q3 - 1.5 / (q3 * Q) * (dj[A] * dQ[B] + dQ[A] * dj[B]) -
                1.5 * j / (q3 * Q) * (ddQ - 2.5 / Q * dQ[A] * dQ[B]);
              ddF[A][B] = g * ddQ + dg * (dQ[A] * dC[B] + dC[A] * dQ[B]) +
                          Q * (ddg * dC[A] * dC[B] + dg * ddC);
            }
      }
    else
      for (unsigned int A = 0; A < 3; ++A)
        {
          dF[A]     = 3 * g * s[A];
          ddF[A][A] = 3 * g;
        }

    result.value   = Q * g + p * (p - p_c);
    result.normal  = -deviator_of(dF);
    result.hessian = deviator_of(ddF);
    for (unsigned int A = 0; A < 3; ++A)
      {
        result.normal[A] -= (2 * p - p_c) / 3;
        for (unsigned int B = 0; B < 3; ++B)
          result.hessian[A][B] += 2. / 9.;
      }
    return result;
  }



  double
  CamClay::yield_function(const Tensor<1, 3> &stress,
                          const double       *internal) const
  {
    return yield(stress, internal[0]).value;
  }



  double
  CamClay::Equations::norm() const
  {
    return std::sqrt(flow_error * flow_error + yield_error * yield_error);
  }



  // The flow error is in units of kappa, f in those of p_c,n^2, the multiplier
  // in those of kappa / p_c,n.
  CamClay::Equations
  CamClay::equations(const Tensor<1, 3> &trial,
                     const Start        &start,
                     const Return       &of) const
  {
    const double kappa = parameters.swelling;
    const double p_c_n = start.p_c;
    const double rate  = 1 / (parameters.compression - kappa);
    Equations    result;
    result.at          = elastic(of.elastic, start.mu);
    result.p_c         = p_c_n * std::exp(rate * sum_of(of.elastic - trial));
    result.yield       = yield(result.at.stress, result.p_c);
    result.yield_error = result.yield.value / (p_c_n * p_c_n);
    result.normal      = result.yield.normal / p_c_n;
    result.flow_error =
      (of.elastic - trial) / kappa + of.multiplier * result.normal;
    result.flow_matrix =
      (of.multiplier / p_c_n) * (result.yield.hessian * result.at.tangent);
    const double change = of.multiplier / p_c_n * result.p_c * rate / 3;
    for (unsigned int A = 0; A < 3; ++A)
      {
        result.flow_matrix[A][A] += 1 / kappa;
        for (unsigned int B = 0; B < 3; ++B)
          result.flow_matrix[A][B] += change;
      }
    result.yield_row = result.yield.normal * result.at.tangent;
    for (unsigned int B = 0; B < 3; ++B)
      result.yield_row[B] -= result.yield.p * result.p_c * rate;
    result.yield_row /= p_c_n * p_c_n;
    return result;
  }



  bool
  CamClay::iterate(const Tensor<1, 3> &trial,
                   const Start        &start,
                   Return             &of) const
  {
    Equations now = equations(trial, start, of);
    for (unsigned int i = 0; i < most_clay_iterations; ++i)
      {
        const double error = now.norm();
        if (!std::isfinite(error))
          return false;
        const Tensor<2, 3> inverse = invert(now.flow_matrix);
        const Tensor<1, 3> flow    = inverse * now.flow_error;
        const Tensor<1, 3> normal  = inverse * now.normal;
        const double       change =
          (now.yield_error - now.yield_row * flow) / (now.yield_row * normal);
        const Tensor<1, 3> step = -flow - change * normal;

        double    part = 1;
        Return    next;
        Equations then;
        for (;; part /= 2)
          {
            next.elastic    = of.elastic + part * step;
            next.multiplier = of.multiplier + part * change;
            then            = equations(trial, start, next);
            if (then.norm() <= (1 - 1e-4 * part) * error ||
                error <= clay_tolerance)
              break;
            if (part < 1e-3)
              return error <= 1e3 * clay_tolerance && of.multiplier >= 0;
          }
        const bool done = error <= clay_tolerance;
        if (!done || then.norm() <= error)
          {
            of  = next;
            now = then;
          }
        of.p_c = now.p_c;
        if (done)
          return of.multiplier >= 0;
      }
    return false;
  }



  bool
  CamClay::approach(const Tensor<1, 3> &trial,
                    const Start        &start,
                    Return             &of) const
  {
    const double       volume = -volume_at(0.5 * start.p_c) / 3;
    const Tensor<1, 3> middle({volume, volume, volume});
    const auto         on_way = [&](const double part) {
      return (1 - part) * middle + part * trial;
    };

    double low = 0, high = 1; // to where it is elastic
    while (high - low > 1e-3)
      {
        const double part = 0.5 * (low + high);
        const double f =
          yield(elastic(on_way(part), start.mu).stress, start.p_c).value;
        (f <= 0 ? low : high) = part;
      }
    of        = {on_way(low), 0, start.p_c};
    double at = low, size = 1e-2;
    for (unsigned int n = 0; at < 1; ++n)
      {
        if (n == most_approaches)
          return false;

        const double next  = std::min(1., at + size);
        Return       found = of;
        found.elastic += on_way(next) - on_way(at);
        if (iterate(on_way(next), start, found))
          {
            of = found;
            at = next;
            size *= 2;
            continue;
          }
        size /= 4;
      }
    return true;
  }



  Tensor<2, 3>
  CamClay::consistent_tangent(const Tensor<1, 3> &trial,
                              const Start        &start,
                              const Return       &of) const
  {
    const Equations    at      = equations(trial, start, of);
    const Tensor<2, 3> inverse = invert(at.flow_matrix);
    const Tensor<1, 3> normal  = inverse * at.normal;
    const double       slope   = at.yield_row * normal;
    const double rate = at.p_c / (parameters.compression - parameters.swelling);
    Tensor<2, 3> moves; // elastic strains by trial strains
    for (unsigned int B = 0; B < 3; ++B)
      {
        // Minus the derivatives by the trial strain.
        Tensor<1, 3> flow;
        for (unsigned int A = 0; A < 3; ++A)
          flow[A] = of.multiplier / start.p_c * rate / 3;
        flow[B] += 1 / parameters.swelling;
        const double       f     = -at.yield.p * rate / (start.p_c * start.p_c);
        const Tensor<1, 3> moved = inverse * flow;
        const double       change = (at.yield_row * moved - f) / slope;
        for (unsigned int A = 0; A < 3; ++A)
          moves[A][B] = moved[A] - change * normal[A];
      }
    return at.at.tangent * moves;
  }



  void
  CamClay::respond(const StepTime &,
                   const ArrayView<PrincipalState> &points) const
  {
    for (PrincipalState &point : points)
      {
        const Tensor<1, 3> trial = point.strain;
        const double       p_c_n = point.internal[0];
        const Start        start{p_c_n, shear_modulus(point.internal)};
        const Elastic      at = elastic(trial, start.mu);
        point.stress          = at.stress;
        point.tangent         = at.tangent;
        if (!(yield(at.stress, p_c_n).value <= clay_tolerance * p_c_n * p_c_n))
          {
            Return found{trial, 0, p_c_n};
            // What Newton's method tries on the way to equilibrium may be
            // absurd.
            if (!(-sum_of(trial) < most_compression * parameters.swelling) ||
                (!iterate(trial, start, found) &&
                 !approach(trial, start, found)))
              {
                point.stress[0] = std::numeric_limits<double>::quiet_NaN();
                continue;
              }
            point.strain      = found.elastic;
            point.stress      = elastic(found.elastic, start.mu).stress;
            point.tangent     = consistent_tangent(trial, start, found);
            point.internal[0] = found.p_c;
            point.internal[1] +=
              std::sqrt(2. / 3.) * deviator_of(trial - found.elastic).norm();
          }
        point.internal[2] = -sum_of(point.stress) / 3;
      }
  }



  std::vector<InternalVariable>
  CamClay::internal_variables() const
  {
    std::vector<InternalVariable> variables{{"preconsolidation_pressure",
                                             "stress",
                                             parameters.least_pressure},
                                            {"plastic_strain", "-"},
                                            {"mean_pressure", "stress"}};
    variables.insert(variables.end(),
                     parameters.fields.begin(),
                     parameters.fields.end());
    return variables;
  }



  double
  CamClay::preconsolidation(const double pressure, const double *internal) const
  {
    const double *fields = internal + n_history;
    return std::max(parameters.OCR.at(fields) * pressure +
                      parameters.POP.at(fields),
                    parameters.least_pressure);
  }



  void
  CamClay::initialise(const SymmetricTensor<2, 3> &stress,
                      const unsigned int           vertical,
                      double                      *internal) const
  {
    const double sigma =
      preconsolidation(-stress[vertical][vertical], internal);
    const double p = sigma * (1 + 2 * parameters.normal_K0) / 3;
    const double q = sigma * (1 - parameters.normal_K0);
    internal[0]    = p + q * q / (M_at_start * M_at_start * p);
    internal[2]    = -trace(stress) / 3;
  }



  double
  CamClay::K0(const double pressure, const double *internal) const
  {
    const double OCR = pressure > 0 ?
                         preconsolidation(pressure, internal) / pressure :
                         parameters.OCR.at(internal + n_history);
    return parameters.normal_K0 *
           std::pow(OCR, std::sin(parameters.friction_angle));
  }



  namespace
  {
    using Critical = CamClayParameters::CriticalState;

    std::vector<MaterialKey>
    cam_clay_keys()
    {
      return {
        {"Critical state angle",
         "Friction angle at critical state, in triaxial compression and "
         "extension (degrees). Required."},
        {"Critical state",
         "How the ratio M = q/p goes from compression to extension. Lode angle: "
         "by the angle everywhere, smoothly (Sheng et al. 2000). circle, "
         "compression: M of triaxial compression everywhere; 30 degrees then "
         "act as 44 in plane strain. circle, plane strain: sqrt(3) sin(phi).",
         "Lode angle",
         patterns::selection(
           {"Lode angle", "circle, compression", "circle, plane strain"})},
        {"Compression index",
         "Slope of ln v over ln p of normally consolidated clay, v = 1 + e: "
         "lambda / v. Required."},
        {"Swelling index",
         "Slope of ln v over ln p on unloading, kappa / v. Required."},
        {"Shear modulus",
         "Elastic shear modulus > 0 (stress): a number or an expression in x, "
         "y, z. Required."},
        {"Minimum pressure",
         "Below this pressure the elastic stiffness stays (stress): about that "
         "of the soil at a depth of a few centimetres. Required."},
        {"OCR",
         "Overconsolidation ratio at the start, preconsolidation over vertical "
         "effective stress (along the last coordinate): a number or an "
         "expression in x, y, z.",
         "1"},
        {"POP",
         "Pre-overburden pressure at the start (stress), added to 'OCR' times "
         "the vertical effective stress: a number or an expression.",
         "0"},
        {"Normal K0",
         "Horizontal over vertical effective stress of normally consolidated "
         "clay; 1 - sin(phi) if left out."}};
    }



    CamClayParameters
    read_cam_clay(MaterialInput &input)
    {
      CamClayParameters result;
      const double      angle =
        input.number("Critical state angle", {1., 48., true, true});
      result.friction_angle    = angle * numbers::PI / 180;
      const std::string &shape = input.text("Critical state");
      result.critical_state =
        shape == "circle, compression"  ? Critical::circle_in_compression :
        shape == "circle, plane strain" ? Critical::circle_in_plane_strain :
                                          Critical::lode_angle;
      result.swelling    = input.number("Swelling index", {0.});
      result.compression = input.number("Compression index", {0.});
      if (!(result.compression > result.swelling))
        input.refuse("Compression index",
                     "above 'Swelling index' = " + text_of(result.swelling) +
                       "; slopes of ln v over ln p");
      result.shear_modulus  = input.parameter("Shear modulus", {0.}, "stress");
      result.least_pressure = input.number("Minimum pressure", {0.});
      result.OCR =
        input.parameter("OCR",
                        {1., std::numeric_limits<double>::infinity(), true},
                        "-");
      result.POP =
        input.parameter("POP",
                        {0., std::numeric_limits<double>::infinity(), true},
                        "stress");
      result.normal_K0 = input.has("Normal K0") ?
                           input.number("Normal K0", {0., 1., false, true}) :
                           1 - std::sin(result.friction_angle);
      result.density   = input.number("Density");
      result.fields    = input.fields();
      return result;
    }
  } // namespace



  MaterialModel
  cam_clay_model()
  {
    return {"Cam-clay",
            "modified Cam-clay, stiffness by pressure, hardening by plastic "
            "volume",
            cam_clay_keys(),
            [](MaterialInput &input) {
              return std::make_shared<CamClay>(read_cam_clay(input));
            }};
  }
} // namespace moraine
