# debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""What the cells of a scene are too coarse for is told before it runs: bodies drawn
apart that stick together, a soft layer in cells that a stiff one shares, thin bodies
of any stage, a surface that ends inside cells; and one that begins away from ground
that has settled."""

SCENE = prm("""
Mesh/Lower corner = -1, 0 | Upper corner = 4, 4 | Cell size = 0.25
Method/Method = GIMP
Materials/firm/Young modulus = 1e5 | Poisson ratio = 0.3 | Density = 2
Materials/soft/Young modulus = 1e3 | Poisson ratio = 0.3 | Density = 2
Bodies/
{bodies}
Grid conditions/base/Side = bottom
Loads/weight/Type = gravity | Value = 0; -10
Output/Points = false | Mesh = false
/
{more}
""")
BODY = prm("""
{name}/Material = {material} | Lower corner = {lower} | Upper corner = {upper}
""")
scene = folder / "scene.prm"


def show(title, bodies, more="", command="check"):
    scene.write_text(SCENE.format(more=more, bodies="".join(
        BODY.format(name=name, material=material, lower=lower, upper=upper)
        for name, material, lower, upper in bodies)))
    result = run(scene, command=command)
    text(title, result.found() or "nothing")


def columns(gap):
    return [("left", "firm", "0, 0", "1.1, 2.1"),
            ("right", "firm", f"{1.1 + gap}, 0", f"{2.1 + gap}, 2.1")]


for gap in (0, 0.05, 0.3, 0.55):
    show(f"columns {gap} apart", columns(gap))


EXPRESSION = prm("""
{name}/Material = firm | Shape = expression | Expression = {expression}
""")


def show_drawn(title, bodies):
    scene.write_text(SCENE.format(more="", bodies="".join(
        EXPRESSION.format(name=name, expression=expression)
        for name, expression in bodies)))
    text(title, run(scene, command="check").found() or "nothing")


# Whatever number an expression is multiplied with, and where it is no distance.
for gap in (0, 0.3):
    for name, upper in (("over 1000", "1e-3*min(3.5 - y, y - {y})"),
                        ("times 1000", "1e3*min(3.5 - y, y - {y})"),
                        ("product", "(3.5 - y)*(y - {y})")):
        show_drawn(f"layers {gap} apart, {name}",
                   [("below", "1.1 - y"), ("above", upper.format(y=1.1 + gap))])


def layers(top_of_seam):
    return [("below", "firm", "0, 0", "3, 1"),
            ("seam", "soft", "0, 1", f"3, {top_of_seam}"),
            ("above", "firm", f"0, {top_of_seam}", "3, 3.5")]


for top in (2, 1.9, 1.9995, 2.35):
    show(f"seam up to {top}", layers(top))

FLOOR = prm("""
Boundaries/floor/Points = -1, 1.3; 4, 1.3
""")
for bottom in (1.3, 1.45):
    show(f"block from {bottom} above a floor at 1.3",
         [("block", "firm", f"0, {bottom}", "2, 3")], FLOOR)

# On a face of cells, inside of one, with a side that goes on in the air, and walls
# that end with the body.
SURFACE = prm("""
{name}/Points = {points}
""")
for title, bottom, surfaces in (
        ("footing to 0.75", 0, [("footing", "0.75, 3; 0, 3")]),
        ("footing to 0.85", 0, [("footing", "0.85, 3; 0, 3")]),
        ("footing to 1.1 with a side", 0, [("footing", "1.1, 3; 0, 3"),
                                             ("side", "1.1, 3.9; 1.1, 3")]),
        ("footing to 1.1 and one beside it", 0, [("footing", "1.1, 3; 0, 3"),
                                                 ("beside", "2.1, 3; 1.1, 3")]),
        ("floor and walls", 0.1, [("floor", "0, 0.1; 2.1, 0.1"),
                                  ("left", "0, 3; 0, 0.1"),
                                  ("right", "2.1, 0.1; 2.1, 3")]),
        ("upper part of a wall", 0.1, [("wall", "2.1, 0.8; 2.1, 3")])):
    show(title, [("block", "firm", f"0, {bottom}", "2.1, 3")],
         "subsection Boundaries\n  " + "".join(
             SURFACE.format(name=name, points=points) for name, points in surfaces)
         + "end\n")

# Of the rim of a body nothing is past the ends, also where points are those of cells
# of degree 2.
scene.write_text(prm("""
Mesh/Lower corner = -6, -6 | Upper corner = 6, 6 | Cell size = 1
Method/Method = finite element
Materials/rock/Young modulus = 1000 | Poisson ratio = 0.3
Bodies/block/Shape = box | Lower corner = 0, 0 | Upper corner = 3, 4
Bodies/block/Rotation angle = 30 | Translation = 0.013, 0.027
Boundaries/base/Body = block | Part = bottom
"""))
for degree in (1, 2):
    result = run(scene, {"Method/Degree": degree}, command="check")
    text(f"base of a turned block, degree {degree}: notes",
         len(result.found()))

# A body as thick as the mesh and one cell, that bends, or cannot, or is thicker.
SIDE = prm("""
{side}/Side = {side} | Components = {components}
""")
for title, size, held in (
        ("beam one cell thick", 1, [("left", "x, y")]),
        ("layer one cell thick", 1, [("bottom", "x, y")]),
        ("column one cell wide", 1, [("left", "x, y"), ("bottom", "y"), ("top", "y")]),
        ("beam two cells thick", 0.5, [("left", "x, y")])):
    scene.write_text(SCENE.format(bodies=BODY.format(
        name="block", material="firm", lower="0, 0", upper="6, 1"), more="").replace(
            "-1, 0\nset Upper corner = 4, 4\nset Cell size = 0.25",
            f"0, 0\nset Upper corner = 6, 1\nset Cell size = {size}").replace(
                "subsection base\nset Side = bottom\nend\n", "".join(
                    SIDE.format(side=side, components=components)
                    for side, components in held)))
    text(title + ": told", "thin-body" in run(scene, command="check").ids())

# Two cells thick across, wherever the mesh cuts; one cell thick across one way.
for title, begin, top in (("bar two cells thick, on mesh lines", 0, 1),
                          ("bar two cells thick, by halves", -0.25, 1),
                          ("bar two cells thick, by 0.6 and 0.4", -0.3, 1),
                          ("plate one cell thick, by halves", -0.25, 0.5)):
    scene.write_text(prm(f"""
