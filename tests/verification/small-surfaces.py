# ranks: 2
# debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Curved surfaces in 3D that are small against a cell: tractions have the force of
their area wherever the surface is, the pressure in a narrow hole that of its
projection; what is far too small is refused."""

from math import pi

CUBE = prm("""
Dimension = 3
Mesh/Lower corner = -1.5, -1.5, -1.5 | Upper corner = 1.5, 1.5, 1.5 | Cell size = 0.5
Materials/soil/Young modulus = 8000 | Poisson ratio = 0.35
Bodies/soil/Lower corner = -1.5, -1.5, -1.5 | Upper corner = 1.5, 1.5, 1.5
Grid conditions/base/Side = bottom
Loads/drag/Type = surface traction
{surface}
Loads/drag/Value = 1; 0; 0
""")
# A quarter of a cylindrical hole along two planes of symmetry.
HOLE = prm("""
Dimension = 3
Mesh/Lower corner = 0, 0, 0 | Upper corner = 2, 2, 1 | Cell size = 0.5
Materials/soil/Young modulus = 8000 | Poisson ratio = 0.35
Bodies/block/Lower corner = 0, 0, 0 | Upper corner = 2, 2, 1
Bodies/bore/Shape = cylinder | Axis start = 0, 0, -1 | Axis end = 0, 0, 2
Bodies/bore/Radius = {radius}
Bodies/soil/Shape = difference | Operands = block, bore | Material = soil
Grid conditions/left/Side = left | Components = x
Grid conditions/front/Side = front | Components = y
Grid conditions/bottom/Side = bottom | Components = z
Loads/water/Type = surface traction | Body = soil | Part = bore/side
Loads/water/Value = 100 * x / {radius}; 100 * y / {radius}; 0
""")
CYLINDER = ("set Surface = cylinder\n set Axis start = {0}\n"
            " set Axis end = {1}\n set Radius = {2}\n set Body side = outside")
SPHERE = ("set Surface = sphere\n set Centre = {0}\n set Radius = {1}\n"
          " set Body side = outside")
SQUARES = ("set Surface = expression\n set Expression = "
           "(x - 0.13)^2 + (y - 0.21)^2 + (z + 0.09)^2 - {0}^2")


def reactions(text_of_scene, expect=0):
    scene = folder / "scene.prm"
    scene.write_text(text_of_scene)
    return run(scene, QUIET, expect=expect)


def drag(name, surface, area):
    row = reactions(CUBE.format(surface=surface)).history()[-1]
    bound(f"{name}: force over area - 1", -row["reaction_x of base"] / area - 1,
          0.01)


for radius in (0.1, 0.55):
    drag(f"cylinder on a mesh line, radius {radius}",
         CYLINDER.format("0, 0, -1.1", "0, 0, 1.2", radius),
         2 * pi * radius * 2.3)
    drag(f"cylinder across the mesh, radius {radius}",
         CYLINDER.format("-0.6, 0.3, -0.4", "0.6, -0.6, 0.4", radius),
         2 * pi * radius * 1.7)
    drag(f"sphere, radius {radius}", SPHERE.format("0, 0, 0", radius),
         4 * pi * radius**2)
    drag(f"expression, radius {radius}", SQUARES.format(radius),
         4 * pi * radius**2)
for radius in (0.2, 0.55):
    row = reactions(HOLE.format(radius=radius)).history()[-1]
    for d, side in (("x", "left"), ("y", "front")):
        bound(f"pressure in a hole of radius {radius}: reaction {d} over "
              "projected area - 1",
              -row[f"reaction_{d} of {side}"] / (100 * radius) - 1, 0.01)
refused = reactions(CUBE.format(surface=SPHERE.format("0.1, 0.2, 0.15", 0.01)), 2)
text("sphere of a fiftieth of a cell", plain(refused.output).split("\n")[-2])
