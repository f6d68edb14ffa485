# ranks: 1-2  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A block on a plane with friction: it stays or slides with g (sin - mu cos), and comes
to rest after v^2/(2 mu g); its work is in the balance of energy."""

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
for angle, mu in ((17, 0.2), (30, 0.3), (30, 0.5)):
    a = G * (sin(radians(angle)) - mu * cos(radians(angle)))
    for method in ("GIMP", "CPDI1", "finite element"):
        result = run(scene_file(f"slide-{angle}-{mu}.prm",
                                block(angle, mu, 40, 1, DYNAMIC)),
                     {"Method/Method": method, **QUIET})
        row = result.history()[-1]
        name = f"{angle} degrees, mu = {mu}, {method}"
        path = (row["u_x at middle"] ** 2 + row["u_y at middle"] ** 2) ** 0.5
        bound(f"{name}: acceleration over exact - 1", 2 * path / a - 1, 2e-3)
        heat = 4 * G * cos(radians(angle)) * mu * path
        bound(f"{name}: work of friction over exact - 1",
              row["work of friction of plane"] / -heat - 1, 2e-3)
        bound(f"{name}: energy out of balance, over that",
              sum(one["energy out of balance"] for one in result.history()) / heat,
              1e-3)
    bound(f"{name}: Newton iterations in a step",
          result.summary["newton_iterations"] / 40, 8)

row = run("prm/dynamics/sliding-block.prm", QUIET).history()[-1]
bound("shipped scene: work of friction over exact - 1",
      row["work of friction of plane"] / (4 * G * cos(radians(17)) * 0.2 * (
          row["u_x at middle"] ** 2 + row["u_y at middle"] ** 2) ** 0.5) + 1, 2e-3)

# Statics: 1 % on either side of tan(angle).
for angle in (17, 30):
    for share in (1.01, 0.99):
        scene = scene_file("start.prm", block(angle, share * tan(radians(angle)), 2, 1))
        result = run(scene, {"Loads/weight/Curve": "t", **QUIET}, expect=None)
        text(f"{angle} degrees, mu = {share} tan(angle)", result.summary["status"])

# Thrown along level ground.
result = run(scene_file("stop.prm", block(0, 0.3, 120, 1.2, DYNAMIC)),
             {"Bodies/block/Initial velocity": "2; 0", **QUIET})
row = result.history()[-1]
number("stops after v^2/(2 mu g) = 0.6796", row["u_x at middle"], 4)
bound("way over exact - 1", row["u_x at middle"] / (4 / (0.6 * G)) - 1, 0.01)
# The pressure swings at first, as the weight comes at once.
bound("work of friction over the energy - 1",
      row["work of friction of plane"] / -8 - 1, 0.02)
