# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Square punch on a von Mises block in 3D: a plateau, which falls with the cell
size, with the mean change of volume of each cell; without, no plateau."""


def forces(method, how, h):
    room = {} if method == "finite element" else \
        {"Mesh/Upper corner": f"3, 3, {h}"}
    rows = run("prm/hard-cases/punch.prm",
               {**QUIET, **room, "Method/Method": method, "Mesh/Cell size": h,
                "Method/Volumetric strain": how}).history()
    return [-row["reaction_z of punch"] for row in rows]


for method in ("finite element", "GIMP"):
    plateau = []
    for h in (0.5, 0.25):
        force = forces(method, "cell mean", h)
        plateau.append(force[-1])
        name = f"{method}, cell mean, h = {h}"
        number(f"{name}: plateau over k", force[-1], 4)
        bound(f"{name}: rise in the last step", force[-1] / force[-2] - 1, 1e-3)
    at_least(f"{method}: fall of the plateau by halved cells",
             plateau[0] - plateau[1], 0.5)
    force = forces(method, "pointwise", 0.25)
    number(f"{method}, pointwise, h = 0.25: at the end", force[-1], 4)
    at_least(f"{method}, pointwise: rise in the last step",
             force[-1] / force[-2] - 1, 5e-2)
