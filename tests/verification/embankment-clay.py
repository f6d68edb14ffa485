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

# The base and the water bear the clay, the water in it, and the sand. Lifts of finite
# elements fill the cells as these have moved.
for method in ("GIMP", "finite element"):
    result = run(EMBANKMENT, {"Method/Method": method})
    rows = result.history()
    at = {t: next(row for row in rows if abs(row["t"] - t) < 1e-9) for t in (1, 3, 4)}
    bound(f"{method}: settlement at rest", abs(at[1]["u_y at ground"]), 1e-10)
    number(f"{method}: settlement below the axis when built", -at[3]["u_y at ground"], 3)
    number(f"{method}: settlement at the end", -at[4]["u_y at ground"], 3)
    bound(f"{method}: forces over the weight - 1",
          abs((at[4]["reaction_y of base"] + at[4]["force_y of water"]) /
              (9.81 * at[4]["mass"]) - 1), 1e-6)
    bound(f"{method}: mass over that of the drawing - 1",
          abs(at[4]["mass"] / (1.6 * 180 + 1.9 * (9 + 7)) - 1), 1e-3)
    excess, = zip(*result.points("excess_pressure"))
    bound(f"{method}: excess pressure at the end", max(map(abs, excess)), 1e-9)
