# ranks: 1 # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Limit loads by path following: a toggle that snaps through, beside
displacement control and a beam's closed form, and a slope that fails."""

from math import cos, cosh, pi, sin, sinh, sqrt

TOGGLE = "prm/hard-cases/toggle.prm"
CHECKPOINTS = {"Output/Checkpoint every": "5 steps", "Output/Write": "end"}
# Of the scene: the crown is pushed down by 100 t. Along and across the bar.
E, RISE, FORCE = 1e6, 0.4, 100.
LENGTH = sqrt(5**2 + RISE**2)
THICKNESS = 0.2 * 5 / LENGTH


def beam_load(w):
    """t at the displacement w of the crown: a shallow beam without shear, fixed
    at its foot, guided at its crown, EI v'''' + N v'' = 0; the shortening
    N L / EA is that of its rise. Simpson's rule, bisection for N."""
    EI, EA = E * THICKNESS**3 / 12, E * THICKNESS

    def state(N):
        k = sqrt(abs(N) / EI)
        S, C, bend = (sin, cos, -1) if N > 0 else (sinh, cosh, 1)
        c = C(k * LENGTH / 2)
        slope = w * k / 2 / (S(k * LENGTH / 2) - k * LENGTH / 2 * c)
        n, shortening = 200, 0
        for i in range(n + 1):
            dv = slope * (C(k * LENGTH * (i / n - 0.5)) - c)
            weight = 1 if i in (0, n) else 4 if i % 2 else 2
            shortening += weight * (RISE / LENGTH - dv / 2) * dv
        shortening *= LENGTH / n / 3
        force = -EI * bend * slope * k * k + N * (RISE / LENGTH - slope * (1 - c))
        return N * LENGTH / EA - shortening, force

    low, high = -60 * EI / LENGTH**2, 4 * pi**2 * EI / LENGTH**2 * 0.999
    while high - low > 1e-9 * EI / LENGTH**2:
        middle = (low + high) / 2 + 1e-9
        low, high = (middle, high) if state(middle)[0] < 0 else (low, middle)
    return state(low)[1] / FORCE


def curve(result, load="t", scale=1., name="u_y at crown"):
    """Displacements down and load factors."""
    return [(-row[name], scale * row[load]) for row in result.history()]


def at(points, w):
    """The cubic through the four points around w."""
    i = next(k for k, p in enumerate(points) if p[0] > w)
    near = points[max(0, i - 2):][:4]
    value = 0
    for a, (x, y) in enumerate(near):
        for b, (z, _) in enumerate(near):
            y *= (w - z) / (x - z) if a != b else 1
        value += y
    return value


def limits(load):
    """Largest load up to w = 0.4, smallest beyond, with w in steps of 1e-3."""
    return (max(load(k / 1000) for k in range(60, 400)),
            min(load(k / 1000) for k in range(300, 600)))


exact = limits(beam_load)
number("beam: largest load", exact[0], 4)
number("beam: smallest load", exact[1], 4)

path = run(TOGGLE)
fe = curve(path)
found = limits(lambda w: at(fe, w))
for which, ours, beams in zip(("largest", "smallest"), found, exact):
    number(f"FE, {which} load", ours, 4)
    bound(f"FE, {which} load over the beam's - 1", ours / beams - 1, 5e-3)
text("the run ends at End time, after fewer steps than it may take",
     f"t = {path.history()[-1]['t']}, {path.summary['steps']} steps")
text("rejected steps", path.summary["rejected_steps"])
number("Newton iterations of a step",
       path.summary["newton_iterations"] / path.summary["steps"], 2)

# The other way round: the crown is moved and its reaction is the load.
moved = run(TOGGLE, {"Time/Arc length": 0, "Loads/push/Value": "0; 0",
                     "Grid conditions/crown/Components": "x, y",
                     "Grid conditions/crown/Displacement": "0; -0.8*t"})
control = curve(moved, "reaction_y of crown", -1 / FORCE)
apart = [at(fe, w) - load for w, load in control if 0.04 < w < 0.75]
at_least("states compared with displacement control", len(apart), 30)
worst = max(map(abs, apart)) / found[0]
number("FE, path and displacement control, over the largest load", worst, 1)
bound("FE, path and displacement control, over the largest load", worst, 2e-3)

# A path may be driven by a prescribed displacement: the same states again.
driven = run(TOGGLE, {"Loads/push/Value": "0; 0",
                      "Grid conditions/crown/Components": "x, y",
                      "Grid conditions/crown/Displacement": "0; -0.8*t",
                      "Time/Steps": 12})
bound("path driven by a displacement, over the largest load", max(
    abs(at(control, w) - load)
    for w, load in curve(driven, "reaction_y of crown", -1 / FORCE)
    if w > 0.04) / found[0], 1e-3)

gimp = curve(run(TOGGLE, {"Method/Method": "GIMP", "Method/Degree": 1,
                          "Mesh/Cell size": 0.05, "Time/Steps": 18}))
ours = max(load for _, load in gimp)
number("GIMP, largest load of a step", ours, 3)
bound("GIMP over FE, largest load of a step - 1",
      ours / max(load for _, load in fe[:18]) - 1, 0.03)

# By other solvers, on other ranks, and resumed.
for title, settings, n in (("3 ranks", {}, 3),
                           ("GMRES", {"Solver/Solver": "gmres"}, None),
                           ("multigrid CG", {"Solver/Solver": "amg-cg"}, None)):
    other = run(TOGGLE, {**settings, "Time/Steps": 16}, on_ranks=n)
    bound(f"{title}: t", max(
        abs(a["t"] - b["t"]) for a, b in zip(other.history(), path.history())),
        1e-7)
halted = run(TOGGLE, {**CHECKPOINTS, "Time/Steps": 10}, on_ranks=1)
run(halted.folder, {"Time/Steps": 16}, command="resume", on_ranks=1)
whole = run(TOGGLE, {**CHECKPOINTS, "Time/Steps": 16}, on_ranks=1)
text("resumed: history.csv", "the same bits" if (
    halted.folder / "history.csv").read_bytes() == (
    whole.folder / "history.csv").read_bytes() else "NO")

refused = run(TOGGLE, {"Loads/push/Value": "0; -500"}, expect=2)
text("nothing changes with t", plain(refused.output).strip().splitlines()[-1])

# A slope: the load factor at failure.
failure = {}
for title, scene, settings in (
        ("GIMP, h = 1", "prm/hard-cases/slope-gimp.prm", {"Mesh/Cell size": 1}),
        ("FE Q2, h = 0.5", "prm/hard-cases/slope-fe.prm", {"Mesh/Refinements": 2})):
    # GIMP on two ranks.
    rows = run(scene, settings, on_ranks=2 if "GIMP" in title else 1).history()
    failure[title] = max(row["t"] for row in rows)
    number(f"slope, {title}: largest t", failure[title], 3)
    bound(f"slope, {title}: growth of t in the last tenth of the path",
          rows[-1]["t"] / next(row["t"] for row in rows if row["path_length"] >=
                               0.9 * rows[-1]["path_length"]) - 1, 1e-2)
a, b = failure.values()
bound("slope, GIMP over FE Q2 - 1", a / b - 1, 0.03)
