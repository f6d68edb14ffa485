# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A traction on a surface that is longer than its body acts as far as the body goes:
its force, which the foot of the body takes, is the traction times the length or area
that they share, however both lie in the mesh."""

from math import asin, cos, hypot, pi, radians, sin

SCENE = prm("""
Dimension = {dim}
Mesh/Lower corner = {lower} | Upper corner = {upper} | Cell size = {h}
Method/Method = {method}
Materials/stone/Young modulus = 1e5 | Poisson ratio = 0.25
Bodies/
{bodies}
Boundaries/foot/Body = {foot} | Part = {part}
Loads/traction/Type = surface traction
{surface}
Loads/traction/Value = {value}
Output/Points = false | Mesh = false
""")
scene = folder / "scene.prm"


def body(name, **keys):
    lines = "".join(f"    set {key.replace('_', ' ')} = {value}\n"
                    for key, value in keys.items())
    return f"  subsection {name}\n{lines}  end\n"


def force(bodies, surface, h, dim=2, part="bottom", foot="block", method="GIMP",
          lower="-4, -4", upper="4, 4"):
    """The size of the force of a traction of 1 along z or y."""
    value = "0; 0; -1" if dim == 3 else "0; -1"
    scene.write_text(SCENE.format(bodies=bodies, surface=surface, h=h, dim=dim,
                                  part=part, foot=foot, value=value, lower=lower,
                                  upper=upper, method=method))
    return run(scene).reactions["foot"][dim - 1]


def line(*points):
    return "set Points = " + "; ".join(f"{x!r} {y!r}" for x, y in points)


# 30 places of a block of 3 by 2; the line along its top is longer at both ends.
worst = 0
for k in range(30):
    angle, x, y = 12.3 * k, 0.017 * k, 0.4 - 0.023 * k
    c, s = cos(radians(angle)), sin(radians(angle))
    corner = x - 1.5 * c - s, y - 1.5 * s + c  # left end of the top

    def on_top(a):
        return corner[0] + a * c, corner[1] + a * s

    block = body("block", Shape="box", Lower_corner=f"{x - 1.5}, {y - 1}",
                 Upper_corner=f"{x + 1.5}, {y + 1}", Rotation_angle=angle,
                 Rotation_centre=f"{x}, {y}")
    worst = max(worst, abs(force(block, line(on_top(3.41), on_top(-0.29)), 0.32)
                           / 3 - 1))
bound("line on a turned block, 30 places: force", worst, 1e-8)

# Sides that fall away from the crest, and points of the line in four digits.
bank = body("block", Shape="polygon", Vertices="-3 0; 3 0; 0.55 1.3; -0.8 1.3")
bound("line past the crest of a bank: force",
      force(bank, line((1.7, 1.3), (-2.1, 1.3)), 0.25, part="1") / 1.35 - 1, 1e-8)
c, s = cos(radians(30)), sin(radians(30))
block = body("block", Shape="box", Lower_corner="-1.5, -1", Upper_corner="1.5, 1",
             Rotation_angle=30)
ends = [(round(a * c - s, 4), round(a * s + c, 4)) for a in (2.1, -2.3)]
way = hypot(ends[1][0] - ends[0][0], ends[1][1] - ends[0][1])
off = asin(((ends[1][0] - ends[0][0]) * s - (ends[1][1] - ends[0][1]) * c) / way)
bound("line in four digits: force",
      force(block, line(*ends), 0.32) * cos(off) / 3 - 1, 1e-8)

# A quarter of a ring, turned, under a full circle; a circle around a polygon.
for angle in (0, 21.3):
    quarter = body("ring", Shape="ring", Centre="0, 0", Radius=3, Inner_radius=2)
    quarter += body("square", Shape="box", Lower_corner="0, 0",
                    Upper_corner="3.5, 3.5", Rotation_angle=angle)
    quarter += body("block", Shape="intersection", Operands="ring, square")
    for method in ("GIMP", "finite element"):
        for h in (0.5, 0.25):
            for radius, side in ((2, "outside"), (3, "inside")):
                circle = (f"set Surface = circle\n set Centre = 0, 0\n"
                          f" set Radius = {radius}\n set Body side = {side}")
                bound(f"quarter ring at {angle}, {method}, h = {h}, circle of "
                      f"{radius}: force",
                      force(quarter, circle, h, part="square/bottom",
                            method=method) / (pi * radius / 2) - 1, 1e-6)
corners = "; ".join(f"{3 * cos(pi * k / 16)!r} {3 * sin(pi * k / 16)!r}"
                    for k in range(32))
polygon = body("block", Shape="polygon", Vertices=corners)
circle = "set Surface = circle\n set Centre = 0, 0\n set Body side = inside\n"
for radius in (3, 2.99):
    bound(f"circle of {radius} along a polygon: force",
          force(polygon, circle + f"set Radius = {radius}", 0.32, part="1")
          / (2 * pi * radius) - 1, 1e-8)

# A plane without ends on a block and on a cylinder, turned.
worst = 0
for k in range(8):
    angle = 31.7 * k
    c, s = cos(radians(angle)), sin(radians(angle))
    block = body("block", Shape="box", Lower_corner="-1, -0.8, -0.6",
                 Upper_corner="1, 0.8, 0.6", Rotation_angle=angle,
                 Rotation_axis="0, 1, 0.3")
    n = hypot(1, 0.3)
    axis = 0, 1 / n, 0.3 / n
    top = [axis[i] * axis[2] * (1 - c) + d for i, d in
           enumerate((axis[1] * s, -axis[0] * s, c))]
    plane = ("set Surface = plane\n set Point = "
             + ", ".join(repr(0.6 * t) for t in top) + "\n set Normal = "
             + ", ".join(repr(t) for t in top))
    worst = max(worst, abs(force(block, plane, 0.5, 3, lower="-2, -2, -2",
                                 upper="2, 2, 2") / 3.2 - 1))
bound("plane on a turned block, 8 places: force", worst, 1e-8)
pile = body("block", Shape="cylinder", Axis_start="0, 0, -0.6",
            Axis_end="0.05, 0.1, 0.7", Radius=0.9)
plane = ("set Surface = plane\n set Point = 0.05, 0.1, 0.7\n"
         " set Normal = 0.05, 0.1, 1.3")
bound("plane on a tilted cylinder: force",
      force(pile, plane, 0.5, 3, lower="-2, -2, -2", upper="2, 2, 2")
      / (0.81 * pi) - 1, 1e-6)
