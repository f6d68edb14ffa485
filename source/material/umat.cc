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
    constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

    using Stress = SymmetricTensor<2, 3>;
    using Matrix = Tensor<2, 3>;



    /** With shear components times @p factor: 2 makes angles of them. */
    Stress
    with_shear(Stress strain, const double factor)
    {
      for (unsigned int I = 3; I < 6; ++I)
        strain.access_raw_entry(I) *= factor;
      return strain;
    }



    /** What turns e, with angles, to @f$Q\, e\, Q^T@f$. The transpose takes
     * stresses back if Q is a rotation. */
    Tensor<2, 6>
    turning(const Matrix &Q)
    {
      constexpr auto pairs = voigt_pairs<3>();
      Tensor<2, 6>   result;
      for (unsigned int I = 0; I < 6; ++I)
        for (unsigned int J = 0; J < 6; ++J)
          {
            const auto [a, b] = pairs[I];
            const auto [i, j] = pairs[J];
            result[I][J] =
              (I < 3 ? 0.5 : 1.) * (Q[a][i] * Q[b][j] + Q[a][j] * Q[b][i]);
          }
      return result;
    }



    /** @p c times a strain without angles. */
    Stress
    product(const Tensor<2, 6> &c, const Stress &strain)
    {
      Stress result;
      for (unsigned int I = 0; I < 6; ++I)
        for (unsigned int J = 0; J < 6; ++J)
          result.access_raw_entry(I) +=
            c[I][J] * (J < 3 ? 1. : 2.) * strain.access_raw_entry(J);
      return result;
    }



    SymmetricTensor<4, 3>
    fourth_order(const Tensor<2, 6> &c)
    {
      constexpr auto        pairs = voigt_pairs<3>();
      SymmetricTensor<4, 3> result;
      for (unsigned int I = 0; I < 6; ++I)
        for (unsigned int J = 0; J < 6; ++J)
          result[pairs[I][0]][pairs[I][1]][pairs[J][0]][pairs[J][1]] = c[I][J];
      return result;
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



    /** The logarithmic strain of a step, and what it does to stresses. */
    struct LogarithmicStep
    {
      explicit LogarithmicStep(const Matrix &dF)
        : at(spectrum<3>(symmetrize(transpose(dF) * dF)))
      {
        Tensor<1, 3> logarithms;
        Matrix       turned;
        for (unsigned int A = 0; A < 3; ++A)
          {
            logarithms[A] = 0.5 * std::log(at.values[A]);
            stretch[A]    = std::sqrt(at.values[A]);
            turned[A]     = dF * at.directions[A] / stretch[A];
          }
        strain    = at.tensor(logarithms);
        rotation  = transpose(turned) * at.directions;
        to_frame  = turning(turned);
        to_strain = to_frame;
        for (unsigned int I = 0; I < 6; ++I)
          {
            const auto [A, B] = voigt_pairs<3>()[I];
            difference[A][B]  = difference[B][A] =
              log_difference(at.values[A], at.values[B]);
            to_strain[I] *= stretch[A] * stretch[B] * difference[A][B];
          }
        to_strain = turning(transpose(at.directions)) * to_strain;
      }

      /** @f$\sigma@f$ of T. */
      Stress
      stress(const Stress &T) const
      {
        Stress result;
        for (unsigned int I = 0; I < 6; ++I)
          for (unsigned int J = 0; J < 6; ++J)
            result.access_raw_entry(I) +=
              to_strain[J][I] * T.access_raw_entry(J);
        return result;
      }

      /** The tangent of @f$\sigma@f$, with T and DDSDDE. */
      Tensor<2, 6>
      tangent(const Stress &T, const Tensor<2, 6> &D) const
      {
        constexpr unsigned int index[3][3]{{0, 3, 4}, {3, 1, 5}, {4, 5, 2}};
        const Stress           T_frame = transformed(at.directions, T);
        Tensor<2, 6>           by_T;
        for (unsigned int I = 0; I < 6; ++I)
          for (unsigned int C = 0; C < 3; ++C)
            {
              const auto [A, B] = voigt_pairs<3>()[I];
              const double part = stretch[A] * stretch[B] * stretch[C] *
                                  second_difference(A, B, C);
              by_T[I][index[C][B]] +=
                (B == C ? 2 : 1) * part * stretch[B] * T_frame[A][C];
              by_T[I][index[A][C]] +=
                (A == C ? 2 : 1) * part * stretch[A] * T_frame[C][B];
            }
        return transpose(to_strain) * D * to_strain +
               transpose(to_frame) * by_T * to_frame;
      }

      /** The second divided difference of ln at three principal values,
       * A <= B. Where they are nearly equal, a quotient would lose digits. */
      double
      second_difference(const unsigned int A,
                        const unsigned int B,
                        const unsigned int C) const
      {
        // They fall with their number.
        const unsigned int first = std::min(A, C), last = std::max(B, C),
                           middle = A + B + C - first - last;
        const double x = at.values[first], y = at.values[middle],
                     z = at.values[last];
        if (x - z > 1e-3 * x)
          return (difference[first][middle] - difference[middle][last]) /
                 (x - z);
        const double m = (x + y + z) / 3;
        const double a = x / m - 1, b = y / m - 1, c = z / m - 1;
        return (-0.5 - (a * a + b * b + c * c) / 8 + a * b * c / 5) / (m * m);
      }

      const Spectrum at;
      Matrix         difference; ///< first ones of ln
      Tensor<1, 3>   stretch;
      Stress         strain;
      Matrix         rotation;
      Tensor<2, 6>   to_frame;  ///< d in the principal frame of the end
      Tensor<2, 6>   to_strain; ///< rate of the strain by d
    };
  } // namespace



  Umat::Umat(const Parameters &of)
    : parameters(of)
    , library(std::make_shared<UmatLibrary>(of.file, of.symbol))
    , failure(std::make_shared<Failure>())
  {
    if (of.by_sdvini && !library->has_sdvini())
      throw InputError("'" + of.file + "' has no SDVINI");
    parameters.name.resize(80, ' ');

    std::vector<double> state = internal_at(Point<3>());
    UmatCall            call;
    call.state          = state.data();
    call.n_state        = of.state.size();
    const bool answers  = ask(call);
    const auto stiffest = [&](const unsigned int first) {
      double largest = 0;
      for (unsigned int I = first; I < first + 3; ++I)
        largest = std::max(largest, call.tangent[I][I]);
      return largest;
    };
    const double normal = stiffest(0), shear = stiffest(3);
    stiffness = {std::max(0., normal - 2 * shear), shear};
    if (!answers || !(normal > 0 && shear > 0))
      throw InputError("the UMAT in '" + of.file +
                       "' has no stiffness without stress and strain: DDSDDE "
                       "has " +
                       text_of(normal) + " for normal strains, " +
                       text_of(shear) + " for shear");
  }



  std::vector<InternalVariable>
  Umat::internal_variables() const
  {
    std::vector<InternalVariable> result;
    const unsigned int            n = parameters.state.size();
    for (unsigned int i = 0; i < n; ++i)
      {
        result.push_back(
          {"statev_" + std::to_string(i + 1), "-", parameters.state[i]});
        if (!parameters.by_sdvini)
          continue;
        result.back().initial_at =
          [library = library, i, n](const Point<3> &x) {
            std::vector<double> state(n);
            library->call_sdvini(state, x);
            return state[i];
          };
        result.back().initial = result.back().initial_at(Point<3>());
      }
    for (const char *name : {"xx", "yy", "zz", "xy", "xz", "yz"})
      result.push_back({std::string("stran_") + name, "-"});
    return result;
  }



  bool
  Umat::ask(UmatCall &call) const
  {
    library->call(call, parameters.constants, parameters.name);
    call.tangent = transpose(call.tangent);
    return call.new_step >= 1 &&
           std::isfinite(call.stress.norm() + call.tangent.norm());
  }



  void
  Umat::respond(const StepTime               &time,
                const StrainMeasure           measure,
                const ArrayView<TensorState> &points) const
  {
    const auto answer =
      measure == StrainMeasure::small ? &Umat::respond_small :
      parameters.hughes_winget        ? &Umat::respond_by_hughes_winget :
                                        &Umat::respond_by_logarithm;
    for (unsigned int i = 0; i < points.size(); ++i)
      {
        TensorState &point = points[i];
        UmatCall     call;
        call.state   = point.internal;
        call.n_state = parameters.state.size();
        call.time    = time.start;
        // Some divide by it.
        call.step      = time.size() > 0 ? time.size() : 1;
        call.is_finite = measure == StrainMeasure::finite;
        if (call.is_finite)
          {
            call.F_n = transpose(point.F_n);
            call.F   = transpose(point.F);
          }
        call.stress = point.stress;
        std::copy_n(point.internal + call.n_state,
                    6,
                    &call.strain.access_raw_entry(0));
        try
          {
            if ((this->*answer)(call, point))
              {
                if (parameters.symmetrises_tangent)
                  call.tangent = 0.5 * (call.tangent + transpose(call.tangent));
                point.tangent = fourth_order(call.tangent);
                std::copy_n(&call.strain.access_raw_entry(0),
                            6,
                            point.internal + call.n_state);
                continue;
              }
          }
        catch (UmatExit &exit)
          {
            exit.point = i;
            throw;
          }
        point.stress = no_number * unit_symmetric_tensor<3>();
        if (failure->time.start != time.start || failure->time.end != time.end)
          *failure = {time};
        failure->least_new_step =
          std::min(failure->least_new_step, call.new_step);
      }
  }



  bool
  Umat::respond_small(UmatCall &call, TensorState &point) const
  {
    call.strain_increment = with_shear(point.strain_increment, 2);
    const Stress strain   = call.strain + call.strain_increment;
    if (!ask(call))
      return false;
    call.strain  = strain;
    point.stress = call.stress;
    return true;
  }



  bool
  Umat::respond_by_logarithm(UmatCall &call, TensorState &point) const
  {
    const Matrix dF = point.F * invert(point.F_n);
    if (!(determinant(dF) > 0))
      return false;
    const LogarithmicStep step(dF);
    const Stress          strain = with_shear(call.strain, 0.5) + step.strain;
    call.strain_increment        = with_shear(step.strain, 2);
    if (!ask(call))
      return false;
    const double J = determinant(point.F);
    call.strain    = with_shear(transformed(step.rotation, strain), 2);
    point.stress   = J * step.stress(call.stress);
    call.tangent   = J * step.tangent(call.stress, call.tangent);
    for (unsigned int I = 0; I < 6; ++I)
      for (unsigned int d = 0; d < 3; ++d)
        call.tangent[I][d] += point.stress.access_raw_entry(I);
    return true;
  }



  bool
  Umat::respond_by_hughes_winget(UmatCall &call, TensorState &point) const
  {
    const Matrix one = unit_symmetric_tensor<3>();
    const Matrix dF  = point.F * invert(point.F_n);
    if (!(determinant(dF) > 0) || !(determinant(dF + one) > 0))
      return false;
    const Matrix middle = invert(dF + one);
    const Matrix h      = 2. * (dF - one) * middle;
    const Stress e      = symmetrize(h);
    const Matrix omega  = 0.5 * (h - transpose(h));
    const Matrix before = invert(one - 0.5 * omega);
    const Matrix Q      = before * (one + 0.5 * omega);
    call.stress         = transformed(Q, point.stress);
    call.strain = with_shear(transformed(Q, with_shear(call.strain, 0.5)), 2);
    call.strain_increment = with_shear(e, 2);
    call.rotation         = transpose(Q);
    const Stress strain   = call.strain + call.strain_increment;
    if (!ask(call))
      return false;
    const double       J     = determinant(point.F);
    const Matrix       sigma = call.stress;
    const Tensor<2, 6> D     = call.tangent;
    // A rotation W of stress and strain increment together turns the answer.
    const auto spin = [](const Matrix &W, const Matrix &s) {
      return symmetrize(W * s - s * W);
    };
    call.strain  = strain;
    point.stress = J * call.stress;
    for (unsigned int K = 0; K < 6; ++K)
      {
        Stress d;
        d.access_raw_entry(K) = K < 3 ? 1 : 0.5;
        const Matrix d_m      = d;
        const Matrix d_h      = (2. * one - h) * d_m * dF * middle;
        const Matrix d_W      = 0.25 * (d_h - transpose(d_h));
        const Matrix W        = before * d_W * (one + Q) * transpose(Q);
        const Stress rate     = product(D, symmetrize(d_h) - spin(W, e)) +
                            spin(W, sigma) + trace(d) * call.stress -
                            2. * symmetrize(d_m * sigma);
        for (unsigned int I = 0; I < 6; ++I)
          call.tangent[I][K] = J * rate.access_raw_entry(I);
      }
    return true;
  }



  std::string
  Umat::why_no_stress() const
  {
    return failure->least_new_step < 1 ?
             "has a UMAT that asks for a smaller step (PNEWDT = " +
               text_of(failure->least_new_step) + ")" :
             "has a UMAT whose stress or DDSDDE is not a number";
  }



  double
  Umat::wanted_cut(const StepTime &time) const
  {
    return failure->time.start == time.start && failure->time.end == time.end ?
             failure->least_new_step :
             1;
  }



  namespace
  {
    /** The whole number from 1 to 10 000 in @p text, 0 if there is none. */
    unsigned int
    count_in(const std::string &text)
    {
      const double n = plain_number(text).value_or(0);
      return n >= 1 && n <= 10000 && n == std::floor(n) ? n : 0;
    }



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
          const auto         star = part.find('*');
          const bool         many = star != std::string::npos;
          const unsigned int n    = many ? count_in(part.substr(0, star)) : 1;
          const auto value = number_from(many ? part.substr(star + 1) : part);
          if (n == 0 || !value)
            input.refuse(key,
                         "numbers separated by commas; '3*0' is '0, 0, 0'");
          result.insert(result.end(), n, *value);
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
      result.file                = input.text("Library");
      result.symbol              = input.text("Symbol");
      result.constants           = read_numbers(input, "Constants");
      result.density             = input.number("Density");
      result.hughes_winget       = input.text("Objective rate") != "logarithm";
      result.symmetrises_tangent = input.text("Tangent") == "symmetric";
      for (const char c : input.section.substr(input.section.rfind('/') + 1))
        result.name += std::toupper(static_cast<unsigned char>(c));

      const std::string  key   = "State variables";
      const std::string &state = input.text(key);
      const auto         by    = state.find("by SDVINI");
      result.by_sdvini         = by != std::string::npos;
      if (!result.by_sdvini)
        result.state = read_numbers(input, key);
      else if (const unsigned int n = count_in(state.substr(0, by)))
        result.state.resize(n);
      else
        input.refuse(key, "a number before 'by SDVINI', as '12 by SDVINI'");
      try
        {
          return std::make_shared<Umat>(result);
        }
      catch (const UmatExit &exit)
        {
          throw InputError("section '" + input.section + "': with " +
                           std::to_string(result.constants.size()) +
                           " constants and " +
                           std::to_string(result.state.size()) +
                           " state variables " + exit.what());
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
        "The name of the subroutine; it is looked for as it is, and in lower "
        "case with an underscore.",
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
        patterns::selection({"logarithm", "Hughes-Winget"})},
       {"Tangent",
        "full: all of DDSDDE. symmetric: its symmetric part, as Abaqus takes "
        "without UNSYMM; conjugate gradients can then solve, but Newton's "
        "method is slow where the rest matters. At finite strain the rest is "
        "never quite 0.",
        "full",
        patterns::selection({"full", "symmetric"})}},
      read_umat,
      /* is_isotropic = */ false};
  }
} // namespace moraine
