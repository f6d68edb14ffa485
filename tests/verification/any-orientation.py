# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""The contained block of Cortis et al. (2017) at random orientations and places in
coarse meshes: rollers on all its faces, of which one moves by 1 % of its length.
The displacement is linear, so every method and enforcement has to be exact, and no
boundary may let go."""

import math
import random

L = 100
STRAIN = 0.01

SCENE = prm("""
Dimension = {dim}
Mesh/Lower corner = {low} | Upper corner = {high} | Cells = {cells}
Method/Method = {method} | Aggregate below = {aggregate}
Materials/e/Young modulus = 1000 | Poisson ratio = 0.3
Bodies/b/Lower corner = {origin} | Upper corner = {size} | Rotation angle = {angle}
{axis}
Boundaries/
{boundaries}
Output/Points = false | Mesh = false
Exact solution/Displacement = {displacement}
""")

BOUNDARY = prm("""
{part}/Body = b | Part = {part} | Constraint = roller | Enforcement = {enforcement}
{motion}
""")


def rotation(axis, angle):
    """Rodrigues' formula."""
    c, s = math.cos(angle), math.sin(angle)
    x, y, z = axis
    cross = ((0, -z, y), (z, 0, -x), (-y, x, 0))
    return [[(i == j) * c + s * cross[i][j] + (1 - c) * axis[i] * axis[j]
             for j in range(3)] for i in range(3)]


def scene(dim, rng, cells_across, **keys):
    h = L / cells_across
    axis = [rng.gauss(0, 1) for _ in range(3)] if dim == 3 else [0, 0, 1]
    axis = [a / math.hypot(*axis) for a in axis]
    angle = rng.uniform(0, 2 * math.pi)
    turn = rotation(axis, angle)
    corners = [[L * sum(turn[i][j] * (k >> j & 1) for j in range(dim))
                for i in range(dim)] for k in range(2**dim)]
    low = [min(c[i] for c in corners) - h * rng.uniform(0.1, 1.1)
           for i in range(dim)]
    cells = [math.ceil((max(c[i] for c in corners) - low[i]) / h + 0.1)
             for i in range(dim)]
    along = [turn[i][0] for i in range(dim)]
    stretch = " + ".join(f"({a!r})*{x}" for a, x in zip(along, "xyz"))

    def numbers(values):
        return ", ".join(map(repr, values))

    parts = ("right", "left", "bottom", "top", "front", "back")[:2 * dim]
    motion = "; ".join(f"{STRAIN * L * a!r}*t" for a in along)
    return SCENE.format(
        dim=dim, low=numbers(low),
        high=numbers([x + n * h for x, n in zip(low, cells)]),
        cells=numbers(cells), origin=numbers([0] * dim), size=numbers([L] * dim),
        angle=repr(math.degrees(angle)), method=keys["method"],
        aggregate=keys["aggregate"],
        axis=f"set Rotation axis = {numbers(axis)}" if dim == 3 else "",
        boundaries="".join(BOUNDARY.format(
            part=part, enforcement=keys["enforcement"],
            motion=f"set Translation = {motion}" if part == "right" else "")
            for part in parts),
        displacement="; ".join(f"t*{STRAIN}*({stretch})*({a!r})" for a in along))


ENFORCEMENTS = ("skew Nitsche", "symmetric Nitsche", "augmented Lagrangian",
                "weighted", "penalty")
METHODS = ("material point", "GIMP", "CPDI1", "finite element")
# Shares of the length of the block.
CELLS_ACROSS = {2: (2.3, 3.3, 4, 6, 10), 3: (3.3, 4, 5)}

# Without multipliers a boundary gives way by the traction over its stiffness, and
# multipliers are found in passes that end where they gain little. Slivers whose
# nodes are free gain least.
LIMITS = {"augmented Lagrangian": {2: 1e-10, 3: 1e-6}, "weighted": {2: 1e-5, 3: 1e-5},
          "penalty": {2: 1e-5, 3: 1e-5}}

for dim, n in ((2, 160), (3, 80)):
    rng = random.Random(dim)
    worst = {}
    met = 0
    for k in range(n):
        keys = {"enforcement": ENFORCEMENTS[k % 5], "method": METHODS[k % 4],
                "aggregate": (0.1, 0.5, 0)[k % 3]}
        path = folder / "block.prm"
        path.write_text(scene(dim, rng, rng.choice(CELLS_ACROSS[dim]), **keys))
        result = run(path, on_ranks=2 if k % 13 == 0 else 1)
        met += "conflicting-constraints" in result.ids()
        name = keys["enforcement"]
        if name in LIMITS and keys["aggregate"] == 0:
            name += " without aggregation"
        worst[name] = max(worst.get(name, 0), result.errors["r_u"])
    for name, r_u in sorted(worst.items()):
        limit = 1e-3 if "without" in name else LIMITS.get(name, {}).get(dim, 1e-10)
        bound(f"{dim}D, {name}: worst r_u", r_u, limit)
    text(f"{dim}D: runs in which boundaries let go", met)
