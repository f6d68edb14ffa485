# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A pressure that follows: tube and sphere against the equation of their radius, a strip
blown to an arc, a block that turns under pressure from all sides, the work of a gas."""

from math import asin, cos, log, pi, sin, sqrt


def lame(young, poisson):
    return (young * poisson / (1 + poisson) / (1 - 2 * poisson),
            young / 2 / (1 + poisson))


def blown(sphere, expanded, young=1000, poisson=0.3, inner=1, outer=2, n=40):
    """Pressure of a neo-Hookean tube, or a sphere, with the inner radius 'expanded', and
    rows of R, r and dr/dR: dP/dR = -m (P - P_t)/R with m = 1, or 2, by Runge and Kutta, where P of the
    stretch s = dr/dR and P_t of r/R are stresses per area of the start."""
    la, mu = lame(young, poisson)
    m = 2 if sphere else 1

    def slopes(R, r, P):
        hoop, s = r / R, 1.
        for _ in range(30):
            s -= ((mu * (s * s - 1) + la * log(s * hoop ** m) - P * s) /
                  (2 * mu * s + la / s - P))
        P_t = (mu * (hoop * hoop - 1) + la * log(s * hoop ** m)) / hoop
        return s, -m * (P - P_t) / R

    def radii(P):
        h = (outer - inner) / n
        R, r = inner, expanded
        rows = []
        for _ in range(n):
            rows.append((R, r, slopes(R, r, P)[0]))
            a, A = slopes(R, r, P)
            b, B = slopes(R + h / 2, r + h / 2 * a, P + h / 2 * A)
            c, C = slopes(R + h / 2, r + h / 2 * b, P + h / 2 * B)
            d, D = slopes(R + h, r + h * c, P + h * C)
            R, r, P = R + h, r + h / 6 * (a + 2 * b + 2 * c + d), \
                P + h / 6 * (A + 2 * B + 2 * C + D)
        return rows + [(R, r, slopes(R, r, P)[0])], P

    low, high = -2. * young, 0.
    for _ in range(50):
        middle = (low + high) / 2
        low, high = (low, middle) if radii(middle)[1] > 0 else (middle, high)
    return -low * (inner / expanded) ** m, radii(low)[0]


def radius_of(R, rows):
    """By Hermite's cubic between rows of R, r and dr/dR."""
    h = rows[1][0] - rows[0][0]
    i = min(max(int((R - rows[0][0]) / h), 0), len(rows) - 2)
    (R0, a, s0), (_, b, s1) = rows[i:i + 2]
    w = (R - R0) / h
    return (a * (1 + 2 * w) * (1 - w) ** 2 + b * (3 - 2 * w) * w ** 2 +
            h * (s0 * w * (1 - w) ** 2 - s1 * (1 - w) * w ** 2))


# A thick tube, and a sphere, whose inner radius grows by one half.
p, radii = blown(False, 1.5)
number("tube: pressure", p, 10)
FITTED = f"""
Mesh/Type = generator | Generator = quarter_hyper_shell
Mesh/Arguments = 0, 0 : 1 : 2 : 2 : true
Mesh/Side names = inner: 0, vertical: 2, horizontal: 3
Method/Method = finite element | Strain = finite
Materials/rubber/Model = neo-Hookean | Young modulus = 1000 | Poisson ratio = 0.3
Bodies/wall/Shape = mesh
Grid conditions/vertical/Side = vertical | Components = x
Grid conditions/horizontal/Side = horizontal | Components = y
Loads/gas/Type = pressure | Side = inner | Value = {p!r} * t
Probes/inner/Location = 1, 0 | Kind = interpolated
Time/Steps = 4
Output/Mesh = false
"""
CUT = "prm/large-deformation/pressurised-tube.prm"


