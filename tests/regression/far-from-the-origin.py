# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Scenes in map coordinates: what lies on faces of cells is found as it is at the origin."""

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

FAR = ((450000.3, 5300000.7), (3500123.1, 5812345.9))

ON_FACES = BLOCK + """
subsection Mesh
  set Lower corner = $x, $y
  set Upper corner = $x + 6, $y + 4.2
  set Cells        = 20, 14
end
subsection Method
  set Method = finite element
  set Strain = small
end
subsection Bodies
  subsection block
    set Lower corner = $x + 0.3, $y + 0.3
    set Upper corner = $x + 5.7, $y + 3.3
  end
end
subsection Boundaries
  subsection base
    set Body = block
    set Part = bottom
  end
  subsection left
    set Body       = block
    set Part       = left
    set Constraint = roller
  end
end
subsection Loads
  subsection push
    set Type  = surface traction
    set Body  = block
    set Part  = right
    set Value = -2; 1
    set Curve = t
  end
  subsection press
    set Type  = surface traction
    set Body  = block
    set Part  = top
    set Value = 0; -5
    set Curve = t
  end
end
subsection Time
  set Steps = 4
end
subsection Probes
  subsection corner
    set Location = $x + 5.7, $y + 3.3
    set Kind     = interpolated
  end
  subsection node
    set Location = $x + 3, $y + 1.5
  end
end
"""
on_faces = folder / "on-faces.prm"
on_faces.write_text(ON_FACES)


def answers(x, y):
    # Stiff, so that nodes move less than they are rounded.
    row = run(on_faces, {"Constants/x": x, "Constants/y": y,
                         "Materials/block/Young modulus": 1e6}).history()[-1]
    return [row[name] for name in
            ("reaction_x of base", "reaction_y of base", "reaction_x of left",
             "u_x at corner", "u_y at corner", "u_y at node")]


at_origin = answers(0, 0)
number("boundaries: force of both", at_origin[0] + at_origin[2], 6)
for x, y in FAR:
    bound(f"  at ({x:.0f}, {y:.0f}) forces and displacements differ by",
          max(abs(far / near - 1)
              for far, near in zip(answers(x, y), at_origin)), 1e-4)

HELD = BLOCK + """
subsection Mesh
  set Lower corner = $x, $y
  set Upper corner = $x + 3.3, $y + 1.5
  set Cells        = 11, 5
end
subsection Method
  set Method = finite element
end
subsection Bodies
  subsection block
    set Lower corner = $x, $y
    set Upper corner = $x + 3.3, $y + 1.5
  end
end
subsection Grid conditions
  subsection foot
    set Lower corner = $x + 1.2, $y
    set Upper corner = $x + 2.1, $y
  end
end
subsection Loads
  subsection weight
    set Type  = surface traction
    set Body  = block
    set Part  = top
    set Value = 1; -1
  end
end
subsection Probes
  subsection top
    set Location = $x + 3.3, $y + 1.5
    set Kind     = interpolated
  end
end
"""
held = folder / "held.prm"
held.write_text(HELD)
moved = [run(held, {"Constants/x": x, "Constants/y": y}
             ).history()[-1]["u_y at top"] for x, y in ((0, 0), *FAR)]
bound("box that holds nodes: displacements elsewhere differ by",
      max(abs(u / moved[0] - 1) for u in moved), 1e-5)

small = run(held, {"Constants/x": FAR[1][0], "Constants/y": FAR[1][1],
                   "Mesh/Cells": "55, 25"})
number("  small cells: force", small.reactions["foot"][1], 6)

# Files for ParaView.
places = run(held, {"Constants/x": FAR[0][0], "Constants/y": FAR[0][1]}
             ).points("position")
text("points that stand on places of their own",
     f"{len(set(places))} of {len(places)}")
for degree in (1, 2):
    near, far = (
        {tuple(round(a - b, 5) for a, b in zip(place, (x, y, 0)))
         for place, in run(held, {"Constants/x": x, "Constants/y": y,
                                  "Method/Degree": degree}).nodes("position")}
        for x, y in ((0, 0), FAR[0]))
    text(f"degree {degree}: {len(far)} nodes, places as at the origin",
         near == far)
