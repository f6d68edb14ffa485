# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Hard cases of contact: patches and cylinders at random angles and places in the mesh,
layers thinner than a cell between two walls, a block that slides off the end of a
surface, one that sticks and slides in turns, one at rest that is pushed in motion and out
of the mesh."""

from math import ceil, cos, pi, radians, sin, sqrt
import random
import re

E = 1000


def place(angle, x, y):
    c, s = cos(radians(angle)), sin(radians(angle))
    return c * x - s * y, s * x + c * y


def points(angle, *places):
    return "; ".join("%r, %r" % place(angle, *one) for one in places)


def vector(angle, x, y, curve=""):
    return "; ".join(f"{v!r}{curve}" for v in place(angle, x, y))


def scene(angle, lower, upper, h, nu, offset=(0.37, 0.37), keep=True):
    """A mesh around a box of the turned frame, with its edge at an offset."""
    xs, ys = zip(*(place(angle, x, y) for x in (lower[0], upper[0])
                   for y in (lower[1], upper[1])))
    low = [min(v) - h * (1 + o) for v, o in zip((xs, ys), offset)]
    high = [a + h * ceil((max(v) - a) / h + 1) for a, v in zip(low, (xs, ys))]
    return f"""
Dimension = 2
Mesh/Lower corner = {low[0]!r}, {low[1]!r} | Upper corner = {high[0]!r}, {high[1]!r}
Mesh/Cell size = {h!r}
Method/Method = GIMP | {"Mesh after step = keep" if keep else "Strain = finite"}
Materials/rock/Young modulus = {E} | Poisson ratio = {nu}
"""


def in_frame(row, name, angle):
    return place(-angle, row[f"reaction_x of {name}"], row[f"reaction_y of {name}"])


# Patches that stick and slide.
P, MU = 10, 0.3


def patch(angle, offset, slides):
    tau = P * MU if slides else P * MU / 2
    across = 0 if slides else P * 0.3 / 0.7
    return tau, scene(angle, (0, 0), (2, 1.5), 0.5, 0 if slides else 0.3, offset) + f"""
Bodies/block/Lower corner = 0, 0 | Upper corner = 2, 1.5 | Rotation angle = {angle!r}
Boundaries/floor/Points = {points(angle, (-1, 0), (3, 0))} | Constraint = contact
Boundaries/floor/Friction = {MU}
Loads/left/Type = surface traction | Body = block | Part = left
Loads/left/Value = {vector(angle, across, -tau)}
Loads/right/Type = surface traction | Body = block | Part = right
Loads/right/Value = {vector(angle, -across, tau)}
Solver/Solver = direct | Tolerance = 1e-12
""" + (f"""
Boundaries/top/Points = {points(angle, (2, 1.5), (0, 1.5))} | Constraint = fixed
Boundaries/top/Translation = {vector(angle, 0.1, -1.5 * P / E, "*t")}
""" if slides else f"""
Loads/top/Type = surface traction | Body = block | Part = top
Loads/top/Value = {vector(angle, tau, -P)}
""")


any_of = random.Random(48)
worst = 0
for i in range(10):
    angle, offset = any_of.uniform(0, 360), (any_of.random(), any_of.random())
    tau, text_of_scene = patch(angle, offset, i % 2 == 1)
    row = run(scene_file("patch.prm", text_of_scene), QUIET).history()[-1]
    found = in_frame(row, "floor", angle)
    worst = max(worst, abs(found[0] + 2 * tau) / P, abs(found[1] - 2 * P) / P)
bound("10 patches at random: error of the force over p", worst, 1e-8)

# Cylinders, pushed by their tops.
R = 10


def cylinder(angle, offset):
    return scene(angle, (-2.5, 0), (2.5, 2.5), 0.3, 0.3, offset) + f"""
