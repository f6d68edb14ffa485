# ranks: 1
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Mistakes and faults of finite strain, domains and moving meshes."""



def message(output):
    return plain(" | ".join(
        line.strip() for line in output.splitlines()
        if line.startswith("moraine: ") or "ended early" in line))


def show(name, result):
    text(name, message(result.output))
    text("  status", result.summary.get("status"))
    rows = len((result.folder / "history.csv").read_text().splitlines()) - 1
    text("  rows in history.csv", rows)
    text("  steps in summary.json", result.summary.get("steps"))
    points = sorted(p.name for p in result.folder.glob("points/*"))
    text("  last file of points", points[-1])


def refused(name, scene, settings):
    result = run(scene, settings, expect=2)
    text(name, message(result.output))
    text("  no results are written",
         not (result.folder / "history.csv").exists())


stretch = "prm/wang-2018/stretch-mpm.prm"
twist = "prm/wang-2018/twist-80-mpm.prm"

refused("GIMP on a mesh of a generator", twist, {"Method/Method": "GIMP"})
refused("neo-Hookean at small strain", stretch, {
    "Method/Strain": "small", "Materials/block/Model": "neo-Hookean",
    "Materials/block/Yield radius": ""})
refused("finite strain on a mesh that is kept", stretch, {
    "Method/Mesh after step": "keep", "Mesh motion/Stretch between": ""})
refused("split domains of points without", stretch, {
    "Method/Method": "material point", "Method/Split domains": "true"})
refused("softening that no return can follow", stretch, {
    "Materials/block/Yield radius": "0: 400, 0.001: 10"})
refused("a mesh that finite elements move twice",
        "prm/wang-2018/stretch-fe.prm", {"Mesh motion/Follow": "right"})
refused("mesh motion by an unknown name", stretch, {
    "Mesh motion/Stretch between": "left, rihgt"})
refused("mesh motion by one name", stretch, {
    "Mesh motion/Stretch between": "left"})
refused("both kinds of mesh motion", stretch, {"Mesh motion/Follow": "right"})
refused("a mesh that moves off a held side", stretch, {
    "Mesh motion/Stretch between": "", "Mesh motion/Follow": "right"})

# Sides and conditions that move alike, in stages: what holds a side in one of
# them need not in another, and the second begins with a mesh that is longer.
stages = scene_file("stages.prm", """
Mesh/Lower corner = 0, 0 | Upper corner = 2, 2 | Cells = 2, 2
Method/Method = material point | Strain = finite
Materials/block/Young modulus = 1000 | Poisson ratio = 0
Bodies/block/Lower corner = 0, 0 | Upper corner = 2, 2
Grid conditions/left/Side = left | Components = x
Grid conditions/base/Side = bottom | Components = y
Grid conditions/right/Side = right | Components = x | Displacement = 0.8*t; 0
Mesh motion/Stretch between = left, right
Stages/first/Time/End time = 1
Stages/second/Time/End time = 2
""")
lid, plate = "Grid conditions/lid/", "Grid conditions/plate/"
for name, settings in (
        ("a mesh that two stages stretch", {}),
        ("a lid, then a plate that the mesh goes with", {
            "Grid conditions/right/Displacement": "0; 0",
            lid + "Side": "top", lid + "Components": "y",
            plate + "Side": "top", plate + "Components": "y",
            plate + "Displacement": "0; -0.3*max(t - 1, 0)",
            "Mesh motion/Stretch between": "base, plate",
            "Stages/first/Grid conditions": "left, base, right, lid",
            "Stages/second/Grid conditions": "left, base, right, plate"})):
    text(name, run(stages, settings, "check").output.splitlines()[-1].strip())

show("a mesh motion that inverts cells", run(stretch, {
    "Bodies/block/Upper corner": "0.5, 2", "Probes/corner/Location": "0, 2",
    "Grid conditions/right/Displacement": "-0.0125*t^5; 0",
    "Time/End time": 4, "Time/Steps": 2}, expect=1))
show("a point that the mesh leaves behind", run(stretch, {
    "Bodies/block/Upper corner": "0.9, 2", "Probes/corner/Location": "0, 2",
    "Grid conditions/right/Displacement": "-0.2*t; 0",
    "Time/End time": 8, "Time/Steps": 8}, expect=1))
returned = run(stretch, {
    "Grid conditions/right/Displacement": "0; 0",
    "Grid conditions/bottom/Displacement": "0; 0.3*t",
    "Mesh motion/Stretch between": "", "Method/Return tolerance": 0.1,
    "Time/End time": 1, "Time/Steps": 1})
show("points that end outside a box and are returned", returned)
number("  points", returned.finding("returned-points")["value"], 2)
show("the step limit", run(stretch, {
    "Solver/Maximum iterations": 1, "Time/Smallest step": 0.1}, expect=1))
show("a step that would turn points inside out", run(stretch, {
    "Grid conditions/right/Displacement": "-0.0125*t^5; 0",
    "Time/End time": 4, "Time/Steps": 2, "Time/Smallest step": 0.9},
    expect=1))
show("corners of CPDI2 that would be turned inside out", run(stretch, {
    "Method/Method": "CPDI2",
    "Grid conditions/right/Displacement": "-0.0125*t^5; 0",
    "Time/End time": 4, "Time/Steps": 2, "Time/Smallest step": 0.9},
    expect=1))
show("the same where all nodes are prescribed", run(
    "prm/wang-2018/stretch-fe.prm", {
        "Mesh/Cells": "1, 1", "Grid conditions/left/Components": "x, y",
        "Grid conditions/right/Components": "x, y",
        "Grid conditions/right/Displacement": "-2.4*t^2; 0",
        "Time/End time": 1, "Time/Steps": 2, "Time/Smallest step": 0.9},
    expect=1))
