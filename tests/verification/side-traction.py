# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A block narrower than the mesh, pressed by a traction on a side of the mesh:
its free edges lie on lines of the mesh and bulge into cells where nothing was.
The supports must carry the traction times the block's width, no cell more."""

SCENE = prm("""
Dimension = {dim}
Mesh/Lower corner = {lower} | Upper corner = {end} | Cell size = 0.25
Method/Method = {method} | Strain = {strain}
Materials/clay/Young modulus = 1e4 | Poisson ratio = 0.3
Bodies/block/Lower corner = {lower} | Upper corner = {upper}
Grid conditions/
{rollers}
Loads/press/Type = side traction | Side = top | Value = {value}*t
Time/Steps = 3
""")
ROLLER = prm("""
{side}/Side = {side} | Components = {component}
""")


def press(dim, method, strain, pressure, width=1):
    scene = folder / "scene.prm"
    sides = (("left", "x"), ("front", "y"))[:dim - 1] + (("bottom", "xyz"[dim - 1]),)
    scene.write_text(SCENE.format(
        dim=dim, method=method, strain=strain,
        lower=", ".join("0" * dim), end="2, " * (dim - 1) + "2",
        upper=f"{width}, " * (dim - 1) + "2",
        rollers="".join(ROLLER.format(side=s, component=c) for s, c in sides),
        value="0; " * (dim - 1) + f"-{pressure}"))
    return run(scene)


for dim, method, strain in ((2, "GIMP", "small"), (2, "CPDI1", "finite"),
                            (2, "CPDI2", "finite"), (2, "material point", "small"),
                            (3, "GIMP", "small")):
    for pressure in (1, 100):
        result = press(dim, method, strain, pressure)
        last = result.history()[-1]
        up = "y" if dim == 2 else "z"
        bound(f"{dim}D, {method}, pressed by {pressure}: reaction over load - 1",
              abs(last[f"reaction_{up} of bottom"] / pressure - 1), 1e-9)

# The edge of the block cuts a face of a cell.
for method, strain in (("GIMP", "small"), ("CPDI1", "finite"),
                       ("finite element", "finite")):
    last = press(2, method, strain, 1, width=1.1).history()[-1]
    bound(f"1.1 wide, {method}: reaction over load - 1",
          abs(last["reaction_y of bottom"] / 1.1 - 1), 1e-2)
