# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A smooth pipe pushed into clay by its diameter D beside V/(su D) = 4.97 (w/D)^0.23, and
6.73 (w/D)^0.29 of a rough one (Aubeny et al. 2005); from 4.2 to 4.5 at half a diameter."""

H = 0.125
# Half by symmetry.
PIPE = f"""
Dimension = 2
Mesh/Lower corner = 0, -2 | Upper corner = 2.5, 0.75 | Cell size = {H}
Method/Method = GIMP | Strain = finite
Materials/clay/Model = von Mises | Shear yield stress = 10
Materials/clay/Young modulus = 2000 | Poisson ratio = 0.49
Bodies/ground/Lower corner = 0, -2 | Upper corner = 2.5, 0
Boundaries/pipe/Surface = circle | Centre = 0, 0.5 | Radius = 0.5
Boundaries/pipe/Body side = outside | Constraint = contact
Boundaries/pipe/Translation = 0; -t
Grid conditions/axis/Side = left | Components = x
Grid conditions/right/Side = right | Components = x
Grid conditions/base/Side = bottom
Time/Steps = 100
"""

rows = run(scene_file("pipe.prm", PIPE), QUIET).history()
for depth in (0.25, 0.5, 1):
    row = min(rows, key=lambda one: abs(one["t"] - depth))
    found = -2 * row["reaction_y of pipe"] / 10
    smooth, rough = 4.97 * depth ** 0.23, 6.73 * depth ** 0.29
    at_least(f"w = {depth} D: V/(su D) over {smooth:.3g}, the smooth one",
             found / smooth, 1)
    at_least("the rough one over it", rough / found, 1)
    if depth == 0.5:
        at_least("over 4.2", found / 4.2, 1)
        at_least("4.5 over it", 4.5 / found, 1)
bound("deepest place behind the surface, over a cell",
      max(row["penetration of pipe"] for row in rows) / H, 0.1)
