# debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Rigid motion through the mesh gives no stress."""

from math import cos, hypot, radians

METHODS = {
    "MPM, 2x2 points": {},
    "MPM, 3x3 points": {"Method/Points per direction": 3},
    "GIMP": {"Method/Method": "GIMP"},
    "FE": {"Method/Method": "finite element"},
}
SCENE = "prm/verification/rigid-motion.prm"
E = 1000
LAMBDA, MU = 0.3 * E / (1.3 * 0.4), E / 2.6

for name, settings in METHODS.items():
    moved = run(SCENE, settings)
    # A strain of the size of the motion would be 37/55.
    bound(f"{name}, translation by 3.7 cells: r_u", moved.errors["r_u"], 1e-13)
    bound(f"{name}, translation by 3.7 cells: stress over E",
          moved.errors["max_sigma"] / E, 1e-11)

    turned = run(SCENE, {
        **settings,
        "Method/Mesh after step": "keep",
        "Boundaries/sides/Translation": "0; 0",
        "Boundaries/sides/Displacement": "-1e-3*t*y; 1e-3*t*x",
    })
    bound(f"{name}, small rotation by 1e-3: stress over E",
          turned.errors["max_sigma"] / E, 1e-14)

    # Small strain sees cos(angle) - 1 in both directions in each of ten steps.
    # The points of a cut cell integrate that stress inexactly in the steps that
    # follow: multipliers of every place take up the difference, those of means
    # and Nitsche's flux do not.
    strain = 10 * (1 - cos(radians(0.1)))
    expected = strain * hypot(2 * (LAMBDA + MU), 2 * (LAMBDA + MU), 2 * LAMBDA)
    lagrangian = {"Boundaries/sides/Enforcement": "augmented Lagrangian"}
    for how, enforcement in (
            ("", {}), (", augmented Lagrangian", lagrangian),
            (", augmented Lagrangian, places",
             {**lagrangian, "Boundaries/sides/Held in a cell": "places"})):
        both = run(SCENE, {
            **settings, **enforcement,
            "Boundaries/sides/Rotation angle": "20+t",
            "Exact solution/Displacement":
                "37*t+(cos(t*pi/180)-1)*x-sin(t*pi/180)*y; "
                "21*t+sin(t*pi/180)*x+(cos(t*pi/180)-1)*y",
        })
        title = f"{name}{how}, translation and 1 degree"
        bound(f"{title}: r_u", both.errors["r_u"], 1e-6)
        ratio = both.errors["max_sigma"] / expected
        if "places" in how:
            bound(f"{title}: stress over that of small strain - 1", ratio - 1,
                  0.02)
        else:
            number(f"{title}: stress over that of small strain", ratio, 2)
