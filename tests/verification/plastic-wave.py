# ranks: 1 # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A step load above yield in uniaxial strain: an elastic precursor of the
stress sigma_y (1 - nu) / (1 - 2 nu) at c_p, and a plastic front at
sqrt(K / rho), behind which the stress is that of the load."""

from math import sqrt

E, NU, RHO, YIELD, LOAD = 20e3, 0.25, 1.5, 100., 300.
C_ELASTIC = sqrt(E * (1 - NU) / (1 + NU) / (1 - 2 * NU) / RHO)
C_PLASTIC = sqrt(E / (3 * (1 - 2 * NU)) / RHO)
LIMIT = YIELD * (1 - NU) / (1 - 2 * NU)
RAMP = 0.01  # of the load; levels between come so much later


def arrival(rows, name, level):
    """When the stress passes the level."""
    for before, after in zip(rows, rows[1:]):
        a, b = (-row[f"sigma_yy at {name}"] for row in (before, after))
        if a < level <= b:
            return before["t"] + (level - a) / (b - a) * (after["t"] - before["t"])
    return float("nan")


def mean(rows, name, start, end):
    values = [-row[f"sigma_yy at {name}"] for row in rows if start < row["t"] < end]
    return sum(values) / len(values)


def compare(title, settings, wave=0.01, stress=0.01):
    result = run("prm/dynamics/plastic-wave.prm", settings)
    rows = result.history()
    for name in ("z5", "z10"):
        depth = 20 - rows[0][f"y at {name}"]
        elastic, plastic = depth / C_ELASTIC, depth / C_PLASTIC
        # Half way up each front; the load itself is there at half its ramp.
        first = arrival(rows, name, LIMIT / 2) - RAMP * LIMIT / 2 / LOAD
        second = arrival(rows, name, (LIMIT + LOAD) / 2) \
            - RAMP * (LIMIT + LOAD) / 2 / LOAD
        number(f"{title}, {name}: precursor's time over exact - 1",
               first / elastic - 1, 2)
        bound(f"{title}, {name}: precursor's time", first / elastic - 1, wave)
        number(f"{title}, {name}: plastic front's time over exact - 1",
               second / plastic - 1, 2)
        bound(f"{title}, {name}: plastic front's time", second / plastic - 1, wave)
        between = plastic - elastic
        level = mean(rows, name, elastic + RAMP * LIMIT / LOAD + 0.2 * between,
                     plastic + RAMP * LIMIT / LOAD - 0.2 * between)
        bound(f"{title}, {name}: stress of the precursor over exact - 1",
              level / LIMIT - 1, stress)
        behind = mean(rows, name, plastic + RAMP + 0.01, plastic + RAMP + 0.03)
        bound(f"{title}, {name}: stress behind the front over the load - 1",
              behind / LOAD - 1, stress)
    energy = result.summary["energy"]
    bound(f"{title}: energy that is dissipated, less than 0",
          min(0., energy["plastic_dissipation"]), 0.)
    number(f"{title}: part of the external work that is dissipated",
           energy["plastic_dissipation"] / energy["external_work"], 2)


compare("finite element", {})
