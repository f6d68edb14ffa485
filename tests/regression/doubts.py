# debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A run whose stress shows that its volume locks, that points cross cells or that
cuts are felt, or that strain is not small, says so, with the key that helps; one
that took the key does not."""

import json

POINT = {"Method/Volumetric strain": "pointwise"}
BEARING = {"Mesh/Cell size": 0.25, "Time/Steps": 4}
BLOCK = "prm/hard-cases/cut-block.prm"


def told(result):
    return result.found()


def show(name, scene, settings):
    text(name, told(run(scene, settings)) or "nothing")


# Plastic soil, and elastic material with a Poisson ratio near 0.5.
for method in ("fe", "gimp"):
    scene = f"prm/hard-cases/bearing-{method}.prm"
    settings = {**BEARING, "Mesh/Upper corner": "5, 0.25"}
    if method == "fe":
        settings = {**BEARING, "Mesh/Cell size": 0.26}
    show(f"footing, {method}, pointwise", scene, {**settings, **POINT})
    show(f"footing, {method}, cell mean", scene, settings)
    show(f"membrane, {method}, pointwise, nu = 0.49",
         f"prm/hard-cases/cook-{method}.prm",
         {**POINT, "Materials/panel/Poisson ratio": 0.49})
    show(f"membrane, {method}, pointwise, nu = 0.33",
         f"prm/hard-cases/cook-{method}.prm",
         {**POINT, "Materials/panel/Poisson ratio": 0.33})
show("footing, MPM, pointwise", "prm/hard-cases/bearing-gimp.prm",
     {**BEARING, **POINT, "Mesh/Upper corner": "5, 0.25",
      "Method/Method": "material point"})
show("slope, pointwise", "prm/geotechnics/slope.prm",
     {**POINT, "Mesh/Cell size": 1, "Time/End time": 1, "Time/Steps": 20})

# A scene in which no load acts.
result = run(BLOCK, {"Loads/weight/Value": "0; 0", "Loads/end/Value": "0; 0"})
text("nothing acts: warnings", told(result))

# Ground at rest that hardly changes its volume: mean stress grows with depth from
# cell to cell, by more than the deviatoric stress, and is right.
for volumetric in ("pointwise", "cell mean"):
    show(f"ground at rest, {volumetric}", "prm/geotechnics/slope.prm",
         {"Bodies/embankment/Vertices": "0 0; 40 0; 40 12; 0 12",
          "Materials/clay/Poisson ratio": 0.495, "Mesh/Cell size": 1,
          "Method/Volumetric strain": volumetric,
          "Method/Strain": "small", "Method/Mesh after step": "keep",
          "Time/End time": 1, "Time/Steps": 1})

# Hardly filled cells: the block turned by 30 degrees, and its mesh moved.
DOWN = "sin(30*pi/180); -cos(30*pi/180)"
CUT = {"Bodies/block/Rotation angle": 30, "Loads/weight/Value": DOWN,
       "Boundaries/support/Rotation angle": 30, "Loads/end/Value": DOWN,
       "Probes/tip/Location": "1.47, 1.42",
       "Mesh/Lower corner": "-1.057084, -1.5000023",
       "Mesh/Upper corner": "2.942916, 2.4999977"}
for fill in (0, 0.1):
    show(f"block, Aggregate below = {fill}", BLOCK,
         {**CUT, "Method/Aggregate below": fill})

# A condition that holds nothing: here the ground ends below the side.
idle = run("prm/hard-cases/bearing-fe.prm",
           {**BEARING, "Mesh/Cell size": 0.26, "Mesh/Upper corner": "5.2, 0.26"})
text("footing above the ground", told(idle))

# Small strain where it is none: force over area of the start is no stress where
# points move.
PLATE = prm("""
Mesh/Lower corner = 0, 0 | Upper corner = 3, 1.5 | Cell size = 0.25
Materials/steel/Young modulus = 1000 | Poisson ratio = 0.3
Bodies/plate/Shape = box | Lower corner = 0, 0 | Upper corner = 2, 1
Grid conditions/left/Side = left | Components = x
Grid conditions/base/Side = bottom | Components = y
Loads/pull/Type = surface traction | Body = plate | Part = right | Value = 100 * t; 0
Time/Steps = 4
""")
plate = folder / "plate.prm"
plate.write_text(PLATE)
SMALL = {"Method/Strain": "small", "Method/Method": "GIMP"}
for name, settings in (
        ("GIMP", {}), ("FE", {"Method/Method": "finite element"}),
        ("a third of the load", {"Time/End time": 0.33}),
        ("points stay", {"Method/Mesh after step": "keep"}),
        ("finite strain", {"Method/Strain": "finite"})):
    result = run(plate, {**SMALL, **settings})
    text(f"plate pulled, small strain, {name}: warnings", told(result) or "none")

# What displacements do not know of after a reset: that the plate was strained, and
# is not slender; that it was moved.
STEPS = prm("""
Time/Steps = 4
""")
assert STEPS in PLATE
plate.write_text(PLATE.replace(STEPS, prm("""
Stages/first/Time/Steps = 4
Stages/held/Reset displacements = true
Stages/held/Time/End time = 2
""")).replace("100 * t", "100 * min(t, 1)"))
for name, settings in (
        ("", {"Output/Checkpoint every": "1 step"}),
        (", not reset", {"Stages/held/Reset displacements": "false"}),
        (", a third of the load", {"Loads/pull/Value": "33 * min(t, 1); 0"})):
    result = run(plate, {**SMALL, **settings})
    text(f"plate pulled, then held{name}: warnings", told(result) or "none")
    if "Output/Checkpoint every" in settings:
        run(result.folder, command="resume", extra=["--from", "4"])
        again = json.loads((result.folder / "summary.json").read_text())
        text("  resumed before: the same", again["warnings"] == result.summary["warnings"])
        run(result.folder, command="resume", extra=["--from", "5"])
        again = json.loads((result.folder / "summary.json").read_text())
        text("  resumed after: the same", again["warnings"] == result.summary["warnings"])
ALL = "Grid conditions/all"
result = run(plate, {"Method/Method": "material point", "Loads/pull/Value": "0; 0",
                     f"{ALL}/Lower corner": "-1, -1", f"{ALL}/Upper corner": "4, 4",
                     f"{ALL}/Translation": "0: 0, 1: 0.5, 2: 0.5; 0",
                     "Stages/first/Grid conditions": "all"})
text("plate moved, then held: warnings", told(result))

# A block that has fallen on a floor and rests: what stress is left in it counts,
# though motion once had much more energy.
landed = scene_file("landed.prm", """
Mesh/Lower corner = -1, 0 | Upper corner = 2, 3 | Cell size = 0.25
Method/Method = GIMP | Strain = finite
Materials/block/Young modulus = 1e7 | Poisson ratio = 0.3 | Density = 2
Bodies/block/Lower corner = 0, 1 | Upper corner = 1, 2 | Stiffness damping = 0.002
Grid conditions/floor/Side = bottom | Components = y
Loads/weight/Type = gravity | Value = 0; -10
Time/Integrator = Newmark | End time = 3 | Steps = 1000
Output/Points = false | Mesh = false
""")
result = run(landed, on_ranks=1)
text("landed", told(result) or "nothing")
text("landed: has an estimate", "estimated_stress_error" in result.summary)
