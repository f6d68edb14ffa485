# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Material that grows past the end of what holds it is told of: a block that spreads
on its own 'Part'; not on a longer line, nor beside a footing. In the last step as in
others."""

from math import log

SCENE = prm("""
Mesh/Lower corner = -1.03, -1.02 | Upper corner = 6.97, 4.98 | Cell size = 0.5
Method/Method = {method} | Strain = finite
Materials/soil/Young modulus = {modulus} | Poisson ratio = 0.3 | Density = 2
Bodies/block/Lower corner = 0, 0 | Upper corner = 3, 3
Boundaries/low/
{low}
Boundaries/low/Constraint = roller
Boundaries/left/Body = block | Part = left | Constraint = roller
Boundaries/
{more}
Loads/weight/Type = gravity | Value = 0; -10*t
Time/Steps = 20
""")
PART = "    set Body = block\n    set Part = bottom"
LINE = "    set Points = -1 0; 6 0"
FOOTING = prm("""
footing/Points = 1 3; 0 3 | Constraint = roller | Translation = 0; -0.4*t
""")
for name, low, more, modulus, methods in (
        ("on its own part", PART, "", 100, ("GIMP", "CPDI2")),
        ("on a longer line", LINE, "", 100, ("GIMP", "CPDI2")),
        ("below a footing", LINE, FOOTING, 1000, ("GIMP",))):
    for method in methods:
        scene = folder / "block.prm"
        scene.write_text(SCENE.format(method=method, low=low, more=more,
                                      modulus=modulus))
        result = run(scene, {"Output/Points": "false", "Output/Mesh": "false"},
                     expect=None)
        text(f"{name}, {method}",
             [one for one in result.found() if one.startswith("surface-coverage")]
             or "nothing")

# Between rollers that are its own sides; the first time to be told of, and the end.
pressed = scene_file("pressed.prm", """
Mesh/Lower corner = -1.3, -0.3 | Upper corner = 3.7, 1.7 | Cell size = 0.25
Method/Method = finite element | Strain = finite
Materials/gel/Model = neo-Hookean | Young modulus = 100 | Poisson ratio = 0.3
Bodies/block/Lower corner = 0, 0 | Upper corner = 2, 1
Grid conditions/middle/Lower corner = 0.94, -1 | Upper corner = 0.96, 2
Grid conditions/middle/Components = x
Boundaries/low/Body = block | Part = bottom | Constraint = roller
Boundaries/top/Body = block | Part = top | Constraint = roller
Boundaries/top/Translation = 0; -0.5*t
Output/Points = false | Mesh = false
""")
for end, steps in ((0.65, 13), (0.7, 14)):
    result = run(pressed, {"Time/End time": end, "Time/Steps": steps})
    text(f"pressed to t = {end}", [
        (one["object"], round(one["t"], 6)) for one in result.summary["warnings"]
        if one["id"] == "surface-coverage"])

# A cube between plates: its cells can follow rollers and plates, but beside a fixed
# wall cells let go of the upper one.
cube = scene_file("cube.prm", """
Dimension = 3
Mesh/Lower corner = -1, -1, -1 | Upper corner = 3, 3, 4 | Cell size = 1
Method/Method = GIMP | Strain = finite
Materials/clay/Young modulus = 1000 | Poisson ratio = 0.3
Bodies/cube/Lower corner = 0.13, 0.13, 0.13 | Upper corner = 2.13, 2.13, 2.13
Boundaries/top/Surface = plane | Point = 0, 0, 2.13 | Normal = 0, 0, 1
Boundaries/top/Constraint = roller | Translation = 0; 0; -0.6*t
Time/Steps = 10
Output/Points = false | Mesh = false
""", *(f"Boundaries/{name}/Surface = plane | Point = {point} | Normal = {normal}"
       " | Constraint = roller" for name, point, normal in (
           ("left", "0.13, 0, 0", "-1, 0, 0"), ("front", "0, 0.13, 0", "0, -1, 0"),
           ("bottom", "0, 0, 0.13", "0, 0, -1"))))
exact = 1000 * log(0.7) * 4 / 0.7  # Hencky: tau A / J
for name, h, wall, way in (("rollers", 1, "roller", 0.6), ("rollers", 0.5, "roller", 0.6),
                           ("a fixed wall", 1, "fixed", 0.36)):
    result = run(cube, {"Mesh/Cell size": h, "Boundaries/left/Constraint": wall,
                        "Boundaries/top/Translation": f"0; 0; -{way}*t"})
    row = result.history()[-1]
    text(f"{name}, h = {h}: material beyond the plate by more than a tenth of a cell",
         row["penetration of top"] > 0.1 * h)
    text("  found", result.found())
    if h == 0.5:
        bound("  force of the plate over the exact one - 1",
              row["reaction_z of top"] / exact - 1, 1e-3)
