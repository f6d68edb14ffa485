# debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Bodies come and go: settlement and heave of a confined column, an embankment
in lifts, a tunnel that is dug and lined."""

SCENE = "prm/geotechnics/fill-and-dig.prm"
# Constrained modulus, and settlements by the load of the fill and by its own
# weight.
M = 20e3 * 0.75 / (1.25 * 0.5)
BY_LOAD, BY_ITSELF = 200 * 10 / M, 200 * 10 / (2 * M)


def check(name, settings, limit):
    alone, filled, dug = run(SCENE, settings).history()
    bound(f"{name}: settlements and heave over the exact ones - 1", max(
        abs(value / exact - 1) for value, exact in (
            (alone["u_y at ground"], -BY_ITSELF),
            (filled["u_y at ground"], -BY_LOAD),
            (filled["u_y at fill"], -BY_LOAD - BY_ITSELF),
            (dug["u_y at ground"], BY_LOAD))), limit)
    stages = (alone, 20), (filled, 40), (dug, 20)
    bound(f"{name}: mass", max(abs(row["mass"] - mass) for row, mass in stages),
          1e-10)
    bound(f"{name}: reaction of the base", max(
        abs(row["reaction_y of base"] / (10 * mass) - 1)
        for row, mass in stages), 1e-8)


check("finite element", {}, 1e-10)
for method in ("material point", "GIMP", "CPDI1", "CPDI2"):
    check(f"{method}, small displacement", {"Method/Method": method}, 1e-10)
check("finite element, Q2", {"Method/Degree": 2}, 1e-10)
# Points that move through the mesh: the strain is 0.4 %, its square is missed.
check("GIMP that moves", {"Method/Method": "GIMP",
                          "Method/Mesh after step": "reset"}, 0.02)

# Nodes that move with the material: the fill fills what the ground has settled.
rows = run(SCENE, {"Method/Strain": "finite",
                   "Method/Mesh after step": "follow material"}).history()
settled = -rows[0]["u_y at ground"]
bound("finite strain: mass filled less 2 (20 + settlement)",
      rows[1]["mass"] - 2 * (20 + settled), 1e-10)
for row in rows:
    bound("finite strain: reaction of the base over the weight - 1",
          row["reaction_y of base"] / (10 * row["mass"]) - 1, 1e-8)
bound("finite strain: heave over that of small strain - 1",
      rows[2]["u_y at ground"] / BY_LOAD - 1, 0.03)

# Dug out at once, in dynamics, the column swings to twice the heave at 2 L/c,
# c = sqrt(M/rho).
period = 4 * 10 / (M / 2) ** 0.5
for name, settings in (("finite element", {}),
                       ("GIMP", {"Method/Method": "GIMP"})):
    result = run(SCENE, {**settings, "Mesh/Cell size": 0.5,
                         "Stages/dug/Time/Integrator": "Newmark",
                         "Stages/dug/Time/End time": 2 + period,
                         "Stages/dug/Time/Steps": 80})
    rows = result.history()[2:]
    highest = max(rows, key=lambda row: row["u_y at ground"])
    bound(f"{name}, dynamic: largest heave over twice the static one - 1",
          highest["u_y at ground"] / (2 * BY_LOAD) - 1, 0.02)
    bound(f"{name}, dynamic: its time over half a period - 1",
          (highest["t"] - 2) / (period / 2) - 1, 0.03)
    bound(f"{name}, dynamic: energy out of balance",
          result.summary["energy"]["balance_error"], 1e-10)

# A body that is taken away in a stage with inertia.
result = run(SCENE, {"Stages/filled/Time/Integrator": "Newmark",
                     "Stages/filled/Time/Steps": 20,
                     "Stages/dug/Time/Integrator": "Newmark",
                     "Stages/dug/Time/Steps": 20})
bound("two dynamic stages: energy out of balance",
      result.summary["energy"]["balance_error"], 1e-10)
bound("two dynamic stages: mass at the end",
      result.history()[-1]["mass"] - 20, 1e-10)

# A probe on the ground, which rises by 4 t^2 / M * (20 z - z^2 / 2) under the fill
# and by 4 t^2 / M * 50 without it, where the place is above the cells.
result = run(SCENE, {"Method/Method": "material point",
                     "Method/Mesh after step": "reset",
                     "Loads/weight/Value": "0; 2*t^2",
                     "Stages/alone/Bodies": "ground, fill",
                     "Stages/filled/Bodies": "ground",
                     "Stages/filled/Reset displacements": "false",
                     "Stages/dug/Reset displacements": "false"})
for row, height in zip(result.history(), (150, 50, 50)):
    bound(f"a fill is taken away: rise of the ground at t = {row['t']:g} over the "
          "exact one - 1",
          row["u_y at ground"] / (4 * row["t"] ** 2 * height / M) - 1, 0.02)
bound("a fill is taken away: notes of the probe that leaves the cells - 1",
      (result.folder / "log.txt").read_text().count(
          "probe 'ground' has left the cells") - 1, 0)

# An embankment on ground at rest: the ground carries what is there.
result = run("prm/geotechnics/staged-embankment.prm")
rows = result.history()
bound("embankment: ground at rest moves", rows[0]["u_y at ground"], 1e-12)
for row, area in zip(rows, (0, 16, 24)):
    weight = 9.81 * (1.6 * 120 + 1.9 * area)
    bound("embankment: reaction of the base over the weight - 1",
          row["reaction_y of base"] / weight - 1, 1e-7)
number("embankment: settlement by the first lift", -rows[1]["u_y at ground"], 2)
number("embankment: settlement by both", -rows[2]["u_y at ground"], 2)

# A tunnel: what is dug out weighs no more, the lining does.
rows = run("prm/geotechnics/dug-tunnel.prm").history()
pi = 3.141592653589793
# The rim of what is dug out later cuts cells.
bound("tunnel: ground at rest moves", abs(rows[0]["u_y at crown"]), 1e-6)
for row, weight in zip(rows, (
        8000, 8000 - 90 * pi, 8000 - 90 * pi + 60 * pi,
        8000 - 90 * pi + 60 * pi + 300)):
    bound("tunnel: reaction of the base over the weight - 1",
          row["reaction_y of base"] / weight - 1, 1e-7)
for key in ("u_y at crown", "u_y at surface"):
    number(f"tunnel dug: {key}", rows[1][key], 2)
