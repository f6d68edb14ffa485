# ranks: 1 # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""One element with E = rho = 1, u'' = -3 u: forces that are there at once, for
they depend on velocities, begin with a stage or come from a base that
accelerates, do not cost the second order in time."""

from math import cos, exp, sin, sqrt

SCENE = prm("""
Mesh/Lower corner = 0, 0 | Upper corner = 1, 1 | Cell size = 1
Method/Method = finite element | Mesh after step = keep
Materials/m/Young modulus = 1 | Poisson ratio = 0 | Density = 1
Bodies/b/Lower corner = 0, 0 | Upper corner = 1, 1
{body}
Grid conditions/l/Side = left | Components = x
{base}
Grid conditions/y/Side = bottom | Components = y
Grid conditions/top/Side = top | Components = y
Grid conditions/
{condition}
/
{rest}
Probes/tip/Location = 1, 0.5 | Kind = interpolated
""")

OMEGA = sqrt(3)


def time(integrator, end, steps):
    return prm(f"""
Time/Integrator = {integrator} | End time = {end} | Steps = {steps}
""")


def damped(t):
    frequency = sqrt(OMEGA ** 2 - 0.25)  # u'' = -u' - 3 u
    return 0.01 * exp(-t / 2) * sin(frequency * t) / frequency


def in_one(integrator, steps):
    return time(integrator, 4, steps)


def load_begins(integrator, steps):
    return prm(f"""
Loads/p/Type = side traction | Side = right | Value = 0.01; 0
Stages/a/Loads = none
{time(integrator, 1, 2)}
Stages/b/Loads = p
{time(integrator, 5, steps)}
""")


def hold_ends(integrator, steps):
    return prm(f"""
Stages/pull/
{time("quasi-static", 1, 1)}
Stages/held/
{time(integrator, 2, 2)}
Stages/free/Grid conditions = l, y, top
{time(integrator, 6, steps)}
""")


held = prm("""
r/Side = right | Components = x | Displacement = 0.01 * min(t, 1); 0
""")
for name, parts, rest, exact in (
        ("mass damping", {"body": "set Initial velocity = 0.01 * x; 0\n"
                                  "    set Mass damping = 1"}, in_one, damped),
        ("a load begins with a stage", {}, load_begins,
         lambda t: 0.01 * (1 - cos(OMEGA * (t - 1))) if t > 1 else 0.),
        ("a condition ends with a stage", {"condition": held}, hold_ends,
         lambda t: 0.01 * cos(OMEGA * (t - 2)) if t > 2 else 0.01 * min(t, 1)),
        ("the base accelerates",
         {"base": "set Displacement = 0.005 * t^2; 0"}, in_one,
         lambda t: 0.005 * t * t - 0.005 * (1 - cos(OMEGA * t))),
        ("the base jerks",
         {"base": "set Displacement = 0.005 * t^3; 0"}, in_one,
         lambda t: (0.005 * t**3 - 0.01 * t * (1 + 0.5) + 0.015 / OMEGA * sin(OMEGA * t)))):
    for integrator in ("Newmark", "generalised-alpha", "Bathe",
                       "energy-momentum"):
        errors = []
        for steps in (80, 160):
            scene = folder / "scene.prm"
            scene.write_text(SCENE.format(**{
                "body": "", "base": "", "condition": "",
                "rest": rest(integrator, steps), **parts}))
            errors.append(max(abs(row["u_x at tip"] - exact(row["t"]))
                              for row in run(scene).history()))
        number(f"{name}, {integrator}: largest error over 0.01, 80 steps",
               errors[0] / 0.01, 2)
        number(f"{name}, {integrator}: over that of 160 steps",
               errors[0] / errors[1], 2)
