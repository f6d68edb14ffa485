# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""An elastic bar hits a rigid wall: it touches at 0.5, presses with rho c v = 300 for
2 L/c and leaves as fast as it came, with the default integrator and with Newmark's."""

BAR = """
Dimension = 2
Mesh/Lower corner = 0, -1 | Upper corner = 0.2, 17 | Cell size = 0.2
Method/Method = finite element | Mesh after step = keep
Materials/bar/Young modulus = 900 | Poisson ratio = 0 | Density = 1
Bodies/bar/Lower corner = 0, 5 | Upper corner = 0.2, 15 | Initial velocity = 0; -10
Boundaries/wall/Points = -1 0; 2 0 | Constraint = contact
Grid conditions/sides/Side = left | Components = x
Time/Integrator = generalised-alpha | End time = 1.5
"""
scene = scene_file("bar.prm", BAR)
for courant, steps in ((1, 225), (0.5, 450)):
    result = run(scene, {"Time/Steps": steps, **QUIET})
    rows = result.history()
    pushed = [row["t"] for row in rows if row["reaction_y of wall"] > 0]
    energy = [(row["kinetic energy"] + row["strain energy"]) / 100 for row in rows]
    forces = [row["reaction_y of wall"] / 60 - 1 for row in rows
              if 0.52 < row["t"] < 1.15]
    dt = 1.5 / steps
    name = f"Courant number {courant}"
    bound(f"{name}: touches at 0.5, off by, steps", (pushed[0] - 0.5) / dt - 1, 1.01)
    bound(f"{name}: for 2/3, off by", pushed[-1] - pushed[0] - 2 / 3, 0.01)
    bound(f"{name}: largest energy over that before - 1", max(energy) - 1, 0.005)
    at_least(f"{name}: energy left", energy[-1], 0.94)
    bound(f"{name}: error of the force, root of the mean square",
          (sum(f * f for f in forces) / len(forces)) ** 0.5, 0.06)
    bound(f"{name}: momentum over exact - 1", rows[-1]["momentum_y"] / 20 - 1, 0.05)
