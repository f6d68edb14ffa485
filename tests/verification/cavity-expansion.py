# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Cylindrical cavities in sand that are widened to twice their radius, beside the
pressures of Yu and Houlsby (1991), and of an ordinary differential equation for the
law at hand, logarithmic strain and Kirchhoff stress."""

from math import exp, log, radians, sin, sqrt

SCENE, BOX = "prm/geotechnics/cavity-expansion.prm", "prm/geotechnics/cavity-box.prm"
# Yu and Houlsby (1991), Geotechnique 41, 173: sand without end, over a/a0
PUBLISHED = {0: {1.1: 332.4196, 1.2: 396.8222, 1.5: 479.8630, 2: 528.3874},
             10: {1.1: 357.3374, 1.2: 438.8751, 1.5: 551.0973, 2: 622.3646}}


def pressure(wide, psi, outer, n=400):
    """Of a cavity widened by a factor; 100 kPa, a dead load, act at this radius."""
    E, nu, s, q = 1e4, 0.3, sin(radians(30)), sin(radians(psi))
    mu, lam = E / 2 / (1 + nu), E * nu / (1 + nu) / (1 - 2 * nu)
    first = -100 / (3 * lam + 2 * mu)
    flow = 2 * lam * q - 2 * mu * (1 - q), 2 * lam * q + 2 * mu * (1 + q)

    def stress(radial, around):
        mean = lam * (3 * first + radial + around)
        a, b = mean + 2 * mu * (first + radial), mean + 2 * mu * (first + around)
        out = max(0, (1 + s) * b - (1 - s) * a) / (
            (1 + s) * flow[1] - (1 - s) * flow[0])
        return a - out * flow[0], b - out * flow[1]

    def slopes(R, r, P):
        """Over log(R), of the place and of the radial force over first area."""
        around, x = log(r / R), 0
        for _ in range(30):
            f = [stress(x + d, around)[0] - P * exp(x + d) for d in (0, 1e-6)]
            move = -1e-6 * f[0] / (f[1] - f[0])
            x += max(-0.3, min(0.3, move))
            if abs(move) < 1e-12:
                break
        return R * exp(x), stress(x, around)[1] * R / r - P

    low, high = 100, 2000
    while high - low > 1e-6:
        middle, step = (low + high) / 2, log(outer) / n
        r, P = wide, -middle
        for i in range(n):
            a, b = slopes(exp(i * step), r, P)
            a, b = slopes(exp((i + 0.5) * step), r + step / 2 * a,
                          P + step / 2 * b)
            r, P = r + step * a, P + step * b
        low, high = (low, middle) if P + 100 < 0 else (middle, high)
    return low / wide


def measured(result, last):
    """Mean radius of the wall and the pressure, at all times."""
    return [(1 + (row["u_x at wall"] + sqrt(2) * row["u_x at wall between"]) / 2,
             100 + (last - 100) * row["t"]) for row in result.history()]


def at(rows, wide):
    """The pressure where the wall is."""
    for (a, N), (b, M) in zip(rows, rows[1:]):
        if a <= wide < b:
            return (N + (wide - a) / (b - a) * (M - N)) / wide
    return None


for psi, published in PUBLISHED.items():
    last = 1060 if psi == 0 else 1260
    law = {wide: pressure(wide, psi, 200) for wide in published}
    for wide, value in published.items():
        bound(f"psi = {psi}, {wide}: differential equation over published - 1",
              law[wide] / value - 1, 1e-2)
    for method in "finite element", "CPDI1":
        rows = measured(run(SCENE, {
            "Method/Method": method, "Materials/sand/Dilation angle": psi,
            "Loads/pressure/Curve": f"100 + {last - 100}*t", **QUIET}), last)
        for wide, value in published.items():
            p = at(rows, wide)
            bound(f"psi = {psi}, {method}, {wide}: over published - 1",
                  p / value - 1, 1e-2)
            bound(f"psi = {psi}, {method}, {wide}: over differential equation - 1",
                  p / law[wide] - 1, 1e-2)

# A box of equal cells. Without dilation bands form in it, which the exact solution
# does not have.
for psi, last, methods in (10, 480, ("GIMP", "finite element")), (
        0, 440, ("GIMP",)):
    for method in methods:
        rows = measured(run(BOX, {
            "Method/Method": method, "Materials/sand/Dilation angle": psi,
            "Loads/pressure/Curve": f"100 + {last - 100}*t", **QUIET}), last)
        for wide in 1.1, 1.2:
            bound(f"box, psi = {psi}, {method}, {wide}: over differential "
                  "equation - 1", at(rows, wide) / pressure(wide, psi, 10) - 1,
                  5e-3 if psi else 1e-2)
