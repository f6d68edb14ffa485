# ranks: 2  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
# Contained block (Cortis et al. 2017, section 5.1, table 1) at five places
# against the mesh, and a cube.
paper = {"Boundaries/*/Enforcement": "weighted",
         "Boundaries/*/Band width": 1e-6,
         "Boundaries/*/Held in a cell": "places"}

def stress_errors(result):
    return [value for name, value in result.errors.items()
            if name.startswith("r_sigma") and value is not None]


for scene in ("prm/cortis-2017/block-0.prm", "prm/cortis-2017/block-30.prm",
              "prm/cortis-2017/block-45.prm", "prm/cortis-2017/block-90.prm",
              "prm/cortis-2017/block-17-offset.prm"):
    result = run(scene, QUIET)
    text(scene, result.summary["status"])
    bound("r_u", result.errors["r_u"], 1e-10)
    bound("largest r_sigma", max(stress_errors(result)), 1e-9)
    # The sides carry what the exact stress gives them.
    for side, force in (("moved", 1346.1538461538462),
                        ("top", 576.92307692307692)):
        x, y = result.reactions[side]
        bound(f"reaction of {side} over exact - 1",
              (x * x + y * y)**0.5 / force - 1, 1e-10)
    result = run(scene, QUIET | paper)
    # Along the displacement: x at 0 degrees, y at 90.
    along = "r_sigma_yy" if "block-90" in scene else "r_sigma_xx"
    number("with the paper's setting, r_u", result.errors["r_u"], 2)
    number(f"with the paper's setting, {along}", result.errors[along], 2)

result = run("prm/cortis-2017/block-3d.prm", QUIET)
text("block-3d", result.summary["status"])
bound("r_u", result.errors["r_u"], 1e-9)
bound("largest r_sigma", max(stress_errors(result)), 1e-9)
for side, force in (("moved", 134615.38461538462), ("top", 57692.307692307692)):
    bound(f"reaction of {side} over exact - 1",
          sum(f * f for f in result.reactions[side])**0.5 / force - 1, 1e-10)
