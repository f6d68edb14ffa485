# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A region with the corners of a side of the mesh is that side, also where they are
no numbers of base two: none of its dashpots is lost to round-off."""

SCENE = prm("""
Mesh/Lower corner = {first}, 0 | Upper corner = {last}, 1 | Cells = {cells}, 10
Method/Method = finite element
Materials/rock/Young modulus = 1000 | Poisson ratio = 0.3 | Density = 1
Bodies/block/Lower corner = {first}, 0 | Upper corner = {last}, 1
Grid conditions/right/Side = right | Constraint = absorbing
Grid conditions/right/Incident velocity = -0.01; 0
{region}
Time/Integrator = Newmark | End time = 0.02 | Steps = 8
Output/Write = end
""")
for first, last, cells in ((0, 0.6, 4), (0.2, 1.7, 5), (0, 0.9, 3), (-0.3, 0.4, 7)):
    found = []
    for region in ("", f"set Lower corner = {last}, 0\n"
                       f"    set Upper corner = {last}, 1"):
        scene = folder / "scene.prm"
        scene.write_text(SCENE.format(first=first, last=last, cells=cells,
                                      region=region))
        found.append([row["reaction_x of right"] for row in run(scene).history()])
    at_least(f"{first} to {last}: reaction", max(map(abs, found[0])), 0.1)
    bound(f"{first} to {last}: with the region less without",
          max(abs(a - b) for a, b in zip(*found)), 1e-12)
