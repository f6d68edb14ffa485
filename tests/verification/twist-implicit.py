# ranks: 1 2
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Ring turned by implicit boundaries on a mesh that stays: torque against the
one-dimensional solution and against the ring on a mesh that fits it."""

from math import pi

NO_FILES = {"Output/Points": "false", "Output/Mesh": "false"}
EXACT = {5: 0.115823, 10: 0.228440}


def torques(scene, settings=None):
    rows = run(scene, {**NO_FILES, **(settings or {})}).history()
    return {round(row["t"]): abs(row["moment of hole"]) / (50e6 * pi)
            for row in rows}, rows


fitted = torques("prm/wang-2018/twist-80-fe.prm",
                 {"Time/End time": 20, "Time/Steps": 4})[0]
for method in ("mpm", "gimp", "cpdi1", "cpdi2"):
    found, rows = torques(f"prm/wang-2018/twist-implicit-{method}.prm")
    for angle in (5, 10, 20):
        number(f"{method}, {angle} degrees: torque / (2 pi 25 E)",
               found[angle], 3)
    if method == "mpm":  # cell crossing; see the page
        continue
    for angle, value in EXACT.items():
        bound(f"{method}, {angle} degrees: against the solution in r",
              found[angle] / value - 1, 0.02)
    for angle in (5, 10, 15, 20):
        bound(f"{method}, {angle} degrees: against fitted FE",
              found[angle] / fitted[angle] - 1, 0.025)
    bound(f"{method}: torques balance",
          rows[-1]["moment of outer"] / rows[-1]["moment of hole"] + 1, 1e-3)
