# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A disc on a rough slope rolls, or slides and spins; a block on a slope that gets
steeper topples or slides, whichever comes first."""

from math import atan, atan2, ceil, cos, degrees, hypot, pi, radians, sin

G, R, ANGLE, END = 9.81, 0.5, 30, 0.6
C, S = cos(radians(ANGLE)), sin(radians(ANGLE))


def at(x, y):
    """x down the slope, y off it."""
    return f"{C * x + S * y!r}, {C * y - S * x!r}"


# 16 cells across; with eight the mean over a cell is too coarse a contact, 3 %.
DISC = f"""
Dimension = 2
Mesh/Lower corner = -0.53, -1.01 | Upper corner = 1.47, 1.24 | Cell size = 0.0625
Method/Method = GIMP | Strain = finite
Materials/rubber/Young modulus = 1000 | Poisson ratio = 0.3 | Density = 1
Bodies/disc/Shape = disc | Centre = {at(0, R)} | Radius = {R}
Boundaries/plane/Points = {at(-2, 0)}; {at(9, 0)} | Constraint = contact
Loads/weight/Type = gravity | Value = 0; -{G}
Time/Steps = 60 | End time = {END} | Integrator = generalised-alpha
Probes/middle/Location = {at(0, R)} | Kind = interpolated
Probes/side/Location = {at(R / 2, R)} | Kind = interpolated
"""


def accelerations(row):
    """Down the slope, and R times that of the spin."""
    x, y = (row[f"u_{c} at middle"] for c in "xy")
    along, off = (R / 2 * e + row[f"u_{c} at side"] - row[f"u_{c} at middle"]
                  for c, e in (("x", C), ("y", -S)))
    turn = (-radians(ANGLE) - atan2(off, along)) % (2 * pi)
    return 2 * hypot(x, y) / END ** 2, 2 * R * turn / END ** 2


for name, mu, path, spin in (("rolls", 0.3, 2 / 3 * G * S, 2 / 3 * G * S),
                             ("slides", 0.1, G * (S - 0.1 * C), 2 * 0.1 * G * C)):
    result = run(scene_file("disc.prm", DISC), {"Boundaries/plane/Friction": mu, **QUIET})
    found = accelerations(result.history()[-1])
    number(f"disc {name}: acceleration, exact {path:.5g}", found[0], 3)
    bound("error", found[0] / path - 1, 0.01)
    # As it rolls, it creeps by its elasticity: Carter's (1926) share of the path is 2 %.
    number(f"disc {name}: spin times R, exact {spin:.5g}", found[1], 3)
    bound("error", found[1] / spin - 1, 0.05)

# 1 x 2, 20 cells across; just over half a cell at the edge that it topples over.
H = 1 / 20
BLOCK = f"""
Dimension = 2
Mesh/Lower corner = {-2.55 * H!r}, {-1.37 * H!r}
Mesh/Upper corner = {1 + 2.45 * H!r}, {41.63 * H!r} | Cell size = {H!r}
Method/Method = GIMP | Strain = finite
Materials/rock/Young modulus = 1e5 | Poisson ratio = 0.3 | Density = 1
Bodies/block/Lower corner = 0, 0 | Upper corner = 1, 2
Boundaries/plane/Points = -9 0; 9 0 | Constraint = contact
Loads/across/Type = gravity | Value = 0; -{G}
Loads/along/Type = gravity | Value = {G}; 0
Time/Steps = 12 | End time = 12 | Smallest step = 0.02
"""
for name, mu, exact in (("topples", 0.6, degrees(atan(0.5))),
                        ("slides", 0.4, degrees(atan(0.4)))):
    first = exact - 2.5
    tilt = f"pi/180*({first!r} + 0.5*max(0, t - 2))"
    result = run(scene_file("block.prm", BLOCK), {
        "Boundaries/plane/Friction": mu,
        "Loads/across/Curve": f"min(t, 1)*cos({tilt})",
        "Loads/along/Curve": f"max(0, min(t - 1, 1))*sin({tilt})", **QUIET}, expect=1)
    row = result.history()[-1]
    found = first + 0.5 * (row["t"] - 2)
    number(f"block {name}: angle, exact {exact:.4g}", found, 4)
    bound("error in degrees", found - exact, 1)
    number("part in contact at last", row["contact area of plane"], 2)
