# ranks: 2
# debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A ring slides on a curved roller: each method and enforcement with its default
factors solves each step at once, however stiff its penalty, and has the exact
displacement. A shaft in a bearing. A cylinder pressed in a tube."""

from math import cos, degrees, log, pi, radians

# The ring is pulled outward by f r and turned by an angle, both small, over an inner
# arc that stays: u_r = A r + B/r - C r^3, with u_r = 0 on that arc, r = 0.4, and no
# stress on the outer one, r = 1.
F, ANGLE, INNER = 12, 1e-3, 0.4
LAMBDA, MODULUS = 300 / 1.3 / 0.4, 700 / 1.3 / 0.4
C = F / 8 / MODULUS
A = C * (3 * MODULUS + LAMBDA + (MODULUS - LAMBDA) * INNER**4) / (
    MODULUS + LAMBDA + (MODULUS - LAMBDA) * INNER**2)
B = C * INNER**4 - A * INNER**2
SLIDES = {**QUIET, "Method/Mesh after step": "default", "Time/Steps": 2,
          "Boundaries/inner/Displacement": "",
          "Boundaries/lower/Rotation angle": f"20 + {degrees(ANGLE)!r}*t",
          "Boundaries/upper/Rotation angle": f"20 + {degrees(ANGLE)!r}*t",
          "Loads/pull/Type": "body force",
          "Loads/pull/Value": f"{F}*t*x; {F}*t*y",
          "Exact solution/Constants":
              f"A: {A!r}, B: {B!r}, C: {C!r}, w: {ANGLE!r}",
          "Exact solution/Displacement":
              "t*(x*(A+B/(x^2+y^2)-C*(x^2+y^2))-w*y); "
              "t*(y*(A+B/(x^2+y^2)-C*(x^2+y^2))+w*x)",
          "Exact solution/Stress": ""}

for method in ("GIMP", "material point", "finite element"):
    for enforcement in ("augmented Lagrangian", "weighted", "penalty",
                        "skew Nitsche"):
        result = run("prm/boundaries/ring-roller.prm",
                     {**SLIDES, "Method/Method": method,
                      "Boundaries/inner/Enforcement": enforcement})
        case = f"{method}, {enforcement}"
        text(f"{case}: rejected steps", result.summary["rejected_steps"])
        bound(f"{case}: Newton iterations in two steps",
              result.summary["newton_iterations"], 15)
        bound(f"{case}: l2_u", result.errors["l2_u"], 0.012)

# A shaft in a bearing that does not follow the mesh. Turned at its bore, it has
# neither stress nor torque; pulled outward by f r too, its rim carries what Lame's
# solution has for u(12) = u(30) = 0.
SHAFT = prm("""
Mesh/Lower corner = 67, -43 | Upper corner = 137, 27 | Cell size = 5
Method/Strain = finite
Materials/steel/Young modulus = 210000 | Poisson ratio = 0.3
Bodies/shaft/Shape = ring | Centre = 101.3, -7.9 | Radius = 30 | Inner radius = 12
Boundaries/bore/Body = shaft | Part = inner
Boundaries/bore/Rotation angle = if(t > 1, 60 * (t - 1), 0)
Boundaries/bore/Rotation centre = 101.3, -7.9
Boundaries/bearing/Surface = circle | Centre = 101.3, -7.9 | Radius = 30
Boundaries/bearing/Body side = inside | Constraint = roller | Rotation angle = 0
Boundaries/bearing/Rotation centre = 101.3, -7.9
Time/End time = 2 | Steps = 8
""")
PULL = {"Loads/pull/Type": "body force",
        "Loads/pull/Value": "2.5*min(t, 1)*(x-101.3); 2.5*min(t, 1)*(y+7.9)"}
E, INNER, OUTER = 210000, 12, 30
TURN = cos(radians(15))  # in a step, of the body force with its place at the start
FORCE = 2 * pi * OUTER * 2.5 / 4 * (OUTER**2 - INNER**2)

scene = folder / "shaft.prm"
scene.write_text(SHAFT)
for method in ("GIMP", "finite element"):
    turned = run(scene, {"Method/Method": method})
    bound(f"shaft, {method}: stress over E",
          max(abs(s) for (stress,) in turned.points("stress") for s in stress) /
          E, 1e-11)
    text(f"shaft, {method}: rejected steps", turned.summary["rejected_steps"])
    history = run(scene, {"Method/Method": method, **PULL}).history()
    for when, row, factor in (("", history[3], 1), (" and turned", history[-1], TURN)):
        force = row["force magnitude of bearing"]
        bound(f"pulled outward{when}, {method}: force on the rim, off by",
              force / FORCE / factor - 1, 0.01)
        bound(f"pulled outward{when}, {method}: moment over force times radius",
              row["moment of bearing"] / force / OUTER, 1e-9)

# A cylinder in a smooth tube, pressed to 0.8 of its length: uniaxial strain.
scene.write_text(prm("""
Dimension = 3
Mesh/Lower corner = -0.86, -0.86, -0.86 | Upper corner = 0.94, 0.94, 1.94
Mesh/Cells = 9, 9, 14
Method/Method = finite element | Strain = finite
Materials/rubber/Model = neo-Hookean | Young modulus = 1000 | Poisson ratio = 0.3
Bodies/plug/Shape = cylinder | Axis start = 0, 0, 0 | Axis end = 0, 0, 1
Bodies/plug/Radius = 0.5
Boundaries/tube/Body = plug | Part = side | Constraint = roller
Boundaries/bottom/Body = plug | Part = bottom
Boundaries/piston/Body = plug | Part = top | Constraint = roller
Boundaries/piston/Translation = 0; 0; -0.2*t
Time/Steps = 4
Output/Points = false | Mesh = false
"""))
result = run(scene, on_ranks=1)
MU, LAMBDA, STRETCH = 1000 / 2.6, 300 / 1.3 / 0.4, 0.8
FORCE = pi / 4 * (MU * (STRETCH**2 - 1) + LAMBDA * log(STRETCH)) / STRETCH
bound("confined cylinder: force, off by",
      result.reactions["piston"][2] / FORCE - 1, 5e-4)
text("confined cylinder: rejected steps", result.summary["rejected_steps"])
