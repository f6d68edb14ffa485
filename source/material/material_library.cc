// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/material/material_library.h>

#include <moraine/core/arithmetic.h>
#include <moraine/core/exceptions.h>
#include <moraine/core/patterns.h>
#include <moraine/core/ranges.h>
#include <moraine/core/words.h>
#include <moraine/material/cam_clay.h>
#include <moraine/material/drucker_prager.h>
#include <moraine/material/linear_elastic.h>
#include <moraine/material/mohr_coulomb.h>
#include <moraine/material/neo_hookean.h>
#include <moraine/material/umat.h>
#include <moraine/material/von_mises.h>

#include <algorithm>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    const MaterialKey &
    density_key()
    {
      static const MaterialKey key("Density",
                                   "Mass density (mass / length^3); needed for "
                                   "gravity.",
                                   "0",
                                   patterns::non_negative());
      return key;
    }



    const MaterialKey &
    saturated_density_key()
    {
      static const MaterialKey key("Saturated density",
                                   "With section 'Water': mass density below "
                                   "the phreatic line, above 'Density' "
                                   "(mass / length^3); 'Density' if left out.",
                                   "",
                                   Patterns::Anything());
      return key;
    }



    /** The keys of all models, each once. */
    const std::vector<MaterialKey> &
    all_keys()
    {
      static const std::vector<MaterialKey> keys = [] {
        std::vector<MaterialKey> result;
        for (const MaterialModel &model : material_models())
          {
            for (const MaterialKey &key : model.keys)
              if (!any_of(result, [&](const MaterialKey &known) {
                    return known.name == key.name;
                  }))
                result.push_back(key);
            if (result.size() == model.keys.size())
              {
                result.push_back(density_key());
                result.push_back(saturated_density_key());
              }
          }
        result.insert(result.end(),
                      drainage_keys().begin(),
                      drainage_keys().end());
        return result;
      }();
      return keys;
    }
  } // namespace



  const std::vector<MaterialModel> &
  material_models()
  {
    static const std::vector<MaterialModel> models{linear_elastic_model(),
                                                   neo_hookean_model(),
                                                   von_mises_model(),
                                                   mohr_coulomb_model(),
                                                   tresca_model(),
                                                   drucker_prager_model(),
                                                   cam_clay_model(),
                                                   umat_model()};
    return models;
  }



  void
  MaterialParameters::add_parameters(ParameterHandler &prm)
  {
    std::vector<std::string> names;
    std::string              meanings;
    for (const MaterialModel &known : material_models())
      {
        names.push_back(known.name);
        meanings += " " + known.name + ": " + known.meaning + ".";
      }
    prm.add_parameter("Model",
                      model,
                      "The constitutive law." + meanings,
                      patterns::selection(names));
    for (const MaterialKey &key : all_keys())
      {
        texts[key.name] = key.default_text;
        prm.add_parameter(key.name,
                          texts[key.name],
                          key.documentation,
                          *key.pattern);
      }
  }



  std::shared_ptr<const Material>
  make_material(const MaterialParameters &parameters,
                const std::string        &section,
                const MaterialPlace      &place)
  {
    const MaterialModel &model =
      *std::find_if(material_models().begin(),
                    material_models().end(),
                    [&](const MaterialModel &known) {
                      return known.name == parameters.model;
                    });
    MaterialInput            input(parameters, section, place);
    std::vector<std::string> own{density_key().name,
                                 saturated_density_key().name};
    for (const MaterialKey &key : model.keys)
      own.push_back(key.name);
    const auto is_drainage = [](const MaterialKey &key) {
      return any_of(drainage_keys(), [&](const MaterialKey &known) {
        return known.name == key.name;
      });
    };
    for (const MaterialKey &key : all_keys())
      if (!contains(own, key.name) &&
          !(model.is_isotropic && is_drainage(key)) &&
          input.text(key.name) != key.default_text &&
          !(number_from(key.default_text) &&
            number_from(input.text(key.name)) == number_from(key.default_text)))
        input.refuse(key.name,
                     is_drainage(key) ?
                       "nothing; what water does is a matter of the " +
                         model.name :
                       "nothing; the keys of '" + model.name + "' are " +
                         list_of(own));
    return model.is_isotropic ? with_drainage(model.make(input), input) :
                                model.make(input);
  }



  double
  extra_density_of(const MaterialParameters &parameters,
                   const std::string        &section)
  {
    const std::string &key  = saturated_density_key().name;
    const std::string &text = parameters.texts.at(key);
    if (text.empty())
      return 0.;
    const auto   found = number_from(text);
    const double density =
      Utilities::string_to_double(parameters.texts.at(density_key().name));
    if (!found || !(*found >= density))
      reject(section,
             key,
             text,
             "a number >= " + text_of(density) + ", its 'Density'");
    return *found - density;
  }
} // namespace moraine
