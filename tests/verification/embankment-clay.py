# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Soft clay (Cam-clay) that is loaded before its water can flow. A footing against
its undrained strength, and an embankment that is built, then settles."""

FOOTING = "prm/geotechnics/footing-cam-clay.prm"
EMBANKMENT = "prm/geotechnics/embankment-clay.prm"

# (2 + pi) s_u with s_u = sin(phi) 100 (1/2)^0.8.
s_u = 0.5 * 100 * 0.5**0.8
rows = run(FOOTING, QUIET).history()
forces = [-row["reaction_y of footing"] for row in rows]
number("footing: N_c, exact 5.142", forces[-1] / s_u, 3)
bound("footing: error", abs(forces[-1] / s_u / 5.14159 - 1), 0.04)
bound("footing: rise in the last quarter of the way",
      forces[-1] / forces[3 * len(forces) // 4] - 1, 0.01)

settled = {}
for method in ("GIMP", "finite element"):
    result = run(EMBANKMENT, {"Method/Method": method})
    rows = result.history()
    at = {t: next(row for row in rows if abs(row["t"] - t) < 1e-9) for t in (2, 3)}
    # The clay and its water, 16 kN/m3 * 9.81 / 10, and the sand.
    weight = 9.81 * (1.6 * 180 + 1.9 * (1.5 * 21 / 2 + 1.5 * 15 / 2))
    settled[method] = [-at[t]["u_y at ground"] for t in (2, 3)]
    number(f"{method}: settlement below the axis when built", settled[method][0], 3)
    number(f"{method}: settlement at the end", settled[method][1], 3)
    for t in (2, 3):
        print(at[t])
    excess, = zip(*result.points("excess_pressure"))
    bound(f"{method}: excess pressure at the end", max(map(abs, excess)), 1e-9)
