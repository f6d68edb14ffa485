# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Scenes in map coordinates: what lies on faces of cells is found as it is at the origin."""

BLOCK = prm("""
Constants/x = 0 | y = 0
Materials/block/Young modulus = 1000 | Poisson ratio = 0.3
Output/Write = end
""")

stretch = scene_file("stretch.prm", BLOCK, """
Mesh/Lower corner = $x, $y | Upper corner = $x + 10.3, $y + 10.3 | Cells = 10, 10
Method/Method = GIMP | Strain = finite
Bodies/block/Lower corner = $x, $y | Upper corner = $x + 10.3, $y + 10.3
Grid conditions/left/Side = left | Components = x
Grid conditions/bottom/Side = bottom | Components = y
Grid conditions/right/Side = right | Components = x | Displacement = 0.5*t; 0
Mesh motion/Stretch between = left, right
Time/End time = 4 | Steps = 8
""")
forces = [run(stretch, {"Constants/x": x, "Constants/y": y}
              ).history()[-1]["reaction_x of right"]
          for x, y in ((0, 0), (17000.1, 0), (530000.1, 5800000.3))]
at_least("mesh that stretches: force", forces[0], 1000)
bound("  elsewhere it differs by", max(abs(force / forces[0] - 1)
                                       for force in forces), 1e-6)

turns = scene_file("turns.prm", BLOCK, """
Mesh/Lower corner = $x, $y | Upper corner = $x + 3, $y + 3 | Cell size = 0.5
Method/Method = finite element
Bodies/block/Lower corner = $x, $y | Upper corner = $x + 2, $y + 2
Grid conditions/corner/Lower corner = $x, $y | Upper corner = $x + 0.1, $y + 0.1
Loads/push/Type = point force | Location = $x + 2, $y + 2 | Value = -t; 0
""")
for x, y in ((0, 0), (1e3, 1e3), (1e5, 1e5), (5e5, 4.6e6), (1e7, 1e7)):
    refused = run(turns, {"Constants/x": x, "Constants/y": y}, expect=2)
    text(f"held at a corner, at ({x:g}, {y:g})",
         "free to rotate" if "is free to rotate" in refused.output
         else refused.output)

FAR = ((450000.3, 5300000.7), (3500123.1, 5812345.9))

on_faces = scene_file("on-faces.prm", BLOCK, """
Mesh/Lower corner = $x, $y | Upper corner = $x + 6, $y + 4.2 | Cells = 20, 14
Method/Method = finite element | Strain = small
Bodies/block/Lower corner = $x + 0.3, $y + 0.3 | Upper corner = $x + 5.7, $y + 3.3
Boundaries/base/Body = block | Part = bottom
Boundaries/left/Body = block | Part = left | Constraint = roller
Loads/push/Type = surface traction | Body = block | Part = right | Value = -2; 1
Loads/push/Curve = t
Loads/press/Type = surface traction | Body = block | Part = top | Value = 0; -5
Loads/press/Curve = t
Time/Steps = 4
Probes/corner/Location = $x + 5.7, $y + 3.3 | Kind = interpolated
Probes/node/Location = $x + 3, $y + 1.5
""")


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

held = scene_file("held.prm", BLOCK, """
Mesh/Lower corner = $x, $y | Upper corner = $x + 3.3, $y + 1.5 | Cells = 11, 5
Method/Method = finite element
Bodies/block/Lower corner = $x, $y | Upper corner = $x + 3.3, $y + 1.5
Grid conditions/foot/Lower corner = $x + 1.2, $y | Upper corner = $x + 2.1, $y
Loads/weight/Type = surface traction | Body = block | Part = top | Value = 1; -1
Probes/top/Location = $x + 3.3, $y + 1.5 | Kind = interpolated
""")
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
