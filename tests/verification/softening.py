# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A shear band in a layer that softens: what it dissipates per area, with and
without a softening length, over the size of the cells, against the closed form;
and what of the mesh is still felt."""
import math

SCENE = "prm/hard-cases/softening.prm"
LENGTH, PEAK, REST, KAPPA, G = 0.125, 0.99, 0.1, 0.02, 1000
SIZES = (0.25, 0.125, 0.0625, 0.03125)


def energy(h, settings=None):
    """Work per area beyond that of the stress that remains, over its exact
    value for a band of 0.125: a triangle less what stays elastic."""
    result = run(SCENE, {"Constants/h": h, **(settings or {})})
    u, tau, work = 0, 0, 0
    for row in result.history():
        u_next, tau_next = 0.012 * row["t"], row["reaction_x of top"] / h
        work += (u_next - u) * (tau + tau_next) / 2
        u, tau = u_next, tau_next
    exact = ((PEAK - REST) * math.sqrt(3) * KAPPA * LENGTH / 2 -
             REST**2 / G * (1 + h) / 2)
    return (work - REST * u) / exact


GIMP = {"Method/Method": "GIMP"}
without = {"Materials/*/Softening length": 0}
for h in SIZES:
    with_length = energy(h)
    bound(f"h = {h}: with a softening length, - 1", with_length - 1, 2e-3)
    number("  without", energy(h, without), 3)
    number("  GIMP", energy(h, GIMP), 3)
    number("  mesh a quarter of a cell lower", energy(
        h, {**GIMP, "Constants/s": 0.25}), 3)

# Domains that lie across the edges of cells: both rows take part.
for h in SIZES[1:3]:
    n = round(2 / h)
    number(f"h = {h}: GIMP, domains over two rows", energy(h, {
        **GIMP, "Constants/s": 0.125, "Bodies/below/Point grid": f"4, {n}",
        "Bodies/band/Point grid": "4, 4",
        "Bodies/above/Point grid": f"4, {n}"}), 3)

# Half of the weaker row in each of two rows of cells: both soften alike, which
# is an equilibrium, until its matrix is singular at the end of softening.
number("h = 0.125: half of the weaker row in each of two", energy(
    0.125, {"Method/Method": "material point", "Constants/s": 0.5,
            "Time/End time": 0.72}), 3)

# A band at 45 degrees to the cells is wider than one: it dissipates more.
plate_exact = 0.9 * math.sqrt(3) * 0.08 * LENGTH / 2 * math.sqrt(2)


def energy_of_plate(settings):
    result = run("prm/hard-cases/softening-plate.prm",
                 {**settings, "Output/Points": "false", "Output/Mesh": "false"})
    u, force, work = 0, 0, 0
    for row in result.history():
        u_next, force_next = 0.02 * row["t"], -row["reaction_y of top"]
        work += (u_next - u) * (force + force_next) / 2
        u, force = u_next, force_next
    return (work - 2 * REST * u) / plate_exact


for cells in ("8, 16", "16, 32"):
    number(f"plate of {cells} cells, band at 45 degrees",
           energy_of_plate({"Mesh/Cells": cells}), 3)
number("plate of 16, 32 cells, without a softening length", energy_of_plate(
    {"Mesh/Cells": "16, 32", **without}), 3)
