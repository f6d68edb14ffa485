# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A stiff block sinks through the level of the water, held at its top: what holds it has
its weight less that of the water that it displaces, without a kick as points go under,
and Newton's method needs hardly more iterations than without water, but for elements
that move, to which nothing happens in air."""

SCENE = """
Dimension = 2
Mesh/Lower corner = 0, 0 | Upper corner = 6, 10 | Cell size = 1
Method/Method = GIMP | Strain = finite | Mesh after step = reset
Materials/soil/Young modulus = 1e6 | Poisson ratio = 0.3 | Density = 2
Bodies/block/Lower corner = 2, 6 | Upper corner = 4, 8
Boundaries/top/Points = 4 8; 2 8 | Constraint = fixed | Translation = 0; -4*t
Loads/weight/Type = gravity | Value = 0; -10
Water/Level = 5.03 | Unit weight = 10
Time/Steps = 40
Probes/middle/Location = 3, 7
"""
scene = scene_file("sinking.prm", SCENE)
dry = scene_file("dry.prm", SCENE.replace("Water/Level = 5.03 | Unit weight = 10\n", ""))
METHODS = {"FE": {"Method/Method": "finite element",
                  "Method/Mesh after step": "follow material"},
           "MPM": {"Method/Method": "material point"}, "GIMP": {},
           "CPDI1": {"Method/Method": "CPDI1"}}
for method, settings in METHODS.items():
    result = run(scene, {**settings, **QUIET})
    error, step, before = 0, 0, 80
    for row in result.history():
        wet = min(max(5.03 - (6 - 4 * row["t"]), 0), 2)
        error = max(error, abs(row["reaction_y of top"] - (80 - 2 * 10 * wet)))
        step = max(step, before - row["reaction_y of top"])
        before = row["reaction_y of top"]
    number(f"{method}: largest error of the reaction, of 80 kN/m", error, 2)
    # A step immerses 0.1 m of 2 m.
    number(f"{method}: largest change in a step, 2 kN/m", step, 3)
    without = run(dry, {**settings, **QUIET})
    text(f"{method}: Newton iterations", result.summary["newton_iterations"])
    text(f"{method}: without water", without.summary["newton_iterations"])
