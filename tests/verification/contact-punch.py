# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A rough flat punch on an elastic half-plane: the half width c of what sticks over that
of the punch. Poisson's ratio 0.3; the integral equation of the problem solved
numerically, and as its shear had no effect on the pressure: K'(c/a)/K(c/a) = beta/mu."""

from math import pi, sqrt

H = 0.2
# Half by symmetry. The ground is large: of 8 by 8, 0.6 of the punch would stick.
PUNCH = f"""
Dimension = 2
Mesh/Lower corner = 0, -24 | Upper corner = 24, 0 | Cell size = {H}
Method/Method = finite element | Mesh after step = keep
Materials/rock/Young modulus = 1000 | Poisson ratio = 0.3
Bodies/ground/Lower corner = 0, -24 | Upper corner = 24, 0
Boundaries/punch/Points = 1 0; -1 0 | Constraint = contact
Boundaries/punch/Translation = 0; -0.001*t
Grid conditions/axis/Side = left | Components = x
Grid conditions/base/Side = bottom
Time/Steps = 1
"""


def elliptic(k):
    """The complete integral of the first kind, by the arithmetic-geometric mean."""
    a, b = 1, sqrt(1 - k * k)
    while a - b > 1e-15:
        a, b = (a + b) / 2, sqrt(a * b)
    return pi / (2 * a)


def uncoupled(mu):
    beta = (1 - 2 * 0.3) / (2 * (1 - 0.3))
    low, high = 1e-9, 1 - 1e-9
    while high - low > 1e-9:
        c = (low + high) / 2
        falls = elliptic(sqrt(1 - c * c)) / elliptic(c) > beta / mu
        low, high = (c, high) if falls else (low, c)
    return low


for mu, exact in (0.1, 0.036), (0.2, 0.360), (0.5, 0.941):
    row = run(scene_file("punch.prm", PUNCH), {
        **QUIET, "Boundaries/punch/Friction": mu}).history()[-1]
    found = row["contact area of punch"] - row["slipping area of punch"]
    number(f"mu = {mu}: c/a, without coupling {uncoupled(mu):.3f}, exact {exact}",
           found, 2)
    bound("cells off", (found - exact) / H, 1)
