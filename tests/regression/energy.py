# debug: no
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

COLUMN = prm("""
Mesh/Lower corner = {0}, {0} | Upper corner = {1}, {1} | Cell size = 0.5
Method/Method = finite element | Degree = {degree}
Materials/soil/Young modulus = 20000 | Poisson ratio = 0.25 | Density = 2
Bodies/column/Lower corner = 0, 0 | Upper corner = 1, 4 | Rotation angle = {angle}
Bodies/column/Rotation centre = 0, 0 | Initial velocity = {velocity}
Boundaries/
{boundaries}
Time/Integrator = Newmark | End time = 4 | Steps = {steps}
Output/Points = false | Mesh = false
""")
PART = prm("""
{part}/Body = column | Part = {part} | Constraint = {constraint}
""")
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
moving_base = scene_file("moving-base.prm", """
Mesh/Lower corner = 0, 0 | Upper corner = 2, 0.5 | Cell size = 0.25
Method/Method = finite element
Materials/bar/Young modulus = 1 | Poisson ratio = 0 | Density = 1
Bodies/bar/Lower corner = 0, 0 | Upper corner = 2, 0.5
Grid conditions/base/Side = left | Displacement = 0.001*sin(0.5*t)*(1-exp(-0.1*t)); 0
Time/Integrator = Newmark | End time = 60 | Steps = 400
Output/Points = false | Mesh = false
""")
result = run(moving_base, on_ranks=1)
text("moving base: energy of boundaries", [
    one for one in result.found() if one.startswith("energy")])
energy = result.summary["energy"]
bound("moving base: out of balance, of the largest", energy["balance_error"], 0.03)

# One that moves by a surface as well, where a step turns its force by much.
shaken = scene_file("shaken.prm", """
Mesh/Cell size = 0.5
Method/Method = finite element
Materials/soil/Young modulus = 2.6 | Poisson ratio = 0.3 | Density = 1
Bodies/column/Lower corner = 0, 0 | Upper corner = 2, 5 | Damping ratio = 0.1
Bodies/column/Damping frequencies = 0.0125, 0.15
Boundaries/base/Body = column | Part = bottom | Translation = 0.01*sin(0.15708*t); 0
Boundaries/left/Body = column | Part = left | Constraint = components | Components = y
Boundaries/right/Body = column | Part = right | Constraint = components
Boundaries/right/Components = y
Time/Integrator = Newmark | End time = 240 | Steps = 240
Output/Points = false | Mesh = false
""")
for lower in (0, -0.1):
    text(f"shaken column, mesh from {lower}: told", "energy-growth" in run(
        shaken, {"Mesh/Lower corner": f"-3, {lower}",
                 "Mesh/Upper corner": f"5, {lower + 6}"}, on_ranks=1).ids())

# With forces in the middle of a step, walls are held by what does no work there.
TURN = prm("""
Mesh/Lower corner = -0.3, -0.3 | Upper corner = 2.2, 2.7 | Cell size = 0.25
Method/Method = {method}
Materials/elastic/Young modulus = 100 | Poisson ratio = 0.3 | Density = 1
Bodies/block/Lower corner = 0, 0 | Upper corner = 1.5, 2
Bodies/block/Initial velocity = 0.02*x*y; -0.01*x*y
Boundaries/side/Points = 0 2; 0 0 | Constraint = roller
Boundaries/base/Points = 0 0; 1.5 0 | Constraint = roller
Time/Integrator = energy-momentum | End time = 2 | Steps = 100
Output/Write = end
""")
for method in "finite element", "GIMP":
    turn = folder / f"{method.split()[0]}.prm"
    turn.write_text(TURN.replace("{method}", method))
    rows = run(turn).history()
    total = max(row["kinetic energy of nodes"] + row["strain energy"]
                for row in rows)
    bound(f"energy-momentum, {method}: work of walls over the energy",
          max(abs(row["work of boundaries"]) for row in rows) / total, 1e-9)
