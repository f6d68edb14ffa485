# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""What of a field of points in 2D alternates between neighbours, on a mesh of
squares with a vertex at the origin.

A value minus the mean of its four neighbours, over the range of the field: of
points ('points'; neighbours are those of the start), of means over cells
('cells'), and of the field smoothed over nodes ('nodes': the mean of a node by
volume and shape function, interpolated to points again).
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


def _nodes(place, h):
    """Nodes of the cell of a place and their bilinear functions."""
    i, j = floor(place[0] / h), floor(place[1] / h)
    p, q = place[0] / h - i, place[1] / h - j
    return (((i, j), (1 - p) * (1 - q)), ((i + 1, j), p * (1 - q)),
            ((i, j + 1), (1 - p) * q), ((i + 1, j + 1), p * q))


def smoothed(places, values, volumes, h):
    sums = {}
    for place, value, volume in zip(places, values, volumes):
        for node, shape in _nodes(place, h):
            both = sums.setdefault(node, [0, 0])
            both[0] += shape * volume * value
            both[1] += shape * volume
    return [sum(shape * sums[node][0] / sums[node][1]
                for node, shape in _nodes(place, h) if sums[node][1])
            for place in places]


def alternating(result, h, per_cell=2, field="mean_stress", beside=None):
    """{'points' | 'cells' | 'nodes': (least, largest value, what alternates over
    the range: root of the mean square, largest)}; without what is nearer than
    3 h to the place 'beside'."""
    now, moved, values, volumes = zip(
        *result.points("position", "displacement", field, "volume"))
    start = [[a - b for a, b in zip(x, u)] for x, u in zip(now, moved)]
    cells = _means(now, values, volumes, h)
    nodes = smoothed(now, values, volumes, h)
    found = {}
    for name, grid, size, shown in (
            ("points", _means(start, values, volumes, h / per_cell),
             h / per_cell, values),
            ("cells", cells, h, cells.values()),
            ("nodes", _means(start, nodes, volumes, h / per_cell),
             h / per_cell, nodes)):
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
