# ranks: 2  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Soil at rest between walls on a base, and a hole that is widened: the force of
nodes that two grid conditions hold is shared out, whichever of them comes first."""

SOIL = prm("""
Mesh/Lower corner = {low} | Upper corner = {high} | Cells = {cells}
Method/Method = {method} | Degree = {degree}
Materials/soil/Young modulus = 1e5 | Poisson ratio = 0.25 | Density = 2
Bodies/layer/Shape = mesh
Grid conditions/
{conditions}
Loads/weight/Type = gravity | Value = {down}
""")
# At rest the walls carry K0 = nu / (1 - nu) = 1/3 of the weight above.
H, L, GAMMA, K0 = 4, 6, 20, 1 / 3


def conditions(dim, order):
    held = {"wall": ("left", "x"), "other": ("right", "x"),
            "base": ("bottom", ", ".join("xyz"[:dim])),
            "front": ("front", "y"), "back": ("back", "y")}
    return "".join(f"  subsection {name}\n    set Side = {held[name][0]}\n"
                   f"    set Components = {held[name][1]}\n  end\n" for name in order)


def forces(dim, method, degree, order):
    scene = folder / "soil.prm"
    text = SOIL.format(
        low="0, 0" if dim == 2 else "0, 0, 0",
        high=f"{L}, {H}" if dim == 2 else f"{L}, 2, {H}",
        cells="6, 4" if dim == 2 else "6, 2, 4", method=method, degree=degree,
        down="0; -10" if dim == 2 else "0; 0; -10", conditions=conditions(dim, order))
    scene.write_text(("set Dimension = 3\n" if dim == 3 else "") + text)
    return run(scene, {"Output/Points": "false", "Output/Mesh": "false"}).history()[-1]


for dim, method, degree in ((2, "finite element", 1), (2, "finite element", 2),
                            (2, "GIMP", 1), (2, "material point", 1),
                            (3, "finite element", 1), (3, "CPDI1", 1)):
    names = ["wall", "other", "base"] + (["front", "back"] if dim == 3 else [])
    for order in (names, names[::-1]):
        last = forces(dim, method, degree, order)
        width = 2 if dim == 3 else 1
        exact = {"reaction_x of wall": K0 * GAMMA * H * H / 2 * width,
                 "reaction_x of other": -K0 * GAMMA * H * H / 2 * width,
                 "reaction_x of base": 0,
                 f"reaction_{'xyz'[dim - 1]} of base": GAMMA * H * L * width}
        if dim == 3:
            exact["reaction_y of front"] = K0 * GAMMA * H * H / 2 * L
            exact["reaction_y of base"] = 0
        bound(f"{dim}D, {method} of degree {degree}, {order[0]} first: forces",
              max(abs(last[name] - value) for name, value in exact.items())
              / (GAMMA * H * H * width), {"GIMP": 0.02, "CPDI1": 0.02}.get(method, 1e-6))
