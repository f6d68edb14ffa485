# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""What the mean change of volume of each cell changes where nothing locks: next to
nothing on cells that stay full, more in bending by points that leave them."""

ELASTIC = {"Materials/clay/Model": "linear elastic",
           "Materials/clay/Shear yield stress": ""}
FE, GIMP = ({"Method/Method": name} for name in ("finite element", "GIMP"))


def change(scene, settings, result):
    point, mean = (result(run(scene, {**QUIET, **settings,
                                      "Method/Volumetric strain": how}))
                   for how in ("pointwise", "cell mean"))
    return mean / point - 1


def last(column):
    return lambda found: found.history()[-1][column]


for name, method in (("FE", FE), ("GIMP", GIMP)):
    for nu in (0, 0.3):
        bound(f"deep beam, {name}, nu = {nu}: change of the displacement",
              change("prm/studies/fe-mpm.prm",
                     {**method, "Mesh/Cell size": 2.5,
                      "Materials/elastic/Poisson ratio": nu},
                     last("u_y at corner")), 2e-3)
        bound(f"elastic embankment, {name}, nu = {nu}: change of the settlement",
              change("prm/hard-cases/embankment.prm",
                     {**method, **ELASTIC, "Mesh/Cell size": 1,
                      "Materials/clay/Poisson ratio": nu},
                     last("u_y at crest")), 2e-4)
    bound(f"column, {name}, nu = 0: change of the error of the stress",
          change("prm/verification/column.prm", {**method, "Mesh/Cell size": 2},
                 lambda found: found.errors["l2_sigma"]), 1e-3)

BENT = {"Time/Steps": 50, "Mesh/Cell size": 0.5,
        "Materials/steel/Poisson ratio": 0.2}
REFERENCE = -7.756  # FE Q2, see prm/studies/large-cantilever.prm
for name, method in (("FE", {**FE, "Method/Fictitious stiffness": 0}),
                     ("GIMP", {**GIMP, "Method/Points per direction": 3})):
    for how in ("pointwise", "cell mean"):
        u = last("u_y at tip")(run("prm/studies/large-cantilever.prm", {
            **QUIET, **BENT, **method, "Method/Volumetric strain": how}))
        number(f"bent cantilever, two cells high, {name}, {how}: off by",
               u / REFERENCE - 1, 2)