def compare(title, result, radii, inner, over_all):
    """The inner radius, and radii of all points, root of the mean square over the
    displacement of the inner one."""
    number(f"{title}: inner radius", 1 + result.history()[-1]["u_x at inner"], 5)
    bound(f"{title}: error of what it grew by",
          result.history()[-1]["u_x at inner"] / 0.5 - 1, inner)
    square = volume = 0
    for x, u, v in result.points("position", "displacement", "volume"):
        r = sqrt(sum(c * c for c in x))
        R = sqrt(sum((a - b) ** 2 for a, b in zip(x, u)))
        square += v * (r - radius_of(R, radii)) ** 2
        volume += v
    bound(f"{title}: error over all", sqrt(square / volume) / 0.5, over_all)


fitted = scene_file("tube.prm", FITTED)
for title, scene, settings, inner, over_all in (
        ("tube, elements, 8 x 8", fitted, {"Mesh/Refinements": 2}, 0.014, 0.013),
        ("tube, elements, 16 x 16", fitted, {"Mesh/Refinements": 3}, 0.0035, 0.0032),
        ("tube, GIMP, 20", CUT, {}, 0.0152, 0.0042),
        ("tube, GIMP, 40", CUT, {"Mesh/Cells": "40, 40"}, 0.0106, 0.0008),
        ("tube, CPDI1, 20", CUT, {"Method/Method": "CPDI1"}, 0.0116, 0.008),
        ("tube, CPDI1, 40", CUT, {"Method/Method": "CPDI1", "Mesh/Cells": "40, 40"},
         0.0062, 0.0034)):
    compare(title, run(scene, settings), radii, inner, over_all)

p, radii = blown(True, 1.5)
number("sphere: pressure", p, 10)
sphere = scene_file("sphere.prm", "Dimension = 3", FITTED.replace(
    "0, 0 : 1 : 2 : 2 :", "0, 0, 0 : 1 : 2 : 3 :").replace(
    "vertical: 2, horizontal: 3", "vertical: 2, horizontal: 3, flat: 4").replace(
    "Loads/", "Grid conditions/flat/Side = flat | Components = z\nLoads/", 1).replace(
    "Location = 1, 0", "Location = 1, 0, 0").replace("Value = ", f"Value = {p!r} * t #"))
result = run(sphere, {"Mesh/Refinements": 2, "Time/Steps": 2})
compare("sphere, elements, 8 across", result, radii, 0.05, 0.036)

# A strip held by its middle plane at both ends becomes an arc: p R = T on its inside,
# with the stretch f/sin f, and -p/2 across it in the mean.
HALF, THICK, ANGLE = 5, 0.1, 1.0
la, mu = lame(1000, 0.3)
stretch, across, radius = ANGLE / sin(ANGLE), 1., HALF / sin(ANGLE)
p = 0.
for _ in range(60):
    for _ in range(30):
        across -= ((mu * (across ** 2 - 1) + la * log(stretch * across) +
                    p / 2 * stretch * across) /
                   (2 * mu * across + la / across + p / 2 * stretch))
    tension = (mu * (stretch ** 2 - 1) + la * log(stretch * across)) * THICK / stretch
    p = tension / (radius - THICK * across / 2)
sag = radius * (1 - cos(ANGLE))
result = run(scene_file("strip.prm", f"""
Mesh/Lower corner = 0, {-THICK / 2} | Upper corner = {HALF}, {THICK / 2} | Cells = 40, 1
Method/Method = finite element | Strain = finite | Degree = 2
Materials/rubber/Model = neo-Hookean | Young modulus = 1000 | Poisson ratio = 0.3
Bodies/strip/Lower corner = 0, {-THICK / 2} | Upper corner = {HALF}, {THICK / 2}
Grid conditions/middle/Side = left | Components = x
Grid conditions/hinge/Lower corner = {HALF - 0.01}, -0.01 | Upper corner = {HALF + 0.01}, 0.01
Loads/gas/Type = pressure | Side = bottom | Value = {p!r} | Curve = t^3
Probes/middle/Location = 0, 0 | Kind = interpolated
Time/Steps = 10
"""))
row = result.history()[-1]
bound("strip: error of its rise", row["u_y at middle"] / sag - 1, 0.0025)
bound("strip: error of the tension at its middle", -row["reaction_x of middle"] / tension - 1,
      0.0025)

