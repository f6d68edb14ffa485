# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Twist of a thick tube by its top: torque and axial force."""

from math import pi, radians

NO_FILES = {"Output/Points": "false", "Output/Mesh": "false"}
# Finite elements with 3 x 16 x 8 and 6 x 32 x 16 cells at 15 degrees, which an
# error of second order makes 4 times smaller, extrapolated.
TORQUE, FORCE = 73.8234, -2.0760


def forces(scene, settings):
    row = run(scene, {**NO_FILES, **settings}).history()[-1]
    total = sum(value for key, value in row.items()
                if key.startswith("reaction_z"))
    bound("  sum of axial forces over the largest",
          total / row["reaction_z of top"], 1e-6)
    return row["moment of top"], row["reaction_z of top"]


MESH = "prm/large-deformation/tube-mesh.prm"
fe = forces(MESH, {"Method/Method": "finite element", "Mesh motion/Follow": ""})
number("FE: torque at 45 degrees", fe[0], 5)
number("FE: axial force", fe[1], 4)
for method, limits in (("material point", (0.015, 0.04)),
                       ("CPDI2", (0.01, 0.02))):
    found = forces(MESH, {"Method/Method": method})
    for name, a, b, limit in zip(("torque", "axial force"), found, fe, limits):
        bound(f"{method}: {name} over FE - 1", a / b - 1, limit)

for method, limits in (("GIMP", (0.01, 0.02)), ("material point", (0.03, 0.06))):
    found = forces("prm/large-deformation/tube-implicit.prm",
                   {"Method/Method": method, "Time/End time": 15,
                    "Time/Steps": 3})
    for name, a, b, limit in zip(("torque", "axial force"), found,
                                 (TORQUE, FORCE), limits):
        bound(f"implicit boundaries, {method}: {name} at 15 degrees over "
              "FE - 1", a / b - 1, limit)

# Saint-Venant: a small twist has the torque G J theta / L exactly, because
# sections of a circular tube stay plane. Fitted cells see a polygon of 16 or
# 32 sides, an error of second order.
ANGLE = 0.01
SMALL = {**NO_FILES, "Time/End time": ANGLE, "Time/Steps": 1}
EXACT = 1000 / 2.6 * pi / 2 * (1 - 0.5**4) * radians(ANGLE) / 2
coarse, fine = (
    run(MESH, {**SMALL, "Method/Method": "finite element",
               "Mesh motion/Follow": "", **cells}
        ).history()[-1]["moment of top"] / EXACT
    for cells in ({}, {
        "Mesh/Arguments": "0, 0 : 0.5 : 1 : 6 : 0 : 32 : true",
        "Mesh/Extrusion layers": 16}))
bound("FE, small twist: extrapolated torque over exact - 1",
      (4 * fine - coarse) / 3 - 1, 0.001)
for method in ("GIMP", "CPDI1", "material point"):
    row = run("prm/large-deformation/tube-implicit.prm",
              {**SMALL, "Method/Method": method}).history()[-1]
    bound(f"implicit boundaries, {method}, small twist: torque over exact - 1",
          row["moment of top"] / EXACT - 1, 0.005)
