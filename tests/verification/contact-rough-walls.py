# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Rough walls that are pushed into soil or give way, by contact: clay with full adhesion
(1/2 gamma H^2 +- k H (1 + pi/2)), sand with friction of the wall (delta = 15 degrees)
beside Coulomb's wedge and the lower bound of Lancellotta (2002)."""

from math import cos, pi, radians, sin, sqrt, tan

# The wall ends at the base, which holds the soil from the second cell on.
WALL = """
Dimension = 2
Mesh/Lower corner = -2, 0 | Upper corner = 24, 12 | Cell size = 1
Method/Method = GIMP | Mesh after step = keep
Boundaries/wall/Points = 0 12; 0 -1 | Constraint = contact
Bodies/fill/Lower corner = 0, 0 | Upper corner = 24, 10
Bodies/fill/Initial stress = geostatic
Grid conditions/toe/Side = bottom | Components = y
Grid conditions/base/Side = bottom
Grid conditions/base/Lower corner = 1, 0 | Upper corner = 24, 0
Grid conditions/right/Side = right | Components = x
Loads/weight/Type = gravity | Value = 0; -10
Time/Steps = 10
"""
CLAY = scene_file("clay.prm", WALL, """
Materials/clay/Model = Tresca | Shear strength = 20
Materials/clay/Young modulus = 2e5 | Poisson ratio = 0.49 | Density = 2
Bodies/fill/K0 = 1
Boundaries/wall/Adhesion = 20 | Separation = false
""")
SAND = scene_file("sand.prm", WALL, """
Materials/sand/Model = Mohr-Coulomb | Friction angle = 30 | Dilation angle = 30
Materials/sand/Young modulus = 2e5 | Poisson ratio = 0.3 | Density = 2
Bodies/fill/K0 = 0.5
Boundaries/wall/Friction angle = 15
""")
FULL = 20 * 10 ** 2 / 2


def at_end(scene, motion, **keys):
    result = run(scene, {"Boundaries/wall/Translation": f"{motion}*t; 0", **QUIET,
                         **keys})
    return result.history()[-1], result.summary["rejected_steps"]


for name, motion, size in (("passive", 0.01, 1), ("active", -0.01, 0.5)):
    row, rejected = at_end(CLAY, motion, **{"Mesh/Cell size": size})
    exact = FULL + (1 if motion > 0 else -1) * 20 * 10 * (1 + pi / 2)
    found = row["reaction_x of wall"]
    number(f"clay, {name}: force, exact {exact:.5g}", found, 4)
    bound("error", found / exact - 1, 0.03)
    bound("shear force over 200 - 1", abs(row["reaction_y of wall"]) / 200 - 1, 1e-4)
    # Pieces that start or cease to slip must not bypass the line search.
    text("rejected steps", rejected)

PHI, DELTA = radians(30), radians(15)


def coulomb(sign):
    """Normal part, vertical wall and level ground."""
    root = sqrt(sin(PHI + DELTA) * sin(PHI) / cos(DELTA))
    return cos(PHI) ** 2 / (1 - sign * root) ** 2


for name, motion, low, high in (
        ("passive", 0.1, 4.288, coulomb(1)), ("active", -0.01, coulomb(-1), 0.2944)):
    row, _ = at_end(SAND, motion)
    found = row["reaction_x of wall"] / FULL
    number(f"sand, {name}: coefficient, {low:.4g} to {high:.4g}", found, 3)
    at_least("over the lower one", found / low, 0.97)
    at_least("the upper one over it", high / found, 0.97)
    bound("friction over tan(delta) - 1",
          abs(row["reaction_y of wall"] / row["reaction_x of wall"]) / tan(DELTA) - 1,
          1e-3)
