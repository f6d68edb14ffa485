# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
# Slender cantilever: a mesh turned by 90 degrees changes nothing; one at 45
# degrees to the beam changes what refinement removes.
from math import cos, log2, radians, sin

scenes = {0: "prm/cortis-2017/cantilever-0.prm",
          45: "prm/cortis-2017/cantilever-45.prm",
          90: "prm/cortis-2017/cantilever-90.prm"}

def deflection(angle, settings, expect_steps):
    result = run(scenes[angle], {**QUIET, **settings})
    steps = result.history()
    assert len(steps) == expect_steps
    a = radians(angle)
    return [step["u_x at tip"] * sin(a) - step["u_y at tip"] * cos(a)
            for step in steps]


# The published case to its full load.
w = {angle: deflection(angle, {}, 20) for angle in (0, 45, 90)}
bound("h = 2, 100 points: largest relative difference of 0 and 90 degrees",
      max(abs(a / b - 1) for a, b in zip(w[0], w[90])), 1e-10)
for step in (1, 5, 10, 15, 20):
    number(f"h = 2, 100 points: deflection of step {step} at 90 degrees",
           w[90][step - 1], 6)
number("h = 2, 100 points: deflection of step 20 at 45 degrees", w[45][-1], 6)

# the first step on three meshes
enforcements = {
    "skew Nitsche": {},
    "symmetric Nitsche": {"Nitsche factor": 20},
    "augmented Lagrangian": {},
    "penalty": {},
    "weighted": {},
    "weighted, places": {"Held in a cell": "places"},
}
for name, extra in enforcements.items():
    difference = []
    for h in (4, 2, 1):
        settings = {"Mesh/Cell size": h, "Method/Points per direction": 5,
                    "Time/End time": 0.05, "Time/Steps": 1,
                    "Boundaries/support/Enforcement": name.split(",")[0]}
        for key, value in extra.items():
            settings["Boundaries/support/" + key] = value
        w = {angle: deflection(angle, settings, 1)[0] for angle in (0, 45, 90)}
        bound(f"{name}, h = {h}: relative difference of 0 and 90 degrees",
              w[0] / w[90] - 1, 1e-8)
        difference.append(abs(w[45] / w[90] - 1))
        number(f"{name}, h = {h}: relative difference of 45 and 90 degrees",
               difference[-1], 3)
    order = min(log2(difference[0] / difference[1]),
                log2(difference[1] / difference[2]))
    number(f"{name}: lower of the two orders", order, 3)
    if "places" not in name:
        at_least(f"{name}: order", order, 1.5)
