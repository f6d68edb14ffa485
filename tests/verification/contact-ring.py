# ranks: 1-2
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A ring shrunk on a rigid shaft that is too thick for it, and then turned: pressure and
torque of Lame's ring with its rim held."""

from math import pi

E, NU, A, B, DELTA, MU = 1000, 0.3, 1, 2, 1e-3, 0.3
G = E / 2 / (1 + NU)
RING = f"""
Dimension = 2
Mesh/Lower corner = -2.25, -2.25 | Upper corner = 2.25, 2.25 | Cell size = 0.125
Method/Method = GIMP | Mesh after step = keep
Materials/steel/Young modulus = {E} | Poisson ratio = {NU}
Bodies/ring/Shape = ring | Centre = 0, 0 | Inner radius = {A} | Radius = {B}
Boundaries/shaft/Surface = circle | Centre = 0, 0 | Radius = {A + DELTA} | Body side = outside
Boundaries/shaft/Constraint = contact | Friction = {MU}
Boundaries/shaft/Rotation angle = 0.2*t
Boundaries/rim/Surface = circle | Centre = 0, 0 | Radius = {B} | Body side = inside | Constraint = fixed
Time/Steps = 4
"""
result = run(scene_file("ring.prm", RING))
for row in result.history():
    print(row["moment of shaft"], row["contact area of shaft"], row["slipping area of shaft"])
p = [sum(c * c for c in t) ** 0.5 for t, s in result.contact("traction", "size") if abs(t[0]) + abs(t[1]) > 0]
print(min(p), max(p), sum(p) / len(p), 1.66667 * (1 + MU * MU) ** 0.5, result.summary["newton_iterations"])
