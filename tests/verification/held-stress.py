# ranks: 2  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A boundary that cuts cells begins with the stress beside it: ground at rest on it
stays at rest, and one that takes over from nodes holds what they held."""


HEIGHT, WEIGHT = 2, 20
SCENE = prm("""
Mesh/Lower corner = 0, -0.5 | Upper corner = 4, 3 | Cell size = 0.25
Materials/soil/Young modulus = 1e4 | Poisson ratio = 0.3 | Density = 2
Bodies/ground/Lower corner = 0, {bottom} | Upper corner = 4, {top}
Bodies/ground/Initial stress = {stress}
Grid conditions/left/Side = left | Components = x
Grid conditions/right/Side = right | Components = x
Grid conditions/
{nodes}
Boundaries/base/Body = ground | Part = bottom
Loads/weight/Type = gravity | Value = 0; -10
Output/Points = false | Mesh = false
Probes/low/Location = 2.05, {low} | Quantities = stress, displacement, position
Probes/surface/Location = 2.05, {surface} | Quantities = displacement, position
/
{end}
""")
scene = folder / "ground.prm"


def write(bottom, low, stress="geostatic", nodes="", end=""):
    scene.write_text(SCENE.format(
        bottom=bottom, top=bottom + HEIGHT, stress=stress, nodes=nodes, end=end,
        low=bottom + low, surface=bottom + HEIGHT - 0.02))


settlement = (1 + 0.3) * (1 - 0.6) / (1 - 0.3) / 1e4 * WEIGHT * HEIGHT**2 / 2
for bottom, rest in ((0.1, 1e-12), (0.2, 1e-2)):
    write(bottom, 0.02)
    for method in ("material point", "GIMP", "finite element"):
        for how in ("skew Nitsche", "symmetric Nitsche", "augmented Lagrangian"):
            result = run(scene, {"Method/Method": method,
                                 "Boundaries/base/Enforcement": how})
            last = result.history()[-1]
            name = f"base at {bottom}, {method}, {how}"
            bound(f"{name}: stress of the lowest point over the exact one - 1",
                  last["sigma_yy at low"] /
                  (WEIGHT * (last["y at low"] - bottom - HEIGHT)) - 1, rest)
            bound(f"{name}: surface, over the settlement by gravity",
                  last["u_y at surface"] / settlement, rest)
            bound(f"{name}: reaction over the weight - 1",
                  last["reaction_y of base"] / (4 * WEIGHT * HEIGHT) - 1, 1e-9)

# Nodes of a side hold at first, then the surface in the same place.
write(-0.5, 0.06, "", "subsection nodes\n set Side = bottom\n end", prm("""
Stages/nodes/Boundaries = none
Stages/nodes/Time/End time = 1
Stages/surface/Boundaries = base | Grid conditions = left, right
Stages/surface/Time/End time = 2 | Steps = 2
"""))
for method in ("material point", "finite element"):
    rows = run(scene, {"Method/Method": method}).history()
    for name in ("sigma_yy at low", "u_y at surface"):
        bound(f"swap, {method}: {name}, over that before - 1",
              rows[-1][name] / rows[0][name] - 1, 0.01)

# Ground beside a rough wall at 15 degrees, at finite strain: pieces of the wall begin
# with how the stress varies along them, too. Without that 0.24 % is out of balance.
wall = scene_file("wall.prm", """
Mesh/Lower corner = -1, -0.6 | Upper corner = 4, 3.4 | Cell size = 0.25
Method/Method = GIMP | Strain = finite
Materials/soil/Young modulus = 1e4 | Poisson ratio = 0.3 | Density = 2
Bodies/ground/Shape = polygon | Vertices = 0 -0.1; 4 -0.1; 4 2.4; -0.67 2.4
Bodies/ground/Initial stress = geostatic | K0 = 0.5
Boundaries/wall/Body = ground | Part = 4
Boundaries/base/Body = ground | Part = 1 | Constraint = roller
Grid conditions/right/Side = right | Components = x
Loads/weight/Type = gravity | Value = 0; -10
Time/Steps = 2
""")
found = run(wall, {"Output/Write": "end"})
bound("ground beside an oblique wall: % out of balance",
      100 * found.finding("initial-imbalance")["value"], 0.1)
