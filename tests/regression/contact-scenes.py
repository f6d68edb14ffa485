# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Shipped scenes of contact beside what their heads say: a silo, a pile that is pulled, a
pipe that is pressed into clay and lifted, a disc that bounces."""

from math import exp, pi

rows = run("prm/geotechnics/silo.prm", QUIET).history()
K, MU, GAMMA, H = 0.3 / 0.7, 0.4, 8, 8
FLOOR = GAMMA / (2 * MU * K) * (1 - exp(-2 * MU * K * H)) / 2
number(f"silo: floor, Janssen {FLOOR:.4g} kN/m", rows[-1]["reaction_y of floor"], 4)
bound("silo: error", rows[-1]["reaction_y of floor"] / FLOOR - 1, 0.02)
bound("silo: floor and walls less weight, over it",
      (rows[-1]["reaction_y of floor"] + rows[-1]["reaction_y of wall"]) / (H * GAMMA / 2)
      - 1, 1e-8)

result = run("prm/geotechnics/pile-pulled.prm", {"Output/Points": "false"})
rows = result.history()
# tan(25 degrees) K0 gamma L^2/2 = 37.3, less as the sand gives: h/4 has 35.37 and 35.44
# (augmented Lagrangian).
number("pile: one side of the shaft, 35.4 kN/m", rows[-1]["reaction_y of pile"], 4)
bound("pile: error", rows[-1]["reaction_y of pile"] / 35.4 - 1, 0.02)
# Beside the tip, a corner, stress is singular.
cells = {}
for (x, y, _), (pressure, _, _) in result.contact("position", "traction"):
    if x < 0.3 and y > 3:
        cells.setdefault(int(y / 0.25), []).append(pressure)
means = [sum(cells[k]) / len(cells[k]) for k in sorted(cells, reverse=True)]
text("pile: pressure grows with depth from cell to cell, but for 5 %",
     means[-1] > 20 and all(below >= 0.95 * above
                            for above, below in zip(means, means[1:])))

rows = run("prm/geotechnics/pipe.prm", QUIET).history()
PIPE = 4.97 * 10 * 0.55 ** 0.23 / 2
deepest = min(rows, key=lambda row: row["u_y of pipe"])
number(f"pipe: half of it, {PIPE:.4g} kN/m", -deepest["reaction_y of pipe"], 4)
bound("pipe: error", -deepest["reaction_y of pipe"] / PIPE - 1, 0.04)
bound("pipe: force when it is lifted", rows[-1]["reaction_y of pipe"], 1e-8)

rows = run("prm/dynamics/bouncing-disc.prm", QUIET).history()
at_least("disc: steps in which it touches the floor",
         sum(row["contact area of floor"] > 0 for row in rows), 10)
MOMENTUM = 2 * 1000 * pi * 0.2 ** 2
number("disc: speed after over that before", rows[-1]["momentum_y"] / MOMENTUM, 3)

# One size of cells: methods and bands give the same.
result = run("prm/studies/contact.prm",
             {"Mesh/Cell size": 0.25, "Study/Group by": "Series", **QUIET}, command="study")
for row in result.study_rows():
    number(f"ring, {row['Series']}: error of the torque", float(row["error"]), 1)
    bound("all the same", float(row["error"]), 0.012)
