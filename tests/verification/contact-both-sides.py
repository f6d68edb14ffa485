# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Ground on both sides of a wall, 1 m thick and in the mesh: each side touches its own
surface, and what lies on the other side of a surface is no overlap. Elastic ground under
its weight presses by nu/(1 - nu) gamma H^2/2."""

WALL = """
Dimension = 2
Mesh/Lower corner = 0, 0 | Upper corner = 9, 5 | Cell size = 0.5
Method/Mesh after step = keep
Materials/soil/Young modulus = 2e4 | Poisson ratio = 0.3 | Density = 2
Bodies/retained/Lower corner = 0, 0 | Upper corner = 4, 4
Bodies/front/Lower corner = 5, 0 | Upper corner = 9, 2
Boundaries/retained/Points = 4 -1; 4 6 | Constraint = contact
Boundaries/front/Points = 5 6; 5 -1 | Constraint = contact
Grid conditions/base/Side = bottom | Components = y
Grid conditions/left/Side = left | Components = x
Grid conditions/right/Side = right | Components = x
Loads/weight/Type = gravity | Value = 0; -10
Time/Steps = 2
"""
for method in "GIMP", "CPDI1", "finite element":
    row = run(scene_file("wall.prm", WALL), {**QUIET, "Method/Method": method}).history()[-1]
    for name, height, way in ("retained", 4, -1), ("front", 2, 1):
        exact = way * 3 / 7 * 20 * height ** 2 / 2
        bound(f"{method}: {name}", row[f"reaction_x of {name}"] / exact - 1, 1e-8)
