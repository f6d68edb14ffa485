# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Scenes in other units, to the digits: a plastic block on a tilted implicit
boundary (GIMP, finite strain), the same thrown and shaken (dynamics), a beam
(finite elements). In m, kPa, s, as in µm and GPa, km and kPa, mm and MPa; and in
units that are powers of two of these, where nothing is rounded: not a bit may
differ then, if no threshold of the program has a unit."""
import math

# Length, stress and time in which a metre, a kPa and a second are given.
UNITS = {"um, GPa, us": (1e6, 1e-6, 1e6), "km, kPa, h": (1e-3, 1., 1 / 3600),
         "mm, MPa, ms": (1e3, 1e-3, 1e3)}
POWERS = {"2^20, 2^-30, 2^20": (2.**20, 2.**-30, 2.**20),
          "2^-10, 1, 2^-12": (2.**-10, 1., 2.**-12),
          "2^-20, 2^50, 1": (2.**-20, 2.**50, 1.)}
ANGLE = math.radians(17)


def text_of(values, factor, separator=", "):
    return separator.join(repr(value * factor) for value in values)


def turned(x, y):
    """By the angle, and moved."""
    c, s = math.cos(ANGLE), math.sin(ANGLE)
    return c * x - s * y + 0.313, s * x + c * y + 0.107


def block(L, S, T, dynamic):
    """A block on a boundary, pressed beyond yield; or pushed along it."""
    corners = "; ".join(text_of(turned(*x), L, " ")
                        for x in ((0, 0), (1, 0), (1, 0.7), (0, 0.7)))
    base = "; ".join(text_of(turned(x, 0), L, " ") for x in (-0.5, 1.5))
    probe = text_of(turned(0.9, 0.1), L)
    push = (150., -400.) if dynamic else (17., -42.)
    return f"""
subsection Mesh
  set Lower corner = {text_of((-0.2, -0.1), L)}
  set Upper corner = {text_of((1.8, 1.4), L)}
  set Cells = 16, 12
end
subsection Method
  set Method = GIMP
  set Strain = finite
end
subsection Materials
  subsection clay
    set Model = von Mises
    set Young modulus = {1e3 * S!r}
    set Poisson ratio = 0.4
    set Density = {2 * S * T**2 / L**2!r}
    set Shear yield stress = 0: {10 * S!r}, 0.1: {12 * S!r}
  end
end
subsection Bodies
  subsection block
    set Shape = polygon
    set Vertices = {corners}
  end
end
subsection Boundaries
  subsection base
    set Points = {base}
    set Constraint = {"roller" if dynamic else "fixed"}
  end
end
subsection Loads
  subsection push
    set Type = body force
    set Value = {"; ".join(f"{v * S / L!r}*t/{T!r}" for v in push)}
  end
end
subsection Time
  set End time = {(0.2 if dynamic else 1.) * T!r}
  set Steps = 8
  {"set Integrator = Newmark" if dynamic else ""}
end
subsection Probes
  subsection corner
    set Location = {probe}
    set Kind = nearest point
    set Quantities = displacement, stress
  end
end
"""


def beam(L, S, T, dynamic):
    return f"""
subsection Mesh
  set Lower corner = {text_of((0, 0), L)}
  set Upper corner = {text_of((4, 1), L)}
  set Cells = 16, 4
end
subsection Method
  set Method = finite element
end
subsection Materials
  subsection elastic
    set Young modulus = {2e5 * S!r}
    set Poisson ratio = 0.3
  end
end
subsection Bodies
  subsection beam
    set Lower corner = {text_of((0, 0), L)}
    set Upper corner = {text_of((4, 1), L)}
  end
end
subsection Grid conditions
  subsection left
    set Side = left
  end
end
subsection Loads
  subsection weight
    set Type = body force
    set Value = 0; {-20 * S / L!r}
  end
end
subsection Probes
  subsection tip
    set Location = {text_of((4, 0.5), L)}
    set Kind = interpolated
    set Quantities = displacement
  end
end
"""


def results(make, dynamic, L, S, T, settings):
    file = folder / "scene.prm"
    file.write_text(make(L, S, T, dynamic))
    found = run(file, {"Output/Points": "false", "Output/Mesh": "false",
                       **settings})
    values = {name: value / (L if name.startswith("u_") else S)
              for name, value in found.probes.items()}
    for name, force in found.reactions.items():
        values.update({f"{name} {d}": value / (S * L)
                       for d, value in enumerate(force)})
    for name, value in found.summary.get("energy", {}).items():
        if name != "balance_error":
            values[f"energy {name}"] = value / (S * L**2)
    counts = [found.summary[key] for key in (
        "steps", "rejected_steps", "newton_iterations", "linear_iterations",
        "active_cells", "points")]
    return values, counts


def scale_of(values, name):
    """The largest value of its kind."""
    kind = name.split(" ")[0].split("_")[0]
    return max(abs(value) for other, value in values.items()
               if other.split(" ")[0].split("_")[0] == kind)


for name, make, dynamic, settings in (
        ("plastic block, GIMP, finite strain", block, False, {}),
        ("plastic block, aggregated, cell means", block, False,
         {"Method/Aggregate below": 0.05, "Method/Volumetric strain": "cell mean"}),
        ("plastic block, multigrid", block, False, {"Solver/Solver": "gmres"}),
        ("block, Newmark", block, True, {}),
        ("beam, finite elements", beam, False, {}),
        ("beam, multigrid", beam, False, {"Solver/Solver": "amg-cg"})):
    reference, counts = results(make, dynamic, 1., 1., 1., settings)
    text(name, f"{counts[2]} Newton iterations in {counts[0]} steps")
    if dynamic:
        at_least("  plastic dissipation", reference["energy plastic_dissipation"],
                 0.01)
    elif make == block:
        elastic = results(make, dynamic, 1., 1., 1., {
            **settings, "Strength reduction/Factor": 1e-3})[0]
        at_least("  more displacement than without plasticity",
                 reference["u_x at corner"] / elastic["u_x at corner"] - 1, 0.05)
    # What rounding does to the data: a force along a roller is a difference.
    for group, limit in ((UNITS, 1e-11 if dynamic else 1e-12), (POWERS, 0)):
        for units, factors in group.items():
            values, others = results(make, dynamic, *factors, settings)
            bound(f"  {units}", max(
                abs(values[key] - reference[key]) / scale_of(reference, key)
                for key in reference), limit)
            text("    steps, iterations, cells, points",
                 "the same" if others == counts else f"NO: {others} {counts}")

# A threshold with a unit would be seen.
tolerance = {"Solver/Absolute tolerance": 1e-3}
first = results(block, False, 1., 1., 1., tolerance)
other = results(block, False, *POWERS["2^20, 2^-30, 2^20"], tolerance)
text("a threshold with a unit", "is seen" if first[1] != other[1] else "NO")
