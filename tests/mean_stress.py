# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""What of a field of points in 2D alternates between neighbours, on a mesh of
squares with a vertex at the origin.

A value minus the mean of its four neighbours, over the range of the field: of
points ('points'; neighbours are those of the start), of means over cells
('cells'), and of the field that the program has smoothed over vertices
('smoothed').
"""

from math import floor, sqrt


def _means(places, values, volumes, size):
    """Mean by volume in each square of this size."""
    sums = {}
    for (x, y, *_), value, volume in zip(places, values, volumes):
        both = sums.setdefault((floor(x / size), floor(y / size)), [0, 0])
        both[0] += volume * value
        both[1] += volume
    return {key: sum_of / volume for key, (sum_of, volume) in sums.items()}


def alternating(result, h, per_cell=2, beside=None):
    """{'points' | 'cells' | 'smoothed': (least, largest value, what alternates over
    the range: root of the mean square, largest)}; without what is nearer than
    3 h to the place 'beside'."""
    now, moved, values, smoothed, volumes = zip(
        *result.points("position", "displacement", "mean_stress",
                       "smoothed_mean_stress", "volume"))
    start = [[a - b for a, b in zip(x, u)] for x, u in zip(now, moved)]
    cells = _means(now, values, volumes, h)
    found = {}
    for name, grid, size, shown in (
            ("points", _means(start, values, volumes, h / per_cell),
             h / per_cell, values),
            ("cells", cells, h, cells.values()),
            ("smoothed", _means(start, smoothed, volumes, h / per_cell),
             h / per_cell, smoothed)):
        low, high = min(shown), max(shown)
        jumps = []
        for (i, j), value in grid.items():
            around = [grid.get(key) for key in
                      ((i - 1, j), (i + 1, j), (i, j - 1), (i, j + 1))]
            near = beside and ((i + 0.5) * size - beside[0])**2 + \
                ((j + 0.5) * size - beside[1])**2 < 9 * h * h
            if None not in around and not near:
                jumps.append(abs(value - sum(around) / 4) / (high - low))
        found[name] = (low, high, sqrt(sum(a * a for a in jumps) / len(jumps)),
                       max(jumps))
    return found
