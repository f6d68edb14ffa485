# ranks: 2  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Two layers, one a hundred times as stiff, are stretched while they move
through the mesh: forces, displacements and stresses in closed form."""

from math import log

SCENE = "prm/verification/two-materials.prm"
SIGMA = 1e5 * log(1.1) / 1.1
FORCE = SIGMA * (3.1 / 100 + 2.6)

FE = {"Method/Method": "finite element"}
NITSCHE = {f"Boundaries/{side}/Enforcement": "skew Nitsche"
           for side in ("left", "right")}

# Limits on forces, r_u and the largest error of a point's stress over the
# largest stress. Where both materials are in one cell, its functions have no
# kink; only on the mesh that follows the material that is no matter.
for name, settings, limits in (
        ("FE", FE, (1e-12, 1e-14, 1e-11)),
        ("FE, skew Nitsche", {**FE, **NITSCHE}, (2e-3, 1e-3, 0.05)),
        ("GIMP", {}, (1e-4, 1e-5, 0.01)),
        ("CPDI1", {"Method/Method": "CPDI1"}, (1e-3, 1e-3, 0.1)),
        ("CPDI2", {"Method/Method": "CPDI2"}, (1e-3, 1e-3, 0.1))):
    result = run(SCENE, {**settings, "Output/Points": "false",
                         "Output/Mesh": "false"})
    for side, sign in (("left", -1), ("right", 1)):
        bound(f"{name}: force at the {side} over exact - 1",
              sign * result.reactions[side][0] / FORCE - 1, limits[0])
    bound(f"{name}: r_u", result.errors["r_u"], limits[1])
    bound(f"{name}: error of stress", result.errors["max_sigma"] / SIGMA,
          limits[2])

# A clamp that hardly holds is told of, once.
loose = run(SCENE, {"Boundaries/right/Enforcement": "penalty",
                    "Boundaries/right/Penalty factor": 1,
                    "Output/Points": "false", "Output/Mesh": "false"})
text("loose clamp", loose.found())
text("  its line on the console", loose.output.count("warning     surface-miss"))
