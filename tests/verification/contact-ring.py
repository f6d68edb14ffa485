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
Boundaries/shaft/Surface = circle | Centre = 0, 0 | Radius = {A + DELTA}
Boundaries/shaft/Body side = outside
Boundaries/shaft/Constraint = contact | Friction = {MU}
Boundaries/shaft/Rotation angle = 0.2*t
Boundaries/rim/Surface = circle | Centre = 0, 0 | Radius = {B}
Boundaries/rim/Body side = inside | Constraint = fixed
Time/Steps = 4
"""
# Lame's ring with u(a) = delta, u(b) = 0: sigma_r(a) = 2 (lambda + mu) c - 2 mu d/a^2
# for u = c r + d/r.
LAMBDA = E * NU / (1 + NU) / (1 - 2 * NU)
D = DELTA / (1 / A - A / B ** 2)
PRESSURE = 2 * G * D / A ** 2 + 2 * (LAMBDA + G) * D / B ** 2
number("pressure", PRESSURE, 6)
for method in ("GIMP", "CPDI1"):
    result = run(scene_file("ring.prm", RING), {"Method/Method": method})
    row = result.history()[-1]
    for name, found, exact in (
            ("torque", row["moment of shaft"], 2 * pi * A ** 2 * MU * PRESSURE),
            ("area that slides", row["slipping area of shaft"], 2 * pi * A)):
        number(f"{method}: {name}, exact {exact:.6g}", found, 5)
        bound(f"{method}: error", found / exact - 1, 0.005)
    bound(f"{method}: Newton iterations in a step",
          result.summary["newton_iterations"] / 4, 8)
