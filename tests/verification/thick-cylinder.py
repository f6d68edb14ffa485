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

SLICE = """
set Dimension = 3
subsection Mesh
  set Lower corner = 0, 0, 0
  set Upper corner = 2.4, 2.4, 0.2
  set Cell size    = 0.2
end
subsection Method
  set Method = finite element
end
subsection Materials
  subsection rock
    set Young modulus = 1000
    set Poisson ratio = 0
  end
end
subsection Bodies
  subsection tube
    set Shape        = cylinder
    set Axis start   = 0, 0, -1
    set Axis end     = 0, 0, 2
    set Radius       = 2
    set Inner radius = 1
  end
  subsection quarter
    set Shape        = box
    set Lower corner = 0, 0, 0
    set Upper corner = 3, 3, 0.2
  end
  subsection slice
    set Shape    = intersection
    set Operands = tube, quarter
  end
end
subsection Grid conditions
  subsection x
    set Side       = left
    set Components = x
  end
  subsection y
    set Side       = front
    set Components = y
  end
  subsection bottom
    set Side       = bottom
    set Components = z
  end
  subsection top
    set Side       = top
    set Components = z
  end
end
subsection Loads
  subsection pressure
    set Type  = surface traction
    set Body  = slice
    set Part  = tube/inner
    set Value = 0.1*x/sqrt(x^2 + y^2); 0.1*y/sqrt(x^2 + y^2); 0
  end
end
subsection Output
  set Mesh = false
end
"""
scene = folder / "slice.prm"
scene.write_text(SLICE)
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
