# debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A pulse in a column against d'Alembert's solution."""

from math import sqrt

E, NU, RHO, LENGTH = 20e3, 0.25, 1.5, 20.
M = E * (1 - NU) / (1 + NU) / (1 - 2 * NU)
C = sqrt(M / RHO)


def impulse(t):
    """Integral of the triangular pulse, 300 kPa at 0.25 s [kPa s]."""
    if t <= 0:
        return 0.
    if t <= 0.25:
        return 600 * t * t
    if t <= 0.5:
        return 75 - 600 * (0.5 - t) ** 2
    return 75.


def fixed_end(z, t):
    """Downward displacement at depth z: waves reflected at z = 20 m and 0."""
    return sum((-1) ** k * (impulse(t - (2 * k * LENGTH + z) / C)
                            - impulse(t - (2 * (k + 1) * LENGTH - z) / C))
               for k in range(20)) / (RHO * C)


def viscous_end(z, t):
    return impulse(t - z / C) / (RHO * C)


def compare(name, result, exact, balance=1e-10):
    rows = result.history()
    for depth in (5, 10, 15):
        u = [-row[f"u_y at z{depth}"] for row in rows]
        reference = [exact(depth, row["t"]) for row in rows]
        peak = max(map(abs, reference))
        error = max(abs(a - b) for a, b in zip(u, reference)) / peak
        number(f"{name}: displacement at {depth} m, largest error over the peak",
               error, 2)
        bound(f"{name}: at {depth} m", error, 2e-3)
    bound(f"{name}: energy out of balance",
          result.summary["energy"]["balance_error"], balance)
    for row in rows if balance == 1e-10 else []:
        # The sum is written down, too.
        bound_all = row["strain energy"] + row["kinetic energy of nodes"] \
            + row["absorbed energy"] - row["external work"]
        if abs(bound_all) > 1e-10 * rows[-1]["external work"]:
            text(f"{name}: energy at t = {row['t']}", f"NO, {bound_all}")


fixed = run("prm/phuong-2023/column-fixed-fe.prm")
compare("fixed", fixed, fixed_end)
viscous = run("prm/phuong-2023/column-viscous-fe.prm")
compare("viscous", viscous, viscous_end)
bound("viscous: final displacement at 10 m over impulse / (rho c) - 1",
      viscous.history()[-1]["u_y at z10"] / -viscous_end(10, 9) - 1, 1e-4)
# Points that stay, their strains by composite functions: internal forces are
# not those of the stored energy.
compare("fixed, DM-GC", run("prm/phuong-2023/column-fixed-fe.prm",
                            {"Method/Method": "DM-GC"}), fixed_end, 1e-3)
compare("viscous, DM-GC", run("prm/phuong-2023/column-viscous-fe.prm",
                              {"Method/Method": "DM-GC"}), viscous_end, 1e-4)
for integrator, settings in (
        ("generalised-alpha, 0.8", {"Time/Integrator": "generalised-alpha"}),
        ("lumped mass", {"Time/Mass": "lumped"})):
    result = run("prm/phuong-2023/column-fixed-fe.prm", settings)
    rows = result.history()
    number(f"{integrator}: displacement at 10 m, largest error over the peak",
           max(abs(-row["u_y at z10"] - fixed_end(10, row["t"]))
               for row in rows) / 0.2101, 2)
