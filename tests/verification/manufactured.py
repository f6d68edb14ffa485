# ranks: 1 # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Bodies that move as body forces make them: order in space and time."""

from math import log

SCENES = {"bar": "prm/dynamics/manufactured-bar.prm",
          "cube": "prm/dynamics/manufactured-cube.prm",
          "vortex": "prm/dynamics/manufactured-vortex.prm"}
# Nodes of finite elements keep their velocities.
METHODS = {"finite element": "APIC", "GIMP": "FLIP",
           "CPDI2": "FLIP", "material point": "FLIP"}


def settings_of(method, **others):
    return {"Method/Method": method,
            "Time/Velocity transfer": METHODS[method], **others}


def orders(cells, errors):
    return [log(a / b) / log(m / n)
            for m, n, a, b in zip(cells[1:], cells, errors, errors[1:])]


def refine(scene, method, cells, asked=None, on_ranks=None, **others):
    """Steps grow with the cells."""
    errors = [run(SCENES[scene],
                  settings_of(method, **{"Constants/n": n}, **others),
                  on_ranks=on_ranks).errors["l2_u"] for n in cells]
    transfer = others.get("Time/Velocity transfer")
    name = f"{scene}, {method}" + (f" with {transfer}" if transfer else "")
    for n, error in zip(cells, errors):
        number(f"{name}: error with {n} cells", error, 3)
    for n, order in zip(cells[1:], orders(cells, errors)):
        number(f"{name}: order to {n} cells", order, 2)
    if asked:
        at_least(f"{name}: last order", orders(cells, errors)[-1], asked)


for method in ("finite element", "GIMP", "CPDI2"):
    refine("bar", method, (16, 32, 64), 1.9)
# Points are h/4 from the sides of their cells: from h = 4 G on they cross them.
refine("bar", "material point", (8, 16, 32, 64), **{"Constants/G": 5e-3})
refine("bar", "material point", (16, 32))

# On a fine mesh the error is that of the steps.
for method in ("finite element", "GIMP"):
    steps = (32, 64)
    errors = [run(SCENES["bar"],
                  settings_of(method, **{"Constants/n": 256, "Time/Steps": n})
                  ).errors["l2_u"] for n in steps]
    for n, order in zip(steps[1:], orders(steps, errors)):
        at_least(f"bar, {method}: order in time to {n} steps", order, 1.9)

for method in ("finite element", "GIMP"):
    refine("cube", method, (6, 8), 1.9, on_ranks=2,
           **{"Solver/Solver": "amg-cg"})
for method in ("GIMP", "CPDI2"):
    refine("vortex", method, (16, 32), 1.9)
# With FLIP GIMP has 1.8 from here on, see manufactured.md.
for transfer in ("APIC", "FMPM"):
    refine("vortex", "GIMP", (16, 32), 1.9,
           **{"Time/Velocity transfer": transfer, "Solver/Solver": "amg-cg"})
