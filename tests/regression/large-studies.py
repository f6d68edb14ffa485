# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Studies of large deformation, shortened: what their page says of methods."""



def errors(scene, settings, on_ranks=2):
    result = run(scene, {**settings, "Study/Group by": "Series"},
                 command="study", on_ranks=on_ranks)
    rows = result.study_rows()
    text(scene, " ".join(sorted({row["status"] for row in rows})))
    return {row["Series"]: float(row["error"]) for row in rows}


def study(scene, settings, on_ranks=2):
    for name, value in errors(scene, settings, on_ranks).items():
        number(f"  {name}", value, 2)


RING = "0, 0 : 5 : 10 : 5 : 0 : 36 : true"

study("prm/studies/large-column.prm",
      {"Mesh/Cells": "1, 32", "Time/Steps": 10})
study("prm/studies/large-cantilever.prm",
      {"Mesh/Cell size": 0.5, "Time/Steps": 50}, on_ranks=1)
# Two ranks take three times as long for so few cells.
begin = [errors("prm/studies/large-cantilever.prm",
                {"Mesh/Cell size": 0.5, "Time/Steps": 5, "Time/End time": 0.1},
                on_ranks=n) for n in (1, 2)]
text("  beginning, methods", len(begin[0]))
bound("  beginning, error on two ranks over that on one - 1",
      max(abs(begin[1][name] / begin[0][name] - 1) for name in begin[0]), 1e-8)
study("prm/studies/doughnut-10.prm", {"Mesh/Arguments": RING, "Time/Steps": 2})
study("prm/studies/doughnut-60.prm", {"Mesh/Arguments": RING, "Time/Steps": 12})
