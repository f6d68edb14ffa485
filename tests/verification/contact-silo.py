# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Elastic fill that slides down between rough walls: the force on the floor beside the
exact elastic solution, near Janssen's (1895)."""

from math import ceil, cos, exp, floor, radians, sin

MU, NU, H = 0.3, 0.3, 0.125
K = NU / (1 - NU)


def silo(height, angle, down):
    """1 wide, turned with its weight by an angle to the mesh."""
    c, s = cos(radians(angle)), sin(radians(angle))

    def at(*points):
        return "; ".join(f"{c * x - s * y!r}, {s * x + c * y!r}" for x, y in points)

    corners = [tuple(map(float, at(p).split(",")))
               for p in ((-0.5, 0), (0.5, 0), (0.5, height), (-0.5, height))]
    low = [H * floor(min(v) / H) - 1.37 * H for v in zip(*corners)]
    high = [a + H * ceil((max(v) - a) / H + 1) for a, v in zip(low, zip(*corners))]
    return f"""
Dimension = 2
Mesh/Lower corner = {low[0]!r}, {low[1]!r} | Upper corner = {high[0]!r}, {high[1]!r}
Mesh/Cell size = {H}
Method/Method = GIMP | Mesh after step = keep
Materials/grain/Young modulus = 1e4 | Poisson ratio = {NU} | Density = 1
Bodies/fill/Lower corner = -0.5, 0 | Upper corner = 0.5, {height}
Bodies/fill/Rotation angle = {angle}
Boundaries/right/Points = {at((0.5, -1), (0.5, height + 1))} | Constraint = contact
Boundaries/right/Friction = {MU}
Boundaries/left/Points = {at((-0.5, height + 1), (-0.5, -1))} | Constraint = contact
Boundaries/left/Friction = {MU}
Boundaries/floor/Points = {at((-2, 0), (2, 0))} | Constraint = contact
Boundaries/floor/Translation = {down * s!r}*t; {-down * c!r}*t
Loads/weight/Type = gravity | Value = {s!r}; {-c!r} | Curve = min(2*t, 1)
Time/Steps = 4
"""


for height, exact in ((2, 1.5599), (5, 2.7971)):
    janssen = 1 / (2 * MU * K) * (1 - exp(-2 * MU * K * height))
    number(f"H = {height}: Janssen's force, exact {exact}", janssen, 5)
    for angle in (0, 17) if height == 2 else (0,):
        result = run(scene_file("silo.prm", silo(height, angle, 0.01)), QUIET)
        row = result.history()[-1]
        found = -(sin(radians(angle)) * row["reaction_x of floor"] -
                  cos(radians(angle)) * row["reaction_y of floor"])
        name = f"H = {height}, {angle} degrees"
        number(f"{name}: force", found, 4)
        bound(f"{name}: error", found / exact - 1, 1e-3)
