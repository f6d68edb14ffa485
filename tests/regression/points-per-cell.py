# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Studies of points per cell, shortened: what their page says of 1, 2, 3 and 4."""

import csv


def study(scene, settings, expect=0):
    result = run(scene, settings, command="study", expect=expect)
    with open(result.folder / "study.csv") as file:
        return {(row["Series"], int(row["Method/Points per direction"])): row
                for row in csv.DictReader(file)}


def errors(rows, method):
    return [float(rows[method, n]["error"]) for n in (1, 2, 3, 4)]


# Points that stay: the methods are one, and their number hardly matters.
for name, scene in (("cut", "prm/studies/points-per-cell-cut.prm"),
                    ("plastic", "prm/studies/points-per-cell-plastic.prm")):
    rows = study(scene, {"Mesh/Cells": "36, 36"})
    mpm = errors(rows, "MPM")
    for n, error in enumerate(mpm, 1):
        number(f"{name}, {n} per direction", error, 2)
    bound("  GIMP and CPDI1 differ from MPM by",
          max(abs(b / a - 1) for other in ("GIMP", "CPDI1")
              for a, b in zip(mpm, errors(rows, other))), 1e-6)
    bound("  2 over 4, - 1", mpm[1] / mpm[3] - 1, 0.2)
    at_least("  1 over 2", mpm[0] / mpm[1], 1.15)

# Points that cross cells.
rows = study("prm/studies/points-per-cell-column.prm", {"Mesh/Cells": "1, 32"})
for method in ("MPM", "GIMP", "CPDI1"):
    for n, error in enumerate(errors(rows, method), 1):
        number(f"column, {method}, {n} per direction", error, 2)
bound("  CPDI2 differs from CPDI1 by",
      max(abs(b / a - 1) for a, b in zip(errors(rows, "CPDI1"),
                                         errors(rows, "CPDI2"))), 1e-6)
at_least("  MPM with 4 over GIMP with 2",
         errors(rows, "MPM")[3] / errors(rows, "GIMP")[1], 30)
bound("  GIMP with 2 over 4", errors(rows, "GIMP")[1] /
      errors(rows, "GIMP")[3], 1)

# Bent to a quarter turn: with 1 nothing holds cells against hourglasses.
rows = study("prm/studies/points-per-cell-beam.prm",
             {"Mesh/Cell size": 0.5}, expect=1)
for method in ("GIMP", "CPDI1", "CPDI2"):
    for n in (1, 2, 3, 4):
        row = rows[method, n]
        text(f"beam, {method}, {n} per direction", row["status"] + (
            f", {float(row['error']):.1e}" if row["status"] == "ok" else ""))

# The load that a footing carries on von Mises soil.
for n in (1, 2, 4):
    result = run("prm/hard-cases/bearing-gimp.prm",
                 {"Mesh/Cell size": 0.25, "Mesh/Upper corner": "5, 0.25",
                  "Method/Points per direction": n, "Output/Points": "false",
                  "Output/Mesh": "false"})
    number(f"footing, {n} per direction, load over (2 + pi) k",
           -result.reactions["footing"][1] / (2 + 3.141592653589793), 3)
