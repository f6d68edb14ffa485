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
Mesh/Lower corner = 0, {-1.37 * h!r} | Upper corner = {h * round(8 / h)!r}, {h * round(8 / h) - 1.37 * h!r}
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


for h in (0.3, 0.15):
    result = run(scene_file(f"hertz-{h}.prm", cylinder(h, "GIMP")))
    row = result.history()[-1]
    pressed = sorted((x, -t) for (x, _, _), (_, t, _) in result._fields("contact", ("position", "traction")) if x < 2)
    print(h, P0, row["reaction_y of plane"], result.summary["newton_iterations"])
    for x, p in pressed[::8]:
        print(x, p, P0 * sqrt(max(0, 1 - (x / A) ** 2)))
