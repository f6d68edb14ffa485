# debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Patch tests on meshes that are no boxes: a linear displacement field on
quadrilaterals of gmsh and on an annulus, plane and extruded, and on a body that
cuts such cells. Where the points of a cell are is nothing to two ranks: 2 Gauss
points are on one."""

import math

SCENES = {
    "quads": "prm/verification/mesh-quads.prm",
    "annulus": "prm/verification/mesh-annulus.prm",
    "quads-3d": "prm/verification/mesh-quads-3d.prm",
    "annulus-3d": "prm/verification/mesh-annulus-3d.prm",
}

METHODS = {
    "FE Q1": {},
    "FE Q2": {"Method/Degree": 2},
    "MPM, 2 points": {"Method/Method": "material point"},
    "MPM, 2 Gauss points": {"Method/Method": "material point",
                            "Method/Point layout": "Gauss"},
    "MPM, 3 Gauss points": {"Method/Method": "material point",
                            "Method/Point layout": "Gauss",
                            "Method/Points per direction": 3},
}

for name, scene in SCENES.items():
    for method, settings in METHODS.items():
        result = run(scene, settings,
                     on_ranks=1 if method == "MPM, 2 Gauss points" else None)
        bound(f"{name}, {method}: r_u", result.errors["r_u"], 1e-12)
        bound(f"{name}, {method}: l2_sigma", result.errors["l2_sigma"], 1e-10)

for method, settings in METHODS.items():
    result = run("prm/verification/mesh-cut.prm", settings)
    if method == "FE Q2":
        number(f"cut, {method}: r_u", result.errors["r_u"], 2)
    else:
        bound(f"cut, {method}: r_u", result.errors["r_u"], 1e-10)
        bound(f"cut, {method}: l2_sigma", result.errors["l2_sigma"], 1e-10)

# A traction on the outer side of the annulus: polygon of 18 edges, height 4.
for name, value, height in (("annulus", "t; 0", 1), ("annulus-3d", "t; 0; 0", 4)):
    for degree in (1, 2):
        reactions = run(SCENES[name], {
            "Method/Degree": degree, "Loads/push/Type": "side traction",
            "Loads/push/Side": "outer", "Loads/push/Value": value}).reactions
        total = sum(force[0] for force in reactions.values())
        exact = height * 18 * 20 * math.sin(math.pi / 18)
        bound(f"{name}, Q{degree}: traction held", abs(total) / exact - 1, 1e-10)