# A block that shrinks to s under a pressure from all sides and turns once: nothing else
# holds it, so the nodes at its middle, which are led along, take no force.
la, mu = lame(1000, 0.3)
S, C, N = "(1 - 0.2*t)", "cos(2*pi*t)", "sin(2*pi*t)"
# About the diagonal of a cube.
D, E, F = (f"({C} + (1 - {C})/3)", f"((1 - {C})/3 - {N}/sqrt(3))",
           f"((1 - {C})/3 + {N}/sqrt(3))")
TURNED = f"{S}*({C}*x - {N}*y) - x; {S}*({N}*x + {C}*y) - y"
GAS = f"-({mu!r}*({S}^2 - 1) + 2*{la!r}*log({S})) / {S}^2"
for dim, turned, gas in (
        (2, TURNED, GAS),
        (3, "; ".join(f"{S}*({a}*x + {b}*y + {c}*z) - {x}" for a, b, c, x in (
            (D, E, F, "x"), (F, D, E, "y"), (E, F, D, "z"))),
         f"-({mu!r}*({S}^2 - 1) + 3*{la!r}*log({S})) / {S}^3")):
    lower, upper = ", ".join(["-1"] * dim), ", ".join(["1"] * dim)
    result = run(scene_file("turned.prm", f"""
Dimension = {dim}
Mesh/Lower corner = {lower} | Upper corner = {upper} | Cell size = 0.5
Method/Method = finite element | Strain = finite
Materials/rubber/Model = neo-Hookean | Young modulus = 1000 | Poisson ratio = 0.3
Bodies/block/Lower corner = {lower} | Upper corner = {upper}
Grid conditions/middle/Lower corner = {", ".join(["-0.6"] * (dim - 1) + ["-0.1"])}
Grid conditions/middle/Upper corner = {", ".join(["0.6"] * (dim - 1) + ["0.1"])}
Grid conditions/middle/Displacement = {turned}
Loads/gas/Type = pressure | Body = block | Value = {gas}
Exact solution/Displacement = {turned}
Time/Steps = 20
Solver/Tolerance = 1e-12
"""))
    largest = max(abs(row[f"reaction_{x} of middle"]) for row in result.history()
                  for x in "xyz"[:dim])
    bound(f"block turned in {dim}D: displacement", result.errors["l2_u"], 1e-10)
    bound(f"block turned in {dim}D: force at its middle", largest, 1e-8)

# The pressure begins when the block has turned by itself: its normals have, too.
result = run(scene_file("stages.prm", f"""
Mesh/Lower corner = -1, -1 | Upper corner = 1, 1 | Cell size = 0.5
Method/Method = finite element | Strain = finite
Materials/rubber/Model = neo-Hookean | Young modulus = 1000 | Poisson ratio = 0.3
Bodies/block/Lower corner = -1, -1 | Upper corner = 1, 1
Grid conditions/middle/Lower corner = -0.6, -0.1 | Upper corner = 0.6, 0.1
Grid conditions/middle/Displacement = {TURNED}
Loads/gas/Type = pressure | Body = block | Value = {GAS}
Exact solution/Displacement = {TURNED}
Solver/Tolerance = 1e-12
Stages/turns/Loads = none
Stages/turns/Time/End time = 1 | Steps = 4
Stages/pressed/Loads = gas
Stages/pressed/Time/End time = 2 | Steps = 4
""".replace("(1 - 0.2*t)", "(1 - 0.2*max(t - 1, 0))").replace(
    "2*pi*t", "pi/3*min(t, 1)")))
bound("pressure in a later stage: displacement", result.errors["l2_u"], 1e-10)

