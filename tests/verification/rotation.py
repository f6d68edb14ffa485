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
HOLE = """
subsection Mesh
  set Lower corner = -1.5, -1.5
  set Upper corner = 1.5, 1.5
  set Cell size = 0.25
end
subsection Method
  set Method = finite element
  set Strain = finite
end
subsection Materials
  subsection m
    set Model = neo-Hookean
    set Young modulus = 1e4
    set Poisson ratio = 0.3
    set Density = 1
  end
end
subsection Bodies
  subsection disc
    set Shape = disc
    set Centre = 0, 0
    set Radius = 1.1
    set Initial velocity = -2*y; 2*x
  end
end
subsection Boundaries
  subsection rim
    set Surface = circle
    set Centre = 0, 0
    set Radius = 1.1
    set Body side = inside
    set Constraint = roller
  end
end
subsection Time
  set End time = 6
  set Steps = 150
end
subsection Output
  set Write = end
end
"""
hole = folder / "hole.prm"
hole.write_text(HOLE)
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
ROCKER = """
subsection Mesh
  set Lower corner = -1.2, -1.2
  set Upper corner = 1.2, 1.2
  set Cell size = 0.1
end
subsection Method
  set Strain = finite
end
subsection Materials
  subsection rubber
    set Model = neo-Hookean
    set Young modulus = 1e6
    set Poisson ratio = 0.3
    set Density = 2
  end
end
subsection Bodies
  subsection disc
    set Shape = disc
    set Centre = 0.013, 0
    set Radius = 1
  end
  subsection half
    set Shape = half-space
    set Point = 0.013, -0.6
    set Normal = 0, 1
    set Rotation angle = 40
    set Rotation centre = 0.013, 0
  end
  subsection segment
    set Shape = intersection
    set Operands = disc, half
    set Material = rubber
  end
end
subsection Boundaries
  subsection bowl
    set Surface = circle
    set Centre = 0.013, 0
    set Radius = 1
    set Body side = inside
    set Constraint = roller
  end
end
subsection Loads
  subsection weight
    set Type = gravity
    set Value = 0; -9.81
  end
end
subsection Time
  set Integrator = generalised-alpha
  set End time = 1.01
  set Steps = 60
end
subsection Output
  set Write = end
end
"""
rocker = folder / "rocker.prm"
rocker.write_text(ROCKER)
# Weight and the height that the centre of the segment falls.
half_angle = acos(0.6)
area = half_angle - 0.6 * 0.8
centre = 2 * 0.8**3 / (3 * area)
falls = 2 * 9.81 * area * centre * (1 - cos(40 * pi / 180))
for method in ("finite element", "GIMP", "CPDI1"):
    result = run(rocker, {"Method/Method": method})
    largest = max(row["kinetic energy"] for row in result.history())
    bound(f"rocker, {method}, generalised-alpha: largest kinetic energy over "
          "that of the fall - 1", largest / falls - 1, 0.03)
