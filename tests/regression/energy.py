# ranks: 1 2 # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A run whose energy explodes does not end well; Nitsche's method on walls that
cut cells at an angle keeps it, and where it shakes a column nothing is told. The waves of oblique-inclined.prm, 100 steps. A
column that vibrates between walls keeps it by default, on mesh lines or not."""

from math import cos, radians, sin

scene = "prm/dynamics/oblique-inclined.prm"
short = {"Time/Steps": 100, "Time/End time": 2.5, "Method/Aggregate below": 0}


def walls(enforcement, factor):
    return {**short,
            **{f"Boundaries/{wall}/{key}": value for wall in ("left", "right")
               for key, value in (("Enforcement", enforcement),
                                  ("Nitsche factor", factor))}}


def energies(result):
    return [row["kinetic energy of nodes"] + row["strain energy"]
            for row in result.history()]


for name, factor in (("symmetric Nitsche", 2), ("skew Nitsche", 2)):
    failed = run(scene, walls(name, factor), expect=1)
    message = failed.summary["message"]
    total = energies(failed)
    title = f"{name}, factor {factor}"
    text(f"{title}: status", failed.summary["status"])
    text("  source", message.split("source: ")[1])
    at_least("  energy over that of the start", total[-1] / total[0], 100)
    bound("  and the step before", total[-2] / total[0], 101)

for name, factor, aggregate in (
        ("symmetric Nitsche", 10, 0.1), ("symmetric Nitsche", 20, 0),
        ("skew Nitsche", 10, 0.1), ("skew Nitsche", 10, 0),
        ("augmented Lagrangian", 10, 0.1)):
    kept = run(scene, {**walls(name, factor),
                       "Method/Aggregate below": aggregate})
    total = energies(kept)
    title = f"{name}, factor {factor}, aggregate below {aggregate}"
    text(f"{title}: status", kept.summary["status"])
    bound("  largest energy over that of the start", max(total) / total[0],
          1 + 1e-3)  # walls lend some
    bound("  work of walls, over that",
          max(abs(row["work of boundaries"]) for row in kept.history())
          / total[0], 1e-3)

COLUMN = """
subsection Mesh
  set Lower corner = {0}, {0}
  set Upper corner = {1}, {1}
  set Cell size    = 0.5
end
subsection Method
  set Method = finite element
  set Degree = {degree}
end
subsection Materials
  subsection soil
    set Young modulus = 20000
    set Poisson ratio = 0.25
    set Density       = 2
  end
end
subsection Bodies
  subsection column
    set Lower corner     = 0, 0
    set Upper corner     = 1, 4
    set Rotation angle   = {angle}
    set Rotation centre  = 0, 0
    set Initial velocity = {velocity}
  end
end
subsection Boundaries
  {boundaries}
end
subsection Time
  set Integrator = Newmark
  set End time   = 4
  set Steps      = {steps}
end
subsection Output
  set Points = false
  set Mesh   = false
end
"""
PART = """subsection {part}
    set Body       = column
    set Part       = {part}
    set Constraint = {constraint}
  end
  """
column = folder / "column.prm"
for offset, angle, degree, steps in ((0, 0, 1, 1000), (0.13, 17, 1, 500),
                                     (0.13, 17, 2, 500)):
    c, s = cos(radians(angle)), sin(radians(angle))
    along = f"1e-3*({c!r}*y - {s!r}*x)"
    column.write_text(COLUMN.format(
        -3.5 - offset, 6.5 - offset, degree=degree, angle=angle, steps=steps,
        velocity=f"{s!r}*{along}; -{c!r}*{along}", boundaries="".join(
            PART.format(part=part, constraint=constraint) for part, constraint in
            (("bottom", "fixed"), ("left", "roller"), ("right", "roller")))))
    total = energies(run(column, on_ranks=1))
    title = f"column at {offset}, {angle} degrees, degree {degree}"
    bound(f"{title}: energy over that of the start - 1",
          max(abs(e / total[0] - 1) for e in total), 0.01)

# A base that moves by a condition of nodes gives what it gives, in coarse steps too.
moving_base = folder / "moving-base.prm"
moving_base.write_text("""
subsection Mesh
  set Lower corner = 0, 0
  set Upper corner = 2, 0.5
  set Cell size    = 0.25
