# debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A column under self weight: stress converges with first order."""

from math import log2

METHODS = {
    "MPM, 2x2 points": {},
    "MPM, 3x3 points": {"Method/Points per direction": 3},
    "GIMP": {"Method/Method": "GIMP"},
    "FE Q1": {"Method/Method": "finite element"},
}

for name, settings in METHODS.items():
    errors = []
    for h in (4, 2, 1, 0.5):
        result = run("prm/verification/column.prm",
                     {**settings, "Mesh/Cell size": h})
        errors.append(result.errors["l2_sigma"])
        number(f"{name}, h = {h}: l2_sigma", errors[-1], 3)
        if h == 0.5:
            number(f"{name}, h = {h}: l2_u", result.errors["l2_u"], 3)
        # rho g H times the width
        bound(f"{name}, h = {h}: base reaction over weight - 1",
              result.reactions["base"][1] / 0.01 - 1, 1e-10)
    at_least(f"{name}: order of l2_sigma", log2(errors[0] / errors[-1]) / 3,
             0.95)

# Q2 contains the exact solution, on aligned cells and where the body cuts them.
for title, settings in (
        ("aligned", {"Mesh/Lower corner": "-2, -2",
                     "Mesh/Upper corner": "14, 54"}),
        ("cut", {})):
    result = run("prm/verification/column.prm",
                 {"Method/Method": "finite element", "Method/Degree": 2,
                  "Mesh/Cell size": 2, **settings})
    bound(f"FE Q2 on {title} cells: l2_u", result.errors["l2_u"], 1e-11)
    bound(f"FE Q2 on {title} cells: l2_sigma", result.errors["l2_sigma"], 1e-11)
