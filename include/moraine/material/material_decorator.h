// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_material_material_decorator_h
#define moraine_material_material_decorator_h

#include <moraine/material/material.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace moraine
{
  /** A material that answers as another one does, unless a derived class says
   * otherwise. */
  class MaterialDecorator : public Material
  {
  public:
    explicit MaterialDecorator(std::shared_ptr<const Material> inner)
      : inner(std::move(inner))
    {}

    bool
    is_isotropic() const override
    {
      return inner->is_isotropic();
    }

    void
    respond(const StepTime                          &time,
            const dealii::ArrayView<PrincipalState> &points) const override
    {
      inner->respond(time, points);
    }

    void
    respond(const StepTime                       &time,
            const StrainMeasure                   measure,
            const dealii::ArrayView<TensorState> &points) const override
    {
      inner->respond(time, measure, points);
    }

    std::vector<InternalVariable>
    internal_variables() const override
    {
      return inner->internal_variables();
    }

    LameConstants
    elastic_stiffness() const override
    {
      return inner->elastic_stiffness();
    }

    LameConstants
    elastic_stiffness_at(const double *internal) const override
    {
      return inner->elastic_stiffness_at(internal);
    }

    bool
    has_uniform_stiffness() const override
    {
      return inner->has_uniform_stiffness();
    }

    bool
    has_linear_elasticity() const override
    {
      return inner->has_linear_elasticity();
    }

    dealii::SymmetricTensor<2, 3>
    elastic_strain_of(const dealii::SymmetricTensor<2, 3> &stress,
                      const double *internal) const override
    {
      return inner->elastic_strain_of(stress, internal);
    }

    void
    initialise(const dealii::SymmetricTensor<2, 3> &stress,
               const unsigned int                   vertical,
               double                              *internal) const override
    {
      inner->initialise(stress, vertical, internal);
    }

    double
    K0(const double pressure, const double *internal) const override
    {
      return inner->K0(pressure, internal);
    }

    double
    density() const override
    {
      return inner->density();
    }

    bool
    is_linear() const override
    {
      return inner->is_linear();
    }

    bool
    has_symmetric_tangent() const override
    {
      return inner->has_symmetric_tangent();
    }

    bool
    has_friction() const override
    {
      return inner->has_friction();
    }

    double
    least_stiffness() const override
    {
      return inner->least_stiffness();
    }

    bool
    has_small_strain_limit() const override
    {
      return inner->has_small_strain_limit();
    }

    void
    stored_energies(const dealii::ArrayView<const ElasticPoint> &points,
                    const dealii::ArrayView<double> &energies) const override
    {
      inner->stored_energies(points, energies);
    }

    bool
    dissipates() const override
    {
      return inner->dissipates();
    }

    double
    dissipated_by_water(const double        trial_volume,
                        const ElasticPoint &at_end,
                        const double       *at_start) const override
    {
      return inner->dissipated_by_water(trial_volume, at_end, at_start);
    }

    std::shared_ptr<const Material>
    with_strength_over(const double factor) const override
    {
      return inner->with_strength_over(factor);
    }

    std::string
    why_no_stress() const override
    {
      return inner->why_no_stress();
    }

    double
    wanted_cut(const StepTime &time) const override
    {
      return inner->wanted_cut(time);
    }

    std::string
    how_made() const override
    {
      return inner->how_made();
    }

  protected:
    const std::shared_ptr<const Material> inner;
  };
} // namespace moraine

#endif
