// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_material_elastic_state_h
#define moraine_material_elastic_state_h

#include <moraine/material/material.h>

#include <vector>

namespace moraine
{
  /** Elastic strain and stress of an isotropic material, by principal values.
   */
  struct ElasticState
  {
    dealii::Tensor<1, 3> strain;
    dealii::Tensor<1, 3> stress;
  };

  /**
   * The elastic strain at which @p material has the principal @p stress, by
   * Newton's method, with the @p internal variables it has there. Where it
   * would yield before, or has no such strain, the answer is another stress:
   * the one that it returns to, or the last that was tried.
   */
  ElasticState
  elastic_state(const Material             &material,
                const dealii::Tensor<1, 3> &stress,
                const std::vector<double>  &internal);

  /** The stress that @p material, which is not isotropic, has where it has @p
   * stress and is not strained; at finite strain if it is not deformed. */
  dealii::SymmetricTensor<2, 3>
  stress_unstrained(const Material                      &material,
                    const StrainMeasure                  measure,
                    const dealii::SymmetricTensor<2, 3> &stress,
                    const std::vector<double>           &internal);
} // namespace moraine

#endif
