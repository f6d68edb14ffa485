# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Walls that move differently and meet in a cell: what they push, against elements
fitted to them. Those whose motions a cell can follow keep all they hold."""

from math import cos, radians, sin

SCENE = prm("""
Mesh/Lower corner = {mesh_low} | Upper corner = {mesh_high} | Cell size = {h}
Method/Method = {method}
Materials/clay/Model = {model} | Young modulus = 20000 | Poisson ratio = 0.49
Materials/clay/Density = 1.8
{more}
Bodies/soil/Lower corner = {low} | Upper corner = {high} | Initial stress = geostatic
Bodies/soil/K0 = 1
Boundaries/
{boundaries}
Grid conditions/
{conditions}
Loads/g/Type = gravity | Value = 0; -10
Time/Steps = 5
Output/Write = end
""")
YIELDS = {"model": "von Mises", "more": "set Shear yield stress = 12"}
ELASTIC = {"model": "linear elastic", "more": ""}


def section(name, **keys):
    lines = "".join(f"    set {key.replace('_', ' ')} = {value}\n"
                    for key, value in keys.items())
    return f"  subsection {name}\n{lines}  end\n"


SIDES = (section("l", Side="left", Components="x") +
         section("r", Side="right", Components="x"))


def column(name, wanted, n=1, **parts):
    path = folder / f"{name.replace(' ', '-')}.prm"
    path.write_text(SCENE.format(**parts))
    result = run(path, on_ranks=n)
    row = result.history()[-1]
    met = [one for one in result.ids() if one == "conflicting-constraints"]
    text(f"{name}: notes of meeting walls", len(met))
    return row[wanted]


def trapdoor(name, y, h, door, floor, **others):
    return column(name, "reaction_y of trap", mesh_low="0, -1",
                  mesh_high="6, 5", h=h, method="GIMP", low=f"0, {y}",
                  high=f"6, {y + 2.4}", conditions=SIDES,
                  boundaries=section("trap", Points=f"0 {y}; 1.2 {y}",
                                     Constraint="roller", **door) +
                  section("floor", Points=f"1.2 {y}; 6 {y}", Constraint="roller",
                          **floor), **others)


# Elements end conditions at nodes, and stretch one cell beside each.
def fitted(name, last):
    box = {"Side": "bottom", "Components": "y"}
    return column(name, "reaction_y of trap", mesh_low="0, 0",
                  mesh_high="6, 2.4", h=0.2, method="finite element", low="0, 0",
                  high="6, 2.4", boundaries="",
                  conditions=SIDES +
                  section("trap", **box, Lower_corner="-1, -1",
                          Upper_corner=f"{last}, 1", Translation="0; -0.02*t") +
                  section("floor", **box, Lower_corner=f"{last}, -1",
                          Upper_corner="7, 1"), **YIELDS)


down = {"Translation": "0; -0.02*t"}
exact = (fitted("elements up to 1.1", 1.15) + fitted("elements up to 1.3", 1.25)) / 2
for y, h, n in ((0.1, 0.5, 2), (0.1, 0.25, 1), (0, 0.5, 1)):
    name = f"trapdoor at y = {y}, h = {h}"
    bound(f"{name}, over that of elements - 1",
          trapdoor(name, y, h, down, {}, n=n, **YIELDS) / exact - 1, 0.1)

together = trapdoor("both together", 0.1, 0.5, down, down, **YIELDS)
bound("both together, over the weight - 1", together / (1.2 * 2.4 * 18) - 1, 1e-3)

for name, base, conditions, y in (
        ("base a surface", section("base", Body="soil", Part="bottom"), "", -3.9),
        ("base of the mesh", "", section("base", Side="bottom"), -4)):
    push = section("wall", Body="soil", Part="left", Constraint="roller",
                   Translation="0.05*t; 0")
    far = section("far", Body="soil", Part="right", Constraint="roller")
    force = column(f"wall and {name}", "reaction_x of wall",
                   mesh_low="0, -4" if conditions else "0, -5", mesh_high="12, 1",
                   h=0.5, method="GIMP", low=f"1.1, {y}", high="10.6, 0",
                   boundaries=push + base + far, conditions=conditions,
                   n=2 if conditions else 1, **YIELDS)
    # Rankine's; a rough base adds some per cent.
    rankine = 18 * y**2 / 2 - 2 * 12 * y
    bound(f"wall and {name}, over the force on a smooth base - 1",
          force / rankine - 1, 0.15)

# The toe stays where the wall meets the base: nothing lets go.
turn = section("wall", Body="soil", Part="left", Constraint="roller",
               Rotation_angle="-0.05*t", Rotation_centre="1.1, -3.9")
column("wall that turns about its toe", "reaction_x of wall",
       mesh_low="0, -5", mesh_high="12, 1", h=0.5, method="GIMP", low="1.1, -3.9",
       high="10.6, 0", conditions="",
       boundaries=turn + section("base", Body="soil", Part="bottom") +
       section("far", Body="soil", Part="right", Constraint="roller"), **ELASTIC)

# A door narrower than a cell has nothing to hold.
result = run(folder / "trapdoor-at-y-=-0.1,-h-=-0.5.prm",
             {"Boundaries/trap/Points": "0.1 0.1; 0.4 0.1",
              "Boundaries/floor/Points": "0.4 0.1; 6 0.1"}, expect=2)
text("a door narrower than a cell", plain(result.output.strip()))

# A wall pushed over a rough base by 1.6 cells into clay that yields, on the
# lines of its mesh and turned with all that acts. Slopes of pieces that wall and
# base both cut would let the force creep up.
path = folder / "pushed.prm"
path.write_text(SCENE.format(
    mesh_low="-2, -1", mesh_high="6, 5", h=0.25, method="GIMP", low="0, 0",
    high="4, 2.5", conditions="",
    boundaries=section("base", Body="soil", Part="bottom") +
    section("wall", Body="soil", Part="left"), **YIELDS))


def pushed(method, angle):
    """Forces along the way of the wall."""
    c, s = cos(radians(angle)), sin(radians(angle))
    down = radians(angle - 15)
    rows = run(path, {"Method/Method": method, "Method/Strain": "finite",
                      "Materials/clay/Young modulus": 2000,
                      "Materials/clay/Poisson ratio": 0.3,
                      "Bodies/soil/Initial stress": "", "Bodies/soil/K0": "",
                      "Bodies/soil/Rotation angle": angle,
                      "Boundaries/wall/Translation": f"{0.4 * c}*t; {0.4 * s}*t",
                      "Loads/g/Value": f"{10 * sin(down)}; {-10 * cos(down)}",
                      "Time/Steps": 40}).history()
    return [c * row["reaction_x of wall"] + s * row["reaction_y of wall"]
            for row in rows]


for method in ("CPDI1", "GIMP"):
    turned, aligned = (pushed(method, angle) for angle in (15, 0))
    name = f"wall pushed over a base, turned, {method}: force over aligned - 1"
    bound(name, max(abs(a / b - 1) for a, b in zip(turned[9:], aligned[9:])), 0.08)
    bound(f"{name}, at the end", turned[-1] / aligned[-1] - 1, 0.05)