end
subsection Method
  set Method = finite element
end
subsection Materials
  subsection bar
    set Young modulus = 1
    set Poisson ratio = 0
    set Density       = 1
  end
end
subsection Bodies
  subsection bar
    set Lower corner = 0, 0
    set Upper corner = 2, 0.5
  end
end
subsection Grid conditions
  subsection base
    set Side         = left
    set Displacement = 0.001*sin(0.5*t)*(1-exp(-0.1*t)); 0
  end
end
subsection Time
  set Integrator = Newmark
  set End time   = 60
  set Steps      = 400
end
subsection Output
  set Points = false
  set Mesh   = false
end
""")
result = run(moving_base, on_ranks=1)
text("moving base: energy of boundaries", [
    one for one in result.found() if one.startswith("energy")])
energy = result.summary["energy"]
bound("moving base: out of balance, of the largest", energy["balance_error"], 0.03)

# One that moves by a surface as well, where a step turns its force by much.
shaken = folder / "shaken.prm"
shaken.write_text("""
subsection Mesh
  set Cell size = 0.5
end
subsection Method
  set Method = finite element
end
subsection Materials
  subsection soil
    set Young modulus = 2.6
    set Poisson ratio = 0.3
    set Density       = 1
  end
end
subsection Bodies
  subsection column
    set Lower corner        = 0, 0
    set Upper corner        = 2, 5
    set Damping ratio       = 0.1
    set Damping frequencies = 0.0125, 0.15
  end
end
subsection Boundaries
  subsection base
    set Body        = column
    set Part        = bottom
    set Translation = 0.01*sin(0.15708*t); 0
  end
  subsection left
    set Body       = column
    set Part       = left
    set Constraint = components
    set Components = y
  end
  subsection right
    set Body       = column
    set Part       = right
    set Constraint = components
    set Components = y
  end
end
subsection Time
  set Integrator = Newmark
  set End time   = 240
  set Steps      = 240
end
subsection Output
  set Points = false
  set Mesh   = false
end
""")
for lower in (0, -0.1):
    text(f"shaken column, mesh from {lower}: told", "energy-growth" in run(
        shaken, {"Mesh/Lower corner": f"-3, {lower}",
                 "Mesh/Upper corner": f"5, {lower + 6}"}, on_ranks=1).ids())

# With forces in the middle of a step, walls are held by what does no work there.
TURN = """
subsection Mesh
  set Lower corner = -0.3, -0.3
  set Upper corner = 2.2, 2.7
  set Cell size    = 0.25
end
subsection Method
  set Method = {method}
end
subsection Materials
  subsection elastic
    set Young modulus = 100
    set Poisson ratio = 0.3
    set Density       = 1
  end
end
subsection Bodies
  subsection block
    set Lower corner     = 0, 0
    set Upper corner     = 1.5, 2
    set Initial velocity = 0.02*x*y; -0.01*x*y
  end
end
subsection Boundaries
  subsection side
    set Points     = 0 2; 0 0
    set Constraint = roller
  end
  subsection base
    set Points     = 0 0; 1.5 0
    set Constraint = roller
  end
end
subsection Time
  set Integrator = energy-momentum
  set End time   = 2
  set Steps      = 100
end
subsection Output
  set Write = end
end
"""
for method in "finite element", "GIMP":
    turn = folder / f"{method.split()[0]}.prm"
    turn.write_text(TURN.replace("{method}", method))
    rows = run(turn).history()
    total = max(row["kinetic energy of nodes"] + row["strain energy"]
                for row in rows)
    bound(f"energy-momentum, {method}: work of walls over the energy",
          max(abs(row["work of boundaries"]) for row in rows) / total, 1e-9)
