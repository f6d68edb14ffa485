# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Thick cylinder under inner pressure, nearly incompressible: order two and the
mean stress with the mean change of volume of each cell, not without."""

from math import log2, sqrt

NU = 0.49999
INNER = (1 + NU) / 1000 / 3 * (1 - 2 * NU + 4)
MEAN = 2 * (1 + NU) / 9  # of the three normal stresses, everywhere
FITTED = "prm/hard-cases/thick-cylinder-fe.prm"
CUT = "prm/hard-cases/thick-cylinder-gimp.prm"


def errors(scene, settings):
    """Of the displacement at the inner edge, of all, of the mean stress."""
    result = run(scene, settings)
    points = result.points("volume", "mean_stress")
    return (result.history()[-1]["u_x at inner"] / INNER - 1,
            result.errors["l2_u"],
            sqrt(sum(v * (p / MEAN - 1)**2 for v, p in points) /
                 sum(v for v, p in points)))


for title, scene, cells, settings, edge, stress in (
        ("fitted, finite element", FITTED, (3, 4), {}, 4e-4, 2e-4),
        ("cut, GIMP", CUT, (18, 36), {}, 2e-4, 1e-2),
        ("cut, CPDI1", CUT, (18, 36), {"Method/Method": "CPDI1"}, 2e-4, 1e-2),
        ("cut, finite element", CUT, (18, 36),
         {"Method/Method": "finite element"}, 2e-4, 1e-2)):
    last = None
    for n in cells:
        at, all_over, mean = errors(scene, {
            **settings, "Mesh/Refinements" if scene == FITTED else
            "Mesh/Cells": n if scene == FITTED else f"{n}, {n}"})
        number(f"{title}, {n}: displacement", all_over, 2)
        if last:
            at_least(f"{title}: order", log2(last / all_over), 1.9)
        last = all_over
    bound(f"{title}: displacement of the inner edge", at, edge)
    bound(f"{title}: mean stress", mean, stress)

for title, scene in (("fitted", FITTED), ("cut", CUT)):
    at, all_over, mean = errors(scene,
                                {"Method/Volumetric strain": "pointwise"})
    number(f"{title}, pointwise: displacement of the inner edge", at, 2)
    number(f"{title}, pointwise: mean stress", mean, 2)
