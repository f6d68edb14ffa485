# ranks: 1-2
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A block on an incline with friction: it stays or slides with g (sin - mu cos), and
comes to rest after v^2/(2 mu g)."""

from math import cos, radians, sin, tan

G = 9.81


def block(angle, mu, steps, end, more=""):
    """2 x 1 on a plane that falls to the right, in a mesh along x and y."""
    c, s = cos(radians(angle)), sin(radians(-angle))

    def at(x, y):
        return f"{c * x - s * y!r}, {s * x + c * y!r}"

    return f"""
Dimension = 2
Mesh/Lower corner = -0.85, -3.1 | Upper corner = 5.15, 1.4 | Cell size = 0.25
Method/Method = GIMP | Strain = finite
Materials/rock/Young modulus = 1e5 | Poisson ratio = 0.3 | Density = 2
Bodies/block/Lower corner = 0, 0 | Upper corner = 2, 1 | Rotation angle = {-angle}
Boundaries/plane/Points = {at(-1, 0)}; {at(9, 0)} | Constraint = contact
Boundaries/plane/Friction = {mu}
Loads/weight/Type = gravity | Value = 0; -{G}
Time/Steps = {steps} | End time = {end}
Probes/middle/Location = {at(1, 0.5)}
{more}
"""


DYNAMIC = "Time/Integrator = generalised-alpha\n"
for angle, mu in ((17, 0.2), (30, 0.3)):
    a = G * (sin(radians(angle)) - mu * cos(radians(angle)))
    result = run(scene_file(f"slide-{angle}.prm", block(angle, mu, 40, 1, DYNAMIC)))
    row = result.history()[-1]
    path = (row["u_x at middle"] ** 2 + row["u_y at middle"] ** 2) ** 0.5
    print(2 * path / a - 1, {k: v for k, v in row.items() if "energy" in k or "plane" in k}, result.summary["newton_iterations"])
for f in (0.99, 1.01):
    pass
