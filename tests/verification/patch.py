# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Patch tests: a linear displacement field on bodies that the mesh cuts."""

METHODS = {
    "FE Q1": {"Method/Method": "finite element"},
    "FE Q2": {"Method/Method": "finite element", "Method/Degree": 2},
    "MPM, 1 point": {"Method/Points per direction": 1},
    "MPM, 2x2 points": {"Method/Points per direction": 2},
    "MPM, 3x3 Gauss": {"Method/Points per direction": 3,
                       "Method/Point layout": "Gauss"},
    "GIMP, 1 point": {"Method/Method": "GIMP"},
    "GIMP, 3x3 points": {"Method/Method": "GIMP",
                         "Method/Points per direction": 3},
}


def exact(title, result):
    bound(f"{title}: r_u", result.errors["r_u"], 1e-13)
    bound(f"{title}: l2_sigma", result.errors["l2_sigma"], 1e-12)
    force = max(map(abs, result.reactions["sides"]))
    bound(f"{title}: sum of reactions over E times strain times area",
          force / 1000, 1e-12)


for name, settings in METHODS.items():
    if name != "FE Q2":
        exact("turned square, " + name,
              run("prm/verification/patch.prm", settings))
        exact("square in half cells, " + name,
              run("prm/verification/patch-aligned.prm",
                  {"Method/Method": "material point", **settings}))

# Q2 has quadratic gradients: exact with the Gauss rule of full cells only.
exact("square of full cells, FE Q2",
      run("prm/verification/patch-aligned.prm",
          {"Mesh/Lower corner": "-5, -5", "Mesh/Upper corner": "115, 115",
           **METHODS["FE Q2"]}))
cut = run("prm/verification/patch.prm", METHODS["FE Q2"])
number("turned square, FE Q2: r_u", cut.errors["r_u"], 2)
number("turned square, FE Q2: l2_sigma", cut.errors["l2_sigma"], 2)

scattered = run("prm/verification/patch-random.prm")
number("random points, MPM: r_u", scattered.errors["r_u"], 2)
number("random points, MPM: l2_sigma", scattered.errors["l2_sigma"], 2)
