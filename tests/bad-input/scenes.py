# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Scenes whose parts do not fit together: each has its message."""

scene = "tests/bad-input/base.prm"


def refused(name, settings, command="run", file=scene):
    result = run(file, settings, expect=2, command=command)
    lines = [line for line in result.output.splitlines() if line.strip()]
    text(name, plain(" | ".join(lines)))
    if (result.folder / "history.csv").exists():
        text(name, "NO, a folder was made")


block = "Bodies/block/"
refused("body outside", {block + "Lower corner": "10, 10",
                         block + "Upper corner": "12, 12"})
refused("body partly outside", {block + "Upper corner": "10.5, 4.5"})
refused("turned body partly outside", {block + "Rotation angle": 30})
refused("disc partly outside", {
    "Bodies/disc/Shape": "disc", "Bodies/disc/Centre": "6.5, 6.5",
    "Bodies/disc/Radius": 2})
refused("empty body", {"Bodies/none/Shape": "expression",
                       "Bodies/none/Expression": "-1-x^2"})
refused("bodies overlap", {
    "Bodies/second/Shape": "box", "Bodies/second/Lower corner": "4.25, 1",
    "Bodies/second/Upper corner": "6, 2"})
refused("first and third overlap", {
    "Bodies/b/Shape": "box", "Bodies/b/Lower corner": "4.5, 4.5",
    "Bodies/b/Upper corner": "5, 5",
    "Bodies/c/Shape": "box", "Bodies/c/Lower corner": "4.25, 4",
    "Bodies/c/Upper corner": "5, 4.4"})
refused("boundary away from all bodies",
        {"Boundaries/far/Points": "7 1; 7 4"})
refused("boundary and condition of one name",
        {"Grid conditions/left/Side": "left"})
refused("boundary outside the mesh",
        {"Boundaries/far/Points": "20 1; 20 4"})
refused("boundary with the body behind it",
        {"Boundaries/left/Points": "0.5 0.5; 0.5 4.5"})
refused("gravity without density", {"Loads/weight/Type": "gravity"})
refused("force beside the body", {"Loads/weight/Type": "point force",
                                  "Loads/weight/Location": "6.5, 6.5"})
refused("force on points beside the body", {
    "Loads/weight/Type": "force on points",
    "Loads/weight/Location": "6.5, 6.5"})
refused("force on points that are split", {
    "Method/Method": "GIMP", "Method/Strain": "finite",
    "Method/Split domains": "true", "Loads/weight/Type": "force on points",
    "Loads/weight/Location": "4, 4"})
refused("traction on a side away from the body", {
    "Loads/weight/Type": "side traction", "Loads/weight/Side": "top"})
refused("traction on a surface outside the mesh", {
    "Loads/weight/Type": "surface traction", "Loads/weight/Points": "4 9; 1 9"})
refused("traction on a surface away from the body", {
    "Loads/weight/Type": "surface traction", "Loads/weight/Points": "7 1; 7 4"})
refused("probe away from the body", {"Probes/tip/Location": "7.5, 7.5"})
refused("probe with a quantity twice",
        {"Probes/tip/Location": "2, 1",
         "Probes/tip/Quantities": "displacement, stress, displacement"})
refused("interpolated probe beside the body", {
    "Probes/tip/Location": "6, 1", "Probes/tip/Kind": "interpolated",
    "Probes/tip/Quantities": "displacement"})
refused("boundary by an expression that is no number", {
    "Boundaries/left/Surface": "expression", "Boundaries/left/Points": "",
    "Boundaries/left/Expression": "0.5-sqrt(x-4)"})
refused("exact solution that is no number", {
    "Exact solution/Displacement": "0; sqrt(-1-x^2)"}, "check")
refused("body with too many details", {
    block + "Shape": "expression", block + "Lower corner": "",
    block + "Upper corner": "", block + "Expression": "sin(50*x)*sin(50*y)"})
refused("displacement that is not zero at the start", {
    "Boundaries/left/Displacement": "0; -0.01"})
refused("the same of nodes", {
    "Grid conditions/foot/Lower corner": "2, 0",
    "Grid conditions/foot/Upper corner": "4, 0.5",
    "Grid conditions/foot/Displacement": "0.1*t; -0.01-t"})
refused("free to move", {"Boundaries/left/Constraint": "roller"})
refused("free to move, by nodes that are not there", {
    "Boundaries/left/Constraint": "roller",
    "Grid conditions/pin/Lower corner": "2.4, 2.4",
    "Grid conditions/pin/Upper corner": "2.6, 2.6"})
refused("free to move, both ways", {
    "Boundaries/left/Constraint": "components",
    "Boundaries/left/Components": "y"})
