# ranks: 1 # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Bars that vibrate with large amplitude or yield: energy over 100 periods."""

hencky = "prm/dynamics/hencky-bar.prm"


def energies(rows):
    return [row["kinetic energy of nodes"] + row["strain energy"]
            for row in rows]


def imbalance(rows, names=("kinetic energy of nodes", "strain energy")):
    """The largest energy out of balance, over the largest energy."""
    return (max(abs(row["energy out of balance"]) for row in rows)
            / max(row[name] for row in rows for name in names))


result = run(hencky)
text("energy and momentum, T/20", result.summary["status"])
bound("energy and momentum, T/20: out of balance",
      imbalance(result.history()), 1e-10)
result = run(hencky, {"Time/Integrator": "Newmark"}, expect=None)
told = [one for one in result.ids() if one == "energy-growth"]
text("average acceleration, T/20: told where it starts", len(told))
text("average acceleration, T/20", result.summary["status"])
total = energies(result.history())
at_least("average acceleration, T/20: largest energy, times the "
         "first", max(total) / total[0], 100)
result = run(hencky, {"Time/Integrator": "Newmark", "Time/Steps": 5000})
total = energies(result.history())
change = 100 * max(abs(value / total[0] - 1) for value in total)
at_least("average acceleration, T/50: change of energy, %", change, 1)
bound("average acceleration, T/50: change of energy, %", change, 10)
for integrator in ("generalised-alpha", "Bathe"):
    total = energies(run(hencky, {"Time/Integrator": integrator}).history())
    number(f"{integrator}, T/20: energy at the end, %",
           100 * total[-1] / total[0], 3)

# Its end is moved, under a growing load. Forces are as large as to have
# round-off of 1e-12 here and in the plastic bar.
rounded = {"Solver/Tolerance": 1e-11}
rows = run(hencky, {**rounded, "Time/Steps": 100, "Time/End time": 10,
                    "Bodies/bar/Initial velocity": "0; 0",
                    "Grid conditions/held/Displacement": "0.01*t^2; 0",
                    "Loads/growing/Type": "body force",
                    "Loads/growing/Value": "0.01*t; 0"}).history()
number("moved end: work of boundaries over that of the load",
       rows[-1]["work of boundaries"] / rows[-1]["external work"], 3)
bound("moved end, energy and momentum: out of balance", imbalance(rows), 1e-10)

# Plastic bars.
bar = "prm/dynamics/bar.prm"
plastic = {"Materials/elastic/Model": "von Mises", "Time/Steps": 400,
           "Time/End time": 40, "Materials/elastic/Poisson ratio": 0.3}
names = ("kinetic energy of nodes", "strain energy", "plastic dissipation")
yields = "Materials/elastic/Uniaxial yield stress"
rows = run(bar, {**plastic, yields: "0: 0.005, 1: 0.1"}).history()
number("plastic bar, small strain: dissipated, % of the first energy",
       100 * rows[-1]["plastic dissipation"] / energies(rows)[0], 3)
bound("plastic bar, small strain, average acceleration: out of balance",
      imbalance(rows, names), 1e-10)
rows = run(hencky, {**plastic, **rounded, yields: "0: 0.2, 1: 1"}).history()
number("plastic bar, finite strain: dissipated, % of the first energy",
       100 * rows[-1]["plastic dissipation"] / energies(rows)[0], 3)
bound("plastic bar, finite strain, energy and momentum: out of balance",
      imbalance(rows, names), 1e-10)
