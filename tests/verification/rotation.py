# ranks: 1 # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A disc that spins in a ring and a pendulum on a hinge, implicit rollers both:
angular momentum, energy, period."""

from math import acos, atan2, cos, degrees, pi, sqrt

DISC = "prm/dynamics/disc.prm"


def spin(name, settings, on_ranks=1):
    """One turn."""
    result = run(DISC, {"Time/End time": "2*pi", "Time/Steps": 80, **settings},
                 on_ranks=on_ranks)
    rows = result.history()
    number(f"disc, {name}: angular momentum after a turn over that at the start",
           rows[-1]["angular_momentum_z"] / (pi / 2), 4)
    bound(f"disc, {name}: work of the ring over the kinetic energy",
          rows[-1]["work of boundaries"] / (pi / 4), 1e-4)
    bound(f"disc, {name}: energy out of balance",
          result.summary["energy"]["balance_error"], 1e-9)


spin("finite element", {"Method/Method": "finite element"}, 2)
spin("GIMP", {})
result = run(DISC, {"Time/End time": "2*pi", "Time/Steps": 80,
                    "Method/Method": "finite element",
                    "Time/Integrator": "generalised-alpha"})
bound("disc, finite element, generalised-alpha: angular momentum after a turn "
      "over that at the start - 1",
      result.history()[-1]["angular_momentum_z"] / (pi / 2) - 1, 5e-4)

# A disc turns in a hole of its own size. What turns it is of second order in
# the step with every integrator, and the table of energies is right.
hole = scene_file("hole.prm", """
Mesh/Lower corner = -1.5, -1.5 | Upper corner = 1.5, 1.5 | Cell size = 0.25
Method/Method = finite element | Strain = finite
Materials/m/Model = neo-Hookean | Young modulus = 1e4 | Poisson ratio = 0.3
Materials/m/Density = 1
Bodies/disc/Shape = disc | Centre = 0, 0 | Radius = 1.1 | Initial velocity = -2*y; 2*x
Boundaries/rim/Surface = circle | Centre = 0, 0 | Radius = 1.1 | Body side = inside
Boundaries/rim/Constraint = roller
Time/End time = 6 | Steps = 150
Output/Write = end
""")
for integrator in ("generalised-alpha", "Newmark", "Bathe", "energy-momentum"):
    result = run(hole, {"Time/Integrator": integrator})
    rows = result.history()
    first = rows[4]["angular_momentum_z"]
    name = f"hole, {integrator}"
    bound(f"{name}: change of the spin in two turns",
          max(abs(row["angular_momentum_z"] / first - 1) for row in rows[5:]),
          5e-4)
    energy = result.summary["energy"]
    bound(f"{name}: work of the rim over the energy",
          max(abs(row["work of boundaries"]) for row in rows)
          / energy["kinetic"], 2e-3)
    bound(f"{name}: energy out of balance", energy["balance_error"], 1e-4)
    text(f"{name}: told of energy",
         [one for one in result.ids() if one == "energy-growth"])


def quarter_period():
    """Of the stiff plate that swings by 90 degrees, T/4 = K / omega_0."""
    a, b, d, r = 2.5, 0.62, 0.94, 0.17
    bar, hole = a * b, pi * r * r
    inertia = bar * ((a * a + b * b) / 12 + d * d) - hole * r * r / 2
    x, y = 1., cos(pi / 4)
    for _ in range(10):
        x, y = (x + y) / 2, sqrt(x * y)
    return pi / 2 / x / sqrt(9.81 * bar * d / inertia)


for method, settings in (("finite element", {}),
                         ("GIMP", {"Method/Domain update": "frozen"}),
                         ("CPDI1", {})):
    result = run("prm/dynamics/pendulum.prm",
                 {"Method/Method": method, "Time/End time": 2.4,
                  "Time/Steps": 80, **settings})
    rows = result.history()
    angles = [(row["t"],
               atan2(row["x at upper"] + row["x at lower"],
                     -row["y at upper"] - row["y at lower"])) for row in rows]
    down = [s + (t - s) * a / (a - b)
            for (s, a), (t, b) in zip(angles, angles[1:]) if a * b < 0]
    T = 4 * quarter_period()
    bound(f"pendulum, {method}: first quarter over exact - 1",
          4 * down[0] / T - 1, 1e-3)
    bound(f"pendulum, {method}: the half from bottom to bottom over exact - 1",
          2 * (down[1] - down[0]) / T - 1, 1e-3)
    number(f"pendulum, {method}: swings to, degrees",
           -degrees(min(angle for _, angle in angles)), 4)
    bound(f"pendulum, {method}: energy out of balance",
          result.summary["energy"]["balance_error"], 1e-7)

# A segment of a disc that rocks in a bowl of its radius from 40 degrees: a rigid
# pendulum. Generalised-alpha carries the forces of a step into the next.
rocker = scene_file("rocker.prm", """
Mesh/Lower corner = -1.2, -1.2 | Upper corner = 1.2, 1.2 | Cell size = 0.1
Method/Strain = finite
Materials/rubber/Model = neo-Hookean | Young modulus = 1e6 | Poisson ratio = 0.3
Materials/rubber/Density = 2
Bodies/disc/Shape = disc | Centre = 0.013, 0 | Radius = 1
Bodies/half/Shape = half-space | Point = 0.013, -0.6 | Normal = 0, 1
Bodies/half/Rotation angle = 40 | Rotation centre = 0.013, 0
Bodies/segment/Shape = intersection | Operands = disc, half | Material = rubber
Boundaries/bowl/Surface = circle | Centre = 0.013, 0 | Radius = 1 | Body side = inside
Boundaries/bowl/Constraint = roller
Loads/weight/Type = gravity | Value = 0; -9.81
Time/Integrator = generalised-alpha | End time = 1.01 | Steps = 60
Output/Write = end
""")
# Weight and the height that the centre of the segment falls.
half_angle = acos(0.6)
area = half_angle - 0.6 * 0.8
centre = 2 * 0.8**3 / (3 * area)
falls = 2 * 9.81 * area * centre * (1 - cos(40 * pi / 180))
for method in ("GIMP", "CPDI1"):
    result = run(rocker, {"Method/Method": method})
    largest = max(row["kinetic energy"] for row in result.history())
    bound(f"rocker, {method}, generalised-alpha: largest kinetic energy over "
          "that of the fall - 1", largest / falls - 1, 0.03)
