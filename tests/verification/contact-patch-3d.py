# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Blocks, turned by Euler angles against the mesh, that press on a rigid plane with
friction: the stress is the same everywhere, where they stick and where they slide
askew; two ranks find the force of one."""

from math import acos, ceil, cos, degrees, floor, radians, sin, sqrt

P, MU, H = 10, 0.3, 0.5
SIZE = 2, 1.5, 1.5


def product(*matrices):
    result, *others = matrices
    for m in others:
        result = [[sum(row[k] * m[k][j] for k in range(3)) for j in range(3)]
                  for row in result]
    return result


def turn(angles):
    """Euler's rotation about z, then the new x, then the new z."""
    def about(axis, angle):
        c, s = cos(radians(angle)), sin(radians(angle))
        i, j = [k for k in range(3) if k != axis]
        m = [[float(a == b) for b in range(3)] for a in range(3)]
        m[i][i] = m[j][j] = c
        m[i][j], m[j][i] = -s, s
        return m
    return product(about(2, angles[0]), about(0, angles[1]), about(2, angles[2]))


def rotation(R):
    """Its axis and angle."""
    axis = R[2][1] - R[1][2], R[0][2] - R[2][0], R[1][0] - R[0][1]
    return axis, degrees(acos((R[0][0] + R[1][1] + R[2][2] - 1) / 2))


def vector(R, *v, curve=""):
    return "; ".join(f"{sum(a * b for a, b in zip(row, v))!r}{curve}" for row in R)


def traction(R, part, v):
    return f"""
Loads/{part}/Type = surface traction | Body = block | Part = {part}
Loads/{part}/Value = {vector(R, *v)} | Curve = t
"""


def block(R, tau, across, nu, top):
    """With the pressure @p across and shear tau on its sides; and what its top does."""
    axis, angle = rotation(R)
    corners = [[sum(a * b for a, b in zip(row, (x, y, z))) for row in R]
               for x in (0, SIZE[0]) for y in (0, SIZE[1]) for z in (0, SIZE[2])]
    low = [H * floor(min(v) / H) - 0.77 * H for v in zip(*corners)]
    high = [a + H * ceil((max(v) - a) / H + 0.3) for a, v in zip(low, zip(*corners))]
    return f"""
Dimension = 3
Mesh/Lower corner = {", ".join(map(repr, low))} | Upper corner = {", ".join(map(repr, high))}
Mesh/Cell size = {H}
Method/Method = GIMP | Mesh after step = keep
Materials/rock/Young modulus = 1000 | Poisson ratio = {nu}
Bodies/block/Lower corner = 0, 0, 0 | Upper corner = {", ".join(map(str, SIZE))}
Bodies/block/Rotation angle = {angle!r} | Rotation axis = {", ".join(map(repr, axis))}
Boundaries/floor/Surface = plane | Point = 0, 0, 0
Boundaries/floor/Normal = {vector(R, 0, 0, -1).replace(";", ",")}
Boundaries/floor/Constraint = contact | Friction = {MU}
""" + "".join(traction(R, part, v) for part, v in (
        ("left", (across, 0, -tau[0])), ("right", (-across, 0, tau[0])),
        ("front", (0, across, -tau[1])), ("back", (0, -across, tau[1])))) + top + """
Time/Steps = 2
Solver/Solver = direct | Tolerance = 1e-12
"""


def stick(R):
    tau = 1.2, -0.9
    return tau, P * 0.3 / 0.7, block(R, tau, P * 0.3 / 0.7, 0.3,
                                     traction(R, "top", (*tau, -P)))


def slide(R):
    """Dragged further than it shears, without Poisson's effect."""
    tau = 0.8 * MU * P, 0.6 * MU * P
    corners = "; ".join(vector(R, *c).replace(";", "") for c in (
        (0, 0, SIZE[2]), (SIZE[0], 0, SIZE[2]), (*SIZE[:2], SIZE[2]), (0, *SIZE[1:])))
    return tau, 0, block(R, tau, 0, 0, f"""
Boundaries/top/Points = {corners} | Constraint = fixed
Boundaries/top/Translation = {vector(R, 0.08, 0.06, -SIZE[2] * P / 1000, curve="*t")}
""")


def error_of_stress(result, R, tau, across):
    """The largest error of a stress, over the pressure."""
    frame = [[-across, 0, tau[0]], [0, -across, tau[1]], [tau[0], tau[1], -P]]
    exact = product(R, frame, list(zip(*R)))
    return max(abs(a[3 * i + j] - exact[i][j]) for a, in result.points("stress")
               for i in range(3) for j in range(3)) / P


AREA = SIZE[0] * SIZE[1]
for angles in (30, 50, 20), (-110, 75, 140):
    R = turn(angles)
    for name, make in (("sticks", stick), ("slides", slide)):
        name = f"{name}, {angles} degrees"
        tau, across, scene = make(R)
        result = run(scene_file("block.prm", scene))
        row = result.history()[-1]
        force = [row[f"reaction_{c} of floor"] for c in "xyz"]
        exact = [AREA * float(v) for v in vector(R, -tau[0], -tau[1], P).split("; ")]
        # Files have 7 digits.
        bound(f"{name}: error of stress over p",
              error_of_stress(result, R, tau, across), 1e-6)
        bound(f"{name}: error of the force over p",
              max(abs(a - b) for a, b in zip(force, exact)) / P, 1e-8)
        number(f"{name}: contact, part that slides",
               row["slipping area of floor"] / row["contact area of floor"], 3)
        if angles[0] == 30:
            row = run(scene_file("block.prm", scene), on_ranks=2).history()[-1]
            bound(f"{name}: two ranks, difference of the force over p",
                  max(abs(row[f"reaction_{c} of floor"] - f) / P
                      for c, f in zip("xyz", force)), 1e-10)
