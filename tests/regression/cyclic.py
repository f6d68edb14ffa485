# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""200 plastic cycles: loops of stress over strain stay where they are, at small
and finite strain, without and with hardening, by nodes and by points."""

SCENE = "prm/hard-cases/cyclic.prm"
STEPS, AMPLITUDE = 32, 0.02


def loop(history, number):
    """Force, stresses and positions in the steps of a cycle, scaled."""
    rows = history[(number - 1) * STEPS:number * STEPS]
    columns = [(name, 600) for name in
               ("reaction_y of top", "sigma_xx at middle", "sigma_yy at middle",
                "sigma_zz at middle")]
    columns += [("x at middle", 1), ("y at middle", 1)]
    return [row[name] / scale for row in rows for name, scale in columns]


def cycles(name, settings):
    result = run(SCENE, settings)
    history = result.history()
    last = loop(history, 200)
    # Stress across the plane tends to its middle value in the first cycles.
    for number_of_loop, limit in ((3, 1e-12), (2, 1e-7)):
        bound(f"{name}: loop 200 - loop {number_of_loop}", max(
            abs(a - b) for a, b in zip(loop(history, number_of_loop), last)),
            limit)
    # Work of a cycle: it closes, and it is plastic.
    rows = history[STEPS - 1:2 * STEPS]
    way = [1 - 4 * abs(row["t"] - 0.25 - round(row["t"] - 0.25)) for row in rows]
    force = [row["reaction_y of top"] for row in rows]
    work = AMPLITUDE * sum((force[i] + force[i + 1]) / 2 * (way[i + 1] - way[i])
                           for i in range(STEPS))
    number("  work of a cycle over that of a rigid-plastic one",
           work / (4 * AMPLITUDE * 2 * 600 / 3**0.5), 3)
    text("  steps cut", result.summary["rejected_steps"])


HARDENING = {"Materials/steel/Uniaxial yield stress": "0: 400, 0.03: 600"}
KEEP = {"Method/Mesh after step": "keep"}
FINITE = {"Method/Strain": "finite"}
cycles("small strain, perfectly plastic", KEEP)
cycles("small strain, hardening", {**KEEP, **HARDENING})
cycles("finite strain, perfectly plastic", FINITE)
cycles("finite strain, hardening", {**FINITE, **HARDENING})
cycles("small strain, GIMP, hardening", {
    "Method/Method": "GIMP", **KEEP, **HARDENING})

# Small strain on nodes that move adds up strains over lengths that change: what
# comes back to its strain does not come back to its length.
moved = run(SCENE, {}).history()
text("small strain, nodes move: stresses drift by less than 1e-8", max(
    abs(a - b) for a, b in zip(*[
        [row["sigma_yy at middle"] / 600 for row in
         moved[(n - 1) * STEPS:n * STEPS]] for n in (3, 200)])) < 1e-8)
number("  width after 200 cycles over that after 3", moved[
    -1]["x at middle"] / moved[3 * STEPS - 1]["x at middle"], 4)
