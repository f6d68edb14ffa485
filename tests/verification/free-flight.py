# ranks: 1 # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A free block flies and spins: what every basis and transfer keeps."""

MASS, SPEED, TURNS = 4., 0.4, 10


def fly(name, settings):
    result = run("prm/dynamics/free-flight.prm", settings)
    rows = result.history()
    momentum = [row["momentum_x"] for row in rows]
    angular = [row["angular_momentum_z"] for row in rows]
    kinetic = [row["kinetic energy"] for row in rows]
    bound(f"{name}: momentum over that at the start - 1",
          max(abs(p / (MASS * SPEED) - 1) for p in momentum), 1e-12)
    bound(f"{name}: energy out of balance",
          result.summary["energy"]["balance_error"], 1e-10)
    # The spin about the centre, which flies at y = 4; the rest is the flight's.
    spin = [L + MASS * SPEED * 4 for L in angular]
    flight = MASS * SPEED ** 2 / 2
    number(f"{name}: spin after {TURNS} turns over that at the start",
           spin[-1] / spin[0], 3)
    number(f"{name}: kinetic energy of the spin over that at the start",
           (kinetic[-1] - flight) / (kinetic[0] - flight), 3)
    return result


def keep_all(name, settings):
    """Angular momentum and energy stay, too."""
    result = fly(name, settings)
    rows = result.history()
    angular = [row["angular_momentum_z"] for row in rows]
    bound(f"{name}: angular momentum over that at the start - 1",
          max(abs(L / angular[0] - 1) for L in angular), 1e-10)
    total = [row["kinetic energy of nodes"] + row["strain energy"] for row in rows]
    bound(f"{name}: energy over that at the start - 1",
          max(abs(E / total[0] - 1) for E in total), 1e-10)


keep_all("finite element", {"Method/Method": "finite element"})
for method in ("GIMP", "CPDI1", "CPDI2"):
    fly(f"{method}, APIC", {"Method/Method": method})
# Points a quarter of a cell apart cross the mesh more roughly: one turn.
turn = {"Time/End time": 3.14159265, "Time/Steps": 40}
TURNS = 1
fly("material point, APIC", {"Method/Method": "material point", **turn})
for transfer in ("APIC", "FLIP", "PIC", "blend", "FMPM"):
    fly(f"GIMP, {transfer}", {"Time/Velocity transfer": transfer, **turn})

# Bodies of two velocities share a column of cells: nodes have the momentum of
# the points.
rows = run("prm/dynamics/free-flight.prm", {
    "Method/Method": "finite element", "Bodies/block/Upper corner": "3.2, 5",
    "Bodies/block/Initial velocity": "1; 0", "Bodies/rest/Lower corner": "3.2, 3",
    "Bodies/rest/Upper corner": "4, 5", "Time/End time": 1e-3,
    "Time/Steps": 1}).history()
bound("finite element, two bodies in a cell: momentum over that of the points - 1",
      abs(rows[0]["momentum_x"] / (1.2 * 2) - 1), 1e-12)
