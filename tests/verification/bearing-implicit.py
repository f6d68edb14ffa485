# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Bearing capacity of a strip footing with all boundaries implicit, h = 1/16 of its
half width, against Prandtl's; and what is added where footing and ground move."""

from math import pi

for method, constraint, n in (("finite element", "roller", 2), ("GIMP", "fixed", 1)):
    result = run("prm/hard-cases/bearing-implicit.prm",
                 {"Method/Method": method, "Mesh/Cell size": 0.0625,
                  "Time/Steps": 8,
                  "Boundaries/footing/Constraint": constraint}, on_ranks=n)
    force = [-row["reaction_y of footing"] for row in result.history()]
    name = f"{method}, {constraint}"
    number(f"{name}: plateau over (2 + pi) k - 1", force[-1] / (2 + pi) - 1, 2)
    bound(f"{name}: plateau", force[-1] / (2 + pi) - 1, 3e-2)
    bound(f"{name}: rise in the last tenth of the way",
          force[-1] / force[-3] - 1, 1e-2)

# Soil heaves beside a footing and slides out of its last cell: less than two
# settlements over the half width, whatever the cells.
for h in (0.125, 0.25):
    stays, moves = (
        [-row["reaction_y of footing"] for row in run(
            "prm/hard-cases/bearing-implicit.prm",
            {**QUIET, "Mesh/Cell size": h, "Time/Steps": 8,
             "Method/Mesh after step": after_step}).history()]
        for after_step in ("keep", "follow material"))
    bound(f"moving, h = {h}: rise of the plateau over the settlement",
          (moves[-1] / stays[-1] - 1) / 0.01, 2)
    at_least(f"moving, h = {h}: it rises", moves[-1] / moves[-3] - 1, 1e-3)
