# ranks: 2  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Bodies that come and go at a wall that they touch, and a face that digging lays bare:
the wall bears K0 gamma H^2/2 of the elastic ground that is there."""

K0, GAMMA = 0.25, 10  # nu / (1 - nu)

SCENE = f"""
Dimension = 2
Mesh/Lower corner = -0.2, -0.3 | Upper corner = 4.8, 4.7 | Cell size = 0.25
Method/Method = GIMP
Materials/soil/Young modulus = 1e5 | Poisson ratio = 0.2
Bodies/lower/Lower corner = 0, 0 | Upper corner = 2, 2
Bodies/upper/Lower corner = 0, 2 | Upper corner = 2, 3
Bodies/beside/Lower corner = 2, 0 | Upper corner = 4, 2
Boundaries/left/Points = 0 5; 0 -1 | Constraint = roller
Boundaries/base/Points = -1 0; 5 0 | Constraint = roller
Boundaries/wall/Points = 2 -1; 2 5 | Constraint = contact | Friction = 0
Boundaries/far/Points = 4 -1; 4 5 | Constraint = roller
Loads/weight/Type = body force | Value = 0; -{GAMMA}
"""


def force(result):
    return {round(row["t"], 6): -row["reaction_x of wall"] for row in result.history()
            if "reaction_x of wall" in row}


def stages(*all_of):
    lines = {}
    for k, (name, bodies, boundaries) in enumerate(all_of):
        lines.update({f"Stages/{name}/Bodies": bodies,
                      f"Stages/{name}/Boundaries": boundaries,
                      f"Stages/{name}/Time/Steps": 2,
                      f"Stages/{name}/Time/End time": k + 1})
    return lines


def exact(height):
    return K0 * GAMMA * height**2 / 2


scene = scene_file("stages.prm", SCENE)
result = run(scene, {**stages(("first", "lower", "left, base, wall"),
                              ("filled", "lower, upper", "left, base, wall"),
                              ("dug", "lower", "left, base, wall")), **QUIET})
found = force(result)
for t, height in (1, 2), (2, 3), (3, 2):
    bound(f"fill and dig, H = {height}: force over exact - 1",
          found[t] / exact(height) - 1, 2e-4)  # a roller: 1.2e-4

# Ground beside it goes, and the wall holds the face.
result = run(scene, {**stages(("whole", "lower, beside", "left, base, far"),
                              ("bare", "lower", "left, base, wall")), **QUIET})
bound("laid bare: force over exact - 1", force(result)[2] / exact(2) - 1, 2e-4)  # a roller: 1.2e-4
