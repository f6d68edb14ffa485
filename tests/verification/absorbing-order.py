# ranks: 1 # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""What dashpots of the right impedance send back of a pulse is an error of mesh
and step: energy left when the pulse has gone through the base of a column, over
the work of the load."""

from math import log2

left = []
for n in (1, 2, 4):
    h = 0.25 / n
    last = run("prm/phuong-2023/column-viscous-fe.prm",
               {"Mesh/Cell size": h, "Mesh/Upper corner": f"{h}, 20",
                "Bodies/column/Upper corner": f"{h}, 20",
                "Time/Steps": 400 * n}).history()[-1]
    left.append((last["kinetic energy of nodes"] + last["strain energy"])
                / last["external work"])
    number(f"h = {h}: reflected energy", left[-1], 2)
for n, m in ((0, 1), (1, 2)):
    at_least(f"order of reflected energy, {n}", log2(left[n] / left[m]), 2)
