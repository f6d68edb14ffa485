# debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A cut block of elements of degree 2 that is sheared until cells fold where they have
no material: what lies there of a boundary does not count, forces balance, and the
block stays at its plates. One step that is computed wrong is not cut into others."""

scene = folder / "scene.prm"
scene.write_text("""
set Dimension = 3
subsection Mesh
  set Lower corner = -0.3, -0.3, -0.3
  set Upper corner = 2.7, 2.7, 2.7
  set Cell size    = 0.5
end
subsection Method
  set Method = finite element
  set Strain = finite
  set Degree = 2
end
subsection Materials
  subsection gel
    set Model         = neo-Hookean
    set Young modulus = 100
    set Poisson ratio = 0.3
  end
end
subsection Bodies
  subsection block
    set Lower corner = 0, 0, 0
    set Upper corner = 2, 1, 1
  end
end
subsection Boundaries
  subsection top
    set Body        = block
    set Part        = top
    set Translation = 0.4*t; 0; 0
  end
  subsection bottom
    set Body = block
    set Part = bottom
  end
  subsection front
    set Body       = block
    set Part       = front
    set Constraint = roller
  end
  subsection back
    set Body       = block
    set Part       = back
    set Constraint = roller
  end
end
subsection Output
  set Points = false
  set Mesh   = false
end
subsection Time
  set End time      = 0.7
  set Steps         = 7
  set Smallest step = 0.9
end
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
