# debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A beam that lies at an angle in a mesh of distorted cells: nodes of cut cells follow
cells whose map folds before it gets there. Forces balance all the same and the beam
bends as in a mesh of equal cells, by aggregation and by a ghost term; a block between
plates, whose pieces meet at such nodes, is pressed as it should be."""

import random
from math import cos, radians, sin

random.seed(3)
NX, NY, H = 28, 24, 0.25
nodes, elements = [], []
for j in range(NY + 1):
    for i in range(NX + 1):
        place = [-0.5 + i * H, -0.5 + j * H]
        if 0 < i < NX and 0 < j < NY:
            place = [x + H * random.uniform(-0.25, 0.25) for x in place]
        nodes.append("%d %r %r 0" % (len(nodes) + 1, *place))
for j in range(NY):
    for i in range(NX):
        a = j * (NX + 1) + i + 1
        elements.append(f"{len(elements) + 1} 3 2 1 1 "
                        f"{a} {a + 1} {a + NX + 2} {a + NX + 1}")
mesh = folder / "distorted.msh"
mesh.write_text("\n".join(["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$Nodes",
                           str(len(nodes)), *nodes, "$EndNodes", "$Elements",
                           str(len(elements)), *elements, "$EndElements", ""]))
DISTORTED = {"Mesh/Type": "file", "Mesh/File": mesh}
BOX = {"Mesh/Lower corner": "-0.5, -0.5", "Mesh/Upper corner": "6.5, 5.5",
       "Mesh/Cell size": H}


def scene_of(name, words):
    scene = scene_file(f"{name}.prm", f"""
Materials/steel/Young modulus = 1e4 | Poisson ratio = 0.3
Output/Write = end | Points = false | Mesh = false
/
{words}
""")
    return scene


def beam(angle):
    c, s = cos(radians(angle)), sin(radians(angle))
    scene = scene_of(f"beam-{angle}", prm(f"""
Bodies/beam/Lower corner = 0, 0 | Upper corner = 5, 1 | Rotation angle = {angle}
Bodies/beam/Translation = 0.5, 0.2
Boundaries/left/Body = beam | Part = left
Loads/shear/Type = surface traction | Body = beam | Part = right
Loads/shear/Value = {-s!r}; {c!r}
Probes/tip/Location = {0.5 + 5 * c - 0.5 * s!r}, {0.2 + 5 * s + 0.5 * c!r}
Probes/tip/Kind = interpolated
"""))

    def reaction_and_tip(settings):
        row = run(scene, settings).history()[-1]
        along = [row[f"reaction_{axis} of left"] for axis in "xy"]
        tip = [row[f"u_{axis} at tip"] for axis in "xy"]
        return along[0] - s, along[1] + c, -s * tip[0] + c * tip[1]

    return reaction_and_tip


FINITE_ELEMENTS = {"Method/Method": "finite element"}
for name, angle, settings in (
        ("material point", 10, {"Method/Method": "material point"}),
        ("CPDI2, finite strain", 25,
         {"Method/Method": "CPDI2", "Method/Strain": "finite"}),
        ("finite element", 10, FINITE_ELEMENTS),
        ("finite element, finite strain", 25,
         {**FINITE_ELEMENTS, "Method/Strain": "finite"}),
        ("degree 2", 10, {**FINITE_ELEMENTS, "Method/Degree": 2}),
        ("ghost", 10, {"Method/Method": "CPDI2", "Method/Strain": "finite",
                       "Method/Cut cells": "ghost"})):
    solve = beam(angle)
    *miss, tip = solve({**settings, **DISTORTED})
    *_, of_box = solve({**settings, **BOX})
    bound(f"{name}: what the reaction misses", max(map(abs, miss)), 1e-6)
    bound(f"{name}: tip over that of equal cells - 1", tip / of_box - 1, 0.05)

block = scene_of("block", prm("""
Method/Method = CPDI2 | Strain = finite
Bodies/block/Lower corner = 0.3, 0.2 | Upper corner = 3.3, 0.65
Boundaries/left/Points = 0.3 1.05; 0.3 -0.2 | Constraint = roller
Boundaries/base/Points = -0.1 0.2; 3.7 0.2 | Constraint = roller
Boundaries/plate/Points = 3.7 0.65; -0.1 0.65 | Constraint = roller
Boundaries/plate/Translation = 0; -0.001*t
"""))
force = run(block, DISTORTED).history()[-1]["reaction_y of plate"]
exact = -1e4 / (1 - 0.3 ** 2) * 0.001 / 0.45 * 3
bound("force of a plate over the exact one - 1", force / exact - 1, 0.02)
