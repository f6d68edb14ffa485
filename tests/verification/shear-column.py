# debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A shear column whose base and top cut cells keeps its energy by double mapping."""

SCENE = "prm/dynamics/shear-column.prm"


def largest_energy(method, offset, end):
    """Kinetic and strain energy over that at the start, the mesh shifted."""
    rows = run(SCENE, {
        "Method/Method": method, "Time/End time": end,
        "Mesh/Lower corner": f"{offset - 1}, {-offset}",
        "Mesh/Upper corner": f"{offset + 2}, {6 - offset}"}).history()
    energies = [row["kinetic energy of nodes"] + row["strain energy"] for row in rows]
    return max(energies) / energies[0]


# The penalty of the base stores a little too; stresses of composite functions are not
# quite those of the forces.
for method, allowed in (("DM", 0.02), ("DM-G", 0.02), ("DM-C", 0.06), ("DM-GC", 0.06)):
    every = method in ("DM", "DM-GC")
    for offset in (0.1, 0.3, 0.5, 0.9) if every else (0.3,):
        for end in (100, 25) if offset == 0.3 else (100,):
            bound(f"{method}, offset {offset}, steps of {end / 500}: largest energy "
                  "over that at the start - 1",
                  largest_energy(method, offset, end) - 1, allowed)
