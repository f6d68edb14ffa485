# ranks: 1-2  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Walls that are pushed into soil or give way, by contact: earth pressure of Rankine on
sand; passive and active force of clay on smooth walls, where they hold the soil and
where they let it go."""

WALL = """
Dimension = 2
Method/Method = GIMP | Mesh after step = keep
Boundaries/wall/Points = 0 12; 0 -1 | Constraint = contact
Grid conditions/base/Side = bottom | Components = y
Grid conditions/right/Side = right | Components = x
Loads/weight/Type = gravity | Value = 0; -10
Time/Steps = 10
"""
SAND = scene_file("sand.prm", WALL + """
Mesh/Lower corner = -1, 0 | Upper corner = 14, 6 | Cell size = 0.5
Materials/sand/Model = Mohr-Coulomb | Friction angle = 30 | Dilation angle = 30
Materials/sand/Young modulus = 2e4 | Poisson ratio = 0.3 | Density = 2
Bodies/fill/Lower corner = 0, 0 | Upper corner = 14, 5
Bodies/fill/Initial stress = geostatic | K0 = 0.5
""")
CLAY = scene_file("clay.prm", WALL + """
Mesh/Lower corner = -2, 0 | Upper corner = 30, 12 | Cell size = 1
Materials/clay/Model = Tresca | Shear strength = 20
Materials/clay/Young modulus = 2e4 | Poisson ratio = 0.49 | Density = 2
Bodies/fill/Lower corner = 0, 0 | Upper corner = 30, 10
Bodies/fill/Initial stress = geostatic | K0 = 1
""")


def force(scene, motion, **keys):
    result = run(scene, {"Boundaries/wall/Translation": f"{motion}*t; 0", **{
        f"Boundaries/wall/{key.replace('_', ' ')}": value
        for key, value in keys.items()}})
    row = result.history()[-1]
    print(row["reaction_x of wall"], row["reaction_y of wall"], row["contact area of wall"], row["slipping area of wall"], result.summary["newton_iterations"], result.summary["steps"] if "steps" in result.summary else "")
    return row


force(SAND, -0.02)
force(SAND, 0.3)
force(CLAY, 0.1)
force(CLAY, -0.1, Separation="false")
force(CLAY, -0.1)
force(CLAY, 0.2, Adhesion=20, Separation="false")
print("exact 83.33 750 1400 600 600..640 1514 200")
