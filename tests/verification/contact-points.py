# ranks: 1-2  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A block whose points are given slides as one that is drawn: its rim is that of the
boxes of its points, also where they leave gaps along it."""

from math import cos, radians, sin
from random import Random

G, MU, ANGLE = 9.81, 0.3, 30
FORCE = (G * sin(radians(ANGLE)), -G * cos(radians(ANGLE)))
A = FORCE[0] + MU * FORCE[1]
noise = Random(48)
for name, spread in ("grid", 0), ("scattered", 0.04):
    with open(folder / f"{name}.csv", "w") as file:
        print("x,y,volume", file=file)
        for i in range(16):
            for j in range(8):
                x = (i + 0.5) / 8 + spread * (noise.random() - 0.5)
                print(f"{x!r},{(j + 0.5) / 8!r},{1 / 64!r}", file=file)
scene = scene_file("block.prm", f"""
Mesh/Lower corner = -0.6, -0.35 | Upper corner = 3.9, 1.4 | Cell size = 0.25
Method/Strain = finite
Materials/rock/Young modulus = 1e5 | Poisson ratio = 0.3 | Density = 2
Bodies/block/Lower corner = 0, 0 | Upper corner = 2, 1
Boundaries/plane/Points = -1 0; 9 0 | Constraint = contact | Friction = {MU}
Loads/weight/Type = gravity | Value = {FORCE[0]!r}; {FORCE[1]!r}
Time/Integrator = generalised-alpha | Steps = 20 | End time = 0.5
Probes/middle/Location = 1.06, 0.56
""")
for method in ("GIMP", "CPDI1", "material point"):
    for points in ("drawn", "grid", "scattered"):
        result = run(scene, {"Method/Method": method, **({} if points == "drawn" else {
            "Bodies/block/Shape": "points-from-file", "Bodies/block/Lower corner": "",
            "Bodies/block/Upper corner": "",
            "Bodies/block/Point file": folder / f"{points}.csv"}), **QUIET})
        row = result.history()[-1]
        bound(f"{method}, {points}: acceleration over exact - 1",
              row["u_x at middle"] / (A * 0.25 / 2) - 1, 2e-3)
        if points != "scattered":
            bound(f"{method}, {points}: contact area - 2", row["contact area of plane"] - 2,
                  1e-2)
