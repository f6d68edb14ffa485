# ranks: 1 # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Keys and values that are wrong in the text: each has its message. Every rank
reads the text alike; that two ranks give one message is seen in scenes.py."""

base = (root / "tests/bad-input/base.prm").read_text()


def refused(name, scene=base, settings=None):
    """Exit code 2, one message on stderr, no results made."""
    file = folder / "scene.prm"
    file.write_text(scene)
    result = run(file, settings, expect=2)
    lines = [line for line in result.output.splitlines() if line.strip()]
    text(name, plain(" | ".join(lines)))
    if (result.folder / "history.csv").exists():
        text(name, "NO, results were made")


def with_line(line, section="Mesh"):
    return base.replace(f"subsection {section}\n", f"subsection {section}\n  {line}\n", 1)


def without(key):
    return "".join(line for line in base.splitlines(True) if f"set {key} " not in line)


refused("unknown key", with_line("set Colour = red"))
refused("misspelt key", base.replace("Poisson ratio", "Poison ratio"))
refused("misspelt section", base.replace("subsection Method", "subsection Metod"))
refused("unknown section", base + "subsection Weather\n  set Rain = 1\nend\n")
refused("key of another section", with_line("set Steps = 3"))
refused("key of an earlier version", settings={
    "Boundaries/left/Carry reaction": "false"})
for key, value in (("Method/Put back", "0.1"), ("Method/Empty stiffness", "1e-6"),
                   ("Solver/Limit points", "jump")):
    refused("key of an earlier version", settings={key: value})
MEAN = {"Method/Volumetric strain": "cell mean"}
for name, settings in (
        ("degree 2", {"Method/Method": "finite element", "Method/Degree": 2}),
        ("double mapping", {"Method/Method": "DM-GC"}),
        ("energy-momentum", {"Time/Integrator": "energy-momentum"}),
        ("stiffness damping", {"Time/Integrator": "Newmark",
                               "Bodies/block/Stiffness damping": 0.1})):
    refused(f"cell means, {name}", settings={**MEAN, **settings})
refused("symmetric Nitsche in the middle of a step",
        settings={"Boundaries/left/Enforcement": "symmetric Nitsche",
                  "Materials/soil/Density": 1,
                  "Time/Integrator": "energy-momentum"})
refused("more than a full cell", settings={"Method/Aggregate below": 1.5})
refused("part of a cell in words", settings={"Method/Aggregate below": "half"})
refused("more than a full cell, of a body",
        settings={"Bodies/block/Aggregate below": 1.5})
GHOST = {"Method/Cut cells": "ghost"}
for name, settings in (
        ("unknown cure", {"Method/Cut cells": "ghosts"}),
        ("factor 0", {**GHOST, "Method/Ghost factor": 0}),
        ("negative factor", {**GHOST, "Method/Ghost factor": -1}),
        ("factor without ghost", {"Method/Ghost factor": 0.5}),
        ("ghost of no cells", {**GHOST, "Method/Aggregate below": 0})):
    refused(f"cut cells, {name}", settings=settings)
STRENGTH = {"Materials/soil/Model": "von Mises",
            "Materials/soil/Shear yield stress": "1"}
SOFTENING = {"Materials/soil/Model": "von Mises",
             "Materials/soil/Shear yield stress": "0: 1, 0.01: 0.5"}
REDUCTION = "Strength reduction"
for name, settings in (
        ("without strength", {f"{REDUCTION}/Factor": 1.5}),
        ("factor 0", {**STRENGTH, f"{REDUCTION}/Factor": 0}),
        ("unknown material", {**STRENGTH, f"{REDUCTION}/Materials": "sol"}),
        ("material without strength", {f"{REDUCTION}/Materials": "soil"}),
        ("bounds", {**STRENGTH, f"{REDUCTION}/Lower factor": 3}),
        ("kind of study", {"Study/Kind": "factor of safty"}),
        ("study without strength", {"Study/Kind": "factor of safety"}),
        ("key of errors", {**STRENGTH, "Study/Kind": "factor of safety",
                           "Study/Error": "r_u"})):
    refused(f"strength reduction, {name}", settings=settings)
LENGTH = "Materials/soil/Softening length"
for name, settings in (
        ("of an elastic material", {LENGTH: 1}),
        ("without softening", {**STRENGTH, LENGTH: 1}),
        ("too short", {**SOFTENING, LENGTH: 1e-3}),
        ("negative", {**SOFTENING, LENGTH: -1})):
    refused(f"softening length, {name}", settings=settings)
STEEP = {**SOFTENING, "Materials/soil/Shear yield stress": "0: 1, 1e-5: 0.5"}
refused("steep without softening length", settings=STEEP)
good = folder / "good.prm"
good.write_text(base)
text("softening length, makes steep ones usable",
     run(good, {**STEEP, LENGTH: 100}, command="check").output.splitlines()[-1].strip())
MADE = {"Bodies/hole/Lower corner": "1, 1", "Bodies/hole/Upper corner": "2, 2",
        "Bodies/rest/Shape": "difference", "Bodies/rest/Operands": "block, hole"}
for key, value in (("Initial stress", "geostatic"), ("Material", "soil"),
                   ("Point grid", "2, 2"), ("Aggregate below", "0.3")):
    refused(f"{key} of a region that others are made of",
            settings={**MADE, f"Bodies/block/{key}": value})
refused("key set twice", with_line("set Cell size = 2"))
refused("missing key", without("Young modulus"))
refused("missing corner", without("Upper corner"))
refused("missing end", base[:base.rindex("end")])
refused("not a statement", base + "Steps = 3\n")
refused("unknown override", settings={"Mesh/Cel size": 2})

refused("misspelt name in an override", settings={"Boundaries/lfet/Flip": "true"})
refused("key that a load does not use", settings={"Loads/weight/Location": "1, 1"})
refused("key that a constraint does not use",
        settings={"Boundaries/left/Components": "x"})

refused("text for a number", settings={"Mesh/Cell size": "small"})
refused("nan", settings={"Materials/soil/Young modulus": "nan"})
refused("infinity", settings={"Materials/soil/Young modulus": "inf"})
refused("nan in a list", settings={"Bodies/block/Lower corner": "0.5, nan"})
refused("nan in a surface", settings={"Boundaries/left/Points": "0.5 4.5; nan 0.5"})
refused("zero cell size", settings={"Mesh/Cell size": 0})
refused("negative cell size", settings={"Mesh/Cell size": -1})
refused("cell size that does not fit", settings={"Mesh/Cell size": 3})
refused("corners swapped", settings={"Mesh/Upper corner": "-8, 8"})
refused("box of no size", settings={"Bodies/block/Upper corner": "0.5, 4.5"})
refused("negative radius", settings={
    "Bodies/disc/Shape": "disc", "Bodies/disc/Centre": "6, 6",
    "Bodies/disc/Radius": -1})
refused("zero points per direction", settings={"Method/Points per direction": 0})
refused("negative points per direction", settings={"Method/Points per direction": -2})
refused("half a point", settings={"Method/Points per direction": 2.5})
refused("zero modulus", settings={"Materials/soil/Young modulus": 0})
refused("negative modulus", settings={"Materials/soil/Young modulus": -5})
refused("Poisson ratio 0.5", settings={"Materials/soil/Poisson ratio": 0.5})
refused("Poisson ratio 0.7", settings={"Materials/soil/Poisson ratio": 0.7})
refused("zero steps", settings={"Time/Steps": 0})
refused("end before start", settings={"Time/End time": -1})
refused("zero Nitsche factor", settings={"Boundaries/left/Nitsche factor": 0})
refused("dimension 4", settings={"Dimension": 4})

refused("unknown material", settings={"Bodies/block/Material": "sol"})
refused("unknown method", settings={"Method/Method": "finite elment"})
refused("unknown model", settings={"Materials/soil/Model": "plastic"})
refused("unknown shape", settings={"Bodies/block/Shape": "bx"})
refused("unknown surface", settings={"Boundaries/left/Surface": "line"})
refused("unknown constraint", settings={"Boundaries/left/Constraint": "rollr"})
refused("unknown enforcement", settings={"Boundaries/left/Enforcement": "glue"})
refused("unknown side", settings={"Grid conditions/a/Side": "lef"})
refused("unknown body of a load", settings={"Loads/weight/Bodies": "blok"})
refused("unknown load", settings={"Loads/weight/Type": "wind"})
refused("unknown solver", settings={"Solver/Solver": "magic"})
refused("not an expression", settings={"Loads/weight/Value": "0; -1*"})
refused("unknown variable", settings={"Loads/weight/Value": "0; -g"})
refused("time in a surface", settings={
    "Boundaries/left/Surface": "expression", "Boundaries/left/Points": "",
    "Boundaries/left/Expression": "x-t"})
refused("time in a shape", settings={
    "Bodies/disc/Shape": "expression", "Bodies/disc/Expression": "x-6-t"})
refused("table with one component",
        settings={"Boundaries/left/Translation": "0: 0, 1: 2"})
refused("too few components", settings={"Loads/weight/Value": "-1"})
refused("weights fitted to cells with GIMP",
        settings={"Method/Method": "GIMP",
                  "Method/Point weights": "fitted to cells"})
refused("weights fitted to cells that do not change",
        settings={"Method/Mesh after step": "keep",
                  "Method/Point weights": "fitted to cells"})
refused("GIMP of degree 2",
        settings={"Method/Method": "GIMP", "Method/Degree": 2})
refused("DM-GC of degree 2",
        settings={"Method/Method": "DM-GC", "Method/Degree": 2})
refused("DM on a mesh that moves",
        settings={"Method/Method": "DM",
                  "Method/Mesh after step": "follow material"})
refused("GIMP on a mesh that moves",
        settings={"Method/Method": "GIMP",
                  "Method/Mesh after step": "follow material"})
refused("a choice in a run", settings={"Mesh/Cell size": "{{1|2}}"})

# Dynamics.
dynamic = {"Time/Integrator": "Newmark", "Materials/soil/Density": 2}
refused("a key of Newmark in a quasi-static scene",
        settings={"Time/Newmark beta": 0.3})
refused("a key of another integrator",
        settings={**dynamic, "Time/Spectral radius": 0.5})
refused("spectral radius above 1",
        settings={**dynamic, "Time/Integrator": "generalised-alpha",
                  "Time/Spectral radius": 1.1})
refused("unstable Newmark", settings={**dynamic, "Time/Newmark beta": 0.2})
refused("unstable Newmark", settings={**dynamic, "Time/Newmark gamma": 0.4})
refused("no density", settings={"Time/Integrator": "Newmark"})
refused("velocity in a quasi-static scene",
        settings={"Bodies/block/Initial velocity": "1; 0"})
refused("share of FLIP without a blend",
        settings={**dynamic, "Time/FLIP share": 0.9})
refused("velocity transfer of finite elements",
        settings={**dynamic, "Method/Method": "finite element",
                  "Time/Velocity transfer": "PIC"})
refused("limit points in dynamics",
        settings={**dynamic, "Solver/Limit points": "pseudo-transient"})
refused("a path in dynamics", settings={**dynamic, "Time/Arc length": 0.1})
refused("a path and pseudo-transient continuation",
        settings={"Time/Arc length": 0.1, "Solver/Limit points": "pseudo-transient"})
refused("a path on a mesh that moves",
        settings={"Time/Arc length": 0.1, "Mesh motion/Follow": "left"})
refused("a negative arc length", settings={"Time/Arc length": -0.1})
refused("velocity of a node that is held",
        settings={**dynamic, "Bodies/block/Lower corner": "0, 0.5",
                  "Grid conditions/side/Side": "left",
                  "Boundaries/left/Points": "4.5 0.5; 4.5 4.5",
                  "Bodies/block/Initial velocity": "1; 0"})

# Stages.
staged = base[:base.index("subsection Time")] + prm("""
Stages/gravity/Time/End time = 1
Stages/later/Time/End time = 2
""")
refused("time beside stages", staged + "subsection Time\n  set Steps = 4\nend\n")
refused("a stage that goes back", staged, {"Stages/later/Time/End time": 0.5})
refused("a stage that does not follow", staged,
        {"Stages/later/Time/Start time": 1.5})
refused("a stage with an unknown load", staged,
        {"Stages/later/Loads": "weigth"})
refused("a stage with an unknown boundary", staged,
        {"Stages/later/Boundaries": "lft"})
refused("absorbing what is not there", staged,
        {"Stages/later/Absorbing": "base"})
refused("absorbing in quasi-static stages", staged,
        {"Stages/later/Absorbing": "left"})
refused("absorbing from the time on when bodies go",
        (root / "prm/geotechnics/fill-and-dig.prm").read_text(),
        {"Stages/dug/Absorbing": "base", "Stages/dug/Time/Integrator": "Newmark"})
refused("absorbing in a quasi-static stage after one with inertia", staged,
        {"Materials/soil/Density": 2, "Stages/gravity/Time/Integrator": "Newmark",
         "Stages/later/Absorbing": "left"})
refused("dynamic key in a quasi-static stage", staged,
        {"Stages/later/Time/Spectral radius": 0.5})
refused("error tolerance in a quasi-static scene",
        settings={"Time/Error tolerance": 1e-4})
refused("a path before another stage", staged,
        {"Stages/gravity/Time/Arc length": 0.1})
refused("another mass in a later stage", staged,
        {"Materials/soil/Density": 2, "Stages/gravity/Time/Integrator": "Newmark",
         "Stages/later/Time/Integrator": "Newmark",
         "Stages/later/Time/Mass": "lumped"})
refused("another share in a later stage", staged,
        {"Materials/soil/Density": 2, "Stages/gravity/Time/Integrator": "Newmark",
         "Stages/gravity/Time/Velocity transfer": "blend",
         "Stages/later/Time/Integrator": "Newmark",
         "Stages/later/Time/Velocity transfer": "blend",
         "Stages/later/Time/FLIP share": 0.5})

# Text that would take for ever, or that is no text.
refused("two thousand million steps", settings={"Time/Steps": 2000000000})
refused("constants that double", "subsection Constants\n  set a0 = x\n" + "".join(
    f"  set a{i} = $a{i - 1}$a{i - 1}\n" for i in range(1, 60)) + "end\n" + base)
refused("random body", settings={
    "Bodies/block/Shape": "expression", "Bodies/block/Lower corner": "",
    "Bodies/block/Upper corner": "", "Bodies/block/Expression": "rand()-0.5"})
refused("random load", settings={"Loads/weight/Curve": "rand_seed(1)"})
for name in ("x", "t", "2a"):
    refused(f"a constant called {name}", settings={
        "Exact solution/Displacement": "0; x", "Exact solution/Constants": f"{name}: 3"})
refused("arithmetic that is no whole number", settings={"Time/Steps": "100/7"})
refused("arithmetic without a value", settings={"Materials/soil/Young modulus": "1/0"})
(folder / "latin.prm").write_bytes(
    base.replace("subsection soil", "subsection Gerölle").encode("latin-1"))
result = run(folder / "latin.prm", expect=2)
text("a name in Latin-1", plain(result.output.strip()))
refused("a long line", with_line("set Type = " + "x" * 100001))
refused("corners of a region that are swapped",
        settings={"Grid conditions/hold/Lower corner": "1, 1",
                  "Grid conditions/hold/Upper corner": "0, 1"})
refused("an axis of rotation in 2D",
        settings={"Boundaries/left/Rotation axis": "0, 0, 1"})
refused("means where it absorbs",
        settings={**dynamic, "Boundaries/left/Constraint": "absorbing",
                  "Boundaries/left/Held in a cell": "mean"})
refused("an incident wave where nothing absorbs",
        settings={**dynamic, "Boundaries/left/Incident velocity": "1; 0"})
