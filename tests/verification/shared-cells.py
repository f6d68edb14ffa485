# ranks: 2  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""What boundaries report that hold the same cells. By multipliers each cell knows the
sum of their forces alone, and what is left of a motion on a curve or across a corner is
a pair of opposite forces: of the ring's 0.17 to 1.08 of what is right, of a side of the
square 0.91. Where they are longer than the body, what holds beyond it has no part of
the force."""

from math import cos, hypot, log, radians, sin

# A ring of inner radius 1 and outer radius 2, shear strength 1, of which the bore
# moves: at the limit its pressure is 2 ln 2 (Hill 1950).
ring = scene_file("ring.prm", """
Mesh/Upper corner = 2.3, 2.3
Method/Strain = small | Mesh after step = keep
Materials/soil/Model = von Mises | Young modulus = 1000 | Poisson ratio = 0.49
Materials/soil/Shear yield stress = 1
Bodies/quarter/Shape = box | Lower corner = 0, 0 | Upper corner = 3, 3
Bodies/outer/Shape = disc | Centre = 0, 0 | Radius = 2
Bodies/inner/Shape = disc | Centre = 0, 0 | Radius = 1
Bodies/whole/Shape = intersection | Operands = quarter, outer
Bodies/ring/Shape = difference | Operands = whole, inner
Boundaries/left/Surface = plane | Point = 0, 0 | Normal = -1, 0 | Constraint = roller
Boundaries/bottom/Surface = plane | Point = 0, 0 | Normal = 0, -1
Boundaries/bottom/Constraint = roller
Boundaries/bore/Body = ring | Part = inner | Constraint = fixed
Boundaries/bore/Displacement = 0.03*t*x/sqrt(x^2+y^2); 0.03*t*y/sqrt(x^2+y^2)
Time/Steps = 10
""")


def pressure(h, offset, settings):
    n = -(-2.3 // h)
    result = run(ring, {
        "Mesh/Cell size": h, "Mesh/Lower corner": f"{-offset}, {-offset}",
        "Mesh/Upper corner": f"{n * h - offset!r}, {n * h - offset!r}", **settings})
    forces = result.summary["reactions"]
    for axis, side in (0, "left"), (1, "bottom"):
        if abs(forces["bore"][axis] + forces[side][axis]) > 1e-6:
            text("balance of forces", f"NO, {forces}")
    return [abs(row["reaction_x of left"]) / (2 * log(2))
            for row in result.history()[4:]]


BORE = "Boundaries/bore/Enforcement"
for method, h, offset, enforcement, allowed in (
        ("GIMP", 0.2, 0.06, "augmented Lagrangian", 0.015),
        ("GIMP", 0.2, 0.06, "penalty", 0.04),
        ("GIMP", 0.1, 0.05, "augmented Lagrangian", 0.015),
        ("GIMP", 0.1, 0.03, "augmented Lagrangian", 0.015),
        ("finite element", 0.1, 0.05, "augmented Lagrangian", 0.015)):
    values = pressure(h, offset, {"Method/Method": method, BORE: enforcement})
    bound(f"ring, {method}, {enforcement}, h = {h}, moved by {offset}: "
          "pressure over the limit - 1",
          max(abs(value - 1) for value in values), allowed)

# A square turned by 30 degrees, its rims moved so that it is stretched along its one
# side and pressed along the other: all of it has one stress.
SQUARE = prm("""
Mesh/Lower corner = -1, -1 | Upper corner = 2, 2 | Cell size = 0.1
Method/Strain = small | Mesh after step = keep
Materials/soil/Model = von Mises | Young modulus = 1000 | Poisson ratio = 0.3
Materials/soil/Shear yield stress = 1
Bodies/square/Shape = box | Lower corner = 0, 0 | Upper corner = 1, 1
Bodies/square/Rotation angle = 30
Boundaries/
RIMS
Time/Steps = 4
""")
square = folder / "square.prm"
c, s = cos(radians(30)), sin(radians(30))
# In the axes of the square u = (e x', -e y').
MOTION = (f"0.03*t*({c * c - s * s!r}*x + {2 * c * s!r}*y); "
          f"0.03*t*({2 * c * s!r}*x - {c * c - s * s!r}*y)")
square.write_text(SQUARE.replace("RIMS", "\n".join(
    f"  subsection {side}\n    set Body = square\n    set Part = {side}\n"
    f"    set Constraint = fixed\n    set Displacement = {MOTION}\n  end"
    for side in ("left", "right", "bottom", "top"))))
for method in "GIMP", "finite element":
    forces = run(square, {"Method/Method": method}).summary["reactions"]
    worst = max(
        hypot(forces[side][0] - x, forces[side][1] - y)
        for side, x, y in (("left", -c, -s), ("right", c, s),
                           ("bottom", -s, c), ("top", s, -c)))
    bound(f"square, {method}: largest error of a force over it", worst, 0.02)

# A cube that is pressed between six plates, anywhere in its mesh.
CUBE = prm("""
Dimension = 3
Mesh/Lower corner = -0.07, -0.11, -0.05 | Upper corner = 1.43, 1.39, 1.45
Mesh/Cell size = 0.25
Method/Method = GIMP
Materials/soil/Model = von Mises | Young modulus = 1000 | Poisson ratio = 0.3
Materials/soil/Shear yield stress = 1
Bodies/cube/Shape = box | Lower corner = 0, 0, 0 | Upper corner = 1, 1, 1
Boundaries/
RIMS
Time/End time = 0.1 | Steps = 4
""")
cube = folder / "cube.prm"
cube.write_text(CUBE.replace("RIMS", "\n".join(
    f"  subsection {side}\n    set Body = cube\n    set Part = {side}\n"
    "    set Constraint = fixed\n    set Displacement = "
    "0.01*t*(x-0.5); -0.01*t*(y-0.5); 0\n  end"
    for side in ("left", "right", "front", "back", "bottom", "top"))))
forces = run(cube, {"Method/Strain": "small",
                    "Method/Mesh after step": "keep"}).summary["reactions"]
G = 1000 / 2.6
for side, direction, sign in (("left", 0, -1), ("right", 0, 1),
                              ("front", 1, 1), ("back", 1, -1),
                              ("bottom", 2, 0), ("top", 2, 0)):
    exact = [0., 0., 0.]
    exact[direction] = sign * 2 * G * 0.001
    bound(f"cube, {side}: largest error of the force over that of the sides",
          max(abs(a - b) for a, b in zip(forces[side], exact)) / (2 * G * 0.001),
          0.02)

# Ground between walls four cells apart, which push with nu/(1 - nu) of its weight.
BOX = prm("""
Mesh/Lower corner = -0.1, -0.15 | Upper corner = 1.4, 2.35 | Cell size = 0.25
Materials/soil/Young modulus = 1e5 | Poisson ratio = 0.3 | Density = 2
Bodies/ground/Shape = box | Lower corner = 0, 0 | Upper corner = 1, 2
Boundaries/left/Body = ground | Part = left | Constraint = roller
Boundaries/right/Body = ground | Part = right | Constraint = roller
Boundaries/base/Body = ground | Part = bottom | Constraint = CONSTRAINT
Loads/weight/Type = gravity | Value = 0; -10
""")
box = folder / "box.prm"
for constraint, allowed in ("roller", 1e-3), ("fixed", 1e-2):
    box.write_text(BOX.replace("CONSTRAINT", constraint))
    for method in "GIMP", "finite element":
        forces = run(box, {"Method/Method": method}).summary["reactions"]
        push = 0.3 / 0.7 * 40
        bound(f"ground, {method}, base {constraint}: push of a wall over that of "
              "rest - 1", max(abs(forces["left"][0] / push - 1),
                              abs(forces["right"][0] / push + 1)), allowed)
        bound(f"ground, {method}, base {constraint}: weight on the base over it - 1",
              forces["base"][1] / 40 - 1, 1e-6)

# A block two cells high between planes without ends, the upper of which moves: its
# force is that of the stress on the block.
PRESSED = prm("""
Dimension = DIM
Mesh/Lower corner = LOW | Upper corner = HIGH | Cell size = 1
Method/Method = GIMP | Strain = finite
Materials/rubber/Young modulus = 1000 | Poisson ratio = 0.3
Bodies/block/Lower corner = BLOCK_LOW | Upper corner = BLOCK_HIGH
Boundaries/
PLANES
Boundaries/lid/Surface = plane | Point = BLOCK_HIGH | Normal = UP
Boundaries/lid/Constraint = roller | Translation = DOWN
Time/Steps = STEPS
Probes/inside/Location = MIDDLE | Quantities = stress
""")
pressed = folder / "pressed.prm"


def unit(dim, factor, axis, separator=", "):
    return separator.join(str(factor) if d == axis else "0" for d in range(dim))


def press(dim, top, way, steps, n=1, **settings):
    """The last row of the history."""
    low, high = ", ".join(dim * ["0.13"]), ", ".join((dim - 1) * ["2.13"] + [str(top)])
    planes = "\n".join(
        f"  subsection {name}\n    set Surface = plane\n    set Point = {low}\n"
        f"    set Normal = {unit(dim, -1, axis)}\n    set Constraint = roller\n  end"
        for name, axis in (("left", 0), ("front", 1), ("base", dim - 1))[::4 - dim])
    scene = PRESSED
    for key, value in (
            ("PLANES", planes), ("DIM", str(dim)), ("BLOCK_LOW", low),
            ("BLOCK_HIGH", high), ("LOW", ", ".join(dim * ["-1"])),
            ("HIGH", ", ".join(dim * ["4"])), ("MIDDLE", ", ".join(dim * ["1.2"])),
            ("UP", unit(dim, 1, dim - 1)), ("DOWN", unit(dim, f"-{way}*t", dim - 1, "; ")),
            ("STEPS", str(steps))):
        scene = scene.replace(key, value)
    pressed.write_text(scene)
    return run(pressed, settings, on_ranks=n).history()[-1]


# In 3D cells are halved twice where a body ends, in 2D four times.
for dim, enforcement, allowed in ((2, "augmented Lagrangian", 0.01),
                                  (2, "penalty", 0.01),
                                  (3, "augmented Lagrangian", 0.03)):
    row = press(dim, 1.83, 0.002, 1, **{"Boundaries/lid/Enforcement": enforcement})
    axis = "xyz"[dim - 1]
    bound(f"pressed block, {dim}D, {enforcement}: force of the lid over that of the "
          "stress - 1", row[f"reaction_{axis} of lid"] /
          (row[f"sigma_{axis}{axis} at inside"] * 2**(dim - 1)) - 1, allowed)
