# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Scenes in other units: scaled results and numbers of iterations must be the same,
for no threshold of the program has a unit. In units that are powers of two of each
other nothing is rounded, and not a bit may differ. A plastic block on a tilted
implicit boundary, the same pushed along it (dynamics), an elastic one by several
methods in 2D and 3D, finite elements on a mesh that fits."""
import math

# Length, stress and time in which a metre, a kPa and a second are given.
UNITS = {"um, GPa, us": (1e6, 1e-6, 1e6), "km, kPa, h": (1e-3, 1., 1 / 3600),
         "mm, MPa, ms": (1e3, 1e-3, 1e3)}
POWERS = {"2^20, 2^-30, 2^20": (2.**20, 2.**-30, 2.**20),
          "2^-10, 1, 2^-12": (2.**-10, 1., 2.**-12),
          "2^-20, 2^50, 1": (2.**-20, 2.**50, 1.)}
# Lengths and stresses that are far apart.
FAR = {"1e-6, 1": (1e-6, 1., 1.), "1, 1e-12": (1., 1e-12, 1.),
       "1e6, 1e12": (1e6, 1e12, 1.), "1e-3, 1e-12": (1e-3, 1e-12, 1.),
       "1e-6, 1e12": (1e-6, 1e12, 1.)}
ANGLE = math.radians(17)


def text_of(values, factor, separator=", "):
    return separator.join(repr(value * factor) for value in values)


def growing(values, factor, T=1.):
    """A vector that grows with time."""
    return "; ".join(f"{value * factor!r}*t/{T!r}" for value in values)


def turned(x, y):
    """By the angle, and moved."""
    c, s = math.cos(ANGLE), math.sin(ANGLE)
    return c * x - s * y + 0.313, s * x + c * y + 0.107


def plastic(L, S, T, dynamic=False):
    """A block on a boundary, pressed beyond yield; or pushed along it."""
    corners = "; ".join(text_of(turned(*x), L, " ")
                        for x in ((0, 0), (1, 0), (1, 0.7), (0, 0.7)))
    base = "; ".join(text_of(turned(x, 0), L, " ") for x in (-0.5, 1.5))
    probe = text_of(turned(0.9, 0.1), L)
    push = (150., -400.) if dynamic else (17., -42.)
    return prm(f"""
Mesh/Lower corner = {text_of((-0.2, -0.1), L)}
Mesh/Upper corner = {text_of((1.8, 1.4), L)} | Cells = 16, 12
Method/Method = GIMP | Strain = finite
Materials/clay/Model = von Mises | Young modulus = {1e3 * S!r} | Poisson ratio = 0.4
Materials/clay/Density = {2 * S * T**2 / L**2!r}
Materials/clay/Shear yield stress = 0: {10 * S!r}, 0.1: {12 * S!r}
Bodies/block/Shape = polygon | Vertices = {corners}
Boundaries/base/Points = {base} | Constraint = {"roller" if dynamic else "fixed"}
Loads/push/Type = body force | Value = {growing(push, S / L, T)}
Time/End time = {(0.2 if dynamic else 1.) * T!r} | Steps = 8
{"set Integrator = Newmark" if dynamic else ""}
Probes/corner/Location = {probe} | Kind = nearest point
Probes/corner/Quantities = displacement, stress
""")


def tilted(L, S, T, dim, method):
    """A block of 1 x 0.7 (x 0.6) turned by 17 degrees."""
    if dim == 2:
        base = "set Points = " + "; ".join(
            text_of(turned(x, -0.003), L, " ") for x in (-0.5, 1.5))
        top = "set Points = " + "; ".join(
            text_of(turned(x, 0.7), L, " ") for x in (1, 0))
    else:
        base = ("set Surface = plane\n set Point = "
                + text_of(turned(0, -0.003) + (0,), L)
                + "\n set Normal = "
                + text_of((math.sin(ANGLE), -math.cos(ANGLE), 0), 1))
        top = ("set Surface = plane patch\n set Points = " + "; ".join(
            text_of(turned(x, 0.7) + (z + 0.041,), L, " ")
            for x, z in ((0, 0), (0, 0.6), (1, 0.6), (1, 0))))
    size = (1, 0.7, 0.6)[:dim]
    return prm(f"""
Dimension = {dim}
Mesh/Lower corner = {text_of((-0.1, -0.02, -0.11)[:dim], L)}
Mesh/Upper corner = {text_of((1.4, 1.23, 0.89)[:dim], L)}
Mesh/Cells = {"6, 5, 4" if dim == 3 else "12, 10"}
Method/Method = {method} | Strain = finite | Points per direction = 2
Materials/soft/Model = neo-Hookean | Young modulus = {1e3 * S!r} | Poisson ratio = 0.3
Bodies/block/Shape = box | Lower corner = {text_of((0,) * dim, L)}
Bodies/block/Upper corner = {text_of(size, L)} | Rotation angle = 17
{"set Rotation axis = 0, 0, 1" if dim == 3 else ""}
Bodies/block/Translation = {text_of((0.313, 0.107, 0.041)[:dim], L)}
Boundaries/base/
{base}
Loads/press/Type = surface traction
{top}
Loads/press/Value = {growing((2., -5., 1.)[:dim], S)}
Loads/drag/Type = body force | Bodies = block
Loads/drag/Value = {growing((1., -2., 1.)[:dim], S / L)}
Time/Steps = 2
Probes/corner/Location = {text_of((turned(0.95, 0.65) + (0.3,))[:dim], L)}
Probes/corner/Kind = nearest point | Quantities = displacement, stress
""")


DRAWN = 1e-3  # a traction, 1e-6 of Young's modulus


def fitted(L, S, T, dim, load):
    """Finite elements: a block held on the left, drawn on the right or bent by
    its weight."""
    if load == "weight":
        force = f"set Type = body force\n set Value = 0; {-0.1 * S / L!r}"
    else:
        force = ("set Type = side traction\n set Side = right\n set Value = "
                 + text_of((DRAWN, DRAWN / 2, DRAWN / 4)[:dim], S, "; "))
    return prm(f"""