Bodies/disc/Shape = disc | Centre = 0, {R} | Radius = {R}
Bodies/box/Lower corner = -2.5, 0 | Upper corner = 2.5, 2.5
Bodies/part/Shape = intersection | Operands = disc, box | Rotation angle = {angle!r}
Boundaries/plane/Points = {points(angle, (-5, 0), (5, 0))} | Constraint = contact
Boundaries/plane/Friction = 0.3
Boundaries/top/Points = {points(angle, (2.5, 2.5), (-2.5, 2.5))} | Constraint = fixed
Boundaries/top/Translation = {vector(angle, 0, -0.12, "*t")}
"""


forces, pressures = [], []
for i in range(8):
    angle, offset = any_of.uniform(0, 360), (any_of.random(), any_of.random())
    result = run(scene_file("cylinder.prm", cylinder(angle, offset)))
    forces.append(in_frame(result.history()[-1], "plane", angle)[1])
    a = sqrt(4 * forces[-1] * R * (1 - 0.3 ** 2) / (pi * E))
    middle = [(size, place(-angle, *t[:2])[1])
              for x, t, size in result.contact("position", "traction", "size")
              for along, up in (place(-angle, *x[:2]),)
              if up < 1 and abs(along) < a / 2]
    # p0 times the mean of the root over the middle half.
    pressures.append(sum(size * p for size, p in middle) / sum(size for size, p in middle)
                     / (2 * forces[-1] / (pi * a)) / (sqrt(3) / 4 + pi / 6))


def spread(values):
    mean = sum(values) / len(values)
    return sqrt(sum((v - mean) ** 2 for v in values) / len(values)) / mean


bound("8 cylinders at random: largest force over smallest - 1",
      max(forces) / min(forces) - 1, 0.02)
bound("pressure in the middle, over Hertz: spread", spread(pressures), 0.02)
bound("pressure in the middle, over Hertz - 1",
      max(abs(p - 1) for p in pressures), 0.15)

# Layers between two walls: the exact force, without locking.
for cells in (0.6, 1, 2):
    for nu in (0.3, 0.49):
        thickness = 0.25 * cells
        row = run(scene_file(
            "layer.prm", scene(33, (0, 0), (2, thickness), 0.25, nu), f"""
Bodies/layer/Lower corner = 0, 0 | Upper corner = 2, {thickness} | Rotation angle = 33
Boundaries/floor/Points = {points(33, (-1, 0), (3, 0))} | Constraint = contact
Boundaries/top/Points = {points(33, (3, thickness), (-1, thickness))}
Boundaries/top/Constraint = contact
Boundaries/top/Translation = {vector(33, 0, -0.01 * thickness, "*t")}
Boundaries/middle/Points = {points(33, (0, -1), (0, thickness + 1))} | Flip = true
Boundaries/middle/Constraint = roller
"""), QUIET).history()[-1]
        exact = 2 * 0.01 * E / (1 - nu * nu)
        bound(f"layer of {cells} cells, nu = {nu}: force over exact - 1",
              max(abs(in_frame(row, name, 33)[1] / exact) - 1 for name in
                  ("floor", "top")), 1e-4)

# A block that slides off: no jump but that of the last cell.
WAY = 1.5
CURVE = "max(0, t - 0.05)/0.95"
for angle in 0, 17:
    along, down = place(angle, WAY, 0), place(angle, 0, -0.01)
    motion = "; ".join(f"{a!r}*{CURVE} + {d!r}*min(1, 20*t)" for a, d in zip(along, down))
    result = run(scene_file(
        "edge.prm", scene(angle, (0, -0.1), (1 + WAY, 1), 0.25, 0, keep=False), f"""
