// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_material_neo_hookean_h
#define moraine_material_neo_hookean_h

#include <moraine/material/material_input.h>

namespace moraine
{
  /**
   * Compressible neo-Hookean elasticity with the stored energy
   * @f$\frac{\mu}{2}(\mathrm{tr}\, b - 3) - \mu \ln J +
   * \frac{\lambda}{2} (\ln J)^2@f$ per initial volume (Simo and Pister 1984),
   * @f[
   *   \tau = \mu (b - 1) + \lambda \ln J\, 1, \qquad
   *   \tau_A = \mu (e^{2\varepsilon_A} - 1) + \lambda \sum_B \varepsilon_B,
   *   \qquad D_{AB} = 2\mu e^{2\varepsilon_A} \delta_{AB} + \lambda .
   * @f]
   * A law of finite strain: at small strain it is linear elasticity.
   */
  class NeoHookean : public IsotropicMaterial
  {
  public:
    using IsotropicMaterial::IsotropicMaterial;
    using Material::respond;

    void
    respond(const StepTime                          &time,
            const dealii::ArrayView<PrincipalState> &points) const override;

    void
    stored_energies(const dealii::ArrayView<const ElasticPoint> &points,
                    const dealii::ArrayView<double> &energies) const override;

    bool
    has_small_strain_limit() const override
    {
      return false;
    }
  };

  MaterialModel
  neo_hookean_model();
} // namespace moraine

#endif
