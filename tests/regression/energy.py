# ranks: 1 2 # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A run whose energy explodes does not end well; Nitsche's method on walls that
cut cells at an angle keeps it. The waves of oblique-inclined.prm, 100 steps."""

scene = "prm/dynamics/oblique-inclined.prm"
short = {"Time/Steps": 100, "Time/End time": 2.5, "Method/Aggregate below": 0}


def walls(enforcement, factor):
    return {**short,
            **{f"Boundaries/{wall}/{key}": value for wall in ("left", "right")
               for key, value in (("Enforcement", enforcement),
                                  ("Nitsche factor", factor))}}


def energies(result):
    return [row["kinetic energy of nodes"] + row["strain energy"]
            for row in result.history()]


for name, factor in (("symmetric Nitsche", 2), ("skew Nitsche", 2)):
    failed = run(scene, walls(name, factor), expect=1)
    message = failed.summary["message"]
    told = message.split("since t = ")[1].split(". ")[0]
    total = energies(failed)
    title = f"{name}, factor {factor}"
    text(f"{title}: status", failed.summary["status"])
    text("  message", message.split(":")[0])
    text("  where from", message.split(". ")[1].split(":")[0])
    at_least("  energy over that of the start", total[-1] / total[0], 100)
    bound("  and the step before", total[-2] / total[0], 101)
    at_least("  time since when, over that of the end",
             float(told) / failed.summary["time"], 0.3)

for name, factor, aggregate in (
        ("symmetric Nitsche", 10, 0.1), ("symmetric Nitsche", 20, 0),
        ("skew Nitsche", 10, 0.1), ("skew Nitsche", 10, 0),
        ("augmented Lagrangian", 10, 0.1)):
    kept = run(scene, {**walls(name, factor),
                       "Method/Aggregate below": aggregate})
    total = energies(kept)
    title = f"{name}, factor {factor}, aggregate below {aggregate}"
    text(f"{title}: status", kept.summary["status"])
    bound("  largest energy over that of the start", max(total) / total[0],
          1 + 1e-3)  # walls lend some
    bound("  work of walls, over that",
          max(abs(row["work of boundaries"]) for row in kept.history())
          / total[0], 1e-3)
