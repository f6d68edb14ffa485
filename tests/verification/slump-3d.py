# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A cube that yields under its own weight, in 3D at finite strain: the base
carries the weight, direct and multigrid solutions are one."""

SCENE = "prm/large-deformation/slump-3d.prm"
TOP = {"Probes/top/Location": "0.5, 0.5, 0.9"}
WEIGHT = 1000 * 10

tops = {}
for name, limit in (("direct", 1000000), ("multigrid", 0)):
    result = run(SCENE, {**QUIET, **TOP, "Solver/Direct limit 3D": limit})
    last = result.history()[-1]
    text(name, result.summary["status"])
    text(f"{name}, Newton iterations", result.summary["newton_iterations"])
    bound(f"{name}: reaction of the base over the weight",
          last["reaction_z of base"] / WEIGHT - 1, 1e-8)
    for axis in "xy":
        bound(f"{name}: reaction_{axis} of the base over the weight",
              last[f"reaction_{axis} of base"] / WEIGHT, 1e-8)
    tops[name] = next(value for key, value in last.items()
                      if key.startswith("u_z at top"))
    number(f"{name}: u_z at the top", tops[name], 4)
    text(f"{name}: linear iterations",
         "none" if result.summary["linear_iterations"] == 0 else "some")
bound("multigrid over direct, u_z at the top",
      tops["multigrid"] / tops["direct"] - 1, 1e-7)
