# ranks: 1-2
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Blocks that press on a rigid surface with friction, at angles to the mesh: the stress
is the same everywhere, where they stick and where they slide, as they are let go and
touch again."""

from math import ceil, cos, floor, radians, sin

P, MU = 10, 0.3


def placed(angle, *points):
    """Points of the block's frame, in which the surface is y = 0."""
    c, s = cos(radians(angle)), sin(radians(angle))
    return "; ".join(f"{c * x - s * y!r}, {s * x + c * y!r}" for x, y in points)


def turned(angle, x, y, curve=""):
    c, s = cos(radians(angle)), sin(radians(angle))
    return f"{c * x - s * y!r}{curve}; {s * x + c * y!r}{curve}"


def block(angle, tau, nu, across, top):
    """4 x 3, with pressure and shear on its sides; and what its top does."""
    c, s = cos(radians(angle)), sin(radians(angle))
    xs, ys = zip(*((c * x - s * y, s * x + c * y)
                   for x, y in ((0, 0), (4, 0), (4, 3), (0, 3))))
    low = [0.5 * floor(min(v) / 0.5) - 0.77 for v in (xs, ys)]
    high = [a + 0.5 * ceil((max(v) - a) / 0.5 + 1) for a, v in zip(low, (xs, ys))]
    return f"""
Dimension = 2
Mesh/Lower corner = {low[0]!r}, {low[1]!r} | Upper corner = {high[0]!r}, {high[1]!r}
Mesh/Cell size = 0.5
Method/Method = GIMP | Mesh after step = keep
Materials/rock/Young modulus = 1000 | Poisson ratio = {nu}
Bodies/block/Lower corner = 0, 0 | Upper corner = 4, 3 | Rotation angle = {angle}
Boundaries/floor/Points = {placed(angle, (-2, 0), (6, 0))} | Constraint = contact
Boundaries/floor/Friction = {MU}
Loads/left/Type = surface traction | Body = block | Part = left
Loads/left/Value = {turned(angle, across, -tau)} | Curve = t
Loads/right/Type = surface traction | Body = block | Part = right
Loads/right/Value = {turned(angle, -across, tau)} | Curve = t
{top}
Time/Steps = 2
Solver/Solver = direct | Tolerance = 1e-12
"""


def stick(angle):
    return block(angle, 1.5, 0.3, P * 0.3 / 0.7, f"""
Loads/top/Type = surface traction | Body = block | Part = top
Loads/top/Value = {turned(angle, 1.5, -P)} | Curve = t
""")


def slide(angle):
    """Pressed and dragged further than it shears, without Poisson's effect, as the
    top keeps its width."""
    return block(angle, P * MU, 0, 0, f"""
Boundaries/top/Points = {placed(angle, (4, 3), (0, 3))} | Constraint = fixed
Boundaries/top/Translation = {turned(angle, 0.1, -3 * P / 1000, "*t")}
""")


def error_of_stress(result, angle, tau, across):
    """The largest error of a stress, over the pressure."""
    c, s = cos(radians(angle)), sin(radians(angle))
    exact = (-c * c * across - s * s * P - 2 * s * c * tau,
             -s * s * across - c * c * P + 2 * s * c * tau,
             (c * c - s * s) * tau + s * c * (P - across))
    return max(max(abs(a[0] - exact[0]), abs(a[4] - exact[1]), abs(a[1] - exact[2]))
               for a, in result.points("stress")) / P


for name, make, tau, across in (("sticks", stick, 1.5, P * 0.3 / 0.7),
                                ("slides", slide, P * MU, 0)):
    for angle, how in (0, ""), (17, ""), (30, ""), (17, "augmented Lagrangian"):
        result = run(scene_file(f"{name}-{angle}.prm", make(angle)),
                     {"Boundaries/floor/Enforcement": how} if how else {})
        of = f"{name}, {angle} degrees{how and ', ' + how}"
        row = result.history()[-1]
        exact = turned(angle, -4 * tau, 4 * P).split("; ")
        # Files have 7 digits.
        bound(f"{of}: error of stress over p",
              error_of_stress(result, angle, tau, across), 1e-6)
        bound(f"{of}: error of the force over p",
              max(abs(row[f"reaction_{c} of floor"] - float(value))
                  for c, value in zip("xy", exact)) / P, 1e-8)
        number(f"{of}: contact, part that slides",
               row["slipping area of floor"] / row["contact area of floor"], 3)
