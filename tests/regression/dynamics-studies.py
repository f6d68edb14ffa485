# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Studies of dynamics and of double mapping, shortened: what their pages say."""

from math import sqrt


def study(scene, settings):
    result = run(scene, {**settings, "Study/Group by": "Series"},
                 command="study")
    rows = result.study_rows()
    text(scene, " ".join(sorted({row["status"] for row in rows})))
    error = {row["Series"]: float(row["error"]) for row in rows}
    for name, value in error.items():
        number(f"  {name}", value, 2)
    return error


column = study("prm/studies/dynamics-column.prm",
               {"Mesh/Cells": "1, 82", "Time/Steps": 400})
flight = study("prm/studies/dynamics-flight.prm",
               {"Mesh/Cells": "1, 120", "Time/Steps": 800})
# The default is no worse than FLIP; PIC takes what varies over a cell.
for name, error in (("stands", column), ("flies", flight)):
    at_least(f"{name}: error of FLIP over that of APIC",
             error["GIMP FLIP"] / error["GIMP APIC"], 1.1)
    at_least(f"{name}: error of PIC over that of APIC",
             error["GIMP PIC"] / error["GIMP APIC"], 1.5)

static = study("prm/studies/double-mapping-static.prm", {"Mesh/Cells": "1, 32"})
dynamic = study("prm/studies/double-mapping-dynamic.prm",
                {"Mesh/Cells": "1, 41", "Time/Steps": 800})
moving = study("prm/studies/double-mapping-flight.prm",
               {"Mesh/Cells": "1, 60", "Time/Steps": 800})
for name, error, least in (("at rest", static, 2.5), ("under a pulse", dynamic, 3),
                           ("in flight", moving, 1.1)):
    at_least(f"{name}: error of GIMP over that of DM-GC",
             error["GIMP"] / error["DM-GC"], least)

# Noise of the velocity of a point over time, and what is lost, by transfer.
C = sqrt(24e3 / 1.5)


def pulse(t):
    return 0.3 * max(0, 1 - abs(t / 0.125 - 1))


def velocity(z, t):
    """Of a column that flies: waves go down (depth z) and up, ends are free."""
    return -6 - sum(pulse(t - (40 * k + z) / C) + pulse(t - (40 * (k + 1) - z) / C)
                    for k in range(4)) / 1.5 / C


def noise(transfer):
    result = run("prm/studies/dynamics-flight.prm",
                 {"Mesh/Cells": "1, 120", "Time/Steps": 800,
                  "Method/Method": "GIMP", "Time/Velocity transfer": transfer,
                  "Probes/next/Location": "0, 18.18",
                  "Probes/next/Quantities": "position, displacement, velocity",
                  "Output/Write": "end"})
    rows = result.history()
    waves, errors = [], []
    for name in ("middle", "next"):
        z = 28 - (rows[0][f"y at {name}"] - rows[0][f"u_y at {name}"])
        exact = [velocity(z, row["t"]) for row in rows]
        waves.append([value + 6 for value in exact])
        errors.append([row[f"v_y at {name}"] - value
                       for row, value in zip(rows, exact)])

    def rms(values):
        return sqrt(sum(value ** 2 for value in values) / len(values))

    number(f"{transfer}: velocity of a point, rms error over rms",
           rms(errors[0]) / rms(waves[0]), 2)
    # Two points of one cell, of which nodes see the mean.
    number(f"{transfer}: noise, half the difference of two points' errors over rms",
           rms([(a - b) / 2 for a, b in zip(*errors)]) / rms(waves[0]), 2)
    number(f"{transfer}: lost in transfer over the largest strain energy",
           rows[-1]["energy lost in transfer"]
           / max(row["strain energy"] for row in rows), 2)
    bound(f"{transfer}: energy out of balance",
          result.summary["energy"]["balance_error"], 1e-12)


for transfer in ("APIC", "FLIP", "blend", "FMPM", "PIC"):
    noise(transfer)

# Points without boxes that cross cells: composite strains and forces drift apart.
for method in ("DM-GC", "DM-C"):
    result = run("prm/studies/double-mapping-flight.prm",
                 {"Mesh/Cells": "1, 120", "Method/Method": method,
                  "Output/Write": "end"})
    rows = result.history()
    number(f"{method} in flight: energy out of balance over the largest strain energy",
           abs(rows[-1]["energy out of balance"])
           / max(row["strain energy"] for row in rows), 1)
