# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A cylinder pressed on a rigid plane beside Hertz (1882): half width of contact
a = sqrt(4 P R/(pi E*)), pressure p0 = 2 P/(pi a) in its middle."""

from math import pi, sqrt

E, NU, R, P = 1000, 0.3, 10, 50
STAR = E / (1 - NU * NU)
A = sqrt(4 * P * R / (pi * STAR))
P0 = 2 * P / (pi * A)


def cylinder(h, method, more=""):
    """Half of the lower part, 8 wide."""
    return f"""
Dimension = 2
Mesh/Lower corner = 0, {-1.37 * h!r}
Mesh/Upper corner = {h * round(8 / h)!r}, {h * round(8 / h) - 1.37 * h!r}
Mesh/Cell size = {h!r}
Method/Method = {method} | Mesh after step = keep
Materials/steel/Young modulus = {E} | Poisson ratio = {NU}
Bodies/disc/Shape = disc | Centre = 0, {R} | Radius = {R}
Bodies/box/Lower corner = 0, 0 | Upper corner = 7.5, 7.5
Bodies/cylinder/Shape = intersection | Operands = disc, box
Boundaries/plane/Points = -1 0; 9 0 | Constraint = contact
Grid conditions/axis/Side = left | Components = x
Loads/top/Type = surface traction | Points = 7 7.5; 0 7.5 | Value = 0; {-P / 14!r}
Loads/top/Curve = t
Time/Steps = 2
{more}
"""


errors = {}
for h in (0.3, 0.15):
    result = run(scene_file(f"hertz-{h}.prm", cylinder(h, "GIMP")))
    row = result.history()[-1]
    bound(f"h = {h}: force over P/2 - 1", row["reaction_y of plane"] / (P / 2) - 1, 1e-6)
    # The end of the contact is that of a cell.
    bound(f"h = {h}: half width less a, over a cell",
          (row["contact area of plane"] - A) / h, 0.6)
    # Of means over cells, as they are.
    errors[h] = sum(
        size * (t - P0 * sqrt(max(0, 1 - (x / A) ** 2))) ** 2
        for (x, y, _), (_, t, _), size in result.contact("position", "traction", "size")
        if y < 0.05 * R and (x > 1e-6 or y < 1e-6)) ** 0.5
    if h < 0.2:
        peak = max(t for (_, t, _), in result.contact("traction"))
        number("peak", peak, 4)
        bound("peak over p0 - 1", peak / P0 - 1, 0.04)
at_least("error of the pressure with cells of twice the size, over it",
         errors[0.3] / errors[0.15], 1.3)
