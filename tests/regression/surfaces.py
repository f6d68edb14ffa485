# ranks: 2  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""What is told of where surfaces lie: that one goes on beyond its body, where that
matters; that it begins inside a body; that what it lies on is gone. Nothing of
surfaces along the rim of their body, round or not."""

SCENE = prm("""
Mesh/Lower corner = {lower} | Upper corner = {upper} | Cell size = {h}
Materials/ground/Young modulus = 1e5 | Poisson ratio = 0.25 | Density = 2
/
{more}
Output/Points = false | Mesh = false
""")
scene = folder / "scene.prm"


def show(title, settings=None, command="check"):
    result = run(scene, settings, command=command)
    notes = [one for one in result.found() if not one.startswith("thin-body")]
    for note in notes:
        text(title, note)
    if not notes:
        text(title, "nothing")
    return result


def write(more, lower, upper, h):
    scene.write_text(SCENE.format(more=more, lower=lower, upper=upper, h=h))


RING = prm("""
Bodies/ring/Shape = ring | Centre = 1.3, -1 | Radius = 30 | Inner radius = 12
Boundaries/bore/Body = ring | Part = {part}
{more}
""")
for h, part, enforcement in (
        (8, "inner", "augmented Lagrangian"), (4, "inner", "augmented Lagrangian"),
        (8, "inner", "penalty"), (8, "inner", "skew Nitsche"),
        (8, "outer", "weighted")):
    write(RING.format(part=part, more="set Enforcement = " + enforcement),
          "-60, -60", "60, 60", h)
    show(f"{part} rim of a ring, cells of {h}, {enforcement}")
CIRCLE = {"Boundaries/bore/Surface": "circle", "Boundaries/bore/Body": "",
          "Boundaries/bore/Part": "", "Boundaries/bore/Centre": "1.3, -1",
          "Boundaries/bore/Body side": "outside"}
write(RING.format(part="", more=""), "-60, -60", "60, 60", 5)
show("circle along the rim", {**CIRCLE, "Boundaries/bore/Radius": 12})
show("circle inside the ring", {**CIRCLE, "Boundaries/bore/Radius": 20})

BLOCK = prm("""
Bodies/block/Lower corner = 0.3, 0.2 | Upper corner = 3.3, 3.2
Grid conditions/middle/Lower corner = 1, 1 | Upper corner = 2, 2
Boundaries/base/Points = 0.3 {y}; {x} {y} | Constraint = {constraint}
Boundaries/base/Enforcement = {enforcement}
""")
for x, y, constraint, enforcement in (
        (3.3, 0.2, "fixed", "augmented Lagrangian"),
        (5, 0.2, "fixed", "augmented Lagrangian"),
        (5, 0.2, "roller", "augmented Lagrangian"),
        (5, 0.2, "roller", "penalty"),
        (5, 0.2, "roller", "skew Nitsche"),
        (5, 1.5, "roller", "augmented Lagrangian")):
    write(BLOCK.format(x=x, y=y, constraint=constraint, enforcement=enforcement),
          "-2, -2", "6, 6", 0.5)
    show(f"base to ({x}, {y}), {constraint}, {enforcement}")

STAGES = prm("""
Bodies/a/Lower corner = 0, 0 | Upper corner = 3, 4.1
Bodies/b/Lower corner = 0, 4.1 | Upper corner = 3, 4.4
Grid conditions/base/Side = bottom
Loads/weight/Type = gravity | Value = 0; -10
Loads/
{loads}
/
{boundaries}
Stages/before/
{first}
Stages/before/Time/End time = 1
Stages/after/Bodies = {left}
{keep}
Stages/after/Time/End time = 2
""")
PLATE = prm("""
Boundaries/plate/Body = {body} | Part = {part} | Constraint = roller
{motion}
""")


def stages(title, left, loads="", boundaries="", first="", keep=""):
    write(STAGES.format(loads=loads, boundaries=boundaries, first=first,
                        left=left, keep=keep), "0, 0", "3, 6", 0.5)
    return show(title, command="run")


TOP = {"body": "b", "part": "top"}
for rate in (0.1, 1.5):
    stages(f"plate moved by {rate} before it begins", "a, b",
           first="set Boundaries = none", keep="set Boundaries = plate",
           boundaries=PLATE.format(
               **TOP, motion=f"set Translation = 0; -{rate}*min(t,1)"))
LOAD = prm("""
load/Type = {type} | Value = 0; -40
{where}
""")
ON_TOP = LOAD.format(type="surface traction",
                     where="set Body  = b\n    set Part  = top")
ON_POINTS = LOAD.format(type="force on points", where="set Location = 1.5, 4.4")
for left in ("a", "a, b"):
    stages(f"plate on b, {left} left", left, 
           boundaries=PLATE.format(**TOP, motion=""))
    stages(f"load on b, {left} left", left, loads=ON_TOP)
    stages(f"force on points of b, {left} left", left, loads=ON_POINTS)
stages("load on b that ends", "a", loads=ON_TOP, keep="set Loads = weight")
stages("rollers beside both", "a",
       boundaries=prm("""
Boundaries/side/Points = 0 4.4; 0 0 | Constraint = roller
"""))
