# debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A block that hangs over, anywhere in its mesh: with aggregation or a ghost term,
displacements and stresses are those of a block on mesh lines, whatever is cut off its
cells."""

import os
import random
from math import cos, hypot, radians, sin, sqrt

BLOCK = "prm/hard-cases/cut-block.prm"
H = 0.125
# MORAINE_PLACES = 300 takes more of a sequence that is always the same.
PLACES = int(os.environ.get("MORAINE_PLACES", 6))


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


def sweep(settings, h=H, n=PLACES):
    """The largest relative change of the tip, and of the largest stress, from
    the aligned block, and how many steps were rejected."""
    aligned = run(BLOCK, {**at(0, 0, 0, h), **settings})
    worst_u = worst_s = rejected = 0
    for angle, dx, dy in positions(n):
        result = run(BLOCK, {**at(angle, dx * h / H, dy * h / H, h), **settings})
        worst_u = max(worst_u, abs(tip(result) / tip(aligned) - 1))
        worst_s = max(worst_s, largest_stress(result) / largest_stress(aligned))
        rejected += result.summary["rejected_steps"]
    return worst_u, worst_s, rejected


# Cells at an angle are softer or stiffer than aligned ones by a per cent at this
# size, with and without cuts; the difference falls with h squared.
for method, allowed in (("GIMP", 1e-2), ("material point", 1e-2),
                        ("CPDI1", 1e-2), ("CPDI2", 1e-2),
                        ("finite element", 1e-2), ("DM-GC", 3e-2)):
    u, s, rejected = sweep({"Method/Method": method})
    bound(f"{method}: tip over aligned - 1", u, allowed)
    bound(f"{method}: largest stress over aligned", s, 1.5)
    text(f"{method}: rejected steps", rejected)
u, s, rejected = sweep({"Method/Method": "finite element", "Method/Degree": 2})
bound("degree 2: tip over aligned - 1", u, 1e-2)
bound("degree 2: largest stress over aligned", s, 3)
for method in ("GIMP", "finite element"):
    u, s, rejected = sweep({"Method/Method": method}, H / 2, PLACES // 2)
    bound(f"{method}, half the cell size: tip over aligned - 1", u, 4e-3)
    bound(f"{method}, half the cell size: largest stress over aligned", s, 1.5)
for name, in_a_cell in (("augmented Lagrangian", "auto"), ("weighted", "auto"),
                        ("penalty", "auto"), ("weighted", "places")):
    for h, allowed in ((H, 2e-2), (H / 2, 1e-2)):
        u, s, rejected = sweep({"Boundaries/support/Enforcement": name,
                                "Boundaries/support/Held in a cell": in_a_cell},
                               h, PLACES if h == H else PLACES // 2)
        if in_a_cell == "places":
            at_least(f"{name}, places, h = {h}: tip over aligned - 1", u, 5e-2)
            continue
        bound(f"{name}, h = {h}: tip over aligned - 1", u, allowed)
        bound(f"{name}, h = {h}: largest stress over aligned", s, 2)
u, s, rejected = sweep({"Method/Aggregate below": 0}, n=9)
at_least("GIMP without aggregation: largest stress over aligned", s, 100)

# Nodes that springs hold to the cells beside them.
GHOST = {"Method/Cut cells": "ghost"}
for method, settings, allowed, stress in (
        ("GIMP", {}, 1e-2, 1.5), ("material point", {}, 1e-2, 1.5),
        ("CPDI1", {}, 1e-2, 1.5), ("CPDI2", {}, 1e-2, 1.5), ("finite element", {}, 1e-2, 1.5),
        ("finite element", {"Method/Degree": 2}, 1e-2, 3),
        ("DM-GC", {}, 3e-2, 1.5)):
    name = ", ".join([method, *(f"{key.split('/')[1]} {value}"
                                for key, value in settings.items())])
    u, s, rejected = sweep({**GHOST, **settings, "Method/Method": method},
                           n=PLACES // 3)
    bound(f"ghost, {name}: tip over aligned - 1", u, allowed)
    bound(f"ghost, {name}: largest stress over aligned", s, stress)
    text(f"ghost, {name}: rejected steps", rejected)
for factor, allowed in (0.1, 1e-3), (1e4, 1e-7):
    tied, held = (
        run(BLOCK, {**at(17, 0.037, 0.029), "Method/Strain": "finite",
                    "Method/Method": "CPDI1", **settings}, on_ranks=2)
        for settings in ({}, {**GHOST, "Method/Ghost factor": factor}))
    bound(f"ghost, factor {factor}: tip over that of tied nodes - 1",
          abs(tip(held) / tip(tied) - 1), allowed)
    bound(f"ghost, factor {factor}: share of the work",
          held.summary["ghost_term"]["share_of_work"], allowed)
    text(f"ghost, factor {factor}: warnings", "warnings" in held.summary)

# The condition number, which takes many solves, at some of the places.
conditions = {"Solver/Estimate condition number": "true"}
aligned = run(BLOCK, {**at(0, 0, 0), **conditions}).summary["condition_number"]
for cure, name in (({}, ""), (GHOST, "ghost, ")):
    for method in ("GIMP", "finite element"):
        bound(f"{name}{method}: condition number over aligned",
              max(run(BLOCK, {**at(*place), **conditions, **cure,
                              "Method/Method": method})
                  .summary["condition_number"]
                  for place in positions(6))
              / aligned, 2)

# A body that flies through its mesh has cut cells in nearly every step.
flight = {"Time/End time": 7.85398, "Time/Steps": 100}
for cure, name in (({}, ""), (GHOST, "ghost, ")):
    result = run("prm/dynamics/free-flight.prm", {**flight, **cure}, on_ranks=1)
    rows = result.history()
    text(f"{name}flight: rejected steps", result.summary["rejected_steps"])
    text(f"{name}flight: automatic stiffness", "stiffness of empty parts" in
         result.summary["effects"])
    for momentum in ("momentum_x", "momentum_y"):
        bound(f"{name}flight: drift of {momentum}",
              max(abs(row[momentum] - rows[0][momentum]) for row in rows), 1e-11)
energy = result.summary["energy"]
bound("ghost, flight: its work over the kinetic energy",
      abs(energy["damping"]) / energy["kinetic_at_start"], 1e-4)
bound("ghost, flight: balance of energy", energy["balance_error"], 1e-11)
text("ghost, flight: warnings", "warnings" in result.summary)

# Nodes that follow others begin with their velocities, whatever is prescribed.
result = run("prm/dynamics/oblique-inclined.prm",
             {"Method/Aggregate below": 0.5, "Time/End time": 2,
              "Time/Steps": 80})
free = run("prm/dynamics/oblique-inclined.prm",
           {"Method/Aggregate below": 0, "Time/End time": 2,
            "Time/Steps": 80})
for part in ("kinetic_at_start", "absorbed"):
    bound(f"wave on cut cells: {part} over that of free nodes - 1",
          result.summary["energy"][part] / free.summary["energy"][part] - 1,
          5e-3)
