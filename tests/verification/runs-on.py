# debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Boundaries, loads and absorbing surfaces that are longer than the body, at any angle
to cells: they act where the body is, whatever else is in its cells."""

from math import cos, pi, radians, sin, sqrt


def text_of(*numbers):
    return ", ".join(f"{x!r}" for x in numbers)


# A unit block with uniform pressure 1 on top, held by two rollers that meet in a
# corner, as it stands turned by an angle; nothing is stressed along its base.
def block(angle, ends, enforcement, overhang=0.):
    c, s = cos(radians(angle)), sin(radians(angle))

    def at(x, y):
        return text_of(c * x - s * y + 0.013, s * x + c * y + 0.027)

    def surface(a, b, x, y):
        if ends:
            return f"set Points = {at(*a)}; {at(*b)}"
        return f"set Surface = plane\nset Point = {at(*a)}\n" \
               f"set Normal = {text_of(c * x - s * y, s * x + c * y)}"

    return prm(f"""
Mesh/Lower corner = -1, -1 | Upper corner = 2, 2 | Cell size = 0.1
Method/Method = finite element
Materials/rock/Young modulus = 1000 | Poisson ratio = 0.3
Bodies/block/Shape = polygon
Bodies/block/Vertices = {at(0, 0)}; {at(1, 0)}; {at(1, 1)}; {at(0, 1)}
Boundaries/base/Constraint = roller | Enforcement = {enforcement}
{surface((0, 0), (1, 0), 0, -1)}
Boundaries/left/Constraint = roller | Enforcement = {enforcement}
{surface((0, 1), (0, 0), -1, 0)}
Loads/top/Type = surface traction | Value = {s!r}; {-c!r}
Loads/top/Points = {at(1 + overhang, 1)}; {at(-overhang, 1)}
""")


def largest_error(result, direction):
    """Of a component of stress, which is to be -d d^T."""
    n = len(direction)
    exact = [[-direction[i] * direction[j] if i < n and j < n else 0.
              for j in range(3)] for i in range(3)]
    return max(abs(stress[3 * i + j] - exact[i][j])
               for (stress,) in result.points("stress")
               for i in range(n) for j in range(n))


scene = folder / "scene.prm"
for angle in 0, 20, 40:
    for enforcement, limit in (("skew Nitsche", 0.08), ("augmented Lagrangian", 0.06),
                               ("weighted", 0.06)):
        scene.write_text(block(angle, False, enforcement))
        result = run(scene)
        axis = (-sin(radians(angle)), cos(radians(angle)))
        bound(f"block turned by {angle} degrees on planes, {enforcement}: error of stress",
              largest_error(result, axis), limit)
        text("  found", result.found())

# A pressure that is drawn longer than the top of the body acts on the top.
for angle in 0, 20:
    scene.write_text(block(angle, True, "augmented Lagrangian", overhang=0.04))
    result = run(scene)
    row = result.history()[-1]
    bound(f"load on {angle} degrees, longer than the body: force over the right one - 1",
          sqrt(row["reaction_x of base"] ** 2 + row["reaction_y of base"] ** 2) - 1, 5e-3)

CYLINDER = prm("""
Dimension = 3
Mesh/Lower corner = -1.3, -1.3, -1 | Upper corner = 1.9, 1.9, 2.2 | Cell size = 0.2
Method/Method = finite element
Materials/rock/Young modulus = 1000 | Poisson ratio = 0
Bodies/column/Shape = cylinder | Axis start = {start} | Axis end = {end}
Bodies/column/Radius = 0.7
Boundaries/base/Enforcement = augmented Lagrangian | Surface = plane | Point = {start}
Boundaries/base/Normal = {normal}
Loads/top/Type = surface traction | Value = {pressure} | Body = column | Part = top
""")
d = (0.8 * sin(radians(20)), 0.6 * sin(radians(20)), cos(radians(20)))
start = (0.013, 0.027, 0.031)
scene.write_text(CYLINDER.format(
    start=text_of(*start), end=text_of(*(a + b for a, b in zip(start, d))),
    normal=text_of(*(-x for x in d)),
    pressure="; ".join(f"{-x!r}" for x in d)))
result = run(scene)
near = [stress for stress, x in zip((s for (s,) in result.points("stress")),
                                    (x for (x,) in result.points("position")))
        if sum(a * (b - c) for a, b, c in zip(d, x, start)) < 0.3]
bound("cylinder tilted by 20 degrees on a plane: error of stress beside it",
      max(abs(stress[3 * i + j] + d[i] * d[j])
          for stress in near for i in range(3) for j in range(3)), 0.2)

# A quarter of a cylinder of clay in a triaxial cell whose plates are planes; its
# mesh follows it, and plates no longer run along the faces of cells.
scene.write_text(prm("""
Dimension = 3
Mesh/Lower corner = -960, -460, 290 | Upper corner = -910, -410, 450 | Cell size = 10
Method/Method = finite element
Materials/clay/Model = von Mises | Young modulus = 20 | Poisson ratio = 0.45
Materials/clay/Shear yield stress = 0.05
Bodies/whole/Shape = cylinder | Axis start = -960, -460, 303
Bodies/whole/Axis end = -960, -460, 443 | Radius = 35
Bodies/quadrant/Lower corner = -960, -460, 290 | Upper corner = -900, -400, 450
Bodies/sample/Shape = intersection | Operands = whole, quadrant
Boundaries/base/Surface = plane | Point = -960, -460, 303 | Normal = 0, 0, -1
Boundaries/base/Constraint = roller
Boundaries/platen/Surface = plane | Point = -960, -460, 443 | Normal = 0, 0, 1
Boundaries/platen/Constraint = roller | Translation = 0; 0; 0: 0, 1: 0, 2: -2.8
Grid conditions/x/Side = left | Components = x
Grid conditions/y/Side = front | Components = y
Loads/cell/Type = surface traction
Loads/cell/Value = -0.2 * (x + 960) / 35; -0.2 * (y + 460) / 35; 0
Loads/cell/Curve = 0: 0, 1: 1, 2: 1 | Surface = cylinder
Loads/cell/Axis start = -960, -460, 303 | Axis end = -960, -460, 443 | Radius = 35
Loads/cell/Body side = inside
Time/End time = 2 | Steps = 10
"""))
result = run(scene, expect=None)
force = [row["reaction_z of platen"] / (pi * 35 ** 2 / 4) for row in result.history()]
text("triaxial: status", result.summary["status"])
# Confined: the lateral pressure times 2 nu; then the yield stress above it.
bound("triaxial: axial stress when confined over the exact one - 1",
      force[4] / -0.18 - 1, 5e-3)
bound("triaxial: axial stress at the end over the exact one - 1",
      force[-1] / -(0.2 + sqrt(3) * 0.05) - 1, 3e-2)

# The force of dashpots on a body that moves as a whole is rho c v times the area.
BAR = prm("""
Mesh/Lower corner = 0, 0 | Upper corner = 3, 6 | Cell size = {h}
Method/Method = {method}
Materials/rock/Young modulus = 100 | Poisson ratio = 0 | Density = 0.01
Bodies/bar/Lower corner = 0, {low!r} | Upper corner = {right!r}, {high!r}
Bodies/bar/Initial velocity = 1; 0
/
{how}
Time/Integrator = Newmark | End time = 1e-7 | Steps = 1
""")
SIDE = prm("""
Grid conditions/end/Side = right | Constraint = absorbing
""")
LINE = prm("""
Boundaries/end/Surface = plane | Point = 2.3, 0 | Normal = 1, 0
Boundaries/end/Constraint = absorbing
""")
for name, how, right, low, high in (("side", SIDE, 3., 0., 4.), ("side", SIDE, 3., 1., 5.),
                                    ("side", SIDE, 3., 0.7, 3.45),
                                    ("plane", LINE, 2.3, 0., 4.), ("plane", LINE, 2.3, 0.7, 3.45)):
    for method in "GIMP", "finite element":
        scene.write_text(BAR.format(h=0.5, method=method, how=how, right=right,
                                    low=low, high=high))
        force = -run(scene).history()[-1]["reaction_x of end"]
        # rho c = 1
        bound(f"absorbing {name}, bar from {low} to {high}, {method}: force over the "
              "right one - 1", force / (high - low) - 1, 0.03)

# Only what is prescribed along the material is a uniform strain.
scene.write_text(prm("""
Mesh/Lower corner = 0, 0 | Upper corner = 2, 1 | Cell size = 0.25
Method/Method = finite element | Strain = finite
Materials/rubber/Young modulus = 1000 | Poisson ratio = 0
Bodies/sheet/Shape = mesh
""" + "\n".join(f"Grid conditions/{side}/Side = {side} | Displacement = 0.5 * x * t; 0"
                for side in ("left", "right", "bottom", "top"))))
for steps in 1, 8:
    stress = [s[0] for (s,) in run(scene, {"Time/Steps": steps}).points("stress")]
    number(f"sheet stretched by 'Displacement = 0.5 x t' in {steps} steps: least stress",
           min(stress), 5)
    number("  largest", max(stress), 5)
