// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_material_linear_elastic_h
#define moraine_material_linear_elastic_h

#include <moraine/material/material.h>

#include <deal.II/base/parameter_handler.h>

#include <memory>
#include <string>

namespace moraine
{
  /** Section `Materials/<name>`. */
  struct MaterialParameters
  {
    std::string model         = "linear elastic";
    double      young_modulus = 0;
    double      poisson_ratio = 0;
    double      density       = 0;

    void
    add_parameters(dealii::ParameterHandler &prm);
  };

  /** Linear elasticity at small strain with Young's modulus and Poisson's
   * ratio. */
  class LinearElastic : public Material
  {
  public:
    /** @param E > 0 [stress], @param nu in (-1, 0.5), @param rho mass density
     */
    LinearElastic(const double E, const double nu, const double rho);

    void
    update_stress(const dealii::ArrayView<const dealii::SymmetricTensor<2, 3>>
                    &strain_increment,
                  const dealii::ArrayView<dealii::SymmetricTensor<2, 3>>
                    &stress) const override;

    LameConstants
    elastic_stiffness() const override
    {
      return stiffness;
    }

    double
    density() const override
    {
      return rho;
    }

  private:
    const LameConstants stiffness;
    const double        rho;
  };

  /**
   * The material of a section.
   *
   * @throws InputError naming the section for values a material cannot have.
   */
  std::shared_ptr<const Material>
  make_material(const MaterialParameters &parameters,
                const std::string        &section);
} // namespace moraine

#endif
