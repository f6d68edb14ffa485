# debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A pulse in a column against d'Alembert's solution. What differs
in the step, the load or the probes is on one rank."""

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
    errors = []
    for depth in (5, 10, 15):
        u = [-row[f"u_y at z{depth}"] for row in rows]
        reference = [exact(depth, row["t"]) for row in rows]
        errors.append(max(abs(a - b) for a, b in zip(u, reference))
                      / max(map(abs, reference)))
    number(f"{name}: displacement, largest error over the peak", max(errors), 2)
    bound(f"{name}: displacement", max(errors), 2e-3)
    bound(f"{name}: energy out of balance",
          result.summary["energy"]["balance_error"], balance)
    for row in rows if balance == 1e-10 else []:
        # The sum is written down, too.
        bound_all = row["strain energy"] + row["kinetic energy of nodes"] \
            + row["absorbed energy"] - row["external work"]
        if abs(bound_all) > 1e-10 * rows[-1]["external work"]:
            text(f"{name}: energy at t = {row['t']}", f"NO, {bound_all}")


average = {"Time/Integrator": "Newmark"}
compare("fixed, average acceleration",
        run("prm/phuong-2023/column-fixed-fe.prm", average, on_ranks=1), fixed_end)
# What Bathe's rule takes of the waves that the mesh does not resolve.
compare("fixed", run("prm/phuong-2023/column-fixed-fe.prm"), fixed_end, 1e-4)
viscous = run("prm/phuong-2023/column-viscous-fe.prm", on_ranks=1)
compare("viscous", viscous, viscous_end)
bound("viscous: final displacement at 10 m over impulse / (rho c) - 1",
      viscous.history()[-1]["u_y at z10"] / -viscous_end(10, 9) - 1, 1e-4)
# Points that stay, their strains by composite functions: internal forces are
# not those of the stored energy.
result = run("prm/phuong-2023/column-fixed-dmgc.prm")
compare("fixed, DM-GC", result, fixed_end, 1e-4)
# The first step has 2.4 % of an energy of next to nothing.
text("fixed, DM-GC: warnings", len(result.summary.get("warnings", [])))
compare("viscous, DM-GC",
        run("prm/phuong-2023/column-viscous-dmgc.prm", on_ranks=1), viscous_end, 1e-4)
rows = run("prm/phuong-2023/column-viscoelastic-dmgc.prm", on_ranks=1).history()
number("viscoelastic, DM-GC: largest displacement at 10 m",
       max(-row["u_y at z10"] for row in rows), 4)


def pulse(t):
    return 300 * max(0, 1 - abs(t / 0.25 - 1)) if t > 0 else 0.


def fixed_stress(z, t):
    return sum((-1) ** k * (pulse(t - (2 * k * LENGTH + z) / C)
                            + pulse(t - (2 * (k + 1) * LENGTH - z) / C))
               for k in range(20))


def viscous_stress(z, t):
    return pulse(t - z / C)


def compare_points(name, scene, limit, settings={}, on_ranks=None,
                   exact_u=fixed_end, exact_stress=fixed_stress):
    """At the points next to the depths; the stress too."""
    probes = {f"Probes/z{depth}/{key}": value for depth in (5, 10, 15)
              for key, value in (("Kind", "nearest point"),
                                 ("Quantities", "displacement, stress, position"))}
    rows = run(scene, {**probes, **settings}, on_ranks=on_ranks).history()
    errors = {}
    for depth in (5, 10, 15):
        z = LENGTH - rows[0][f"y at z{depth}"] + rows[0][f"u_y at z{depth}"]
        for what, column, field in (("displacement", "u_y", exact_u),
                                    ("stress", "sigma_yy", exact_stress)):
            exact = [field(z, row["t"]) for row in rows]
            error = max(abs(row[f"{column} at z{depth}"] + value)
                        for row, value in zip(rows, exact)) \
                / max(map(abs, exact))
            errors[what] = max(errors.get(what, 0), error)
    for (what, error), allowed in zip(errors.items(), (2e-3, limit)):
        number(f"{name}: {what}, largest error over the peak", error, 2)
        bound(f"{name}: {what}", error, allowed)


# Points that do not move through their cells, at the full load.
gimp = "prm/phuong-2023/column-fixed-gimp.prm"
for name, scene in (("GIMP", gimp),
                    ("MPM", "prm/phuong-2023/column-fixed-mpm.prm"),
                    ("FE", "prm/phuong-2023/column-fixed-fe.prm"),
                    ("DM-GC", "prm/phuong-2023/column-fixed-dmgc.prm")):
    compare_points(f"fixed, {name}", scene, 2e-2,
                   on_ranks=None if name == "GIMP" else 1)
    if name == "FE":
        compare_points("fixed, FE, average acceleration", scene, 2.5e-2, average,
                       on_ranks=1)
compare_points("viscous, DM-GC", "prm/phuong-2023/column-viscous-dmgc.prm", 2e-2,
               on_ranks=1, exact_u=viscous_end, exact_stress=viscous_stress)
# The forces of DM-GC are those of the points' own functions; with those of the
# recovered stress, waves grew the faster, the smaller the steps.
result = run("prm/phuong-2023/column-fixed-dmgc.prm",
             {**average, "Time/End time": 2, "Time/Steps": 3200}, on_ranks=1)
bound("fixed, DM-GC, a quarter of the step: energy out of balance",
      result.summary["energy"]["balance_error"], 1e-4)
# Points that do, at a thousandth of it and at a third.
for load in (0.001, 0.3):
    rows = run(gimp, {"Method/Mesh after step": "reset",
                      "Loads/pulse/Curve": load},
               on_ranks=1 if load == 0.001 else None).history()
    number(f"fixed, GIMP, points move, load times {load}: displacement at 10 m, "
           "largest error over the peak",
           max(abs(row["u_y at z10"] / load + fixed_end(10 - 0.0625, row["t"]))
               for row in rows) / 0.2101, 2)
for integrator, settings in (
        ("generalised-alpha, 0.8", {"Time/Integrator": "generalised-alpha"}),
        ("lumped mass", {**average, "Time/Mass": "lumped"})):
    result = run("prm/phuong-2023/column-fixed-fe.prm", settings)
    rows = result.history()
    number(f"{integrator}: displacement at 10 m, largest error over the peak",
           max(abs(-row["u_y at z10"] - fixed_end(10, row["t"]))
               for row in rows) / 0.2101, 2)
