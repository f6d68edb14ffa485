// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_material_linear_elastic_h
#define moraine_material_linear_elastic_h

#include <moraine/material/material.h>

namespace moraine
{
  /**
   * Stress linear in strain: Hooke's law at small strain, Hencky's (Kirchhoff
   * stress and logarithmic strain) at finite strain,
   * @f$\tau = C : \varepsilon^e@f$.
   */
  class LinearElastic : public Material
  {
  public:
    /** @param E > 0 [stress], @param nu in (-1, 0.5), @param rho mass density
     */
    LinearElastic(const double E, const double nu, const double rho);

    using Material::respond;

    void
    respond(const StepTime                          &time,
            const dealii::ArrayView<PrincipalState> &points) const override;

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

    bool
    is_linear() const override
    {
      return true;
    }

  private:
    const LameConstants stiffness;
    const double        rho;
  };
} // namespace moraine

#endif
