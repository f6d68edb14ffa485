# ranks: 2
# debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A run says when points without domains leave equilibrium as they move through the
mesh: a beam bent to a quarter of a circle is half as stiff then. It says nothing where
domains carry the forces, or where a body without stress turns."""

from math import pi

scene = scene_file("beam.prm", """
Mesh/Lower corner = -1, -4 | Upper corner = 9, 9 | Cell size = 0.25
Method/Strain = finite
Materials/steel/Young modulus = 1000 | Poisson ratio = 0.3
Bodies/beam/Lower corner = 0, 0 | Upper corner = 8, 1
Boundaries/left/Points = 0 1; 0 0
Boundaries/right/Points = 8 0; 8 1 | Rotation angle = 90 * t
Boundaries/right/Rotation centre = 8, 0.5
Boundaries/right/Translation = if(t > 0, 8 * sin(pi/2 * t) / (pi/2 * t) - 8, 0); if(t > 0, 8 * (1 - cos(pi/2 * t)) / (pi/2 * t), 0)
Time/Steps = 18
Output/Points = false | Mesh = false
""")
exact = 1000 / (1 - 0.3**2) / 12 * (pi / 2) / 8  # E I / (1 - nu^2) / radius
for method in ("finite element", "GIMP", "material point"):
    result = run(scene, {"Method/Method": method})
    moment = result.history()[-1]["moment of right"]
    told = "cell-crossing" in result.ids()
    text(f"{method}: told", told)
    number(f"{method}: moment over that of a beam", moment / exact, 2)

turned = run("prm/large-deformation/rotation-annulus.prm", {"Time/Steps": 6})
text("a turn without stress: told", "cell-crossing" in turned.ids())
