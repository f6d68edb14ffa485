# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A column of sand collapses into water: the sum of the water's forces is the weight of
the water displaced at each step, and points that cross the level cost no steps and
hardly more iterations than the dry collapse."""

from itertools import pairwise

SCENE = "prm/geotechnics/column-collapse.prm"
LEVEL, GRAVITY = 0.83, 9.81
SETTINGS = {"Mesh/Cell size": 0.25, "Time/End time": 1.5, "Time/Steps": 120}
WET = {"Water/Level": LEVEL, "Water/Unit weight": GRAVITY}


def displaced(result):
    """Weight of the water displaced: areas of points whose places are under water."""
    return GRAVITY * sum(volume for (x, y, _), volume in result.points(
        "position", "volume") if y < LEVEL)


for method in ("GIMP", "CPDI1"):
    asked = {**SETTINGS, "Method/Method": method}
    dry = run(SCENE, {**asked, **QUIET})
    wet = run(SCENE, {**asked, **WET, "Output/Write": "end"})
    forces = [row["force_y of water"] for row in wet.history()]
    number(f"{method}: force of water at the end, kN/m", forces[-1], 3)
    bound(f"{method}: over that of the water displaced - 1",
          forces[-1] / displaced(wet) - 1, 5e-3)  # which counts points as a whole
    bound(f"{method}: largest change in a step, of its mean",
          max(abs(b - a) for a, b in pairwise(forces)) * len(forces) / sum(forces), 0.02)
    for name, counts in (("steps", [len(one.history()) for one in (wet, dry)]),
                         ("Newton iterations", [one.summary["newton_iterations"]
                                                for one in (wet, dry)])):
        bound(f"{method}: {name}, over those of the dry collapse - 1",
              max(0, counts[0] / counts[1] - 1), 0.05)
