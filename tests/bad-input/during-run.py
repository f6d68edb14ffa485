# debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Faults that show only while a scene runs, and Ctrl-C."""

import csv
import json
import os
import re
import signal
import subprocess
import time

scene = "tests/bad-input/base.prm"


def message(output):
    lines = [line.strip() for line in output.splitlines()
             if line.startswith("moraine: ") or "ended early" in line]
    # Which of several places comes first depends on the ranks.
    return re.sub(r"is -?nan, (.*) at \([^()]*\)", r"is nan, \1 at (...)",
                  plain(" | ".join(lines)))


def show(name, result):
    text(name, message(result.output))
    text("  status", result.summary.get("status"))
    rows = len((result.folder / "history.csv").read_text().splitlines()) - 1
    text("  rows in history.csv", rows)
    text("  steps in summary.json", result.summary.get("steps"))
    points = sorted(p.name for p in result.folder.glob("points/*"))
    text("  last file of points", points[-1])
    pvd = (result.folder / "points.pvd").read_text()
    text("  points.pvd", "names all" if all(p in pvd for p in points) else "NO")


def no_results(name, result):
    text(name, message(result.output))
    text("  status", result.summary.get("status"))
    text("  results", "SOME" if any(p.suffix in (".csv", ".vtu", ".pvd")
         for p in result.folder.rglob("*")) else "none")


no_results("motion that is no number at t = 0.5", run(
    scene, {"Boundaries/left/Translation": "0.001/(t-0.5); 0"}, expect=2,
    on_ranks=ranks))
no_results("grid condition that is no number later", run(
    scene, {"Grid conditions/foot/Lower corner": "0, 0",
            "Grid conditions/foot/Upper corner": "2, 2",
            "Grid conditions/foot/Displacement": "0; sqrt(0.6-t)-sqrt(0.6)"},
    expect=2, on_ranks=ranks))
no_results("displacement that is no number at a place", run(
    scene, {"Method/Mesh after step": "keep",
            "Boundaries/left/Displacement": "0; 0.001*t*log(t>0.6 ? y-100 : 1)"},
    expect=2, on_ranks=ranks))
show("load that is no number", run(
    scene, {"Loads/weight/Value": "0; sqrt(0.6-t)"}, expect=2,
    on_ranks=ranks))
show("point that leaves the mesh", run(
    scene, {"Boundaries/left/Translation": "0; -0.8*t",
            "Loads/weight/Value": "0; 0"}, expect=1))
show("the same, written at the end only", run(
    scene, {"Boundaries/left/Translation": "0; -0.8*t",
            "Loads/weight/Value": "0; 0", "Output/Write": "end"}, expect=1))

# A point without stress, all nodes of which are prescribed: their forces say nothing
# of it. Above it is a body that moves freely, or that is prescribed as well.
softening = scene_file("softening.prm", """
Mesh/Lower corner = 0, 0 | Upper corner = 1, 3 | Cell size = 1
Method/Method = finite element
Materials/brittle/Model = von Mises | Young modulus = 50000 | Poisson ratio = 0.3
Materials/brittle/Uniaxial yield stress = 0: 100, 0.001: 55, 0.01: 50
Materials/elastic/Young modulus = 10000 | Poisson ratio = 0.3
Bodies/low/Material = brittle | Lower corner = 0, 0 | Upper corner = 1, 1
Bodies/up/Material = elastic | Lower corner = 0, 1 | Upper corner = 1, 3
Grid conditions/base/Side = bottom
Grid conditions/middle/Lower corner = 0, 1 | Upper corner = 1, 1
Grid conditions/middle/Displacement = 0.02*t; 0
Strength reduction/Factor = 0.3
Time/Steps = 2 | Smallest step = 0.9
""")
for method in ("finite element", "GIMP"):
    for up_to in (1, 3):
        result = run(softening, {"Method/Method": method,
                                 "Grid conditions/middle/Upper corner":
                                 f"1, {up_to}"}, expect=1, on_ranks=ranks)
        show(f"no stress, {method}, prescribed up to {up_to}", result)

# Iterations that do not suffice, in full cells and in cells that the block cuts.
few = {"Solver/Solver": "amg-cg", "Solver/Maximum linear iterations": 2,
       "Loads/weight/Value": "0; -1e-3*t", "Mesh/Cell size": 0.125,
       "Mesh/Lower corner": "0.5, 0.5", "Mesh/Upper corner": "4.5, 4.5",
       "Method/Method": "finite element"}
cut = {"Method/Method": "material point", "Mesh/Cell size": 0.11,
       "Mesh/Lower corner": "0, 0", "Mesh/Upper corner": "5.5, 5.5"}
