// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_material_material_library_h
#define moraine_material_material_library_h

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

    /**
     * The yield stress of von Mises: exactly one of these is set, and its name
     * says what it means. Each is a number or a table over the accumulated
     * plastic strain.
     */
    std::string uniaxial_yield_stress; ///< @f$\sigma_y@f$
    std::string shear_yield_stress;    ///< k
    std::string yield_radius;          ///< @f$\|s\| = \sqrt{2 J_2}@f$

    /**
     * Width l of the band for which the softening of the table holds; 0: of
     * any. In cells of size h plastic strains beyond the peak are l/h times
     * as large, so that a band of one cell dissipates the same per area in any
     * mesh (crack band, Bazant and Oh 1983).
     */
    double softening_length = 0;

    void
    add_parameters(dealii::ParameterHandler &prm);

    bool
    yields() const
    {
      return !uniaxial_yield_stress.empty() || !shear_yield_stress.empty() ||
             !yield_radius.empty();
    }

    /** Whether elements of degree 1 may lock: it yields, which keeps volume,
     * or has a Poisson ratio above 0.4. */
    bool
    hardly_changes_volume() const
    {
      return poisson_ratio > 0.4 || yields();
    }
  };

  /**
   * The material of a section.
   *
   * @p cell_size is that of all cells; 0 if it does not matter yet: softening
   * is that of the table then.
   *
   * @throws InputError naming the section for values a material cannot have.
   */
  std::shared_ptr<const Material>
  make_material(const MaterialParameters &parameters,
                const std::string        &section,
                const double              cell_size = 0);
} // namespace moraine

#endif