# A free block that a gas begins to press: the work of the gas is p times the area it
# took, and with 'energy-momentum' that is all the energy there is. A gas all around does
# not push a block away, nor turn it.
for dim, method, integrator, work, balance, pushes in (
        (2, "finite element", "energy-momentum", 1e-7, 1e-12, 1e-12),
        (2, "finite element", "generalised-alpha", 1e-7, 3e-3, 1e-12),
        (2, "finite element", "Newmark", 1e-7, 3e-3, 1e-12),
        (2, "finite element", "Bathe", 1e-7, 1e-3, 1e-12),
        (2, "GIMP", "energy-momentum", 5e-4, 1e-12, 2e-3),
        (3, "finite element", "energy-momentum", 1e-7, 1e-12, 1e-12),
        (3, "finite element", "generalised-alpha", 1e-5, 5e-3, 1e-12)):
    lower, upper = ", ".join(["0"] * dim), ", ".join(["1"] * dim)
    around = [", ".join([number] * dim) for number in ("-0.5", "1.5")]
    result = run(scene_file("pressed.prm", f"""
Dimension = {dim}
Mesh/Lower corner = {around[0] if method == "GIMP" else lower} | Cell size = 0.25
Mesh/Upper corner = {around[1] if method == "GIMP" else upper}
Method/Method = {method} | Strain = finite
Materials/rubber/Young modulus = 1000 | Poisson ratio = 0.3 | Density = 1
Bodies/block/Lower corner = {lower} | Upper corner = {upper}
Bodies/block/Initial velocity = {"-5*y; 5*x" if dim == 2 else "-5*y; 5*x; 0"}
Loads/gas/Type = pressure | Body = block | Value = 100
Time/Integrator = {integrator} | End time = 0.05 | Steps = 25
Solver/Tolerance = 1e-11
Output/Mesh = false
"""))
    first, last = result.history()[0], result.history()[-1]
    taken = 1 - sum(v for v, in result.points("volume"))
    name = f"gas, {dim}D, {method}, {integrator}"
    at_least(f"{name}: taken", taken, 0.05)
    bound(f"{name}: work over p less that", last["external work"] / 100 - taken, work)
    bound(f"{name}: energy out of balance",
          result.summary["energy"]["balance_error"], balance)
    bound(f"{name}: change of the momentum over p t", max(
        abs(last[what] - first[what]) for what in ("momentum_x", "momentum_y")) / 5, pushes)
    if integrator == "energy-momentum" and dim == 2:
        bound(f"{name}: of the angular momentum",
              (last["angular_momentum_z"] - first["angular_momentum_z"]) / 5, 4 * pushes)

# The tangent: residuals of Newton's method fall to their squares.
result = run(fitted, {"Mesh/Refinements": 2, "Time/Steps": 2, "Solver/Tolerance": 1e-12,
                      "Output/Residuals": "true"})
for line in result.output.splitlines():
    if line.split()[:1] == ["residuals"]:
        r = list(map(float, line.split()[1:]))
        bound("tangent: residual over the square of the one before", r[3] / r[2] ** 2, 1)

# Two ranks and one.
for name, scene, settings in (
        ("sphere", sphere, {"Mesh/Refinements": 1}),
        ("tube, CPDI1", CUT, {"Method/Method": "CPDI1", "Time/Steps": 5})):
    one, two = (run(scene, settings, on_ranks=n).history()[-1] for n in (1, 2))
    bound(f"{name}, two ranks less one", max(abs(two[key] - one[key]) / max(1, abs(one[key]))
                                             for key in one), 1e-10)

# At small strain it is a traction along the normal of the start, which is out of the
# body whatever side the scene names.
PRESSURE = {"Loads/pressure/Type": "pressure", "Loads/pressure/Value": 1}
dead, *errors = (run("prm/hard-cases/thick-cylinder-gimp.prm", settings).errors["l2_u"]
                 for settings in ({}, PRESSURE,
                                  {**PRESSURE, "Loads/pressure/Body side": "inside"}))
for error in errors:
    bound("small strain: error of Lame's displacement over that with a traction",
          error / dead - 1, 1e-8)
