# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Slides in sensitive clay that follow one another, and clay that keeps its
strength, in which there are none."""

SCENE = "prm/geotechnics/retrogression.prm"
CREST = 25


def slides(result):
    """How many blocks of ground below the crest slid and stayed whole, and from
    where on all of it moved."""
    columns = {}
    for (x, y, _), (u, v, _), strain in result.points(
            "position", "displacement", "plastic_strain"):
        if y - v > 4.5 and x - u < CREST:
            columns.setdefault(int(x - u), []).append((u, strain))
    mean = {k: [sum(one) / len(of) for one in zip(*of)]
            for k, of in columns.items()}
    moved = [mean[k][0] > 0.5 for k in range(CREST)]
    whole = [moved[k] and mean[k][1] < 0.5 for k in range(CREST)]
    return (sum(b and not a for a, b in zip([False] + whole, whole)),
            moved.index(True) if any(moved) else CREST)


QUICK = {"Output/Write": "end", "Output/Mesh": "false"}
result = run(SCENE, QUICK)
count, head = slides(result)
at_least("slides", count, 2)
bound("way back from the crest over 13 m, - 1", (CREST - head) / 13 - 1, 0.35)
# The second one begins when the first has gone far.
first, second = (next(row["t"] for row in result.history()
                      if row[f"u_x at {name}"] > 0.5)
                 for name in ("crest", "behind"))
at_least("time between the first and the second", second - first, 1)
bound("displacement far behind", result.probes["u_x at far behind"], 0.5)

result = run(SCENE, {**QUICK, "Mesh/Cell size": 1,
                     "Materials/clay/Cohesion": 20,
                     "Materials/clay/Softening length": 0})
text("slides in clay that keeps 20 kPa", slides(result)[0])
bound("displacement of its crest", result.probes["u_x at crest"], 0.5)
