# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A region with the corners of a side of the mesh is that side, also where they are
no numbers of base two: none of its dashpots is lost to round-off."""

SCENE = """
subsection Mesh
  set Lower corner = {first}, 0
  set Upper corner = {last}, 1
  set Cells = {cells}, 10
end
subsection Method
  set Method = finite element
end
subsection Materials
  subsection rock
    set Young modulus = 1000
    set Poisson ratio = 0.3
    set Density = 1
  end
end
subsection Bodies
  subsection block
    set Lower corner = {first}, 0
    set Upper corner = {last}, 1
  end
end
subsection Grid conditions
  subsection right
    set Side = right
    set Constraint = absorbing
    set Incident velocity = -0.01; 0
    {region}
  end
end
subsection Time
  set Integrator = Newmark
  set End time = 0.02
  set Steps = 8
end
subsection Output
  set Write = end
end
"""
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
