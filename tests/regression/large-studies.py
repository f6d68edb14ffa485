# ranks: 2  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Studies of large deformation, shortened: what their page says of methods."""

import csv


def study(scene, settings):
    result = run(scene, {**settings, "Study/Group by": "Series"},
                 command="study")
    with open(result.folder / "study.csv") as file:
        rows = list(csv.DictReader(file))
    text(scene, " ".join(sorted({row["status"] for row in rows})))
    error = {row["Series"]: float(row["error"]) for row in rows}
    for name, value in error.items():
        number(f"  {name}", value, 2)
    return error


RING = "0, 0 : 5 : 10 : 5 : 0 : 36 : true"

study("prm/studies/large-column.prm",
      {"Mesh/Cells": "1, 32", "Time/Steps": 10})
study("prm/studies/large-cantilever.prm",
      {"Mesh/Cell size": 0.5, "Time/Steps": 50})
study("prm/studies/doughnut-10.prm", {"Mesh/Arguments": RING, "Time/Steps": 2})
study("prm/studies/doughnut-60.prm", {"Mesh/Arguments": RING, "Time/Steps": 12})
