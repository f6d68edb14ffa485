# ranks: 2  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A block pressed by a traction that goes with it through the cells stays in a
uniform state of stress, that of elements which fit it."""

BLOCK = prm("""
Dimension = {dim}
Mesh/Lower corner = {lower} | Upper corner = {upper} | Cell size = 0.25
Method/Method = {method} | Strain = finite
Materials/soft/Young modulus = 1000 | Poisson ratio = 0.3
Bodies/block/Lower corner = {base} | Upper corner = {top}
Boundaries/
{rollers}
Loads/pressure/Type = surface traction | Body = block | Part = top | Value = {value}
Time/Steps = {steps}
""")
ROLLER = prm("""
{name}/Constraint = roller | Body = block | Part = {name}
""")


def pressed(dim, method, offset, pressure, steps):
    """A block whose sides but the top and those away from the origin slide."""
    def text(*x):
        return ", ".join(f"{v!r}" for v in x[:dim - 1] + x[-1:])

    scene = folder / "scene.prm"
    scene.write_text(BLOCK.format(
        dim=dim, method=method, steps=steps,
        lower=text(-0.5, -0.5, -0.5), upper=text(2.75, 1.75, 1.5),
        base=text(*offset),
        top=text(*(x + length for x, length in
                   zip(offset, (2 if dim == 2 else 1, 1, 1)))),
        rollers="".join(ROLLER.format(name=name) for name in
                        ("left", "bottom") + ("front",) * (dim - 2)),
        value="; ".join(["0"] * (dim - 1) + [f"-{pressure}*t"])))
    return run(scene)


def vertical(result, dim):
    return [stress[4 * (dim - 1)] for (stress,) in result.points("stress")]


for dim, pressure, steps, limit, methods in (
        (2, 300, 12, 0.01, ("GIMP", "CPDI1", "CPDI2")),
        (3, 200, 4, 0.05, ("GIMP", "CPDI1"))):
    values = vertical(pressed(dim, "finite element", (0., 0., 0.), pressure, steps),
                      dim)
    exact = values[0]
    number(f"{dim}D: stress", exact, 6)
    bound(f"{dim}D, elements: difference", max(values) / min(values) - 1, 1e-8)
    for method in methods:
        values = vertical(
            pressed(dim, method, (0.11, 0.06, 0.07), pressure, steps), dim)
        bound(f"{dim}D, {method}: error of stress",
              max(abs(value / exact - 1) for value in values), limit)
