# ranks: 1 # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Bars that meet each other or a wall: duration 2L/c, momentum exchange; loads
that jump."""

V, H, L = 0.01, 0.02, 1.


def crossings(rows, name, level):
    """When a column passes a level, between the rows."""
    values = [(row["t"], row[name] - level) for row in rows]
    return [s + (t - s) * x / (x - y)
            for (s, x), (t, y) in zip(values, values[1:]) if x * y < 0]


def velocity(rows, name, start, end):
    """Mean of a probe's between two times, over V."""
    first, last = (min(rows, key=lambda row: abs(row["t"] - t))
                   for t in (start, end))
    return (last[name] - first[name]) / (last["t"] - first["t"]) / V


# Two bars. At a distance d from where they meet waves pass within 2(L - d)/c.
bars = "prm/dynamics/impact.prm"
for method in ("GIMP", "CPDI2", "material point"):
    result = run(bars, {"Method/Method": method})
    rows = result.history()
    bound(f"{method}: energy out of balance",
          result.summary["energy"]["balance_error"], 1e-12)
    bound(f"{method}: momentum of both over that of one",
          max(abs(row["momentum_x"]) for row in rows) / (V * L * H), 1e-9)
    start, end = crossings(rows, "sigma_xx at l9", -V / 2)[:2]
    number(f"{method}: bars push each other for 2L/c times",
           (end - start) / (2 * (L - 0.095)), 3)
    number(f"{method}: stress over rho c v",
           -min(row["sigma_xx at l9"] for row in rows) / V, 4)
    number(f"{method}: velocity after, times that before",
           velocity(rows, "u_x at l5", 3, 4), 3)
    number(f"{method}: kinetic energy after over that before",
           rows[-1]["kinetic energy"] / (V * V * H), 3)

# Bars that meet elsewhere on the mesh than they part stay together.
rows = run(bars, {"Bodies/left/Initial velocity": "0.02; 0",
                  "Bodies/right/Initial velocity": "0; 0",
                  "Time/End time": 4.5, "Time/Steps": 450}).history()
number("one bar at rest: largest tension between them over rho c v",
       max(row["sigma_xx at l9"] for row in rows) / V, 2)

# A wall, which holds in both directions.
wall = "prm/dynamics/impact-roller.prm"
for name, settings in (
        ("GIMP", {}),
        ("GIMP, finite strain", {"Method/Strain": "finite"}),
        ("finite element", {"Method/Method": "finite element"}),
        ("GIMP, finite strain, average acceleration",
         {"Method/Strain": "finite", "Time/Integrator": "Newmark"})):
    rows = run(wall, settings, on_ranks=1 if settings else 2).history()
    reactions = [row["reaction_x of wall"] / (V * H) for row in rows
                 if 1 <= row["t"] <= 1.8]
    mean = sum(reactions) / len(reactions)
    number(f"wall, {name}: mean reaction over rho c v", mean, 3)
    number(f"wall, {name}: its largest deviation, t = 1 to 1.8",
           max(abs(r - mean) for r in reactions), 1)
    end = [row["momentum_x"] for row in rows]
    number(f"wall, {name}: momentum after over that before",
           min(end) / (V * H * L), 3)
    number(f"wall, {name}: turned after 2L/c times",
           rows[end.index(min(end))]["t"] / (2 * L), 3)

# A load on the end of a bar that takes the time n h/c to act.
for n in (0, 1, 2, 5, 10):
    rows = run("prm/dynamics/bar.prm", {
        "Mesh/Cell size": H, "Mesh/Upper corner": f"1, {H}",
        "Bodies/bar/Upper corner": f"1, {H}",
        "Bodies/bar/Initial velocity": "0; 0",
        "Probes/tip/Location": f"1, {H / 2}",
        "Probes/middle/Location": "0.5, 0.005",
        "Probes/middle/Quantities": "stress",
        "Loads/push/Type": "side traction", "Loads/push/Side": "right",
        "Loads/push/Value": f"{-V}; 0",
        "Loads/push/Curve": f"min(1, t/{n * H})" if n else "1",
        "Time/End time": 1.4, "Time/Steps": 140}).history()
    number(f"load within {n} h/c: stress over that of the load, %",
           100 * max(-row["sigma_xx at middle"] for row in rows) / V, 3)
