// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_scene_material_test_parameters_h
#define moraine_scene_material_test_parameters_h

#include <moraine/material/material_test.h>

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <vector>

namespace moraine
{
  /** Section `Material test`; a run does not look at it. */
  struct MaterialTestParameters
  {
    std::string         kind           = "triaxial drained";
    std::vector<double> initial_stress = {0, 0, 0};
    std::string         legs;
    unsigned int        steps = 100;
    std::string         control;
    std::string         measured;

    void
    add_parameters(dealii::ParameterHandler &prm);

    dealii::SymmetricTensor<2, 3>
    stress() const;

    /** Whether it is loaded along z and q has a sign. */
    bool
    has_axis() const
    {
      return kind != "general" && !shears();
    }

    bool
    shears() const
    {
      return kind.rfind("simple shear", 0) == 0;
    }

    /** The component whose total stress stays where water cannot leave; -1 if
     * it can. */
    int
    drained_component() const
    {
      return kind == "triaxial undrained"           ? 0 :
             kind == "simple shear constant height" ? 2 :
                                                      -1;
    }

    /** The legs in their order, those of cycles again and again.
     * @throw InputError for what is no leg, or none of this kind of test. */
    std::vector<MaterialTestLeg>
    all_legs() const;
  };
} // namespace moraine

#endif
