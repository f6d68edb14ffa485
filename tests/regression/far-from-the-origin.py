# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Scenes in map coordinates: meshes that stretch, and bodies that nothing holds."""

BLOCK = """
subsection Constants
  set x = 0
  set y = 0
end
subsection Materials
  subsection block
    set Young modulus = 1000
    set Poisson ratio = 0.3
  end
end
subsection Output
  set Write = end
end
"""

STRETCH = BLOCK + """
subsection Mesh
  set Lower corner = $x, $y
  set Upper corner = $x + 10.3, $y + 10.3
  set Cells        = 10, 10
end
subsection Method
  set Method = GIMP
  set Strain = finite
end
subsection Bodies
  subsection block
    set Lower corner = $x, $y
    set Upper corner = $x + 10.3, $y + 10.3
  end
end
subsection Grid conditions
  subsection left
    set Side       = left
    set Components = x
  end
  subsection bottom
    set Side       = bottom
    set Components = y
  end
  subsection right
    set Side         = right
    set Components   = x
    set Displacement = 0.5*t; 0
  end
end
subsection Mesh motion
  set Stretch between = left, right
end
subsection Time
  set End time = 4
  set Steps    = 8
end
"""
stretch = folder / "stretch.prm"
stretch.write_text(STRETCH)
forces = [run(stretch, {"Constants/x": x, "Constants/y": y}
              ).history()[-1]["reaction_x of right"]
          for x, y in ((0, 0), (17000.1, 0), (530000.1, 5800000.3))]
at_least("mesh that stretches: force", forces[0], 1000)
bound("  elsewhere it differs by", max(abs(force / forces[0] - 1)
                                       for force in forces), 1e-6)

TURNS = BLOCK + """
subsection Mesh
  set Lower corner = $x, $y
  set Upper corner = $x + 3, $y + 3
  set Cell size    = 0.5
end
subsection Method
  set Method = finite element
end
subsection Bodies
  subsection block
    set Lower corner = $x, $y
    set Upper corner = $x + 2, $y + 2
  end
end
subsection Grid conditions
  subsection corner
    set Lower corner = $x, $y
    set Upper corner = $x + 0.1, $y + 0.1
  end
end
subsection Loads
  subsection push
    set Type     = point force
    set Location = $x + 2, $y + 2
    set Value    = -t; 0
  end
end
"""
turns = folder / "turns.prm"
turns.write_text(TURNS)
for x, y in ((0, 0), (1e3, 1e3), (1e5, 1e5), (5e5, 4.6e6), (1e7, 1e7)):
    refused = run(turns, {"Constants/x": x, "Constants/y": y}, expect=2)
    text(f"held at a corner, at ({x:g}, {y:g})",
         "free to rotate" if "is free to rotate" in refused.output
         else refused.output)
