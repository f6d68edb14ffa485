# ranks: 1-2  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Smooth walls that are moved away from and towards soil, beside Rankine's active
and passive forces: all soil yields at once, and its stress is exact."""

from math import cos, radians, sin, sqrt

SCENE = "prm/geotechnics/wall.prm"
GAMMA, H, PHI = 20, 4, radians(30)
ACTIVE = (1 - sin(PHI)) / (1 + sin(PHI))
WEIGHT = GAMMA * H**2 / 2
COTANGENT = cos(PHI) / sin(PHI)


def force(c, factor, crack=False):
    """Of a wall on soil with cohesion c and this factor of the weight; with a
    crack as deep as there would be tension."""
    k, side = sqrt(factor), -1 if factor < 1 else 1
    depth = 2 * c / (k * GAMMA) if crack else 0
    return (factor * GAMMA * (H**2 - depth**2) / 2 + side * 2 * c * k * (H - depth))


IN = {"Boundaries/wall/Translation": "0.2*t; 0"}
C = {"Materials/sand/Cohesion": 5}
HELD = {"Materials/sand/Tensile strength": 8.66}
# Later, soil that yields all over flows where round-off says.
EARLY = {"Time/Steps": 4, "Time/End time": 0.4}
CASES = (("active", EARLY, force(0, ACTIVE), 1e-6),
         ("passive", IN, force(0, 1 / ACTIVE), 1e-6),
         ("active, c = 5, tension held", {**C, **HELD}, force(5, ACTIVE), 1e-6),
         ("active, c = 5, cracked", C, force(5, ACTIVE, crack=True), 3e-3),
         ("passive, c = 5", {**C, **IN}, force(5, 1 / ACTIVE), 1e-6))
for name, settings, exact, allowed in CASES:
    number(f"{name}: exact force", exact, 7)
    for method in "GIMP", "CPDI1", "material point", "finite element":
        result = run(SCENE, {"Method/Method": method, **settings, **QUIET})
        bound(f"{name}, {method}: error",
              result.reactions["wall"][0] / exact - 1, allowed)

# The cone has the strength of Mohr and Coulomb's once the stress out of the plane
# is that of flow.
for name, way, factor in (("active", "-0.1*t; 0", ACTIVE),
                          ("passive", "t; 0", 1 / ACTIVE)):
    result = run(SCENE, {"Materials/sand/Model": "Drucker-Prager",
                         "Boundaries/wall/Translation": way, **QUIET})
    bound(f"{name}, Drucker-Prager: error",
          result.reactions["wall"][0] / force(0, factor) - 1, 1e-3)

# At finite strain the soil becomes higher as it becomes narrower, but by 0.3 %
# of its volume less, which is elastic.
for method in "GIMP", "CPDI1", "finite element":
    result = run(SCENE, {"Method/Method": method, "Method/Strain": "finite",
                         "Method/Mesh after step": "default", **IN, **QUIET})
    exact = force(0, 1 / ACTIVE) * (8 / 7.8)**2
    bound(f"passive, {method}, finite strain: error",
          result.reactions["wall"][0] / exact - 1, 5e-3)
