// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_material_material_input_h
#define moraine_material_material_input_h

#include <moraine/core/expression.h>
#include <moraine/material/material.h>
#include <moraine/material/parameter.h>
#include <moraine/material/undrained.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/patterns.h>

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace moraine
{
  /** A key of material models. Models that share one declare it alike. */
  struct MaterialKey
  {
    MaterialKey(const std::string                   &name,
                const std::string                   &documentation,
                const std::string                   &default_text = "",
                const dealii::Patterns::PatternBase &pattern =
                  dealii::Patterns::Anything())
      : name(name)
      , documentation(documentation)
      , default_text(default_text)
      , pattern(pattern.clone())
    {}

    std::string                                          name;
    std::string                                          documentation;
    std::string                                          default_text;
    std::shared_ptr<const dealii::Patterns::PatternBase> pattern;
  };

  /** Section `Materials/<name>`. */
  struct MaterialParameters
  {
    std::string                        model = "linear elastic";
    std::map<std::string, std::string> texts; ///< of all keys but `Model`
    unsigned int                       dim = 2;

    void
    add_parameters(dealii::ParameterHandler &prm);
  };

  /** Where a material is, as far as its parameters depend on it. */
  struct MaterialPlace
  {
    double cell_size = 0; ///< of all cells; 0 if it is not known yet
    std::optional<dealii::Point<3>> middle;  ///< of the body, if it is known
    std::vector<DrainedSpan>        drained; ///< when its water flows
  };

  /** Reads the keys of one material. @throws InputError naming section, key,
   * value and what is allowed. */
  class MaterialInput
  {
  public:
    /**
     * @param parameters the texts of the keys
     * @param section of messages, as "Materials/clay"
     * @param place where the material is
     */
    MaterialInput(const MaterialParameters &parameters,
                  const std::string        &section,
                  const MaterialPlace      &place);

    const std::string &
    text(const std::string &key) const
    {
      return parameters.texts.at(key);
    }

    /** Of the scene. */
    unsigned int
    dim() const
    {
      return parameters.dim;
    }

    /** Whether the scene gives it. */
    bool
    has(const std::string &key) const
    {
      return !text(key).empty();
    }

    [[noreturn]] void
    refuse(const std::string &key, const std::string &allowed) const;

    /** A number that is the same everywhere. */
    double
    number(const std::string &key) const;

    /** The same for a key without default, in a range. */
    double
    number(const std::string &key, const NumberRange &range) const;

    /** A number or an expression in x, y, z, which becomes one of fields() of
     * the name @p key and the @p unit. Points check @p range where they start.
     */
    Parameter
    parameter(const std::string &key,
              const NumberRange &range,
              const std::string &unit);

    /** The rows of a table over the plastic strain kappa, or of one number.
     * `Softening length` over the cell size stretches the strains beyond the
     * row from which the values fall. */
    std::vector<LinearTable::Row>
    table(const std::string &key);

    /** After the tables: refuse `Softening length` if no strength falls. */
    void
    check_softening_length() const;

    /** Whether it is a table, not a number or an expression. */
    bool
    is_table(const std::string &key) const
    {
      return text(key).find(':') != std::string::npos &&
             text(key).find('?') == std::string::npos;
    }

    /** The parameters that differ from place to place, so far. */
    const std::vector<InternalVariable> &
    fields() const
    {
      return variables;
    }

    const std::string   section;
    const MaterialPlace place;

  private:
    const MaterialParameters     &parameters;
    std::vector<InternalVariable> variables;
    bool                          any_falls = false; ///< of tables so far
  };

  /** A constitutive model: its keys, and how to make a material from them. */
  struct MaterialModel
  {
    std::string              name;    ///< the value of key `Model`
    std::string              meaning; ///< in the text of that key
    std::vector<MaterialKey> keys;    ///< beside `Model` and `Density`

    std::function<std::shared_ptr<const Material>(MaterialInput &)> make;

    bool is_isotropic = true; ///< and has drainage_keys()
  };

  /** `Young modulus` and `Poisson ratio`. */
  std::vector<MaterialKey>
  elastic_keys();

  /** The isotropic elasticity that a scene gives by elastic_keys(), and the
   * density. */
  IsotropicElasticity
  read_elasticity(MaterialInput &input);

  /** `Softening length` */
  MaterialKey
  softening_key();
} // namespace moraine

#endif
