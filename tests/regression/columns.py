# ranks: 2
# debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Columns of history.csv: units, what boundaries and grid conditions moved, and
a study of the last value of one."""

import csv

SINK = {"Boundaries/left/Translation": "0.1*t; -0.2*t",
        "Grid conditions/top/Side": "top",
        "Grid conditions/top/Displacement": "0; -0.1*t",
        "Grid conditions/bent/Lower corner": "6, 6",
        "Grid conditions/bent/Upper corner": "8, 7",
        "Grid conditions/bent/Displacement": "0; -0.1*t*x"}


def header(result):
    with open(result.folder / "history.csv") as file:
        return next(csv.reader(file))


plain_run = run("tests/bad-input/base.prm", SINK)
named = run("tests/bad-input/base.prm", {**SINK, "Units": "m, kN, s"})
text("without units", header(plain_run))
text("with units", header(named))
text("summary", [r.summary.get("units") for r in (named, plain_run)])
text("the same numbers", plain_run.history() == named.history())
for column in ("u_x of left", "u_y of left", "u_y of top"):
    text(column, [row[column] for row in named.history()])
for words in ("m, kN", "m, kN, s, t"):
    wrong = run("tests/bad-input/base.prm", {"Units": words}, expect=2)
    text("wrong", plain(wrong.output.strip().splitlines()[-1]))

# Of a condition of a later stage what it moves from then on.
STAGES = {"Stages/stage 1.5/Grid conditions": "none",
          "Stages/stage 1.5/Time/End time": "0.5",
          "Stages/stage 1.5/Time/Steps": "1",
          "Stages/press/Grid conditions": "top",
          "Stages/press/Time/End time": "1",
          "Stages/press/Time/Steps": "2",
          "Grid conditions/top/Side": "top",
          "Grid conditions/top/Displacement": "0; -0.1*t"}
scene = folder / "stages.prm"
scene.write_text("\n".join(
    (root / "tests/bad-input/base.prm").read_text().splitlines()[:-3]) + "\n")
staged = run(scene, STAGES)
text("in stages", [row["u_y of top"] for row in staged.history()])
failing = run(scene, {**STAGES, "Loads/weight/Value": "0; -1000*t",
                      "Stages/stage 1.5/Time/Smallest step": "0.5"}, expect=1)
text("the message names its stage",
     failing.summary["message"].startswith("stage 'stage 1.5': "))

# Without a reference each case is compared with the next finer one.
study = run("tests/bad-input/base.prm",
            {"Mesh/Cell size": "{{2|1|0.5}}",
             "Study/Error": "reaction_y of left"}, command="study")
rows = study.study_rows()
value = [float(row["value"]) for row in rows]
for row, v, finer in zip(rows, value, value[1:]):
    bound("error of " + row["Mesh/Cell size"],
          float(row["error"]) - abs(v / finer - 1), 1e-8)
text("the finest has none", rows[-1]["error"])
