# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A factor of safety is none where something else than equilibrium was missing;
runs and studies do not remove each other's results; orders in time do not depend
on the order of cases."""

import json

SLOPE = "prm/geotechnics/factor-of-safety.prm"
QUICK = {"Mesh/Cell size": 2, "Time/Steps": 4, "Strength reduction/Tolerance": 0.2}

weak = run(SLOPE, {**QUICK, "Mesh/Cell size": 0.5, "Solver/Solver": "gmres",
                   "Solver/Maximum linear iterations": 60},
           command="study", expect=1)
case = json.loads((weak.folder / "summary.json").read_text())["cases"][0]
text("solver that gives up", case["status"])
text("  said", next(line for line in weak.output.splitlines()
                    if "no factor" in line).strip()[:60])

# No number is between the last two.
fine = run(SLOPE, {**QUICK, "Strength reduction/Lower factor": 1.5,
                   "Strength reduction/Upper factor": 1.5000000000000004,
                   "Strength reduction/Tolerance": 1e-30},
           command="study", expect=None)
text("interval of two numbers ends after trials", len(json.loads(
    (fine.folder / "summary.json").read_text())["cases"][0]["trials"]))

study = run(SLOPE, QUICK, command="study")
before = (study.folder / "summary.json").read_bytes()
plain_run = {"Mesh/Cell size": 2, "Time/Steps": 2, "Output/Points": "false"}
there = ["--output", str(study.folder)]
refused = run(SLOPE, plain_run, extra=there, expect=2)
text("run into the folder of a study", "study.csv" in refused.output)
text("  nothing is lost", before == (study.folder / "summary.json").read_bytes())
run(SLOPE, plain_run, extra=[*there, "--overwrite"])
text("  replaced: rows of the study are left",
     (study.folder / "study.csv").exists())
text("  and it is a run", (study.folder / "history.csv").exists())

# Old pictures do not stand beside new rows.
BEAM = "prm/studies/fe-mpm.prm"
beam = run(BEAM, {"Mesh/Cell size": "{{20|10}}"}, command="study")
text("study with a picture", (beam.folder / "study.png").exists())
run(SLOPE, QUICK, command="study",
    extra=["--output", str(beam.folder), "--overwrite"])
text("  another study in its place: old picture",
     (beam.folder / "study.png").exists())

# A curve from its end to its beginning.
for steps in "{{10|40}}", "{{40|10}}":
    column = run("prm/studies/large-column.prm",
                 {"Mesh/Cells": "1, 8", "Time/Steps": steps}, command="study")
    header, *rows = ([cell.strip() for cell in line.split("|")[1:-1]]
                     for line in column.output.splitlines()
                     if line.startswith("|"))
    text(f"steps {steps}, order", rows[-1][header.index("order")])
