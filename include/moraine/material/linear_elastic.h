// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_material_linear_elastic_h
#define moraine_material_linear_elastic_h

#include <moraine/material/material_input.h>

namespace moraine
{
  /**
   * Stress linear in strain: Hooke's law at small strain, Hencky's (Kirchhoff
   * stress and logarithmic strain) at finite strain,
   * @f$\tau = C : \varepsilon^e@f$.
   */
  class LinearElastic : public IsotropicMaterial
  {
  public:
    using IsotropicMaterial::IsotropicMaterial;
    using Material::respond;

    void
    respond(const StepTime                          &time,
            const dealii::ArrayView<PrincipalState> &points) const override;

    bool
    is_linear() const override
    {
      return has_uniform_stiffness();
    }
  };

  MaterialModel
  linear_elastic_model();
} // namespace moraine

#endif
