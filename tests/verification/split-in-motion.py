# ranks: 2  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Domains that split while material moves: halves have the velocity and the
displacement of their own places.

A body without stiffness whose velocity is v = x/2 stretches without end; each
point keeps its velocity, so that x = X (1 + t/2). The lower half of the point
that a probe follows ends 0.95 of the way from the origin to (3.8, 0.2)."""

STRETCH = prm("""
Dimension = 2
Mesh/Lower corner = -12, -3 | Upper corner = 12, 3 | Cell size = 0.5
Method/Method = {method} | Strain = finite | Split domains = {split}
Materials/dust/Young modulus = 1e-6 | Poisson ratio = 0 | Density = 1
Bodies/cloud/Lower corner = -2, -1 | Upper corner = 2, 1 | Initial velocity = 0.5*x; 0
Probes/tip/Location = 1.9, 0.1 | Quantities = velocity, position
Time/Integrator = {integrator} | Steps = {steps} | End time = {end}
Output/Points = false | Mesh = false
""")


def stretch(method, split, integrator, steps, end):
    scene = folder / "stretch.prm"
    scene.write_text(STRETCH.format(method=method, split=split, steps=steps,
                                    integrator=integrator, end=end))
    result = run(scene)
    first, last = result.history()[0], result.history()[-1]
    name = f"{method}, {steps} steps, {integrator}, split {split}"
    start = 1.875  # the point nearest to the probe
    part = last["x at tip"] / (start * (1 + end / 2))
    bound(f"{name}: v = x/(2 + t), relative error",
          abs(last["v_x at tip"] / (start / 2) / part - 1), 2e-4)
    if split == "true":
        number(f"{name}: place over that of the whole", part, 3)
    else:
        bound(f"{name}: place, relative error", abs(part - 1), 2e-4)
    bound(f"{name}: kinetic energy over that at the start - 1",
          abs(last["kinetic energy"] / first["kinetic energy"] - 1), 4e-3)


for method in ("GIMP", "CPDI1", "CPDI2"):
    stretch(method, "false", "Newmark", 15, 1.5)
    stretch(method, "true", "Newmark", 60, 6)
stretch("CPDI1", "true", "generalised-alpha", 60, 6)
stretch("material point", "false", "Newmark", 3, 1.5)

# Displacements that count from a reset, of points that split later.
BAR = prm("""
Dimension = 2
Mesh/Lower corner = 0, 0 | Upper corner = 4, 1 | Cell size = 0.25
Method/Method = {method} | Strain = finite
Materials/soft/Young modulus = 1 | Poisson ratio = 0
Bodies/bar/Lower corner = 0, 0 | Upper corner = 2, 1
Grid conditions/left/Side = left | Components = x
Grid conditions/bottom/Side = bottom | Components = y
Boundaries/grip/Body = bar | Part = right | Constraint = components | Components = x
Boundaries/grip/Translation = 0: 0, 1: 0.8, 2: 1.2; 0
Stages/pull/Time/End time = 1 | Steps = 8
Stages/more/Reset displacements = true
Stages/more/Time/End time = 2 | Steps = 4
Probes/middle/Location = 1, 0.5 | Quantities = position, displacement
Output/Points = false | Mesh = false
""")
for method in ("GIMP", "CPDI1"):
    scene = folder / "bar.prm"
    scene.write_text(BAR.format(method=method))
    last = run(scene).history()[-1]
    # x = 1.6 X by now, 1.4 X at the reset.
    bound(f"{method}, displacement since a reset over that of its place - 1",
          abs(last["u_x at middle"] / (last["x at middle"] * (1 - 1.4 / 1.6)) - 1),
          1e-3)
