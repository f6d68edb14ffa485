// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/material/material_library.h>

#include <moraine/core/exceptions.h>
#include <moraine/core/expression.h>
#include <moraine/core/patterns.h>
#include <moraine/material/linear_elastic.h>
#include <moraine/material/neo_hookean.h>
#include <moraine/material/von_mises.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** One of the ways to give the yield stress. */
    struct YieldKey
    {
      std::string name;
      std::string MaterialParameters::*text;

      /** ||s|| over the value of the key. */
      double radius_factor;

      std::string meaning;
    };



    const std::array<YieldKey, 3> &
    yield_keys()
    {
      static const std::array<YieldKey, 3> keys{
        {{"Uniaxial yield stress",
          &MaterialParameters::uniaxial_yield_stress,
          std::sqrt(2. / 3.),
          "the yield stress sigma_y in uniaxial tension. The yield radius is "
          "||s|| = sqrt(2/3) sigma_y"},
         {"Shear yield stress",
          &MaterialParameters::shear_yield_stress,
          std::sqrt(2.),
          "the yield stress k in shear. The yield radius is ||s|| = sqrt(2) k, "
          "and sigma_y = sqrt(3) k"},
         {"Yield radius",
          &MaterialParameters::yield_radius,
          1.,
          "||s|| = sqrt(2 J2) at yield, with the deviator s of the stress. It "
          "is sqrt(2/3) sigma_y and sqrt(2) k"}}};
      return keys;
    }



    std::string
    as_text(const double value)
    {
      std::ostringstream text;
      text << value;
      return text.str();
    }



    /** The key that gives the yield stress. @throw InputError if it is not
     * exactly one. */
    const YieldKey &
    given_yield_key(const MaterialParameters &parameters,
                    const std::string        &section)
    {
      const YieldKey *given = nullptr;
      for (const YieldKey &key : yield_keys())
        if (!(parameters.*key.text).empty())
          {
            if (given)
              reject(section,
                     key.name,
                     parameters.*key.text,
                     "nothing; '" + given->name + "' gives the yield stress");
            given = &key;
          }
      if (!given)
        reject(section,
               yield_keys()[0].name,
               "",
               "a yield stress > 0, in this key, in '" + yield_keys()[1].name +
                 "' or in '" + yield_keys()[2].name + "'");
      return *given;
    }



    /**
     * Stretch the plastic strains of a table of yield stresses beyond its peak
     * by MaterialParameters::softening_length over the size of the cells.
     * @throw InputError if it has no peak.
     */
    void
    stretch_softening(const MaterialParameters      &parameters,
                      const std::string             &section,
                      const double                   cell_size,
                      std::vector<LinearTable::Row> &rows)
    {
      if (parameters.softening_length == 0)
        return;
      const auto falls =
        std::adjacent_find(rows.begin(),
                           rows.end(),
                           [](const auto &row, const auto &next) {
                             return next.second < row.second;
                           });
      if (falls == rows.end())
        reject(section,
               "Softening length",
               as_text(parameters.softening_length),
               "nothing; the yield stress does not fall");
      const double peak    = falls->first;
      const double stretch = parameters.softening_length / cell_size;
      if (cell_size > 0)
        for (auto row = falls; row != rows.end(); ++row)
          row->first = peak + stretch * (row->first - peak);
    }



    /**
     * Pairs of accumulated plastic strain and yield radius, from @p key.
     * @param G shear modulus [stress]
     * @param cell_size see make_material()
     * @throw InputError for what cannot be a yield stress, or falls so steeply
     * that no stress returns to it.
     */
    std::vector<LinearTable::Row>
    read_yield_radius(const MaterialParameters &parameters,
                      const YieldKey           &key,
                      const std::string        &section,
                      const double              G,
                      const double              cell_size)
    {
      const std::string            &text = parameters.*key.text;
      std::vector<LinearTable::Row> rows =
        LinearTable(text, place(section, key.name), "kappa").rows();
      const auto refuse = [&](const std::string &allowed) {
        reject(section, key.name, text, allowed);
      };

      if (rows.size() == 1 && text.find(':') != std::string::npos)
        refuse("a number, or a table with at least two rows");
      if (rows.front().first != 0)
        refuse("a table whose first kappa is 0");
      stretch_softening(parameters, section, cell_size, rows);
      const double steepest = -std::sqrt(6.) * G / key.radius_factor;
      for (std::size_t i = 0; i < rows.size(); ++i)
        {
          if (!(rows[i].second > 0))
            refuse("yield stresses > 0");
          if (i == 0)
            continue;
          const double slope = (rows[i].second - rows[i - 1].second) /
                               (rows[i].first - rows[i - 1].first);
          // Unknown before the cells are, if they stretch it.
          const bool is_known =
            parameters.softening_length == 0 || cell_size > 0;
          if (is_known && !(slope > steepest))
            refuse("a slope above " + as_text(steepest) +
                   ", where sigma_y falls by 3G; between kappa = " +
                   as_text(rows[i - 1].first) + " and " +
                   as_text(rows[i].first) + " it is " + as_text(slope) +
                   (parameters.softening_length > 0 ?
                      ", by 'Softening length' in cells of " +
                        as_text(cell_size) + "; smaller ones soften less" :
                      ""));
        }
      for (LinearTable::Row &row : rows)
        row.second *= key.radius_factor;
      return rows;
    }
  } // namespace



  void
  MaterialParameters::add_parameters(ParameterHandler &prm)
  {
    prm.add_parameter(
      "Model",
      model,
      "The constitutive law. linear elastic: stress linear in strain; at finite "
      "strain Kirchhoff stress in logarithmic strain (Hencky). neo-Hookean: "
      "Kirchhoff stress mu (b - 1) + lambda ln(J), with the left Cauchy-Green "
      "tensor b; for finite strain. von Mises: linear elastic up to a yield "
      "stress, then plastic with associated flow, and hardening or softening "
      "if the yield stress is a table. The stress that yields is Kirchhoff's "
      "at finite strain.",
      patterns::selection({"linear elastic", "neo-Hookean", "von Mises"}));
    prm.add_parameter("Young modulus",
                      young_modulus,
                      "Young's modulus E > 0 (stress), required.",
                      patterns::number());
    prm.add_parameter("Poisson ratio",
                      poisson_ratio,
                      "Poisson's ratio, larger than -1 and smaller than 0.5, "
                      "required.",
                      patterns::number());
    prm.add_parameter("Density",
                      density,
                      "Mass density (mass / length^3); needed for gravity.",
                      patterns::non_negative());
    for (const YieldKey &key : yield_keys())
      prm.add_parameter(
        key.name,
        this->*key.text,
        "One of three ways to give the yield stress of von Mises (stress): " +
          key.meaning +
          ". A number, or a table 'kappa: value, kappa: value, ...' over the "
          "accumulated plastic strain kappa (that of uniaxial tension), from "
          "kappa = 0 on; linear in between, constant after the last.",
        Patterns::Anything());
    prm.add_parameter(
      "Softening length",
      softening_length,
      "Of von Mises with a yield stress that falls: the width of the band for "
      "which the table holds (length). Plastic strains beyond the peak are "
      "multiplied by this over the cell size, the mean edge of the cells of a "
      "box mesh, so that a band of one cell dissipates the same energy per "
      "area in any mesh. 0: the table holds for cells of any size, and what a "
      "band dissipates falls with them.",
      patterns::non_negative());
  }



  std::shared_ptr<const Material>
  make_material(const MaterialParameters &parameters,
                const std::string        &section,
                const double              cell_size)
  {
    const double E   = parameters.young_modulus;
    const double nu  = parameters.poisson_ratio;
    const double rho = parameters.density;
    if (!(E > 0))
      reject(section, "Young modulus", as_text(E), "a number > 0");
    if (!(nu > -1 && nu < 0.5))
      reject(section, "Poisson ratio", as_text(nu), "a number > -1 and < 0.5");

    if (parameters.model == "von Mises")
      return std::make_shared<VonMises>(
        E,
        nu,
        rho,
        read_yield_radius(parameters,
                          given_yield_key(parameters, section),
                          section,
                          lame_constants(E, nu).mu,
                          cell_size));
    if (parameters.softening_length > 0)
      reject(section,
             "Softening length",
             as_text(parameters.softening_length),
             "nothing; key 'Model' is '" + parameters.model + "'");
    for (const YieldKey &key : yield_keys())
      if (!(parameters.*key.text).empty())
        reject(section,
               key.name,
               parameters.*key.text,
               "nothing; key 'Model' is '" + parameters.model + "'");
    if (parameters.model == "neo-Hookean")
      return std::make_shared<NeoHookean>(E, nu, rho);
    Assert(parameters.model == "linear elastic", ExcInternalError());
    return std::make_shared<LinearElastic>(E, nu, rho);
  }
} // namespace moraine
