// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/material/umat.h>

#include <moraine/core/arithmetic.h>
#include <moraine/core/patterns.h>
#include <moraine/core/words.h>
#include <moraine/material/spectral.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    constexpr auto pairs = voigt_pairs<3>();

    using Stress = SymmetricTensor<2, 3>;
    using Matrix = Tensor<2, 3>;

    constexpr double no_number = std::numeric_limits<double>::quiet_NaN();



    std::array<double, 6>
    components(const Stress &tensor, const double shear_factor = 1)
    {
      std::array<double, 6> result;
      for (unsigned int I = 0; I < 6; ++I)
        result[I] =
          (I < 3 ? 1 : shear_factor) * tensor[pairs[I][0]][pairs[I][1]];
      return result;
    }



    Stress
    tensor_of(const double *values, const double shear_factor = 1)
    {
      Stress result;
      for (unsigned int I = 0; I < 6; ++I)
        result[pairs[I][0]][pairs[I][1]] =
          (I < 3 ? 1 : shear_factor) * values[I];
      return result;
    }



    std::array<double, 9>
    by_columns(const Matrix &matrix)
    {
      std::array<double, 9> result;
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          result[i + 3 * j] = matrix[i][j];
      return result;
    }



    /** DDSDDE times a strain. */
    Stress
    stress_by(const std::array<double, 36> &D, const Stress &strain)
    {
      const std::array<double, 6> e = components(strain, 2);
      std::array<double, 6>       s{};
      for (unsigned int J = 0; J < 6; ++J)
        for (unsigned int I = 0; I < 6; ++I)
          s[I] += D[I + 6 * J] * e[J];
      return tensor_of(s.data());
    }



    /** The tangent whose product with d is @p give (d), linear in d. */
    template <typename Give>
    SymmetricTensor<4, 3>
    tangent_by(const Give &give)
    {
      SymmetricTensor<4, 3> c;
      for (unsigned int J = 0; J < 6; ++J)
        {
          Stress d;
          d[pairs[J][0]][pairs[J][1]] = J < 3 ? 1 : 0.5;
          const Stress rate           = give(d);
          for (unsigned int I = 0; I < 6; ++I)
            c[pairs[I][0]][pairs[I][1]][pairs[J][0]][pairs[J][1]] =
              rate[pairs[I][0]][pairs[I][1]];
        }
      return c;
    }



    /** @f$A\, s\, A^T@f$ */
    Stress
    transformed(const Matrix &A, const Stress &s)
    {
      return symmetrize(A * static_cast<Matrix>(s) * transpose(A));
    }



    /** @f$(\ln x - \ln y) / (x - y)@f$ */
    double
    log_difference(const double x, const double y)
    {
      return x == y ? 1 / x : std::log1p((x - y) / y) / (x - y);
    }



    /** The second divided difference of ln. Where its three places are nearly
     * equal, a quotient of differences would lose digits. */
    double
    second_log_difference(double x, double y, double z)
    {
      if (x > y)
        std::swap(x, y);
      if (y > z)
        std::swap(y, z);
      if (x > y)
        std::swap(x, y);
      if (z - x > 1e-3 * z)
        return (log_difference(x, y) - log_difference(y, z)) / (x - z);
      const double m = (x + y + z) / 3;
      const double a = x / m - 1, b = y / m - 1, c = z / m - 1;
      return (-0.5 - (a * a + b * b + c * c) / 8 + a * b * c / 5) / (m * m);
    }



    /** The logarithmic strain of a step, and what it does to stresses. */
    class LogarithmicStep
    {
    public:
      explicit LogarithmicStep(const Matrix &dF)
        : dF(dF)
        , at(spectrum<3>(symmetrize(transpose(dF) * dF)))
      {
        Tensor<1, 3> logarithms;
        for (unsigned int A = 0; A < 3; ++A)
          {
            logarithms[A] = 0.5 * std::log(at.values[A]);
            root[A]       = std::sqrt(at.values[A]);
            turned[A]     = dF * at.directions[A] / root[A];
          }
        strain = at.tensor(logarithms);
        for (unsigned int A = 0; A < 3; ++A)
          for (unsigned int B = 0; B < 3; ++B)
            theta[A][B] =
              root[A] * root[B] * log_difference(at.values[A], at.values[B]);
      }

      /** @f$\Delta R@f$ */
      Matrix
      rotation() const
      {
        return transpose(turned) * at.directions;
      }

      /** @f$\sigma@f$ of T. */
      Stress
      stress(const Stress &T) const
      {
        return transformed(transpose(turned),
                           times_theta(transformed(at.directions, T)));
      }

      /** @f$L_v\sigma@f$ for d, with T and DDSDDE. */
      Stress
      rate(const Stress                 &T,
           const std::array<double, 36> &D,
           const Stress                 &d) const
      {
        const Stress in_frame = transformed(turned, d);
        const Stress strain_rate =
          transformed(transpose(at.directions), times_theta(in_frame));
        const Stress T_frame = transformed(at.directions, T);
        Stress       result =
          times_theta(transformed(at.directions, stress_by(D, strain_rate)));
        for (unsigned int A = 0; A < 3; ++A)
          for (unsigned int B = A; B < 3; ++B)
            for (unsigned int C = 0; C < 3; ++C)
              result[A][B] += 2 * root[A] * root[B] * root[C] *
                              second_log_difference(at.values[A],
                                                    at.values[B],
                                                    at.values[C]) *
                              (root[B] * T_frame[A][C] * in_frame[C][B] +
                               root[A] * in_frame[A][C] * T_frame[C][B]);
        return transformed(transpose(turned), result);
      }

      Stress strain;

    private:
      Stress
      times_theta(Stress s) const
      {
        for (unsigned int A = 0; A < 3; ++A)
          for (unsigned int B = A; B < 3; ++B)
            s[A][B] *= theta[A][B];
        return s;
      }

      const Matrix   dF;
      const Spectrum at;
      Tensor<1, 3>   root;   ///< stretches
      Matrix         turned; ///< rows: @f$\Delta F N_A / \lambda_A^{1/2}@f$
      Matrix         theta;
    };
  } // namespace



  Umat::Umat(const Parameters &parameters)
    : parameters(parameters)
    , library(std::make_shared<UmatLibrary>(parameters.file, parameters.symbol))
    , last_failure(std::make_shared<Failure>())
  {
    if (parameters.by_sdvini && !library->sets_state())
      throw InputError("'" + parameters.file + "' has no SDVINI");
    find_stiffness();
  }



  void
  Umat::find_stiffness()
  {
    std::vector<double> state = internal_at(Point<3>());
    UmatCall            call;
    call.state   = state.data();
    call.n_state = parameters.state.size();
    library->call(call,
                  parameters.constants.data(),
                  parameters.constants.size(),
                  parameters.name);
    const auto diagonal = [&](const unsigned int first) {
      double largest = 0;
      for (unsigned int I = first; I < first + 3; ++I)
        {
          const double entry = call.tangent[7 * I];
          largest = std::isfinite(entry) ? std::max(largest, entry) : no_number;
        }
      return largest;
    };
    stiffness.mu     = diagonal(3);
    stiffness.lambda = std::max(0., diagonal(0) - 2 * stiffness.mu);
    if (!(stiffness.mu > 0) || !(diagonal(0) > 0) ||
        !std::isfinite(stiffness.mu + stiffness.lambda))
      throw InputError("the UMAT in '" + parameters.file +
                       "' has no stiffness without stress and strain: DDSDDE "
                       "has " +
                       text_of(diagonal(0)) + " for normal strains, " +
                       text_of(stiffness.mu) + " for shear");
  }



  std::vector<InternalVariable>
  Umat::internal_variables() const
  {
    std::vector<InternalVariable> result;
    const unsigned int            n = parameters.state.size();
    for (unsigned int i = 0; i < n; ++i)
      {
        InternalVariable variable{"statev_" + std::to_string(i + 1),
                                  "-",
                                  parameters.state[i]};
        if (parameters.by_sdvini)
          {
            variable.initial_at = [library = library, i, n](const Point<3> &x) {
              std::vector<double> state(n);
              library->set_state(state.data(), n, {x[0], x[1], x[2]});
              return state[i];
            };
            variable.initial = variable.initial_at(Point<3>());
          }
        result.push_back(variable);
      }
    for (const char *name : {"xx", "yy", "zz", "xy", "xz", "yz"})
      result.push_back({std::string("stran_") + name, "-"});
    return result;
  }



  bool
  Umat::ask(UmatCall &call) const
  {
    library->call(call,
                  parameters.constants.data(),
                  parameters.constants.size(),
                  parameters.name);
    double sum = 0;
    for (const double entry : call.stress)
      sum += entry;
    for (const double entry : call.tangent)
      sum += entry;
    if (call.new_step >= 1 && std::isfinite(sum))
      return true;
    last_failure->new_step = call.new_step;
    return false;
  }



  void
  Umat::respond(const StepTime               &time,
                const StrainMeasure           measure,
                const ArrayView<TensorState> &points) const
  {
    const bool   finite = measure == StrainMeasure::finite;
    unsigned int n_done = 0;
    try
      {
        for (TensorState &point : points)
          {
            UmatCall call;
            call.state   = point.internal;
            call.n_state = parameters.state.size();
            call.time    = time.start;
            // Some divide by it.
            call.step      = time.size() > 0 ? time.size() : 1;
            call.is_finite = finite;
            std::copy_n(point.internal + call.n_state, 6, call.strain.begin());
            if (!(finite ? (parameters.rate == Rate::logarithm ?
                              respond_by_logarithm(call, point) :
                              respond_by_hughes_winget(call, point)) :
                           respond_small(call, point)))
              {
                point.stress  = Stress();
                point.tangent = SymmetricTensor<4, 3>();
                for (unsigned int d = 0; d < 3; ++d)
                  point.stress[d][d] = no_number;
              }
            ++n_done;
          }
      }
    catch (UmatExit &exit)
      {
        exit.point = n_done;
        throw;
      }
  }



  bool
  Umat::respond_small(UmatCall &call, TensorState &point) const
  {
    call.stress           = components(point.stress);
    call.strain_increment = components(point.strain_increment, 2);
    const auto increment  = call.strain_increment;
    if (!ask(call))
      return false;
    point.stress = tensor_of(call.stress.data());
    point.tangent =
      tangent_by([&](const Stress &d) { return stress_by(call.tangent, d); });
    for (unsigned int I = 0; I < 6; ++I)
      point.internal[call.n_state + I] += increment[I];
    return true;
  }



  bool
  Umat::respond_by_logarithm(UmatCall &call, TensorState &point) const
  {
    const double J  = determinant(point.F);
    const Matrix dF = point.F * invert(point.F_n);
    if (!(determinant(dF) > 0))
      return false;
    const LogarithmicStep step(dF);
    const Stress          strain = tensor_of(call.strain.data(), 0.5);
    call.stress                  = components(point.stress);
    call.strain_increment        = components(step.strain, 2);
    call.F_n                     = by_columns(point.F_n);
    call.F                       = by_columns(point.F);
    if (!ask(call))
      return false;
    const Stress T     = tensor_of(call.stress.data());
    const Stress sigma = step.stress(T);
    point.stress       = J * sigma;
    point.tangent      = tangent_by([&](const Stress &d) {
      return J * (step.rate(T, call.tangent, d) + trace(d) * sigma);
    });
    const auto total =
      components(transformed(step.rotation(), strain + step.strain), 2);
    std::copy(total.begin(), total.end(), point.internal + call.n_state);
    return true;
  }



  bool
  Umat::respond_by_hughes_winget(UmatCall &call, TensorState &point) const
  {
    const Matrix one = unit_symmetric_tensor<3>();
    const double J   = determinant(point.F);
    const Matrix dF  = point.F * invert(point.F_n);
    if (!(determinant(dF) > 0) || !(determinant(dF + one) > 0))
      return false;
    const Matrix middle   = invert(dF + one);
    const Matrix h        = 2. * (dF - one) * middle;
    const Stress e        = symmetrize(h);
    const Matrix omega    = 0.5 * (h - transpose(h));
    const Matrix before   = invert(one - 0.5 * omega);
    const Matrix Q        = before * (one + 0.5 * omega);
    const Stress strain   = transformed(Q, tensor_of(call.strain.data(), 0.5));
    call.stress           = components(transformed(Q, point.stress));
    call.strain           = components(strain, 2);
    call.strain_increment = components(e, 2);
    call.rotation         = by_columns(Q);
    call.F_n              = by_columns(point.F_n);
    call.F                = by_columns(point.F);
    if (!ask(call))
      return false;
    const Stress sigma   = tensor_of(call.stress.data());
    const Matrix sigma_m = sigma;
    // A rotation W of stress and strain increment together turns the answer.
    const auto turning = [](const Matrix &W, const Matrix &s) {
      return symmetrize(W * s - s * W);
    };
    point.stress     = J * sigma;
    point.tangent    = tangent_by([&](const Stress &d) {
      const Matrix d_m = d;
      const Matrix d_h = (2. * one - h) * d_m * dF * middle;
      const Matrix d_W = 0.25 * (d_h - transpose(d_h));
      const Matrix W   = before * d_W * (one + Q) * transpose(Q);
      const Stress rates =
        stress_by(call.tangent, symmetrize(d_h) - turning(W, e));
      return J * (rates + turning(W, sigma_m) + trace(d) * sigma -
                  2. * symmetrize(d_m * sigma_m));
    });
    const auto total = components(strain + e, 2);
    std::copy(total.begin(), total.end(), point.internal + call.n_state);
    return true;
  }



  std::string
  Umat::why_no_stress() const
  {
    return last_failure->new_step < 1 ?
             "has a UMAT that asks for a smaller step (PNEWDT = " +
               text_of(last_failure->new_step) + ")" :
             "has a UMAT whose stress or DDSDDE is not a number";
  }



  namespace
  {
    /** Numbers between commas; "3*0" is "0, 0, 0". */
    std::vector<double>
    read_numbers(const MaterialInput &input, const std::string &key)
    {
      std::vector<double> result;
      if (!input.has(key))
        return result;
      for (const std::string &part :
           split_outside_brackets(input.text(key), ","))
        {
          const auto        star  = part.find('*');
          const auto        times = star == std::string::npos ?
                                      std::optional<double>(1) :
                                      plain_number(part.substr(0, star));
          const std::string number =
            star == std::string::npos ? part : part.substr(star + 1);
          const auto value = number_from(number);
          if (!value || !times || !(*times >= 1) || *times > 10000 ||
              *times != std::floor(*times))
            input.refuse(key,
                         "numbers separated by commas; '3*0' is '0, 0, 0'");
          result.insert(result.end(), static_cast<std::size_t>(*times), *value);
        }
      return result;
    }



    std::shared_ptr<const Material>
    read_umat(MaterialInput &input)
    {
      Umat::Parameters result;
      if (!input.has("Library"))
        throw InputError(place(input.section, "Library") +
                         ": is not set, and has no default");
      result.file      = input.text("Library");
      result.symbol    = input.text("Symbol");
      result.constants = read_numbers(input, "Constants");
      result.density   = input.number("Density");
      result.name      = input.section.substr(input.section.rfind('/') + 1);
      std::transform(result.name.begin(),
                     result.name.end(),
                     result.name.begin(),
                     [](const unsigned char c) { return std::toupper(c); });
      if (input.text("Objective rate") == "Hughes-Winget")
        result.rate = Umat::Rate::hughes_winget;

      const std::string  key   = "State variables";
      const std::string &state = input.text(key);
      const auto         by    = state.find("by SDVINI");
      if (by == std::string::npos)
        result.state = read_numbers(input, key);
      else
        {
          const auto n = number_from(state.substr(0, by));
          if (!n || !(*n >= 1) || *n > 10000 || *n != std::floor(*n))
            input.refuse(key, "a number before 'by SDVINI', as '12 by SDVINI'");
          result.state.resize(static_cast<std::size_t>(*n));
          result.by_sdvini = true;
        }
      try
        {
          return std::make_shared<Umat>(result);
        }
      catch (const UmatExit &exit)
        {
          throw InputError("section '" + input.section +
                           "': without stress and strain " + exit.what());
        }
      catch (const InputError &error)
        {
          throw InputError("section '" + input.section + "': " + error.what());
        }
    }
  } // namespace



  MaterialModel
  umat_model()
  {
    return {
      "UMAT",
      "a subroutine UMAT as for Abaqus, in a library or a source in Fortran",
      {{"Library",
        "The file of the UMAT: a shared library (.so), or a source (.f, .for, "
        ".f90), which gfortran compiles once. Required."},
       {"Symbol",
        "The name of the subroutine. It is also looked for in lower case with "
        "an underscore and in upper case.",
        "umat"},
       {"Constants", "PROPS: numbers separated by commas. '3*0' is '0, 0, 0'."},
       {"State variables",
        "STATEV before the first step: numbers separated by commas, as '0.7, "
        "6*0', or their number if the library sets them, as '12 by SDVINI'. "
        "Empty: none."},
       {"Objective rate",
        "What the UMAT gets at finite strain. logarithm: half the logarithm of "
        "C of the step, in the frame of its start. Hughes-Winget: strain and "
        "rotation at the middle of the step, as Abaqus gives them; also for a "
        "UMAT that takes its stress from DFGRD1.",
        "logarithm",
        patterns::selection({"logarithm", "Hughes-Winget"})}},
      read_umat};
  }
} // namespace moraine
