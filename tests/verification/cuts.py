# debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A block that hangs over, anywhere in its mesh: with aggregation, displacements and
stresses are those of a block on mesh lines, whatever is cut off its cells."""

import random
from math import cos, hypot, radians, sin, sqrt

BLOCK = "prm/hard-cases/cut-block.prm"
H = 0.125
# The first of a sequence that is always the same.
POSITIONS = 12


def at(angle, dx, dy, h=H):
    """The block turned, its mesh moved by (-dx, -dy)."""
    c, s = cos(radians(angle)), sin(radians(angle))
    down = f"sin({angle!r}*pi/180); -cos({angle!r}*pi/180)"
    return {"Mesh/Lower corner": f"{-1 - dx!r}, {-1.5 - dy!r}",
            "Mesh/Upper corner": f"{3 - dx!r}, {2.5 - dy!r}",
            "Mesh/Cell size": h,
            "Bodies/block/Rotation angle": angle,
            "Boundaries/support/Rotation angle": angle,
            "Loads/weight/Value": down,
            "Loads/end/Value": down,
            "Probes/tip/Location":
                f"{1.99 * c - 0.5 * s!r}, {1.99 * s + 0.5 * c!r}"}


def largest_stress(result):
    """von Mises stress of the points (plane strain)."""
    return max(sqrt(((a - b) ** 2 + (b - c) ** 2 + (c - a) ** 2) / 2 + 3 * t * t)
               for ((a, t, _, _, b, _, _, _, c),) in result.points("stress"))


def tip(result):
    return hypot(*list(result.probes.values())[:2])


def positions(n):
    """Offsets all over a cell and within 1e-8 to 1e-2 of it from its ends."""
    random.seed(3)
    for _ in range(n):
        angle = random.choice([0, 0, 17, 30, 45, random.uniform(0, 90)])
        offsets = []
        for _ in "xy":
            little = 10 ** random.uniform(-8, -2)
            offsets.append(H * random.choice(
                [random.uniform(0, 1), little, 1 - little]))
        yield angle, *offsets


# Displacements: cells at an angle are softer or stiffer than aligned ones by some
# per cent at this cell size, with and without cuts; see below.
for method, settings in (
        ("GIMP", {}), ("material point", {}), ("CPDI1", {}), ("CPDI2", {}),
        ("finite element", {}), ("DM-GC", {}),
        ("GIMP, roller", {"Boundaries/support/Constraint": "roller",
                          "Method/Method": "GIMP"}),
        ("FE, degree 2", {"Method/Method": "finite element",
                          "Method/Degree": 2})):
    settings = {"Method/Method": method, **settings}
    aligned = run(BLOCK, {**at(0, 0, 0), **settings})
    worst_u = worst_s = rejected = 0
    for position in positions(POSITIONS):
        result = run(BLOCK, {**at(*position), **settings})
        worst_u = max(worst_u, abs(tip(result) / tip(aligned) - 1))
        worst_s = max(worst_s,
                      largest_stress(result) / largest_stress(aligned))
        rejected += result.summary["rejected_steps"]
    bound(f"{method}: tip over aligned - 1", worst_u, 2e-2)
    bound(f"{method}: largest stress over aligned", worst_s, 3)
    text(f"{method}: rejected steps", rejected)
