# ranks: 2  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Parameters that differ from place to place, and strip footings on Tresca's and
Mohr and Coulomb's soil without weight, beside Prandtl's limit loads."""

from math import log, pi

# A column 4 high of E = 1000 (1 + y), nu = 0, sinks under its weight of 1 per
# volume by the integral of (4 - y) / E.
COLUMN = scene_file("column.prm", """
Mesh/Lower corner = 0, 0 | Upper corner = 1, 4 | Cell size = 0.25
Method/Method = finite element
Materials/soil/Young modulus = 1000*(1 + y) | Poisson ratio = 0 | Density = 1
Bodies/column/Shape = box | Lower corner = 0, 0 | Upper corner = 1, 4
Grid conditions/base/Side = bottom
Grid conditions/left/Side = left | Components = x
Grid conditions/right/Side = right | Components = x
Loads/weight/Type = gravity | Value = 0; -1
Probes/top/Location = 0.5, 4 | Quantities = displacement
Time/Steps = 1
""")
EXACT = (5 * log(5) - 4) / 1000
for method in ("finite element", "GIMP"):
    for strain in ("small", "finite"):
        column = run(COLUMN, {"Method/Method": method, "Method/Strain": strain,
                              **QUIET})
        bound(f"{method}, {strain} strain: error of the settlement",
              abs(-column.probes["u_y at top"] / EXACT - 1),
              0.01 if strain == "small" else 0.02)


def footing(model, settings):
    """Largest force of the footing over half its width and the cohesion."""
    result = run("prm/hard-cases/bearing-fe.prm", {
        "Materials/soil/Model": model, "Materials/soil/Shear yield stress": "",
        **settings, **QUIET})
    return max(-row["reaction_y of footing"] for row in result.history())


tresca = footing("Tresca", {"Materials/soil/Shear strength": 1})
bound("Tresca: error of N_c", abs(tresca / (2 + pi) - 1), 0.03)
frictional = footing("Mohr-Coulomb", {
    "Materials/soil/Cohesion": 1, "Materials/soil/Friction angle": 30,
    "Materials/soil/Dilation angle": 30,
    "Materials/soil/Tensile strength": "none",
    "Materials/soil/Poisson ratio": 0.3,
    "Grid conditions/footing/Components": "x, y",
    "Grid conditions/footing/Displacement": "0; -0.05 * t"})
bound("Mohr-Coulomb, associated: error of N_c", abs(frictional / 30.140 - 1),
      0.08)
