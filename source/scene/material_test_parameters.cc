// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/scene/material_test_parameters.h>

#include <moraine/core/arithmetic.h>
#include <moraine/core/exceptions.h>
#include <moraine/core/patterns.h>
#include <moraine/core/words.h>
#include <moraine/material/spectral.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <optional>
#include <sstream>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    const std::string test_section = "Material test";

    constexpr unsigned int most_test_steps = 1000000;

    const std::vector<std::string> six_names{"xx",
                                             "yy",
                                             "zz",
                                             "xy",
                                             "xz",
                                             "yz"};

    /** A kind of test: which sums of stresses stay in place of the strain of a
     * component; all other strains do but the one that is driven. */
    struct TestKind
    {
      std::string                                      name;
      unsigned int                                     driven;
      std::vector<std::pair<unsigned int, SixNumbers>> stresses;
    };

    const std::vector<TestKind> test_kinds{
      {"triaxial drained", 2, {{0, {{1}}}, {1, {{0, 1}}}}},
      {"triaxial undrained", 2, {{1, {{1, -1}}}}},
      {"oedometer", 2, {}},
      {"isotropic", 2, {{0, {{1, 0, -1}}}, {1, {{0, 1, -1}}}}},
      {"biaxial", 2, {{0, {{1}}}}},
      {"simple shear constant stress", 4, {{2, {{0, 0, 1}}}}},
      {"simple shear constant height", 4, {}},
      {"general", 0, {}}};



    const TestKind &
    test_kind(const std::string &name)
    {
      return *std::find_if(test_kinds.begin(),
                           test_kinds.end(),
                           [&](const auto &kind) { return kind.name == name; });
    }



    std::vector<std::string>
    words_between_blanks(const std::string &text)
    {
      std::istringstream       stream(text);
      std::vector<std::string> words;
      for (std::string word; stream >> word;)
        words.push_back(word);
      return words;
    }



    StressStrainSum
    test_sum(const bool of_stress, const SixNumbers &factors)
    {
      return of_stress ? StressStrainSum{factors, {}} :
                         StressStrainSum{{}, factors};
    }



    SixNumbers
    only(const unsigned int component)
    {
      SixNumbers factors{};
      factors[component] = 1;
      return factors;
    }



    [[noreturn]] void
    refuse_leg(const std::string &leg, const std::string &allowed)
    {
      reject(test_section, "Legs", leg, allowed);
    }



    /** The number after the words @p begin, if that is how the leg begins. */
    std::optional<double>
    number_after(const std::string &begin, const std::string &leg)
    {
      std::string plain;
      for (const std::string &word : words_between_blanks(leg))
        plain += (plain.empty() ? "" : " ") + word;
      if (plain.rfind(begin + " ", 0) != 0)
        return {};
      return number_from(plain.substr(begin.size() + 1));
    }



    /** Of all kinds but 'general'. */
    MaterialTestLeg
    simple_leg(const TestKind &kind, const std::string &text)
    {
      MaterialTestLeg leg;
      for (unsigned int I = 0; I < 6; ++I)
        leg.sums[I] = test_sum(false, only(I));
      for (const auto &[place, factors] : kind.stresses)
        leg.sums[place] = test_sum(true, factors);
      if (kind.name == "triaxial undrained")
        leg.sums[0] = test_sum(false, {{1, 1, 1}});
      const bool has_q =
        kind.name.rfind("triaxial", 0) == 0 || kind.name == "oedometer";
      const auto drive = [&](const std::string &begin,
                             const bool         of_stress,
                             const SixNumbers  &factors) {
        leg.values[kind.driven] = number_after(begin, text);
        leg.sums[kind.driven]   = test_sum(of_stress, factors);
        return leg.values[kind.driven].has_value();
      };
      if (!drive("to strain", false, only(kind.driven)) &&
          !drive("to stress", true, only(kind.driven)) &&
          !drive("until p =", true, {{1. / 3, 1. / 3, 1. / 3}}) &&
          !(has_q && drive("until q =", true, {{0.5, 0.5, -1}})))
        refuse_leg(text,
                   "'to strain NUMBER', 'to stress NUMBER', 'until p = "
                   "NUMBER', " +
                     std::string(has_q ? "'until q = NUMBER', " : "") +
                     "'NUMBER cycles' with 'Kind = " + kind.name + "'");
      return leg;
    }



    /** Of the kind 'general', by "strain xx -0.01; stress yy 0; ...". */
    MaterialTestLeg
    general_leg(const std::string &control, const std::string &text)
    {
      MaterialTestLeg leg;
      for (unsigned int I = 0; I < 6; ++I)
        leg.sums[I] = test_sum(true, only(I));
      auto parts = Utilities::split_string_list(control, ';');
      if (parts.empty())
        parts = {""};
      for (const std::string &part : parts)
        {
          const auto         words = words_between_blanks(part);
          const unsigned int I =
            words.size() != 3 ?
              6 :
              std::find(six_names.begin(), six_names.end(), words[1]) -
                six_names.begin();
          if (I == 6 || !contains({"stress", "strain"}, words[0]) ||
              leg.values[I] || !(leg.values[I] = number_from(words[2])))
            reject(test_section,
                   "Control",
                   part,
                   "'stress' or 'strain', one of " + list_of(six_names) +
                     " and a number, for each component at most once; as "
                     "'strain xx -0.01; stress yy 0'");
          leg.sums[I] = test_sum(words[0] == "stress", only(I));
        }
      const auto factor = number_after("to", text);
      if (!factor)
        refuse_leg(text,
                   "'to FACTOR' or 'NUMBER cycles' with 'Kind = general', as "
                   "'to 1, to 0'");
      leg.factor = *factor;
      return leg;
    }



    /** How often 'N cycles' has the legs before it run in all. */
    std::optional<unsigned int>
    cycles_of(const std::string &leg)
    {
      const auto words = words_between_blanks(leg);
      if (words.empty() || words.back() != "cycles")
        return {};
      const auto n = words.size() == 2 ? number_from(words[0]) : std::nullopt;
      if (!n || !(*n >= 1) || *n != std::floor(*n) || *n > most_test_steps)
        refuse_leg(leg, "a whole number >= 1 of cycles, as '50 cycles'");
      return *n;
    }
  } // namespace



  void
  MaterialTestParameters::add_parameters(ParameterHandler &prm)
  {
    std::vector<std::string> names;
    for (const TestKind &one : test_kinds)
      names.push_back(one.name);
    prm.add_parameter(
      "Kind",
      kind,
      "Of 'moraine test-material'; z is the axis. triaxial drained: sigma_xx "
      "and sigma_yy stay. triaxial undrained: the volume stays, and sigma_xx - "
      "sigma_yy. oedometer: no strain across z; from an initial stress it is "
      "the test called K0. isotropic: normal stresses change alike. biaxial: "
      "sigma_xx stays, eps_yy = 0. simple shear: gamma_xz alone, and sigma_zz "
      "or the height stays. In these eps_zz or sigma_zz is driven, in simple "
      "shear gamma_xz or sigma_xz. general: key 'Control'.",
      patterns::selection(names));
    prm.add_parameter("Initial stress",
                      initial_stress,
                      "sigma_xx, sigma_yy, sigma_zz, sigma_xy, sigma_xz, "
                      "sigma_yz [stress, tension positive]; those left out are "
                      "0.",
                      patterns::numbers(3, 6));
    prm.add_parameter(
      "Legs",
      legs,
      "Of 'moraine test-material': parts of the test, separated by commas. 'to "
      "strain -0.1', 'to stress -200': what is driven goes there [-; stress]. "
      "'until q = 0', 'until p = -50': q (triaxial tests, oedometer) or p goes "
      "there; q is positive where z is compressed most, p as stresses. '50 "
      "cycles': the legs since the last such word run 50 times in all. With "
      "'Kind = general' 'to 1': to the values of 'Control', 'to 0': back to "
      "the initial ones, with any factor.",
      patterns::NumberText());
    prm.add_parameter("Steps",
                      steps,
                      "Of each leg. One that has no answer is halved, up to a "
                      "1024th.",
                      patterns::integer_in_range(1, most_test_steps));
    prm.add_parameter(
      "Control",
      control,
      "Of 'Kind = general': stress or strain of components, 'strain xx -0.01; "
      "stress yy 0'. The strain of a shear component is the angle, 2 eps_xz of "
      "xz. Stresses that are not named stay.",
      patterns::NumberText());
    prm.add_parameter("Measured",
                      measured,
                      "CSV file, seen from the folder of the scene, that is "
                      "drawn over the result. Its columns have names of those "
                      "in the result.");
  }



  SymmetricTensor<2, 3>
  MaterialTestParameters::stress() const
  {
    SymmetricTensor<2, 3> result;
    for (unsigned int I = 0; I < initial_stress.size(); ++I)
      result[voigt_pairs<3>()[I][0]][voigt_pairs<3>()[I][1]] =
        initial_stress[I];
    return result;
  }



  std::vector<MaterialTestLeg>
  MaterialTestParameters::all_legs() const
  {
    const auto texts = Utilities::split_string_list(legs, ',');
    if (texts.empty())
      refuse_leg(legs, "at least one leg, as 'to strain -0.1'");
    if (kind != "general" && !control.empty())
      reject(test_section,
             "Control",
             control,
             "nothing with 'Kind = " + kind + "'");
    std::vector<MaterialTestLeg> all;
    std::size_t                  first = 0;
    for (const std::string &text : texts)
      {
        const auto        n_cycles = cycles_of(text);
        const std::size_t n_legs   = all.size() - first;
        if (n_cycles && n_legs == 0)
          refuse_leg(text, "legs before it that it repeats");
        const double n_more = n_cycles ? n_legs * (*n_cycles - 1.) : 1.;
        if ((all.size() + n_more) * steps > most_test_steps)
          refuse_leg(text, "at most 1000000 steps in all");
        if (!n_cycles)
          {
            all.push_back(kind == "general" ?
                            general_leg(control, text) :
                            simple_leg(test_kind(kind), text));
            all.back().text    = text;
            all.back().n_steps = steps;
            continue;
          }
        for (unsigned int i = 0; i < n_more; ++i)
          all.push_back(MaterialTestLeg(all[all.size() - n_legs]));
        first = all.size();
      }
    return all;
  }
} // namespace moraine
