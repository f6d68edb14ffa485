# debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Points exactly on lines of the mesh: a node at which the functions of its points
are zero has no mass, but stiffness. Bodies fall, fly and spin without stress."""

import itertools

SCENE = "prm/dynamics/free-fall-on-faces.prm"
G, END = 8, 0.75
TRANSFERS = "APIC", "FLIP", "PIC", "blend", "FMPM"
# Lower corner, points per direction and velocity of blocks of 2^dim, each in its own
# 5 cells along x. Steps are powers of two, so that points meet lines exactly, at the
# start or later.
BLOCKS = [((1, 4.5), 4, (0, 0)), ((1, 4.5), 4, (0, -1)), ((1, 5), 4, (0, 1)),
          ((1.25, 5.25), 4, (0.5, 0)), ((1.25, 4.25), 4, (-0.5, 0.5)),
          ((1.75, 3.75), 4, (0, 2)), ((1.125, 4.125), 8, (-0.5, -1))]


def bodies(blocks, dim):
    """Settings of a scene."""
    found = {"Dimension": dim}
    for k, ((x, y), n, (u, v)) in enumerate(blocks):
        lower = [x + 5 * k] + [1] * (dim - 2) + [y]
        name = "Bodies/first" if k == 0 else f"Bodies/b{k}"
        found[f"{name}/Shape"] = "box"
        found[f"{name}/Lower corner"] = ", ".join(map(str, lower))
        found[f"{name}/Upper corner"] = ", ".join(str(c + 2) for c in lower)
        found[f"{name}/Point grid"] = ", ".join([str(n)] * dim)
        found[f"{name}/Initial velocity"] = \
            "; ".join(map(str, [u] + [0] * (dim - 2) + [v]))
    if dim == 3:
        found.update({"Mesh/Lower corner": "0, 0, 0",
                      "Mesh/Upper corner": f"{5 * len(blocks)}, 4, 12",
                      "Loads/gravity/Value": f"0; 0; {-G}"})
    return found


def fall(name, scenes, blocks, dim=2, g=G, allowed=(1e-9, 1e-8)):
    """The largest error of a velocity and the largest stress: under its own weight
    a block would have 16."""
    error = stress = 0
    for settings in scenes:
        result = run(SCENE, {**bodies(blocks, dim), **settings})
        for velocity, sigma, place in result.points("velocity", "stress", "position"):
            u, v = blocks[int(place[0] // 5)][2]
            exact = [u, v - g * END, 0] if dim == 2 else [u, 0, v - g * END]
            error = max(error, *(abs(a - b) for a, b in zip(velocity, exact)))
            stress = max(stress, *map(abs, sigma))
    n = len(scenes) * len(blocks)
    bound(f"{name}, {n} falls: error of velocities", error, allowed[0])
    bound(f"{name}, {n} falls: stress", stress, allowed[1])


for method in ("material point", "DM"):
    fall(method,
         [{"Method/Method": method, "Time/Velocity transfer": transfer,
           "Time/Steps": steps}
          for transfer, steps in itertools.product(TRANSFERS, (12, 24))], BLOCKS)
# Nodes of next to no mass make more of the round-off that Newton's method leaves.
fall("finite strain, other rules",
     [{"Method/Strain": "finite", "Solver/Tolerance": 1e-12, **settings} for settings in (
         {}, {"Time/Mass": "lumped"}, {"Time/Integrator": "generalised-alpha"},
         {"Time/Integrator": "Bathe"}, {"Time/Integrator": "energy-momentum"})], BLOCKS,
     allowed=(1e-7, 1e-5))
fall("3D", [{"Time/Velocity transfer": transfer} for transfer in ("APIC", "FLIP")],
     BLOCKS[1:5], dim=3)

# One point at each corner of four cells: only the nodes there have mass. The others
# move by next to none, which takes digits.
for mass in ("consistent", "lumped"):
    fall(f"one point in a cell, {mass} mass",
         [{"Time/Mass": mass, "Loads/gravity/Value": "0; 0"}],
         [((0.5, 4.5), 2, (1, 0))], g=0, allowed=(1e-8, 1e-6))

# A spin begins as on the same mesh a little aside, where all nodes have mass.
def spin(shift):
    x, y = 3.125, 6 + shift
    return run(SCENE, {
        "Method/Strain": "finite", "Loads/gravity/Value": "0; 0",
        "Bodies/first/Shape": "box", "Bodies/first/Point grid": "4, 4",
        "Bodies/first/Lower corner": f"{x - 0.25}, {y - 0.25}",
        "Bodies/first/Upper corner": f"{x + 1.75}, {y + 1.75}",
        "Bodies/first/Initial velocity": f"-(y - {y}); x - {x}",
    }).points("velocity", "stress", "id")


on_lines, aside = ({number: (velocity, stress)
                    for velocity, stress, number in spin(shift)}
                   for shift in (0, -1e-7))
bound("spin: velocities, against those of points aside",
      max(abs(a - b) for p in on_lines
          for a, b in zip(on_lines[p][0], aside[p][0])), 1e-6)
bound("spin: stresses over E, against those of points aside",
      max(abs(a - b) for p in on_lines
          for a, b in zip(on_lines[p][1], aside[p][1])) / 1e3, 1e-6)

# At small strain on nodes that stay the spin is steady: damping sees no strain.
result = run(SCENE, {
    "Method/Mesh after step": "keep", "Loads/gravity/Value": "0; 0",
    "Bodies/first/Stiffness damping": 0.1,
    "Bodies/first/Lower corner": "1, 4.75", "Bodies/first/Upper corner": "3, 6.75",
    "Bodies/first/Initial velocity": "-(y - 5); x - 2"})
rows = result.history()
bound("damped spin: kinetic energy over that at the start - 1",
      rows[-1]["kinetic energy"] / rows[0]["kinetic energy"] - 1, 1e-10)
