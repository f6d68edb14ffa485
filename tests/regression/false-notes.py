# ranks: 1 # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Scenes that are right and were told that something is wrong: waves, of which
the end is one moment, and material that yields in full cells."""


def told(result):
    return result.found()


for scene in ("impact", "impact-roller"):
    text(f"{scene}: told", told(run(f"prm/dynamics/{scene}.prm")))

# A block of full cells is pulled until it flows.
plateau = scene_file("plateau.prm", """
Mesh/Lower corner = 0, 0 | Upper corner = 4, 6 | Cell size = 0.5
Method/Method = GIMP
Materials/clay/Model = von Mises | Young modulus = 1000 | Poisson ratio = 0.3
Materials/clay/Uniaxial yield stress = 1
Bodies/block/Lower corner = 0, 0 | Upper corner = 2, 4
Grid conditions/left/Side = left | Components = x
Grid conditions/bottom/Side = bottom | Components = y
Loads/pull/Type = surface traction | Points = 2 4; 0 4 | Value = 0; 1.3*t
Time/End time = 1 | Steps = 10
Output/Write = end
""")
for strain in ("small", "finite"):
    result = run(plateau, {"Method/Strain": strain}, expect=1)
    text(f"plateau, {strain} strain: too few points",
         "fictitious-stiffness" in result.ids())
    # Plane strain: 2/sqrt(3) of the yield stress.
    bound(f"plateau, {strain} strain: load over exact - 1",
          1.3 * result.summary["time"] / (2 / 3**0.5) - 1, 0.01)
