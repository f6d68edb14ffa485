// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_material_umat_h
#define moraine_material_umat_h

#include <moraine/material/material_input.h>
#include <moraine/material/umat_library.h>

#include <memory>
#include <string>
#include <vector>

namespace moraine
{
  /**
   * A law in a subroutine UMAT as for Abaqus/Standard; plane strain is the 3D
   * law. At finite strain, with @f$\Delta F = F_{n+1} F_n^{-1}@f$ and
   * @f$\Delta C = \Delta F^T \Delta F@f$, it gets
   * @f$\Delta\varepsilon = \frac12 \ln \Delta C@f$ and makes T of
   * @f$\sigma_n@f$; then
   * @f[
   *   \tau = J \sigma_{n+1} = J\, \Delta F \left(T :
   *     \frac{\partial \ln \Delta C}{\partial \Delta C}\right) \Delta F^T .
   * @f]
   * Or it gets strain and rotation of Hughes and Winget (1980), as in Abaqus;
   * the tangent is then exact for an isotropic law and without spin only.
   */
  class Umat : public Material
  {
  public:
    struct Parameters
    {
      std::string         file, symbol = "umat";
      std::vector<double> constants;
      std::vector<double> state;                       ///< at the start
      bool                by_sdvini           = false; ///< SDVINI sets it
      bool                hughes_winget       = false;
      bool                symmetrises_tangent = false;
      double              density             = 0;
      std::string         name; ///< `CMNAME`
    };

    /** @throws InputError if there is no such UMAT, or if it has no stiffness
     * at the start. */
    explicit Umat(const Parameters &parameters);

    using Material::respond;

    void
    respond(const StepTime                       &time,
            const StrainMeasure                   measure,
            const dealii::ArrayView<TensorState> &points) const override;

    bool
    is_isotropic() const override
    {
      return false;
    }

    /** The state variables, then the strain (`STRAN`). */
    std::vector<InternalVariable>
    internal_variables() const override;

    /** As stiff as the stiffest direction, without strain at the start. */
    LameConstants
    elastic_stiffness() const override
    {
      return stiffness;
    }

    double
    density() const override
    {
      return parameters.density;
    }

    bool
    is_linear() const override
    {
      return false;
    }

    bool
    has_symmetric_tangent() const override
    {
      return parameters.symmetrises_tangent;
    }

    bool
    dissipates() const override
    {
      return true;
    }

    /** Most are soils. */
    bool
    has_friction() const override
    {
      return true;
    }

    double
    least_stiffness() const override
    {
      return 1e-8;
    }

    std::string
    why_no_stress() const override;

    double
    wanted_cut(const StepTime &time) const override;

    std::string
    how_made() const override
    {
      return library->compilation();
    }

  private:
    /** Points that had no stress in the step that was tried last. */
    struct Failure
    {
      StepTime time;
      double   least_new_step = 1; ///< `PNEWDT`
    };

    /** Call it. @return whether it takes the step and its stress is a number;
     * as in the others. */
    bool
    ask(UmatCall &call) const;

    bool
    respond_small(UmatCall &call, TensorState &point) const;

    bool
    respond_by_logarithm(UmatCall &call, TensorState &point) const;

    bool
    respond_by_hughes_winget(UmatCall &call, TensorState &point) const;

    Parameters                         parameters;
    std::shared_ptr<const UmatLibrary> library;
    LameConstants                      stiffness{0, 0};
    std::shared_ptr<Failure>           failure;
  };

  MaterialModel
  umat_model();
} // namespace moraine

#endif
