# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""One scene in many systems of units: scaled results and numbers of iterations
must be the same, for no threshold of the program has a unit. A tilted block on
an implicit boundary under its weight and a traction, at finite strain; for
finite elements a block that fits the mesh."""
import math

QUIET = {"Output/Points": "false", "Output/Mesh": "false"}
UNITS = ((1e-6, 1.), (1., 1e-12), (1e6, 1e12), (1e-3, 1e-12),
         (1e-6, 1e12))


def numbers(values, factor):
    return ", ".join(repr(value * factor) for value in values)


def tilted(dim, length, stress, method, settings):
    """A block of 1 x 0.7 (x 0.6) turned by 17 degrees."""
    angle = math.radians(17)
    c, s = math.cos(angle), math.sin(angle)

    def turned(x, y):
        return (c * x - s * y + 0.313, s * x + c * y + 0.107)

    if dim == 2:
        base = "set Points = " + "; ".join(
            numbers(turned(x, -0.003), length).replace(",", " ")
            for x in (-0.5, 1.5))
        top = "set Points = " + "; ".join(
            numbers(turned(x, 0.7), length).replace(",", " ") for x in (1, 0))
    else:
        base = ("set Surface = plane\n set Point = "
                + numbers(turned(0, -0.003) + (0,), length)
                + "\n set Normal = " + numbers((s, -c, 0), 1))
        top = ("set Surface = plane patch\n set Points = " + "; ".join(
            numbers(turned(x, 0.7) + (z + 0.041,), length).replace(",", " ")
            for x, z in ((0, 0), (0, 0.6), (1, 0.6), (1, 0))))
    size = (1, 0.7, 0.6)[:dim]
    return f"""
set Dimension = {dim}
subsection Mesh
  set Lower corner = {numbers((-0.1, -0.02, -0.11)[:dim], length)}
  set Upper corner = {numbers((1.4, 1.23, 0.89)[:dim], length)}
  set Cells = {"6, 5, 4" if dim == 3 else "12, 10"}
end
subsection Method
  set Method = {method}
  set Strain = finite
  set Points per direction = 2
end
subsection Materials
  subsection soft
    set Model = neo-Hookean
    set Young modulus = {repr(1e3 * stress)}
    set Poisson ratio = 0.3
  end
end
subsection Bodies
  subsection block
    set Shape = box
    set Lower corner = {numbers((0,) * dim, length)}
    set Upper corner = {numbers(size, length)}
    set Rotation angle = 17
    {"set Rotation axis = 0, 0, 1" if dim == 3 else ""}
    set Translation = {numbers((0.313, 0.107, 0.041)[:dim], length)}
  end
end
subsection Boundaries
  subsection base
    {base}
    {settings}
  end
end
subsection Loads
  subsection press
    set Type = surface traction
    {top}
    set Value = {"; ".join(repr(v * stress) + "*t" for v in (2., -5., 1.)[:dim])}
  end
  subsection drag
    set Type = body force
    set Bodies = block
    set Value = {"; ".join(repr(v * stress / length) + "*t" for v in (1., -2., 1.)[:dim])}
  end
end
subsection Time
  set Steps = 2
end
subsection Probes
  subsection corner
    set Location = {numbers((turned(0.95, 0.65) + (0.3,))[:dim], length)}
    set Kind = nearest point
    set Quantities = displacement, stress
  end
end
"""


def fitted(dim, length, stress, load):
    """Finite elements: a block held on the left, drawn on the right."""
    return f"""
set Dimension = {dim}
subsection Mesh
  set Lower corner = {numbers((0,) * dim, length)}
  set Upper corner = {numbers((2, 1, 1)[:dim], length)}
  set Cells = {"6, 3, 3" if dim == 3 else "12, 6"}
end
subsection Method
  set Method = finite element
end
subsection Materials
  subsection elastic
    set Young modulus = {repr(1e3 * stress)}
    set Poisson ratio = 0.3
  end
end
subsection Bodies
  subsection block
    set Shape = box
    set Lower corner = {numbers((0,) * dim, length)}
    set Upper corner = {numbers((2, 1, 1)[:dim], length)}
  end
end
subsection Grid conditions
  subsection left
    set Side = left
  end
end
subsection Loads
  subsection draw
    set Type = side traction
    set Side = right
    set Value = {"; ".join(repr(v * load * 1e3 * stress) for v in (1., 0.5, 0.25)[:dim])}
  end
end
subsection Probes
  subsection corner
    set Location = {numbers((2, 1, 1)[:dim], length)}
    set Kind = interpolated
    set Quantities = displacement
  end
end
"""


def scaled(scene, dim, length, stress, settings):
    file = folder / "scene.prm"
    file.write_text(scene)
    result = run(file, {**QUIET, **settings})
    values = [value / (length if name.startswith("u_") else stress)
              for name, value in result.probes.items()]
    forces = [value / (stress * length**(dim - 1))
              for force in result.reactions.values() for value in force]
    counts = [result.summary[key] for key in
              ("steps", "rejected_steps", "newton_iterations",
               "linear_iterations", "points", "active_cells")]
    return values, forces, counts


def compare(name, make, dim, settings, units=UNITS):
    reference = scaled(make(1., 1.), dim, 1., 1., settings)
    worst, same = 0, True
    for length, stress in units:
        found = scaled(make(length, stress), dim, length, stress, settings)
        for a, b in zip(reference[:2], found[:2]):
            largest = max(map(abs, a))
            worst = max(worst, max(abs(x - y) for x, y in zip(a, b)) / largest)
        if found[2] != reference[2]:
            same = False
    text(f"{name}, steps, iterations, points, cells",
         "the same" if same else "NO")
    bound(f"{name}, scaled results", worst, 1e-9)
    at_least(f"{name}, Newton iterations", reference[2][2], 1)
    return reference


for dim, solvers in ((2, ("direct", "gmres")), (3, ("gmres",))):
    for method in ("material point", "GIMP", "CPDI2"):
        for solver in solvers:
            if dim == 3 and method == "CPDI2":
                continue
            compare(f"{dim}D, {method}, {solver}",
                    lambda l, s: tilted(dim, l, s, method, ""), dim,
                    {"Solver/Solver": solver},
                    UNITS if dim == 2 else UNITS[::2])
for dim in (2, 3):
    for solver in ("direct", "amg-cg"):
        load = 1e-6
        u = compare(f"{dim}D, finite element, {solver}, load {load:g} E",
                    lambda l, s: fitted(dim, l, s, load), dim,
                    {"Solver/Solver": solver})[0]
        number("  displacement over load", u[0] / load, 8)
