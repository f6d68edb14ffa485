# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A thin strip round a quarter of a rough drum, pulled until it slips: the force is
exp(mu pi/2) times that at its other end (Euler)."""

from math import exp, pi

MU, THICK = 0.3, 0.05
SCENE = f"""
Dimension = 2
Mesh/Lower corner = 0, 0 | Upper corner = 1.1, 1.1 | Cell size = 0.025
Method/Mesh after step = keep
Materials/steel/Young modulus = 1e4 | Poisson ratio = 0
Bodies/ring/Shape = ring | Centre = 0, 0 | Inner radius = 1 | Radius = {1 + THICK}
Bodies/box/Lower corner = 0, 0 | Upper corner = 2, 2
Bodies/strip/Shape = intersection | Operands = ring, box
Boundaries/drum/Surface = circle | Centre = 0, 0 | Radius = 1
Boundaries/drum/Body side = outside
Boundaries/drum/Constraint = contact | Friction = {MU}
Grid conditions/pull/Side = bottom | Components = y
Grid conditions/pull/Displacement = 0; -1e-3*max(0, 2*t - 1)
Loads/held/Type = surface traction | Points = 0 {1 + THICK}; 0 1
Loads/held/Value = -1; 0 | Curve = min(2*t, 1)
Time/Steps = 6
"""
for method in ("GIMP", "finite element"):
    row = run(scene_file("strip.prm", SCENE),
              {"Method/Method": method, **QUIET}).history()[-1]
    found = -row["reaction_y of pull"] / THICK
    number(f"{method}: force over that at the other end, exact {exp(MU * pi / 2):.4g}",
           found, 3)
    bound("error", found / exp(MU * pi / 2) - 1, 0.01)
    number("length that slips", row["slipping area of drum"], 2)
