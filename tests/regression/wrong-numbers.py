# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""What could end with "ok" and a wrong number: steps out of balance, a slope on
boundaries that cut cells, a step too long for its error, a load between steps,
cells that are too coarse for a body, displacements and turns too large for small strain."""

PAD = prm("""
Mesh/Lower corner = 900, -400 | Upper corner = 1300, 0 | Cell size = 5
Method/Method = finite element | Degree = 2 | Strain = finite
Materials/rubber/Model = neo-Hookean | Young modulus = 3 | Poisson ratio = 0.45
Bodies/pad/Lower corner = 0, 0 | Upper corner = 200, 100 | Rotation angle = 31
Bodies/pad/Translation = 1053.7, -287.9
Boundaries/bottom/Body = pad | Part = bottom
Boundaries/top/Body = pad | Part = top
Boundaries/top/Translation = 35*t*sin(31*pi/180); -35*t*cos(31*pi/180)
Time/End time = 0.5 | Steps = 10
""")

# A pad that is squeezed until points of cut cells are: no step is accepted that
# leaves the forces of its plates out of balance.
scene = folder / "pad.prm"
scene.write_text(PAD)
pad = run(scene, {"Output/Write": "end"}, expect=None)
worst = max(abs(row[f"reaction_{d} of top"] + row[f"reaction_{d} of bottom"])
            / abs(row["reaction_y of top"])
            for row in pad.history() for d in "xy")
bound("pad: plates out of balance", worst, 1e-6)
at_least("pad: steps", len(pad.history()), 5)

# Taylor's factor for this slope is 1.279; it falls on base and sides that cut
# cells at any angle as on those of the mesh.
SLOPE = "prm/geotechnics/factor-of-safety.prm"
words = open(root / SLOPE).read().split("subsection Grid conditions")
below = words[1].split("subsection Loads")[1]
turned = words[0] + prm("""
Boundaries/base/Body = embankment | Part = 1
Boundaries/right/Body = embankment | Part = 2 | Constraint = roller
Boundaries/left/Body = embankment | Part = 6 | Constraint = roller
""") + "subsection Loads" + below
scene = folder / "slope.prm"
scene.write_text(turned)
for angle in (0, 15):
    for factor, stands in (1.25, True), (1.32, False):
        result = run(scene, {
            "Bodies/embankment/Rotation angle": angle,
            "Mesh/Lower corner": "-4, -1", "Mesh/Upper corner": "42, 24",
            "Loads/weight/Value": f"9.81*sin({angle}*pi/180); "
                                  f"-9.81*cos({angle}*pi/180)",
            "Probes/crest/Location":
                f"10*cos({angle}*pi/180)-11.9*sin({angle}*pi/180), "
                f"10*sin({angle}*pi/180)+11.9*cos({angle}*pi/180)",
            "Strength reduction/Factor": factor, "Output/Write": "end"},
            expect=None)
        text(f"slope turned by {angle}, factor {factor}: stands",
             result.summary["status"] == "ok")

# A step that is only too long is shortened; nodes need no stiffness for that.
block = run("prm/hard-cases/cut-block.prm", {
    "Time/Integrator": "Newmark", "Time/Error tolerance": 1e-4, "Time/Steps": 1,
    "Time/End time": 0.05, "Method/Aggregate below": 0})
at_least("too long a step: rejected", block.summary["rejected_steps"], 3)
text("  stiffness of empty parts",
     "stiffness of empty parts" in block.summary["effects"])

# Steps end on the rows of a table, so that a pulse between their planned ends acts.
for curve, peak in (("0: 0, 0.101: 0, 0.103: 1, 0.105: 0", 0.103),
                    ("0: 0, 0.1: 1, 0.2: 0", 0.1)):
    pulse = run("prm/phuong-2023/column-fixed-fe.prm", {
        "Loads/pulse/Value": "0; -1", "Loads/pulse/Curve": curve,
        "Time/End time": 0.2, "Time/Steps": 20})
    text(f"pulse {curve}: a step ends on its peak",
         any(abs(row["t"] - peak) < 1e-12 for row in pulse.history()))

# What cells are too coarse for, and what small strain is too coarse for.
BLOCK = prm("""
Mesh/Lower corner = 0, 0 | Upper corner = 4, 4 | Cell size = 0.25
Materials/soft/Young modulus = 1 | Poisson ratio = 0.3
Materials/stiff/Young modulus = {stiffness} | Poisson ratio = 0.3
Bodies/block/Shape = box | Lower corner = 0, {bottom} | Upper corner = {corner}
Bodies/block/Material = soft
Bodies/
{second}
Grid conditions/left/Side = left
Grid conditions/right/Side = right | Displacement = {pull}*t; 0
""")
SECOND = prm("""
wall/Shape = box | Lower corner = {x}, 0 | Upper corner = 4, 4 | Material = stiff
""")
for name, corner, second, stiffness, pull in (
        ("a strip of 1.2 cells", "4, 1.35", "", 1, 0.1),
        ("a strip of two", "4, 1.55", "", 1, 0.1),
        ("a stiff wall to 2.4 of a cell", "2.4, 4", SECOND.format(x=2.4), 100, 0.1),
        ("one that ends with it", "2.5, 4", SECOND.format(x=2.5), 100, 0.1),
        ("one not much stiffer", "2.4, 4", SECOND.format(x=2.4), 5, 0.1),
        ("stretched by 0.3 of its size", "4, 4", "", 1, 1.2),
        ("stretched by 0.4", "4, 4", "", 1, 1.6),
        ("pulled by 1.1", "4, 4", "", 1, 4.4)):
    scene = folder / "block.prm"
    scene.write_text(BLOCK.format(
        corner=corner, second=second, stiffness=stiffness, pull=pull,
        bottom=1.05 if "strip" in name else 0))
    result = run(scene, {"Method/Method": "finite element"}, expect=None)
    text(f"{name}: found", result.found() or "nothing")

# A turn is no strain, but small strain finds some in one that is prescribed.
scene = scene_file("shaft.prm", """
Mesh/Lower corner = -35, -35 | Upper corner = 35, 35 | Cell size = 5
Materials/steel/Young modulus = 210000 | Poisson ratio = 0.3
Bodies/shaft/Shape = ring | Centre = 0, 0 | Radius = 30 | Inner radius = 12
Boundaries/bore/Body = shaft | Part = inner | Rotation angle = 3*t
Boundaries/bearing/Body = shaft | Part = outer | Constraint = roller
Boundaries/bearing/Rotation angle = 0
Time/Steps = 4
""")
HELD = {"Boundaries/bearing/Constraint": "fixed"}
for name, settings in (
        ("small strain", {}),
        ("small strain, finite element, nothing moves",
         {"Method/Method": "finite element", "Method/Mesh after step": "keep"}),
        ("small strain, a hundredth of it",
         {"Boundaries/bore/Rotation angle": "0.03*t"}),
        ("small strain, held outside", HELD),
        ("finite strain", {"Method/Strain": "finite"})):
    result = run(scene, {"Output/Write": "end", **settings})
    text(f"shaft, {name}: found", result.found())

# Where volume is kept the bulk modulus meets that strain.
for nu, angle in (0.4999, 1), (0.49, 1), (0.3, 1), (0.4999, 0.1):
    result = run(scene, {"Output/Write": "end", **HELD, "Time/Steps": 1,
                         "Method/Mesh after step": "keep",
                         "Materials/steel/Poisson ratio": nu,
                         "Boundaries/bore/Rotation angle": f"{angle}*t"})
    text(f"shaft held outside, nu = {nu}, {angle} degrees: found",
         "small-strain" in result.ids())

# A step turns by less than half a circle.
for angle, steps in ("360*t", 1), ("360*t", 2), ("100*t", 1):
    result = run(scene, {"Boundaries/bore/Rotation angle": angle, "Time/Steps": steps,
                         "Output/Write": "end"}, expect=None)
    text(f"shaft turned by {angle} in {steps} steps: steps", result.summary["steps"])

# Points of a file with volumes that are not theirs.
for name, size, volume in (
        ("right", 0.5, 1), ("that fit no cells", 0.4, 1),
        ("nearly as large as cells", 0.79, 1), ("twice as large", 0.5, 2)):
    file = folder / "points.csv"
    file.write_text("x,y,volume\n" + "".join(
        f"{0.5 + (i + 0.5) * size},{0.5 + (j + 0.5) * size},{volume * size ** 2}\n"
        for i in range(round(4 / size)) for j in range(round(4 / size))))
    result = run("tests/bad-input/base.prm", {
        "Bodies/block/Shape": "points-from-file", "Bodies/block/Point file": file,
        "Bodies/block/Lower corner": "", "Bodies/block/Upper corner": ""})
    text(f"volumes of points {name}: found", result.found())

# Points in rows that are not those of the cells: standard MPM has stresses off by a
# third, and by as much in smaller cells.
for grid, method in (("8, 8", "material point"), ("10, 10", "material point"),
                     ("10, 10", "GIMP"), ("12, 12", "material point")):
    result = run("tests/bad-input/base.prm", {
        "Bodies/block/Point grid": grid, "Method/Method": method})
    text(f"{grid} points in 4 x 4 cells, {method}: found", "point-volumes" in result.ids())

# Bodies of elements that move into each other, and through a floor with none at it.
FLIGHT = prm("""
Mesh/Lower corner = -3, 0 | Upper corner = 3, 1 | Cell size = 0.25
Method/Method = {method}
Materials/bar/Young modulus = 100 | Poisson ratio = 0 | Density = 1
Bodies/left/Lower corner = -2, 0.5 | Upper corner = -1, 1
Bodies/left/Initial velocity = {velocity}
Bodies/right/Lower corner = 0, 0.5 | Upper corner = 1, 1
Grid conditions/floor/Side = bottom
Time/Integrator = Newmark | End time = 2 | Steps = 20
Output/Points = false | Mesh = false
""")
flight = folder / "flight.prm"
for method, velocity in (("finite element", "1; 0"), ("finite element", "0; -0.5"),
                         ("finite element", "0.2; 0"), ("GIMP", "1; 0"),
                         ("GIMP", "0; 0.1"), ("CPDI2", "1; 0"),
                         ("material point", "1; 0")):
    flight.write_text(FLIGHT.format(method=method, velocity=velocity))
    text(f"{method}, {velocity}: found", run(flight, expect=None).found())

# Boxes of points in rows have their proportions, turned with the body.
for grid, angle in (("8, 16", 0), ("8, 16", 90), ("8, 8", 0)):
    result = run("tests/bad-input/base.prm", {
        "Bodies/block/Point grid": grid, "Bodies/block/Rotation angle": angle,
        "Bodies/block/Rotation centre": "2.5, 2.5", "Method/Method": "GIMP"})
    (lengths,) = zip(*result.points("half_length"))
    for x, y in sorted({(round(x, 6), round(y, 6)) for x, y, _ in lengths}):
        text(f"{grid} points turned by {angle}: half lengths", f"{x} {y}")

# What is filled up from the old level, above ground that has risen meanwhile.
heave = scene_file("heave.prm", """
Mesh/Lower corner = 0, 0 | Upper corner = 1, 14 | Cell size = 0.5
Method/Method = GIMP
Materials/clay/Young modulus = 500 | Poisson ratio = 0.3 | Density = 2
Bodies/low/Lower corner = 0, 0 | Upper corner = 1, 6 | Initial stress = geostatic
Bodies/dug/Lower corner = 0, 6 | Upper corner = 1, 9 | Initial stress = geostatic
Bodies/fill/Lower corner = 0, 6 | Upper corner = 1, 9
Grid conditions/left/Side = left | Components = x
Grid conditions/right/Side = right | Components = x
Grid conditions/base/Side = bottom | Components = y
Loads/weight/Type = gravity | Value = 0; -10
Stages/rest/Bodies = low, dug
Stages/rest/Time/End time = 1
Stages/pit/Bodies = low
Stages/pit/Time/End time = 2
Stages/filled/Bodies = low, fill
Stages/filled/Time/End time = 3
""")
for name, settings in (
        ("GIMP", {}), ("FE", {"Method/Method": "finite element"}),
        ("GIMP, hard ground", {"Materials/clay/Young modulus": 5e5}),
        ("GIMP, hard ground, from inside a cell", {
            "Materials/clay/Young modulus": 5e5, "Bodies/low/Upper corner": "1, 5.8",
            "Bodies/dug/Lower corner": "0, 5.8", "Bodies/fill/Lower corner": "0, 5.8"})):
    result = run(heave, {"Method/Strain": "finite", "Output/Write": "end", **settings})
    text(f"fill above what has risen, {name}: found", [
        one for one in result.ids() if one in ("point-volumes", "bodies-meet")])

# What is dug has the shape that is left: however a cylinder lies in its cells.
BORED = prm("""
Dimension = 3
Mesh/Lower corner = -4, -4, -4 | Upper corner = 4, 4, 4 | Cell size = {h}
Materials/rock/Young modulus = 1000 | Poisson ratio = 0.3
Bodies/all/Lower corner = -4, -4, -4 | Upper corner = 4, 4, 4
Bodies/hole/Shape = cylinder | Axis start = {start} | Axis end = {end}
Bodies/hole/Radius = {radius}
Bodies/ground/Shape = difference | Operands = all, hole
Bodies/core/Shape = {core} | Operands = all, hole
Grid conditions/base/Side = bottom
""")
scene = folder / "bored.prm"
for name, start, end in (("along x", "-4, 0.13, -0.21", "4, 0.13, -0.21"),
                         ("along y", "0.13, -4, -0.21", "0.13, 4, -0.21"),
                         ("along z", "0.13, -0.21, -4", "0.13, -0.21, 4"),
                         ("inclined", "0.13, -0.21, -5", "1.43, -0.4, 5")):
    for radius, h in (2, 0.5), (1.5, 1), (3.3, 1):
        scene.write_text(BORED.format(h=h, radius=radius, start=start, end=end,
                                      core="intersection"))
        result = run(scene, command="check")
        text(f"hole of {radius} {name}, cells of {h}, and its core", result.code)
scene.write_text(BORED.format(h=1, radius=2, start="0, 0, -4", end="0, 0, 4", core="union"))
text("the hole, and all of it", run(scene, command="check", expect=2).code)

# Dashpots hold nothing at rest.
SIDE = "Grid conditions/right/"
ABSORBS = {SIDE + "Constraint": "absorbing", SIDE + "Components": ""}
for name, settings in (
        ("absorbs from the start", ABSORBS),
        ("has springs", {**ABSORBS, SIDE + "Virtual thickness": 4}),
        ("holds, then absorbs", {"Stages/pulse/Absorbing": "base, right"})):
    result = run("prm/dynamics/gravity-then-wave.prm", {
        "Stages/pulse/Time/End time": 1.01, "Stages/pulse/Time/Steps": 2,
        "Output/Write": "end", **settings})
    text(f"side that {name}: found", "absorbing-boundary (right)" in result.found())

# What one body says of its cut cells does not depend on another, far away; its
# domains reach cells that have none of its points.
apart = scene_file("apart.prm", """
Mesh/Lower corner = 0, 0 | Upper corner = 8, 4 | Cell size = 1
Method/Method = GIMP
Materials/solid/Young modulus = 100 | Poisson ratio = 0.3
Bodies/pulled/Lower corner = 0, 0 | Upper corner = 2, 2 | Aggregate below = 0
Bodies/other/Lower corner = 5, 0 | Upper corner = 7, 2
Grid conditions/base/Side = bottom
Loads/pull/Value = 0; 3*t | Bodies = pulled
Time/Steps = 4
Probes/top/Location = 0.1, 1.9
""")
lifts = [run(apart, {"Bodies/other/Aggregate below": fill}).history()[-1]["u_y at top"]
         for fill in (0.1, 0)]
at_least("cut cells of one body: displacement", lifts[0], 0.01)
bound("cut cells of one body, by what another says: difference",
      abs(lifts[0] / lifts[1] - 1), 1e-9)
