# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Simple stretch (Wang et al. 2018, section 3.1) by five methods: stretches,
stresses and reaction against stretch.csv at all steps, and Newton's order."""

import csv
import re
from math import log
from statistics import linear_regression, mean

with open(root / "tests/verification/stretch.csv") as file:
    lines = [line for line in file if not line.startswith("#")]
exact = [{key: float(value) for key, value in row.items()}
         for row in csv.DictReader(lines)]

# of history.csv: column, factor and what it must be
COLUMNS = {"x at corner": (0.5, "stretch_x"), "y at corner": (0.5, "stretch_y"),
           "sigma_xx at point": (1, "sigma_xx"),
           "sigma_zz at point": (1, "sigma_zz"),
           "reaction_x of right": (1, "reaction_x")}


def residuals(output):
    """Residuals of each step after its first iteration and the next ones, those
    of round-off left out."""
    for line in re.findall(r"residuals (.*)", output):
        yield [r for r in map(float, line.split()[1:]) if r >= 1e-13]


def orders(output):
    """Mean over the plastic steps of the slope from the last but one to the
    last pair (residual, next residual) on log axes; slope of one straight line
    through the pairs of all steps."""
    slopes, pairs = [], []
    for r in residuals(output):
        pairs += zip(r, r[1:])
        if len(r) > 2:
            slopes.append(log(r[-1] / r[-2]) / log(r[-2] / r[-3]))
    line = linear_regression([log(a) for a, _ in pairs],
                             [log(b) for _, b in pairs]).slope
    return slopes, line


SCENES = {"fe": "prm/wang-2018/stretch-fe.prm",
          "mpm": "prm/wang-2018/stretch-mpm.prm",
          "gimp": "prm/wang-2018/stretch-gimp.prm",
          "cpdi1": "prm/wang-2018/stretch-cpdi1.prm",
          "cpdi2": "prm/wang-2018/stretch-cpdi2.prm"}
for name, scene in SCENES.items():
    result = run(scene,
                 {"Output/Residuals": "true", "Output/Points": "false",
                  "Output/Mesh": "false"})
    history = result.history()
    text(f"{name}, steps", len(history))
    for column, (factor, key) in COLUMNS.items():
        largest = max(row[key] for row in exact)
        bound(f"{name}, {key}, all steps",
              max(abs(factor * found[column] - row[key])
                  for found, row in zip(history, exact)) / largest, 1e-8)
    slopes, line = orders(result.output)
    text(f"{name}, steps with an order", len(slopes))
    bound(f"{name}, mean order - 2", mean(slopes) - 2, 0.01)
    at_least(f"{name}, smallest order", min(slopes), 1.95)
    bound(f"{name}, line - 2", line - 2, 0.01)