Dimension = {dim}
Mesh/Lower corner = {text_of((0,) * dim, L)}
Mesh/Upper corner = {text_of((2, 1, 1)[:dim], L)}
Mesh/Cells = {"6, 3, 3" if dim == 3 else "12, 6"}
Method/Method = finite element
Materials/elastic/Young modulus = {1e3 * S!r} | Poisson ratio = 0.3
Bodies/block/Shape = box | Lower corner = {text_of((0,) * dim, L)}
Bodies/block/Upper corner = {text_of((2, 1, 1)[:dim], L)}
Grid conditions/left/Side = left
Loads/force/
{force}
Probes/corner/Location = {text_of((2, 1, 1)[:dim], L)} | Kind = interpolated
Probes/corner/Quantities = displacement
""")


def results(scene, units, settings):
    """Scaled values and numbers of iterations of the scene in these units."""
    L, S, T = units
    file = folder / "scene.prm"
    file.write_text(scene(L, S, T))
    found = run(file, {"Output/Points": "false", "Output/Mesh": "false",
                       **settings})
    force = S * L**(found.summary["dimension"] - 1)
    values = {name: value / (L if name.startswith("u_") else S)
              for name, value in found.probes.items()}
    for name, reaction in found.reactions.items():
        values.update({f"{name} {d}": value / force
                       for d, value in enumerate(reaction)})
    for name, value in found.summary.get("energy", {}).items():
        if name != "balance_error":
            values[f"energy {name}"] = value / (force * L)
    counts = [found.summary[key] for key in (
        "steps", "rejected_steps", "newton_iterations", "linear_iterations",
        "active_cells", "points")]
    return values, counts


def scale_of(values, name):
    """The largest value of its kind."""
    kind = name.split(" ")[0].split("_")[0]
    return max(abs(value) for other, value in values.items()
               if other.split(" ")[0].split("_")[0] == kind)


def compare(name, scene, settings, *groups):
    """Results in groups of units, within limits, with those in m, kPa and s."""
    reference, counts = results(scene, (1., 1., 1.), settings)
    text(name, f"{counts[2]} Newton iterations in {counts[0]} steps")
    different = []
    for group, limit in groups:
        worst = 0
        for units, factors in group.items():
            values, others = results(scene, factors, settings)
            worst = max(worst, *(
                abs(values[key] - reference[key]) / scale_of(reference, key)
                for key in reference))
            if others != counts:
                different.append(f"NO: {units}, {others} {counts}")
        bound(f"  {'; '.join(group)}", worst, limit)
    text("  steps, iterations, cells, points", different or "the same")
    return reference


for name, settings in (
        ("plastic block, GIMP, finite strain", {}),
        ("plastic block, aggregated, cell means",
         {"Method/Aggregate below": 0.05, "Method/Volumetric strain": "cell mean"}),
        ("plastic block, multigrid", {"Solver/Solver": "gmres"})):
    found = compare(name, plastic, settings, (UNITS, 1e-12), (POWERS, 0))
    elastic = results(plastic, (1., 1., 1.), {
        **settings, "Strength reduction/Factor": 1e-3})[0]
    at_least("  more displacement than without plasticity",
             found["u_x at corner"] / elastic["u_x at corner"] - 1, 0.05)

# What rounding does to the data: a force along a roller is a difference.
found = compare("block, Newmark", lambda *units: plastic(*units, dynamic=True), {},
                (UNITS, 1e-11), (POWERS, 0))
at_least("  plastic dissipation", found["energy plastic_dissipation"], 0.01)

for dim, method, solver in (
        (2, "material point", "direct"), (2, "material point", "gmres"),
        (2, "GIMP", "direct"), (2, "GIMP", "gmres"),
        (2, "CPDI2", "direct"), (2, "CPDI2", "gmres"),
        (3, "material point", "gmres"), (3, "GIMP", "gmres")):
    some = FAR if dim == 2 else dict(list(FAR.items())[::2])
    compare(f"{dim}D, {method}, {solver}",
            lambda *units: tilted(*units, dim, method),
            {"Solver/Solver": solver}, (some, 1e-9))

for dim in (2, 3):
    for solver in ("direct", "amg-cg"):
        found = compare(f"{dim}D, finite elements, {solver}",
                        lambda *units: fitted(*units, dim, "traction"),
                        {"Solver/Solver": solver}, (FAR, 1e-9))
        number("  displacement over load", found["u_x at corner"] / (DRAWN / 1e3), 8)
        if dim == 2:
            compare("  bent by its weight",
                    lambda *units: fitted(*units, dim, "weight"),
                    {"Solver/Solver": solver}, (UNITS, 1e-12), (POWERS, 0))

# A threshold with a unit would be seen.
tolerance = {"Solver/Absolute tolerance": 1e-3}
first = results(plastic, (1., 1., 1.), tolerance)
other = results(plastic, POWERS["2^20, 2^-30, 2^20"], tolerance)
text("a threshold with a unit", "is seen" if first[1] != other[1] else "NO")
