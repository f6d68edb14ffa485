# ranks: 1-2  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Contact with adhesion: a block dragged over a base by more than a cell, wherever the
mesh lies, and a T-bar in clay beside its plastic limit (Randolph and Houlsby 1984)."""

from math import asin, cos, pi, sin

# The block slips on all its length: adhesion times length, the same in each step.
BLOCK = """
Dimension = 2
Mesh/Cell size = 0.25
Method/Strain = finite
Materials/rock/Young modulus = 1e5 | Poisson ratio = 0.3
Bodies/block/Lower corner = 0, 0 | Upper corner = 2, 1
Boundaries/base/Points = -9 0; 9 0 | Constraint = contact
Boundaries/base/Adhesion = 10 | Separation = false
Boundaries/push/Points = 0 2; 0 -1 | Constraint = roller | Translation = 0.6*t; 0
Time/Steps = 6
"""
# Of a cell is below the block, and left of it.
for method, parts in (("GIMP", (0, 0.05, 0.95)), ("CPDI1", (0.37,)),
                      ("finite element", (0.37,))):
    worst = slips = 0
    for part in parts:
        a = 0.25 * part
        result = run(scene_file("block.prm", BLOCK), {
            **QUIET, "Method/Method": method,
            "Mesh/Lower corner": f"{-2 - a!r}, {-0.5 - a!r}",
            "Mesh/Upper corner": f"{5 - a!r}, {2 - a!r}"})
        worst = max(worst, *(abs(row["reaction_x of base"] / 20 + 1)
                             for row in result.history()))
        slips = result.history()[-1]["slip of base"]
    bound(f"block, {method}: largest error of the shear force", worst, 5e-4)
    bound(f"block, {method}: path over the push - 1", slips / 0.6 - 1, 1e-2)

# A quarter, half of the bar in height: what is above moves as what is below.
BAR = """
Dimension = 2
Mesh/Lower corner = 0, 0 | Upper corner = 2, 2 | Cell size = 0.125
Method/Method = GIMP | Mesh after step = keep
Materials/clay/Model = von Mises | Shear yield stress = 10
Materials/clay/Young modulus = 25e3 | Poisson ratio = 0.49
Bodies/box/Lower corner = 0, 0 | Upper corner = 2, 2
Bodies/hole/Shape = disc | Centre = 0, 0 | Radius = 0.5
Bodies/ground/Shape = difference | Operands = box, hole
Boundaries/bar/Surface = circle | Centre = 0, 0 | Radius = 0.5
Boundaries/bar/Body side = outside | Constraint = contact
Boundaries/bar/Translation = 0; 0.005*t | Separation = false
Grid conditions/axis/Side = left | Components = x
Grid conditions/middle/Side = bottom | Components = x
Grid conditions/right/Side = right | Components = x
Grid conditions/top/Side = top
Time/Steps = 8
"""
for name, alpha, method in (("smooth", 0, "GIMP"), ("rough", 1, "GIMP"),
                            ("rough", 1, "finite element")):
    delta = asin(alpha)
    exact = pi + 2 * delta + 2 * cos(delta) + 4 * (cos(delta / 2) + sin(delta / 2))
    row = run(scene_file("bar.prm", BAR), {
        **QUIET, "Method/Method": method,
        "Boundaries/bar/Adhesion": 10 * alpha}).history()[-1]
    found = 4 * row["reaction_y of bar"] / 10
    number(f"T-bar, {name}, {method}: force over su D, exact {exact:.5g}", found, 3)
    bound("error", found / exact - 1, 0.04)

# A block with a step, pulled up: only the half that touches is held.
STEP = """
Dimension = 2
Mesh/Lower corner = -1, -0.5 | Upper corner = 3, 2 | Cell size = 0.25
Method/Method = GIMP
Materials/rock/Young modulus = 1e5 | Poisson ratio = 0.3
Bodies/block/Shape = polygon
Bodies/block/Vertices = 0 0; 1 0; 1 0.07; 2 0.07; 2 1; 0 1
Boundaries/base/Points = -9 0; 9 0 | Constraint = contact
Boundaries/base/Adhesion = 10 | Separation = false
Boundaries/top/Points = 9 1; -9 1 | Constraint = fixed | Displacement = 0; 1e-4*t
Time/Steps = 2
"""
rows = run(scene_file("step.prm", STEP), QUIET).history()
bound("block with a step: contact area - 1", rows[-1]["contact area of base"] - 1,
      0.13)
bound("force of two steps over that of one, - 2",
      rows[1]["reaction_y of base"] / rows[0]["reaction_y of base"] - 2, 1e-3)
at_least("tension", -rows[-1]["reaction_y of base"] / 1e5, 5e-5)
