# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A sphere pressed on a rigid plane beside Hertz (1882): radius of contact
a^3 = 3 F R/(4 E*), pressure p0 = 3 F/(2 pi a^2) in its middle; a sphere that hits it
(contact for 2.943 delta/v); and one that rolls down 45 degrees with 5/7 g sin 45."""

from math import ceil, pi, sqrt

NU, G = 0.3, 9.81
PLANE = """
Dimension = 3
Boundaries/plane/Surface = plane | Constraint = contact
Grid conditions/front/Side = front | Components = y
"""


def at_rest(h):
    """A quarter of the lower part of a sphere, 2.6 wide."""
    n = round(2.6 / h + 0.5)
    return PLANE + f"""
Mesh/Lower corner = 0, 0, {-0.37 * h!r}
Mesh/Upper corner = {h * n!r}, {h * n!r}, {h * n - 0.37 * h!r} | Cell size = {h!r}
Method/Method = GIMP | Mesh after step = keep
Materials/steel/Young modulus = {E} | Poisson ratio = {NU}
Bodies/ball/Shape = sphere | Centre = 0, 0, {R} | Radius = {R}
Bodies/box/Lower corner = 0, 0, 0 | Upper corner = 2.6, 2.6, 2.47
Bodies/part/Shape = intersection | Operands = ball, box
Boundaries/plane/Point = 0, 0, 0 | Normal = 0, 0, -1
Grid conditions/left/Side = left | Components = x
Loads/top/Type = surface traction | Body = part | Part = box/top
Loads/top/Value = 0; 0; {-F / 4 / 2.6 ** 2!r}
"""


def thrown(h, v, gap, end):
    """A quarter of a sphere of radius 1 and density 1."""
    n = ceil(1.1 / h)
    return PLANE + f"""
Mesh/Lower corner = 0, 0, {-0.37 * h!r} | Cell size = {h!r}
Mesh/Upper corner = {n * h!r}, {n * h!r}, {h * ceil(2.4 / h) - 0.37 * h!r}
Method/Method = GIMP | Mesh after step = keep
Materials/steel/Young modulus = {E} | Poisson ratio = {NU} | Density = 1
Bodies/ball/Shape = sphere | Centre = 0, 0, {1 + gap!r} | Radius = 1
Bodies/box/Lower corner = 0, 0, 0 | Upper corner = 2, 2, 3
Bodies/part/Shape = intersection | Operands = ball, box
Bodies/part/Initial velocity = 0; 0; {-v!r}
Boundaries/plane/Point = 0, 0, 0 | Normal = 0, 0, -1
Grid conditions/left/Side = left | Components = x
Time/Integrator = generalised-alpha | End time = {end!r} | Steps = 32
"""


def rolling(h=0.25):
    """Half of a sphere of radius 1 on a plane that falls to the right."""
    s = sqrt(0.5)
    return PLANE + f"""
Mesh/Lower corner = {-1.25 - 0.37 * h!r}, 0, {-1.5 - 0.61 * h!r} | Cell size = {h}
Mesh/Upper corner = {1.5 - 0.37 * h!r}, 1.25, {1.25 - 0.61 * h!r}
Method/Method = finite element | Strain = finite
Materials/steel/Young modulus = 5e6 | Poisson ratio = {NU}
Materials/steel/Density = {1e4 / (4 / 3 * pi)!r}
Bodies/ball/Shape = sphere | Centre = 0, 0, 0 | Radius = 1
Bodies/box/Lower corner = -2, 0, -2 | Upper corner = 2, 2, 2
Bodies/half/Shape = intersection | Operands = ball, box
Boundaries/plane/Point = {-s!r}, 0, {-s!r} | Normal = {-s!r}, 0, {-s!r}
Boundaries/plane/Friction = 0.4
Loads/weight/Type = gravity | Value = 0; 0; -{G}
Loads/weight/Curve = t < 0.5 ? (1 - cos(2*pi*t))/2 : 1
Time/Integrator = generalised-alpha | End time = 1.1 | Steps = 22
Solver/Tolerance = 1e-8
"""


E, R, F = 1000, 10, 50
STAR = E / (1 - NU * NU)
A = (0.75 * F * R / STAR) ** (1 / 3)
P0 = 1.5 * F / (pi * A * A)


def error(result):
    """Of the pressure, root of the mean square over the contact, over p0."""
    return sqrt(sum(
        size * (t - P0 * sqrt(max(0, 1 - (x * x + y * y) / A ** 2))) ** 2
        for (x, y, z), (_, _, t), size in result.contact("position", "traction", "size")
        if z < 0.5 and min(x, y) > 1e-7) / (pi * A * A / 4)) / P0


for cells in (2, 3):
    result = run(scene_file("sphere.prm", at_rest(A / cells)))
    row = result.history()[-1]
    name = f"a/h = {cells}"
    bound(f"{name}: force over F/4 - 1", 4 * row["reaction_z of plane"] / F - 1, 1e-6)
    bound(f"{name}: radius of contact less a, over a cell",
          (sqrt(4 * row["contact area of plane"] / pi) - A) / (A / cells), 0.5)
    peak = max(t for (_, _, t), in result.contact("traction"))
    bound(f"{name}: peak over p0 - 1", peak / P0 - 1, 0.08)
    # 0.22 of p0 with four cells.
    bound(f"{name}: error of the pressure over p0", error(result), 0.26)

# Radius 1 from here on.
MASS, DELTA = 4 / 3 * pi, 0.1
v = sqrt(16 * STAR * DELTA ** 2.5 / (15 * MASS))
time, gap = 2.943 * DELTA / v, 0.02
rows = run(scene_file("thrown.prm", thrown(0.25, v, gap, gap / v + 1.15 * time)),
           QUIET).history()
energy = [8 * (row["kinetic energy"] + row["strain energy"]) / (MASS * v * v)
          for row in rows]
pushed = [row["t"] for row in rows if row["reaction_z of plane"] > 0]
bound("thrown: largest energy over that before - 1", max(energy) - 1, 0.005)
at_least("thrown: energy left", energy[-1], 0.94)
at_least("thrown: velocity after over before", 4 * rows[-1]["momentum_z"] / MASS / v, 0.95)
# A cell and a quarter is the largest radius of contact.
bound("thrown: touches at gap/v, off by, over the time of contact",
      (pushed[0] - gap / v) / time, 0.1)
bound("thrown: time of contact over exact - 1",
      (pushed[-1] - pushed[0]) / time - 1, 0.35)

rows = run(scene_file("rolling.prm", rolling()), QUIET).history()
a = ((rows[-1]["momentum_x"] - rows[-1]["momentum_z"])
     - (rows[11]["momentum_x"] - rows[11]["momentum_z"])) * sqrt(0.5) / 5e3 / 0.5
number("rolling, exact 4.955: acceleration", a, 3)
bound("rolling: acceleration over exact - 1", a / (5 / 7 * G * sqrt(0.5)) - 1, 0.05)