Bodies/block/Lower corner = 0, 0 | Upper corner = 1, 1 | Rotation angle = {angle}
Boundaries/floor/Points = {points(angle, (-1, 0), (1.13, 0))} | Constraint = contact
Boundaries/floor/Friction = {MU}
Boundaries/top/Points = {points(angle, (1, 1), (0, 1))} | Constraint = fixed
Boundaries/top/Translation = {motion}
Time/Steps = 40
"""), QUIET)
    found = [in_frame(row, "floor", angle) for row in result.history()]
    name = f"off an end, {angle} degrees"
    pushed = [normal for _, normal in found]
    bound(f"{name}: largest fall of the force in a step, over its largest",
          max(a - b for a, b in zip(pushed, pushed[1:])) / max(pushed), 0.16)
    bound(f"{name}: force at the end", pushed[-1], 0)
    bound(f"{name}: friction over mu times the force - 1",
          max(abs(shear / normal) / MU - 1 for shear, normal in found[4:] if normal), 1e-6)

# To and fro.
CYCLES, STEPS = 60, 4
result = run(scene_file("cycles.prm", scene(17, (0, 0), (1, 1), 0.5, 0.3), f"""
Bodies/block/Lower corner = 0, 0 | Upper corner = 1, 1 | Rotation angle = 17
Boundaries/floor/Points = {points(17, (-1, 0), (3, 0))} | Constraint = contact
Boundaries/floor/Friction = 0.3
Boundaries/floor/Translation = {vector(17, 0.02, 0, "*sin(2*pi*t)")}
Boundaries/top/Points = {points(17, (1, 1), (0, 1))} | Constraint = fixed
Boundaries/top/Translation = {vector(17, 0, -0.01, "*min(1, 4*t)")}
Time/End time = {CYCLES} | Steps = {STEPS * CYCLES}
"""), QUIET)
rows = result.history()
number("to and fro: rejected steps", result.summary["rejected_steps"], 1)
bound("cycle 60 less cycle 10: force", max(
    abs(a[f"reaction_{c} of floor"] - b[f"reaction_{c} of floor"]) for c in "xy"
    for a, b in zip(rows[9 * STEPS:10 * STEPS], rows[-STEPS:])), 1e-8)

# Steps of 130 times what a wave takes through a cell, from rest: nothing moves.
PUSHED = scene_file("pushed.prm", """
Dimension = 2
Mesh/Lower corner = -0.5, -0.25 | Upper corner = 5.5, 1.5 | Cell size = 0.25
Method/Method = GIMP | Strain = finite
Materials/rock/Young modulus = 1e5 | Poisson ratio = 0.3 | Density = 2
Bodies/block/Lower corner = 0, 0 | Upper corner = 2, 1
Boundaries/floor/Points = -1 0; 9 0 | Constraint = contact | Friction = 0.3
Loads/weight/Type = gravity | Value = 0; -9.81 | Curve = min(t, 1)
Loads/push/Type = body force | Value = 5*max(0, min(1, 4*(t - 1))); 0
Stages/rest/Time/Steps = 2
Stages/pushed/Time/End time = 2 | Steps = 4 | Integrator = generalised-alpha
""")
rows = run(PUSHED, QUIET).history()
bound("pushed from rest: energy lost in transfer over that of strain",
      rows[-1]["energy lost in transfer"] / rows[-1]["strain energy"], 1e-3)
bound("pushed from rest: largest kinetic energy over that of strain",
      max(row["kinetic energy"] for row in rows) / rows[-1]["strain energy"], 1e-3)
result = run(PUSHED, {"Loads/push/Value": "10*max(0, min(1, 4*(t - 1))); 0",
                      "Method/Return tolerance": 1, "Stages/pushed/Time/Steps": 44,
                      "Stages/pushed/Time/End time": 3.2, **QUIET}, expect=None)
text("pushed out of the mesh", re.sub(r"\(.*\)", "(...)", result.summary["message"]))

# Drawn a little above the floor, which alone holds it.
result = run(scene_file("above.prm", """
Dimension = 2
Mesh/Lower corner = -0.5, -0.5 | Upper corner = 2.5, 2.5 | Cell size = 0.5
Materials/soil/Young modulus = 1e4 | Poisson ratio = 0.3
Bodies/block/Lower corner = 0, 0.02 | Upper corner = 2, 2
Boundaries/floor/Points = -1 0; 3 0 | Constraint = contact | Friction = 0.4
Loads/weight/Type = body force | Value = 0.1; -1
Time/Steps = 2
"""), QUIET)
row = result.history()[-1]
bound("drawn above the floor: force over weight - 1",
      row["reaction_y of floor"] / 3.96 - 1, 1e-8)
bound("friction over its weight along the floor - 1",
      row["reaction_x of floor"] / -0.396 - 1, 1e-8)
