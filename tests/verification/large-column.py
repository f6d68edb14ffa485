# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A soft column under its own weight comes down to half its height. On two ranks
the finest mesh of each method."""

from math import exp, log2

# rho g l0, and the mean stress errors of AMPLE 1.1 over it (GIMP, 40 steps).
SCALE = 40e3
AMPLE = {4: 4.1333e-2, 8: 1.2941e-2, 16: 3.6589e-3, 32: 1.0487e-3,
         64: 4.3572e-4}


def lambert(s):
    """w with w exp(w) = s >= 0."""
    w = s / (1 + s)
    for _ in range(50):
        w -= (w * exp(w) - s) / ((1 + w) * exp(w))
    return w


def height(Y, E=1e4, load=800, length=50):
    """Exact height of what was at Y: E ln(lambda) / lambda = -load (l - Y)."""
    def q(s):
        return lambert(s) * (1 + lambert(s) / 2)
    return E / load * (q(load * length / E) - q(load * (length - Y) / E))


text("exact height of the top", f"{height(50):.8f}")

for scene, cells in (
        ("prm/large-deformation/column-gimp.prm", list(AMPLE)),
        ("prm/large-deformation/column-cpdi1.prm", list(AMPLE)),
        ("prm/large-deformation/column-cpdi2.prm", [8]),
        ("prm/large-deformation/column-mpm.prm", [4, 16, 64])):
    name = scene.split("-")[-1].split(".")[0]
    errors = []
    for n in cells:
        result = run(scene,
                     {"Mesh/Cells": f"1, {n}", "Output/Points": "false",
                      "Output/Mesh": "false"},
                     on_ranks=2 if n == cells[-1] else 1)
        errors.append(result.errors["mean_sigma"] / SCALE)
        title = f"{name}, {n} cells"
        number(f"{title}: mean stress error", errors[-1], 3)
        text(f"{title}: steps, rejected", (result.summary["steps"],
                                           result.summary["rejected_steps"]))
        if name != "mpm":
            # AMPLE's values are given with five digits.
            bound(f"{title}: error over AMPLE's GIMP", errors[-1] / AMPLE[n],
                  1 + 5e-5)
        bound(f"{title}: base reaction over weight - 1",
              result.reactions["base"][1] / SCALE - 1, 1e-8)
        if n == 64:
            place = height(50 - 12.5 / n)
            number(f"{title}: height of the topmost point - exact",
                   result.probes["y at top"] - place, 2)
    if name in ("gimp", "cpdi1"):
        at_least(f"{name}: order from 4 to 32 cells",
                 log2(errors[0] / errors[3]) / 3, 1.6)
    elif name == "mpm":
        at_least("mpm: error with 64 cells over that with 4",
                 errors[-1] / errors[0], 1)

errors = []
for n in (4, 16, 64):
    result = run("prm/large-deformation/column-mpm.prm",
                 {"Mesh/Cells": f"1, {n}", "Output/Points": "false",
                  "Output/Mesh": "false",
                  "Method/Point weights": "fitted to cells"},
                 on_ranks=2 if n == 64 else 1)
    errors.append(result.errors["mean_sigma"] / SCALE)
    number(f"mpm fitted to cells, {n} cells: mean stress error", errors[-1], 3)
    bound(f"mpm fitted to cells, {n} cells: base reaction over weight - 1",
          result.reactions["base"][1] / SCALE - 1, 1e-8)
at_least("mpm fitted to cells: order from 4 to 64 cells",
         log2(errors[0] / errors[2]) / 4, 1.5)
