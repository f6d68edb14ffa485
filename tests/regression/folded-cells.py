# ranks: 2  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A cut block of elements of degree 2 that is sheared until cells fold where they have
no material: what lies there of a boundary does not count, forces balance, and the
block stays at its plates. One step that is computed wrong is not cut into others."""

scene = scene_file("scene.prm", """
Dimension = 3
Mesh/Lower corner = -0.3, -0.3, -0.3 | Upper corner = 2.7, 2.7, 2.7 | Cell size = 0.5
Method/Method = finite element | Strain = finite | Degree = 2
Materials/gel/Model = neo-Hookean | Young modulus = 100 | Poisson ratio = 0.3
Bodies/block/Lower corner = 0, 0, 0 | Upper corner = 2, 1, 1
Boundaries/top/Body = block | Part = top | Translation = 0.4*t; 0; 0
Boundaries/bottom/Body = block | Part = bottom
Boundaries/front/Body = block | Part = front | Constraint = roller
Boundaries/back/Body = block | Part = back | Constraint = roller
Output/Points = false | Mesh = false
Time/End time = 0.7 | Steps = 7 | Smallest step = 0.9
""")
result = run(scene)
rows = result.history()
names = ("top", "bottom", "front", "back")
bound("forces that do not balance, over that of the plate",
      max(abs(sum(row[f"reaction_{axis} of {name}"] for name in names))
          for row in rows for axis in "xyz") / rows[-1]["reaction_x of top"],
      1e-10)
bound("what misses a plate", max(row[f"violation of {name}"]
                                 for row in rows for name in names), 3e-3)
number("force of the plate", rows[-1]["reaction_x of top"], 3)
number("of the step before, over way",
       rows[-2]["reaction_x of top"] * 7 / 6, 3)
