// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_material_material_h
#define moraine_material_material_h

#include <deal.II/base/array_view.h>
#include <deal.II/base/symmetric_tensor.h>

namespace moraine
{
  /**
   * The isotropic stiffness
   * @f$C = \lambda\, 1\otimes 1 + 2\mu\, \mathbb{I}@f$.
   */
  struct LameConstants
  {
    double lambda; ///< @f$\lambda = E\nu/((1+\nu)(1-2\nu))@f$ [stress]
    double mu;     ///< @f$\mu = E/(2(1+\nu))@f$ [stress]

    /** The stress increment @f$\Delta\sigma = C : \Delta\varepsilon@f$. */
    dealii::SymmetricTensor<2, 3>
    operator*(const dealii::SymmetricTensor<2, 3> &strain) const
    {
      return lambda * dealii::trace(strain) *
               dealii::unit_symmetric_tensor<3>() +
             2. * mu * strain;
    }
  };

  /**
   * A material: a pure function of the committed state of a point and the
   * strain increment of the step. It knows no mesh and no neighbours. Plane
   * strain is the 3D law with a plane strain increment, so that the
   * out-of-plane stress is kept.
   */
  class Material
  {
  public:
    virtual ~Material() = default;

    /**
     * Trial stresses of a block of points,
     * @f$\sigma_n = \sigma_{n-1} + C : \Delta\varepsilon@f$ for an elastic one
     * (Cortis et al. 2017, eq. 10).
     *
     * @param strain_increment @f$\Delta\varepsilon@f$ of each point.
     * @param stress on entry the committed stress, on exit the trial stress.
     */
    virtual void
    update_stress(
      const dealii::ArrayView<const dealii::SymmetricTensor<2, 3>>
                                                             &strain_increment,
      const dealii::ArrayView<dealii::SymmetricTensor<2, 3>> &stress) const = 0;

    /** The elastic stiffness, by which boundaries scale their enforcement. */
    virtual LameConstants
    elastic_stiffness() const = 0;

    /** Mass per volume. */
    virtual double
    density() const = 0;
  };
} // namespace moraine

#endif