Dimension = 3
Mesh/Lower corner = {begin}, {begin}, {begin}
Mesh/Upper corner = {begin + 3}, {begin + 3}, {begin + 3} | Cell size = 0.5
Materials/firm/Young modulus = 1e5 | Poisson ratio = 0.3
Bodies/bar/Lower corner = 0, 0, 0 | Upper corner = 2, 1, {top}
Boundaries/end/Body = bar | Part = left
"""))
    text(title + ": told", "thin-body" in run(scene, command="check").ids())

# One that hangs on thick ground does not bend by itself.
scene.write_text(SCENE.format(bodies="".join(
    BODY.format(name=name, material="firm", lower=f"-1, {y}", upper=f"4, {top}")
    for name, y, top in (("ground", 0, 3), ("fill", 3, 4))), more="").replace(
        "set Cell size = 0.25", "set Cell size = 1"))
text("fill one cell thick on ground: told",
     "thin-body" in run(scene, command="check").ids())

# Loads that are some where and not elsewhere, by an expression.
for title, load in (
        ("narrow strip", "set Type = side traction\n set Side = top\n "
         "set Value = 0; x > 1.31 && x < 1.36 ? -10 : 0"),
        ("strip to 1.1", "set Type = side traction\n set Side = top\n "
         "set Value = 0; x < 1.1 ? -10 : 0"),
        ("layer from 3.8", "set Type = body force\n set Value = 0; y > 3.8 ? -10 : 0"),
        ("layer from 3.5", "set Type = body force\n set Value = 0; y > 3.5 ? -10 : 0"),
        ("growing with depth", "set Type = body force\n set Value = 0; y^2 - 16")):
    show(title, [("block", "firm", "0, 0", "2, 4")],
         f"subsection Loads\n  subsection p\n {load}\n  end\nend\n")

STAGES = prm("""
Stages/ground/Bodies = below
Stages/strut/Bodies = below, strut
Stages/strut/Time/End time = 2
""")
show("strut of a later stage", [("below", "soft", "0, 0", "3, 2"),
                                ("strut", "firm", "1, 2", "1.3, 3.5")], STAGES,
     command="run")

PLATE = prm("""
Boundaries/plate/Points = 3 2; 0 2 | Constraint = roller
Boundaries/plate/Displacement = 0; -0.001*(t-1)
Stages/weight/Boundaries = none
Stages/weight/Time/End time = 1
Stages/plate/Boundaries = plate
Stages/plate/Time/End time = 2
""")
for material in ("firm", "soft"):
    show(f"plate on settled ground, {material}",
         [("ground", material, "0, 0", "3, 2")], PLATE, command="run")
