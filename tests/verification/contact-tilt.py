# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A smooth flat punch, 2a wide, that turns as it presses on an elastic half plane with its
force P at e > a/2 from its middle: contact over 4 (a - e), turn P (1 - nu^2)/(pi E (a - e))."""

from math import degrees, pi

E, NU, A, TURN = 1000, 0.3, 1, 1e-3
SCENE = f"""
Dimension = 2
Mesh/Lower corner = -5, -6 | Upper corner = 7, 0
Method/Method = finite element | Mesh after step = keep
Materials/steel/Young modulus = {E} | Poisson ratio = {NU}
Bodies/ground/Lower corner = -5, -6 | Upper corner = 7, 0
Boundaries/punch/Points = {A} 0; {-A} 0 | Constraint = contact
Boundaries/punch/Translation = 0; -9e-4*t | Rotation angle = {-degrees(TURN)!r}*t
Grid conditions/base/Side = bottom
Time/Steps = 2
"""
for h in (0.25, 0.125):
    row = run(scene_file("punch.prm", SCENE), {"Mesh/Cell size": h, **QUIET}).history()[-1]
    force = -row["reaction_y of punch"]
    e = -row["moment of punch"] / force
    number(f"h = {h}: e/a", e / A, 2)
    bound("width of contact less 4 (a - e), over a cell",
          (row["contact area of punch"] - 4 * (A - e)) / h, 1)
    number("turn for P and e over that of the punch",
           force * (1 - NU ** 2) / (pi * E * (A - e)) / TURN, 2)
