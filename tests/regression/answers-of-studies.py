# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A factor of safety is none where something else than equilibrium was missing, nor
where bodies have inertia; what a study says to run runs; runs and studies do not
remove each other's results."""

import json
import subprocess

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

# What shows the failure, pasted into a shell: the soil of the series is in it.
pasted = run(SLOPE, {
    **QUICK, "Title": "clay's", "Mesh/Cell size": "{{4|2}}",
    "Strength reduction/Tolerance": 0.5, "Constants/c": 64,
    "Study/Series/weak/Settings":
        "Materials/clay/Shear yield stress = $c; Constants/c = 32"},
    command="study", extra=["--output", folder / "a study's"])
said = [line.split(": ", 1)[1] for line in pasted.output.splitlines()
        if "to see it" in line]
text("ways to see failures", len(said))
shown = subprocess.run(said[0].replace("moraine", str(program), 1), shell=True,
                       capture_output=True, text=True)
text("  the first one", f"exit code {shown.returncode}")
trials = [trial for trial in json.loads(
    (folder / "a study's/summary.json").read_text())["cases"][0]["trials"]
    if trial["status"] != "ok"]
failed = json.loads((folder / "a study's/failed/summary.json").read_text())
text("  it fails as the trial", failed["time"] == trials[-1]["time"] and
     failed["message"] == trials[-1]["message"])

scene = folder / "slope.prm"
scene.write_text((root / SLOPE).read_text().replace("""subsection Time
  set Steps = 10
end
""", ""))
for name, settings in (
        ("inertia", {"Time/Integrator": "Newmark"}),
        ("inertia in one of two stages", {
            "Stages/weight/Time/Steps": 4,
            "Stages/quake/Time/End time": 2,
            "Stages/quake/Time/Integrator": "generalised-alpha"})):
    refused = run(scene, {"Mesh/Cell size": 4, **settings}, command="study",
                  expect=None)
    text(name, f"exit code {refused.code}, " + plain(
        refused.output.strip().splitlines()[-1]))

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
