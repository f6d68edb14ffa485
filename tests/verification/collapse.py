# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A block of plastic material collapses: every step has an equilibrium."""

SCENE = "prm/large-deformation/collapse.prm"
WEIGHT = 640e3
CELL_SIZES = (1, 0.5)
# AMPLE 1.1 takes 231 and 233.
MOST_ITERATIONS = 185


def place(name, x, y):
    return {f"Probes/{name}/Kind": "interpolated",
            f"Probes/{name}/Location": f"{x}, {y}",
            f"Probes/{name}/Quantities": "position"}


# Biquadratic elements on a mesh that follows: where the points nearest to the
# toe and to the top on the axis go.
places = {}
for h in CELL_SIZES:
    n, d = round(4 / h), h / 4
    places |= place(f"toe {n}", 8 - d, d) | place(f"top {n}", d, 8 - d)
fe = run(SCENE, {"Method/Method": "finite element", "Method/Degree": 2,
                 "Method/Points per direction": 3,
                 "Method/Fictitious stiffness": 0, "Mesh/Cell size": 1,
                 "Output/Points": "false", "Output/Mesh": "false", **places})
text("FE Q2, h = 1: status", fe.summary["status"])
bound("FE Q2, h = 1: Newton iterations", fe.summary["newton_iterations"], 200)

cases = [("corners", h, {}) for h in CELL_SIZES] + [
    ("stretch", 1, {"Method/Domain update": "stretch"}),
    ("CPDI1", 1, {"Method/Method": "CPDI1"}),
    ("CPDI2", 1, {"Method/Method": "CPDI2"})]
for name, h, settings in cases:
    result = run(SCENE, {"Mesh/Cell size": h, "Output/Points": "false",
                         "Output/Mesh": "false", **settings})
    title = f"{name}, h = {h}"
    n = round(4 / h)
    text(f"{title}: steps, rejected", (result.summary["steps"],
                                       result.summary["rejected_steps"]))
    bound(f"{title}: Newton iterations",
          result.summary["newton_iterations"], MOST_ITERATIONS)
    number(f"{title}: x of toe", result.probes["x at toe"], 4)
    number(f"{title}: y of top", result.probes["y at top"], 4)
    bound(f"{title}: x of toe against FE Q2 - 1",
          result.probes["x at toe"] / fe.probes[f"x at toe {n}"] - 1, 0.01)
    bound(f"{title}: y of top against FE Q2 - 1",
          result.probes["y at top"] / fe.probes[f"y at top {n}"] - 1, 0.02)
    bound(f"{title}: base reaction over weight - 1",
          result.reactions["base"][1] / WEIGHT - 1, 1e-8)

# What little the empty parts of cells need at the toe is found by the run.
result = run(SCENE, {"Mesh/Cell size": 1, "Method/Fictitious stiffness": 0,
                     "Method/Domain update": "stretch",
                     "Output/Points": "false", "Output/Mesh": "false"},
             expect=None)
text("stretch, h = 1, found by the run: status", result.summary["status"])
