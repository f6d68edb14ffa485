# ranks: 1 # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Bars of small strain that vibrate and a block that spins: periods, energy,
damping."""

import cmath
import math


def omega(mode):
    """Angular frequency of a mode of ten linear elements, c = L = 1."""
    k = (mode - 0.5) * math.pi
    return math.sqrt(600 * (1 - math.cos(k / 10)) / (2 + math.cos(k / 10)))


def multiplier(rows):
    """The complex number by which every step multiplies the vibration."""
    u = [row["u_x at tip"] for row in rows]
    triples = list(zip(u, u[1:], u[2:]))
    a = sum(y * y for x, y, z in triples)
    b = sum(x * y for x, y, z in triples)
    c = sum(x * x for x, y, z in triples)
    d = sum(z * y for x, y, z in triples)
    e = sum(z * x for x, y, z in triples)
    p, q = (d * c - e * b) / (a * c - b * b), (e * a - d * b) / (a * c - b * b)
    return p / 2 + cmath.sqrt(p * p / 4 + q)


def imbalance(rows, names=("kinetic energy of nodes", "strain energy")):
    """The largest energy out of balance, over the largest energy."""
    return (max(abs(row["energy out of balance"]) for row in rows)
            / max(row[name] for row in rows for name in names))


bar = "prm/dynamics/bar.prm"
period = 2 * math.pi / omega(1)


def energies(rows):
    return [row["kinetic energy of nodes"] + row["strain energy"]
            for row in rows]


# 100 periods, linear.
rows = run(bar).history()
total = energies(rows)
bound("average acceleration, 100 periods: change of energy",
      max(abs(value / total[0] - 1) for value in total), 1e-10)
bound("average acceleration, 100 periods: out of balance", imbalance(rows),
      1e-10)
for integrator in ("generalised-alpha", "Bathe"):
    result = run(bar, {"Time/Integrator": integrator, "Time/End time": 40,
                       "Time/Steps": 200})
    energy = result.summary["energy"]
    bound(f"{integrator}: numerical damping over the energy that is gone - 1",
          energy["numerical_damping"]
          / (energy["kinetic_at_start"] + energy["strain_at_start"]
             - energy["kinetic"] - energy["strain"]) - 1, 1e-9)
    bound(f"{integrator}: out of balance", energy["balance_error"], 1e-10)

for integrator, name in (("Newmark", "average acceleration"),
                         ("generalised-alpha", "generalised-alpha, 0.8"),
                         ("Bathe", "Bathe, 0.8"),
                         ("energy-momentum", "energy and momentum")):
    for steps in (20, 50):
        rows = run(bar, {"Time/Integrator": integrator,
                         "Time/Steps": 10 * steps,
                         "Time/End time": 10 * period}).history()
        # The second root of generalised-alpha is gone after two periods.
        angle = cmath.phase(multiplier(rows[2 * steps:]))
        number(f"{name}, T/{steps}: longer period, %",
               100 * abs(2 * math.pi / steps / angle) - 100, 4)

# What probes and files show: average acceleration, step by step.
probe = {"Probes/tip/Quantities": "displacement, velocity, acceleration",
         "Time/Steps": 40, "Time/End time": period}
for method, kind in (("finite element", "interpolated"),
                     ("finite element", "nearest point"),
                     ("GIMP", "interpolated"), ("GIMP", "nearest point")):
    result = run(bar, {**probe, "Method/Method": method,
                       "Probes/tip/Kind": kind})
    rows = result.history()
    name = f"{method}, {kind}"
    # Points take the motion of the nodes as that crosses the mesh; exact then
    # is nothing but what nodes keep.
    for rate, of in (("v", "u"), ("a", "v")):
        if method == "finite element":
            bound(f"{name}: {of}_x against the mean of {rate}_x of a step",
                  max(abs(new[f"{of}_x at tip"] - old[f"{of}_x at tip"]
                          - period / 80 * (old[f"{rate}_x at tip"]
                                           + new[f"{rate}_x at tip"]))
                      for old, new in zip(rows, rows[1:])), 1e-14)
        number(f"{name}: largest {rate}_x",
               max(row[f"{rate}_x at tip"] for row in rows), 2)
    for kind_of_file in ("mesh", "points"):
        last = sorted((result.folder / kind_of_file).glob("*.vtu"))[-1]
        content = last.read_bytes()
        text(f"{name}: {kind_of_file} file has",
             ", ".join(field for field in ("velocity", "acceleration")
                       if f'Name="{field}"'.encode() in content))

# Damping: ratios at the two given frequencies, and at the next mode.
damped = "prm/dynamics/damped-bar.prm"
beta = 2 * 0.05 / (omega(1) + omega(2))
alpha = beta * omega(1) * omega(2)
for mode in (1, 2, 3):
    rows = run(damped, {"Bodies/bar/Initial velocity":
                        f"0.01*sin({mode - 0.5}*pi*x); 0"},
               on_ranks=2 if mode == 2 else 1).history()
    z = multiplier(rows)
    # What the average acceleration makes of exp(s t).
    s = 2 / 0.05 * (z - 1) / (z + 1)
    exact = alpha / (2 * omega(mode)) + beta * omega(mode) / 2
    number(f"damping ratio of mode {mode}, exact", exact, 5)
    number(f"damping ratio of mode {mode}", -s.real / abs(s), 5)
    bound(f"mode {mode}: out of balance", imbalance(rows), 1e-10)

# Rotation is not damped.
block = "prm/dynamics/spinning-block.prm"
for name, settings, loss, turning in (
        ("energy and momentum", {}, 1e-13, 1e-12),
        ("average acceleration", {"Time/Integrator": "Newmark",
                                  "Time/Steps": 288, "Time/End time": "8*pi"},
         1e-7, 1e-2)):
    rows = run(block, settings).history()
    first = rows[0]["kinetic energy of nodes"]
    # In the second turn what stretched the block has come to rest.
    number(f"spinning block, {name}: damped in the first turn, % of the energy",
           100 * rows[71]["damping energy"] / first, 3)
    bound(f"spinning block, {name}: damped after the second, part of the energy",
          (rows[-1]["damping energy"] - rows[143]["damping energy"]) / first,
          loss)
    bound(f"spinning block, {name}: change of the angular momentum",
          max(abs(6 * row["angular_momentum_z"] - 1) for row in rows), turning)
