# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A column of sand, twice as high as half of it is wide, collapses: its run-out
is between those that Lajeunesse et al. and Lube et al. (2005) measured."""

SCENE = "prm/geotechnics/column-collapse.prm"
SIZE = 0.0625  # of points: half a cell


def deposit(result):
    """Height on the axis, and where the sand becomes thinner than a point."""
    columns = {}
    for (x, _, _), volume in result.points("position", "volume"):
        k = int(x / (2 * SIZE))
        columns[k] = columns.get(k, 0) + volume / (2 * SIZE)
    front = next(k for k in range(1000) if columns.get(k, 0) < SIZE)
    return columns[0], front * 2 * SIZE


for method in "GIMP", "CPDI1":
    result = run(SCENE, {"Method/Method": method, "Output/Write": "end",
                         "Output/Mesh": "false"})
    height, front = deposit(result)
    number(f"{method}: height on the axis", height, 2)
    bound(f"{method}: run-out over 3, - 1", (front - 1) / 3 - 1, 0.2)
    rows = result.history()
    bound(f"{method}: kinetic energy at the end over the largest",
          rows[-1]["kinetic energy"] / max(row["kinetic energy"] for row in rows),
          1e-2)
