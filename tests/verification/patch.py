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
    "CPDI1, 1 point": {"Method/Method": "CPDI1"},
    "CPDI1, 3x3 points": {"Method/Method": "CPDI1",
                          "Method/Points per direction": 3},
    "CPDI2, 1 point": {"Method/Method": "CPDI2"},
    "CPDI2, 2x2 points": {"Method/Method": "CPDI2",
                          "Method/Points per direction": 2},
    "CPDI2, 3x3 points": {"Method/Method": "CPDI2",
                          "Method/Points per direction": 3},
}


def exact(title, result, lost=1):
    bound(f"{title}: r_u", result.errors["r_u"], 1e-13 * lost)
    bound(f"{title}: l2_sigma", result.errors["l2_sigma"], 1e-12 * lost)
    force = max(map(abs, result.reactions["sides"]))
    bound(f"{title}: sum of reactions over E times strain times area",
          force / 1000, 1e-12)


for name, settings in METHODS.items():
    # Quadratic functions are nearly dependent on a small part of a cell.
    exact("turned square, " + name,
          run("prm/verification/patch.prm", settings),
          1000 if name == "FE Q2" else 1)
    exact("square in half cells, " + name,
          run("prm/verification/patch-aligned.prm",
              {"Method/Method": "material point", **settings}))

for method in ("MPM", "GIMP"):
    scattered = run("prm/verification/patch-random.prm",
                    {"Method/Method": "GIMP"} if method == "GIMP" else {})
    number(f"random points, {method}: r_u", scattered.errors["r_u"], 2)
    number(f"random points, {method}: l2_sigma", scattered.errors["l2_sigma"], 2)
