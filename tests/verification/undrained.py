# ranks: 1-2  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Undrained materials: elasticity of total stress, pressures of an oedometer,
cavities, consolidation in a later stage, strength reduction with pressures that
change or are frozen, energy."""

import csv
import math

E, NU, NU_U = 10000, 0.3, 0.495
G, K = E / (2 * (1 + NU)), E / (3 * (1 - 2 * NU))
M = E * (1 - NU) / ((1 + NU) * (1 - 2 * NU))
K_W = 2 * G / 3 * ((1 + NU_U) / (1 - 2 * NU_U) - (1 + NU) / (1 - 2 * NU))
WET = {"Materials/soil/Drainage": "undrained"}
TOTAL = {"Materials/soil/Young modulus": repr(E * (1 + NU_U) / (1 + NU)),
         "Materials/soil/Poisson ratio": NU_U}

# A footing on the left, pulled aside on the right.
block = scene_file("block.prm", f"""
Mesh/Lower corner = 0, 0 | Upper corner = 2, 1 | Cell size = 0.25
Materials/soil/Young modulus = {E} | Poisson ratio = {NU}
Bodies/block/Lower corner = 0, 0 | Upper corner = 2, 1
Grid conditions/base/Side = bottom
Grid conditions/left/Side = left | Components = x
Grid conditions/footing/Upper corner = 0.5, 1 | Lower corner = 0, 1 | Components = y
Grid conditions/footing/Displacement = 0; -0.001*t
Loads/pull/Type = side traction | Side = right | Value = 20*t; 5*t
Time/Steps = 2
Solver/Solver = direct | Tolerance = 1e-12
Probes/foot/Location = 0.6, 0.9 | Quantities = stress
Probes/corner/Location = 2, 1
""")


def differ(a, b):
    """Largest difference of probes over the largest of their kind."""
    worst = 0
    for kind in ("u_", "sigma_"):
        names = [name for name in a.probes if name.startswith(kind)]
        size = max(abs(a.probes[name]) for name in names)
        worst = max([worst] + [abs(a.probes[name] - b.probes[name]) / size
                               for name in names])
    return worst


for method in ("finite element", "material point", "GIMP", "CPDI1"):
    for strain in ("small", "finite")[:2 if method in ("finite element", "GIMP") else 1]:
        how = {"Method/Method": method, "Method/Strain": strain, **QUIET}
        bound(f"{method}, {strain} strain: undrained less total stress",
              differ(run(block, {**how, **TOTAL}), run(block, {**how, **WET})),
              1e-10)

# A column that is pressed by q; x is held.
Q, HEIGHT = 50, 4
column = scene_file("column.prm", f"""
Mesh/Lower corner = 0, 0 | Upper corner = 1, {HEIGHT} | Cell size = 0.5
Method/Mesh after step = keep
Materials/soil/Young modulus = {E} | Poisson ratio = {NU} | Drainage = undrained
Materials/soil/Density = 2
Bodies/column/Lower corner = 0, 0 | Upper corner = 1, {HEIGHT}
Bodies/column/Initial stress = -10; -20; -10; 0
Grid conditions/base/Side = bottom
Grid conditions/left/Side = left | Components = x
Grid conditions/right/Side = right | Components = x
Loads/fill/Type = side traction | Side = top | Value = 0; -20 - {Q}*min(t, 1)
Solver/Tolerance = 1e-12
Probes/top/Location = 0.5, {HEIGHT} | Kind = interpolated
Probes/middle/Location = 0.5, 2 | Quantities = stress
Stages/loaded/Time/Steps = 2
Stages/drained/Drained = soil
Stages/drained/Time/End time = 3 | Steps = 4
Output/Checkpoint every = 1 steps | Write = end
""")


def pressure(row):
    """From the horizontal stress, of which the skeleton has nu/(1-nu)."""
    across, along = -row["sigma_xx at middle"] - 10, -row["sigma_yy at middle"] - 20
    return (across - along * NU / (1 - NU)) / (1 - NU / (1 - NU))


for method in ("finite element", "material point", "GIMP", "CPDI1"):
    result = run(column, {"Method/Method": method})
    rows = result.history()
    loaded, between, last = rows[1], rows[3], rows[-1]
    exact = Q * K_W / (K_W + M)
    text(f"{method}, t", [row["t"] for row in (loaded, between, last)])
    text("  findings", ", ".join(result.found()) or "none")
    bound("  excess pressure over exact - 1", pressure(loaded) / exact - 1, 1e-10)
    bound("  half of it later", pressure(between) / exact - 0.5, 1e-10)
    bound("  none at the end", pressure(last) / exact, 1e-10)
    for name, row, modulus in (("undrained", loaded, K_W + M), ("drained", last, M)):
        bound(f"  {name} settlement over exact - 1",
              -row["u_y at top"] * modulus / (Q * HEIGHT) - 1, 1e-8)
    bound("  excess pressure in the file",
          max(abs(one) for one, in result.points("excess_pressure")), 1e-9)
history = (result.folder / "history.csv").read_text()
run(result.folder, command="resume", extra=("--from", "5"))
text("resumed while it drains", "the same history" if history ==
     (result.folder / "history.csv").read_text() else "ANOTHER history")

result = run(column, {"Stages/drained/Drained": "none"})
stress, effective, excess = zip(*result.points("stress", "effective_stress",
                                               "excess_pressure"))
bound("effective stress in the file", max(
    abs(b[i] - a[i] - (p if i in (0, 4, 8) else 0))
    for a, b, p in zip(stress, effective, excess) for i in range(9)), 1e-5)

# Pulled, until water cavitates.
S = 10
result = run(column, {
    "Loads/fill/Value": f"0; -20 + {Q}*min(t, 1)", "Stages/drained/Drained": "none",
    "Materials/soil/Cavitation suction": S, **QUIET})
bound("cavitation: suction over its limit - 1",
      pressure(result.history()[-1]) / -S - 1, 1e-10)
bound("  heave over exact - 1",
      result.probes["u_y at top"] * M / ((Q - S) * HEIGHT) - 1, 1e-8)

# Energy: that of total stress; what drains is dissipated.
shaken = {"Stages/loaded/Time/Integrator": "Newmark",
          "Stages/drained/Time/Integrator": "Newmark",
          "Stages/loaded/Time/Steps": 20, "Stages/drained/Time/Steps": 40,
          "Bodies/column/Initial stress": "", "Loads/fill/Value": f"0; -{Q}", **QUIET}
wet, total = (run(column, {**shaken, **settings}).history() for settings in (
    {"Stages/drained/Drained": "none"},
    {"Stages/drained/Drained": "none", "Materials/soil/Drainage": "drained", **TOTAL}))
for name in ("strain energy", "kinetic energy of nodes", "energy out of balance"):
    bound(f"{name}: undrained less total stress over the strain energy",
          max(abs(a[name] - b[name]) for a, b in zip(wet, total)) /
          max(row["strain energy"] for row in total), 1e-9)
rows = run(column, shaken).history()
bound("draining: energy out of balance over the strain energy",
      max(abs(row["energy out of balance"]) for row in rows) /
      max(row["strain energy"] for row in rows), 1e-9)

# Sand under a plane strain biaxial load q, in which water takes most of the mean;
# then its strength is divided by F.
PHI, LOAD = 30, 80
lam_u = K_W + 2 * G * NU / (1 - 2 * NU)
mean = 100 + LOAD / 2 - K_W * LOAD / 2 / (lam_u + G)
F = math.tan(math.radians(PHI)) / math.tan(math.asin(LOAD / 2 / mean))
number("frozen pressures: exact factor of safety", F, 6)
biaxial = scene_file("biaxial.prm", f"""
Mesh/Lower corner = 0, 0 | Upper corner = 1, 1 | Cell size = 0.5
Method/Method = finite element | Mesh after step = keep
Materials/soil/Model = Mohr-Coulomb | Friction angle = {PHI} | Dilation angle = 10
Materials/soil/Young modulus = {E} | Poisson ratio = {NU} | Drainage = undrained
Bodies/block/Lower corner = 0, 0 | Upper corner = 1, 1
Bodies/block/Initial stress = -100; -100; -100; 0
Grid conditions/base/Side = bottom | Components = y
Grid conditions/left/Side = left | Components = x
Loads/side/Type = side traction | Side = right | Value = -100; 0
Loads/fill/Type = side traction | Side = top | Value = 0; -100 - {LOAD}*min(t, 1)
Stages/loaded/Time/Steps = 2
Stages/reduced/Time/End time = 2 | Steps = 2
Strength reduction/Stage = reduced | Tolerance = 0.002
Strength reduction/Lower factor = 1.2 | Upper factor = 1.5
Study/Kind = factor of safety
""")
result = run(biaxial, {"Strength reduction/Excess pressure": "frozen"},
             command="study")
found = result.summary["cases"][0]["factor_of_safety"]
bound("  found over exact - 1", found / F - 1, 1e-3)
text("  head", plain(result.output).splitlines()[1].strip())
# Sand that dilates sucks itself together.
result = run(biaxial, {"Strength reduction/Factor": 1.5, **QUIET})
text("pressures that change, F = 1.5", result.summary["status"])
# Without dilation nothing changes the mean: both find the same.
for how in ("undrained", "frozen"):
    for factor, code in ((0.998 * F, 0), (1.002 * F, 1)):
        result = run(biaxial, {"Strength reduction/Factor": factor,
                               "Strength reduction/Excess pressure": how,
                               "Materials/soil/Dilation angle": 0,
                               **QUIET}, expect=code)
        text(f"{how}, no dilation, F = {factor / F:.3f} of it",
             result.summary["status"])

# A point: total stress across stays, or the volume.
point = scene_file("point.prm", f"""
Materials/sand/Model = Mohr-Coulomb | Friction angle = {PHI} | Dilation angle = 0
Materials/sand/Young modulus = {E} | Poisson ratio = {NU} | Drainage = undrained
Material test/Initial stress = -100, -100, -100 | Steps = 20
Material test/Legs = to strain -0.05
""")
for kind in ("triaxial drained", "triaxial undrained"):
    where = folder / kind.replace(" ", "-")
    run(point, {"Material test/Kind": kind}, command="test-material",
        extra=["--output", where], on_ranks=1)
    with open(next(where.glob("*.csv"))) as table:
        last = [{key.split(" [")[0]: float(value) for key, value in row.items()}
                for row in csv.DictReader(table)][-1]
    r = K / (K + K_W) if kind == "triaxial drained" else 0
    q = 120 / (1 - 1.2 * r / 3)
    bound(f"{kind}: q over exact - 1", last["q"] / q - 1, 1e-9)
    exact = q / 3 * (1 - r) if r else 0
    bound("  excess pressure less exact", last["excess_pressure"] - exact, 1e-6)
