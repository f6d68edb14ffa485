# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Thick cylinder under inner pressure, nearly incompressible: order two and the
mean stress with the mean change of volume of each cell, not without. A slice of
one in 3D that cuts its cells, by elements of both degrees."""

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

scene = scene_file("slice.prm", """
Dimension = 3
Mesh/Lower corner = 0, 0, 0 | Upper corner = 2.4, 2.4, 0.2 | Cell size = 0.2
Method/Method = finite element
Materials/rock/Young modulus = 1000 | Poisson ratio = 0
Bodies/tube/Shape = cylinder | Axis start = 0, 0, -1 | Axis end = 0, 0, 2 | Radius = 2
Bodies/tube/Inner radius = 1
Bodies/quarter/Shape = box | Lower corner = 0, 0, 0 | Upper corner = 3, 3, 0.2
Bodies/slice/Shape = intersection | Operands = tube, quarter
Grid conditions/x/Side = left | Components = x
Grid conditions/y/Side = front | Components = y
Grid conditions/bottom/Side = bottom | Components = z
Grid conditions/top/Side = top | Components = z
Loads/pressure/Type = surface traction | Body = slice | Part = tube/inner
Loads/pressure/Value = 0.1*x/sqrt(x^2 + y^2); 0.1*y/sqrt(x^2 + y^2); 0
Output/Mesh = false
""")
for degree, all_over, most in ((1, 5e-3, 1.2e-2), (2, 3e-4, 3e-3)):
    square = total = largest = 0
    for (x, y, _), (u, v, _), volume in run(
            scene, {"Method/Degree": degree}, on_ranks=1).points(
            "position", "displacement", "volume"):
        r = sqrt((x - u)**2 + (y - v)**2)
        exact = 0.1 / 3000 * (r + 4 / r)
        error = ((u * (x - u) + v * (y - v)) / r / exact) - 1
        square += volume * error**2
        total += volume
        largest = max(largest, abs(error))
    bound(f"slice in 3D, degree {degree}: displacement", sqrt(square / total),
          all_over)
    bound(f"slice in 3D, degree {degree}: displacement at any point", largest, most)