refused("free to rotate", {
    "Bodies/block/Shape": "disc", "Bodies/block/Centre": "4, 4",
    "Bodies/block/Radius": "2", "Bodies/block/Lower corner": "",
    "Bodies/block/Upper corner": "",
    "Boundaries/left/Surface": "circle", "Boundaries/left/Points": "",
    "Boundaries/left/Centre": "4, 4", "Boundaries/left/Radius": 2,
    "Boundaries/left/Body side": "inside",
    "Boundaries/left/Constraint": "roller"})
refused("second body not held", {
    "Bodies/lost/Shape": "box", "Bodies/lost/Lower corner": "6, 6",
    "Bodies/lost/Upper corner": "7.5, 7.5"})
refused("point grid of a disc", {
    "Bodies/disc/Shape": "disc", "Bodies/disc/Centre": "6.5, 6.5",
    "Bodies/disc/Radius": 1, "Bodies/disc/Point grid": "4, 4"})
refused("point grid with one number", {block + "Point grid": 4})
refused("point grid with a zero", {block + "Point grid": "4, 0"})
refused("point grid outside", {block + "Point grid": "4, 4",
                               block + "Translation": "100, 0"})
refused("point grid in part outside", {
    "Bodies/second/Lower corner": "6, 6.2", "Bodies/second/Upper corner": "7.5, 8.3",
    "Bodies/second/Point grid": "4, 3"})
refused("point grid over another body", {
    "Bodies/second/Lower corner": "3, 3", "Bodies/second/Upper corner": "5, 6",
    "Bodies/second/Point grid": "4, 3"})

# Each part is judged by its own stiffness: this one is held.
soft = run(scene, {
    "Materials/soil/Young modulus": 1e6, "Bodies/block/Material": "soil",
    "Materials/soft/Young modulus": 0.01, "Materials/soft/Poisson ratio": 0.3,
    "Bodies/second/Material": "soft", "Bodies/second/Shape": "box",
    "Bodies/second/Lower corner": "6, 0.5", "Bodies/second/Upper corner": "7.5, 4.5",
    "Boundaries/left/Enforcement": "augmented Lagrangian", "Boundaries/left/Band width": 1e-6,
    "Boundaries/stop/Points": "6 4.5; 6 0.5", "Loads/weight/Value": "0; -1e-8*t"})
text("soft body and a stiff band", soft.summary["status"])

# Where material was at the start of the run is not known after a reset, unless
# nothing moves.
column = "prm/geotechnics/fill-and-dig.prm"
moves = {"Method/Mesh after step": "follow material"}
refused("original coordinates after a reset", {
    **moves, "Loads/weight/Coordinates": "original"}, file=column)
refused("exact solution after a reset", {
    **moves, "Exact solution/Stress": "0; 0; 0; 0"}, file=column)

# What is allowed, but worth a word; a curve has no value before it acts.
for name, file, settings in (
        ("column", column, {}),
        ("base off the column", column, {"Bodies/ground/Lower corner": "0, 0.3"}),
        ("column off the sides", column, {
            "Bodies/ground/Lower corner": "0.2, 0",
            "Bodies/ground/Upper corner": "0.7, 10"}),
        ("nodes off the column", column, {
            "Grid conditions/base/Side": "",
            "Grid conditions/base/Lower corner": "0, 0",
            "Grid conditions/base/Upper corner": "1, 0",
            "Bodies/ground/Lower corner": "0, 0.3"}),
        ("motion that stays the same", column, {
            "Grid conditions/base/Translation": "0; -0.1"}),
        ("angle that places a surface", "prm/boundaries/tilted-roller.prm", {}),
        ("original coordinates, nothing moves", column, {
            "Loads/weight/Coordinates": "original"}),
        ("curve that is 0", column, {"Loads/weight/Curve": "5: 0, 6: 1"}),
        ("curve of a later stage", column, {
            "Loads/more/Type": "gravity", "Loads/more/Value": "0; -1",
            "Loads/more/Curve": "sqrt(t - 2)", "Stages/alone/Loads": "weight",
            "Stages/filled/Loads": "weight", "Stages/dug/Loads": "weight, more"}),
        ("probe of a body for later", column, {"Probes/top/Location": "0.5, 15"}),
        ("surface that ends with the body", scene, {}),
        ("surface that runs on", scene, {"Boundaries/left/Points": "0.5 5.5; 0.5 0.5"}),
        ("factor of another enforcement", "tests/bad-input/base.prm", {
            "Boundaries/left/Penalty factor": 1e3}),
        ("keys of another enforcement", "tests/bad-input/base.prm", {
            "Boundaries/left/Enforcement": "penalty",
            "Boundaries/left/Band width": 1e-3,
            "Boundaries/left/Nitsche factor": 20}),
        ("surface for later", "prm/cortis-2017/footing.prm", {})):
    found = run(file, settings, command="check").found()
    text(name, " | ".join(found) or "nothing")