stiff = {"Materials/soil/Poisson ratio": 0.49}
for name, settings in (("too few iterations", {}),
                       ("volume that hardly changes", stiff),
                       ("the same in cut cells", {**stiff, **cut})):
    result = run(scene, {**few, **settings}, expect=1)
    text(f"multigrid, {name}", message(result.output))
    text("  rejected steps", result.summary["rejected_steps"])
    text("  free nodes named, too", "'Solver' can help; nodes that too few "
         "points touch can be the cause; 'Fictitious stiffness = 1e-6' in "
         "section 'Method' holds them" in result.output)

no_results("GIMP with one point in a cell, consistent mass", run(
    scene, {"Method/Method": "GIMP", "Method/Points per direction": 1,
            "Bodies/block/Lower corner": "0, 0", "Bodies/block/Upper corner": "4, 4",
            "Boundaries/left/Points": "0 4; 0 0", "Materials/soil/Density": 1,
            "Time/Integrator": "Newmark"}, expect=None, on_ranks=ranks))

# Rough plates squeeze quadratic elements until one beside a corner has folded.
squeezed = scene_file("squeezed.prm", """
Mesh/Lower corner = -0.5, -0.25 | Upper corner = 2.5, 1.25 | Cell size = 0.0625
Method/Method = finite element | Strain = finite | Degree = 2
Materials/metal/Model = von Mises | Young modulus = 1000 | Poisson ratio = 0.3
Materials/metal/Shear yield stress = 10
Bodies/block/Lower corner = 0, 0 | Upper corner = 2, 1
Boundaries/low/Points = -0.4 0; 2.4 0
Boundaries/up/Points = 2.4 1; -0.4 1 | Translation = 0; -0.4*t
Time/Steps = 20
""")
result = run(squeezed, expect=1, on_ranks=1)
at = re.search(r"boundary '(\w+)': the cell at \((\S+) (\S+)\) has folded",
               message(result.output))
text("squeezed between plates: the place that is named is",
     f"beside a corner, at '{at[1]}'" if at and abs(float(at[2]) - 1) > 1 else
     message(result.output))

# A load on a body that a later stage leaves out, and nothing beside it is left.
staged = scene_file("staged.prm", """
Mesh/Lower corner = -1, 0 | Upper corner = 4, 4 | Cell size = 0.25
Method/Method = GIMP
Materials/clay/Young modulus = 1e5 | Poisson ratio = 0.3 | Density = 1
Bodies/ground/Lower corner = 0, 0 | Upper corner = 3, 1
Bodies/fill/Lower corner = 0, 1 | Upper corner = 3, 2
Grid conditions/base/Side = bottom
Loads/surcharge/Type = surface traction | Body = fill | Part = top | Value = 0; -10
Stages/filled/Bodies = ground, fill
Stages/filled/Time/End time = 1
Stages/dug/Bodies = ground
Stages/dug/Time/End time = 2
Probes/top/Location = 1.5, 2
""")
for name, settings in (
        ("", {}),
        (", followed", {"Method/Method": "finite element",
                        "Method/Strain": "finite"}),
        (", with inertia", {"Stages/dug/Time/Integrator": "Newmark"})):
    result = run(staged, {"Output/Write": "end", **settings}, expect=1)
    text(f"load on a body that goes{name}", message(result.output))
    text("  points", result.summary["points"])
    text("  last file of points", f"{len(result.points('position'))} of them")
    bound("  last displacement over that in history.csv - 1",
          result.probes["u_y at top"] / result.history()[-1]["u_y at top"] - 1, 1e-9)
    text("  energy", "energy" in result.summary)

# Ctrl-C: every rank gets it on a terminal; here one rank does.
out = folder / "interrupted"
words = ["mpirun", "-q", "-n", "2", str(program), "run", str(root / scene),
         "--output", str(out),
         "--set", "Time/Steps = 100000", "--set", "Output/Every = 1000000"]
process = subprocess.Popen(words, stdout=subprocess.PIPE,
                           stderr=subprocess.STDOUT, text=True, cwd=folder)
history = out / "history.csv"
for _ in range(600):
    if history.exists() and history.read_text().count("\n") > 3:
        break
    time.sleep(0.1)
children = f"/proc/{process.pid}/task/{process.pid}/children"
os.kill(int(open(children).read().split()[-1]), signal.SIGINT)
output = process.communicate(timeout=120)[0]
text("Ctrl-C: exit code", process.returncode)
text("  message", message(output))
summary = json.loads((out / "summary.json").read_text())
text("  status", summary["status"])
with open(history) as file:
    rows = list(csv.DictReader(file))
whole = all(None not in row.values() for row in rows)
text("  history.csv", "one whole row for each step"
     if whole and len(rows) == summary["steps"] else "NO")
points = sorted(p.name for p in out.glob("points/*"))
text("  files of points", ", ".join(points))
text("  log.txt", "ends as the terminal" if "ended early" in
     (out / "log.txt").read_text() else "NO")
