# ranks: 2  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Elastic ring and hollow sphere cut out of a mesh: order of convergence."""

from math import log2


def orders(scene, title, all_cells, dimension):
    """At least 1.9 over all cells together: the coarsest meshes can be lucky."""
    errors = []
    for cells in all_cells:
        error = run(scene, {"Mesh/Cells": ", ".join([str(cells)] * dimension),
                            "Output/Points": "false",
                            "Output/Mesh": "false"}).errors["l2_u"]
        number(f"{title} {cells} cells: l2_u", error, 3)
        errors.append(error)
    at_least(f"{title} order", log2(errors[0] / errors[-1]) / (len(errors) - 1),
             1.9)


orders("prm/boundaries/ring.prm", "ring,", (20, 40, 80, 160), 2)
orders("prm/boundaries/ring-roller.prm", "ring on a roller,",
       (20, 40, 80, 160), 2)
orders("prm/boundaries/hollow-sphere.prm", "hollow sphere,", (4, 8, 16), 3)
