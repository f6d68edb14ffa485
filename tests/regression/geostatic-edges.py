# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Ground at rest: points straight below the joint of two bodies bear what stands on
both sides of it, and a coordinate that was rounded is no gap. A layer drawn by an
expression bears down whatever number that is multiplied with."""

GROUND = prm("""
Dimension = {dim}
Mesh/Lower corner = {lower} | Upper corner = {upper} | Cell size = 1
Materials/soil/Young modulus = 30e3 | Poisson ratio = 0.35 | Density = 1.9
Grid conditions/left/Side = left | Components = x
Grid conditions/right/Side = right | Components = x
Grid conditions/bottom/Side = bottom
Loads/weight/Type = gravity | Value = {gravity}
""")
SIDES_3D = prm("""
Grid conditions/front/Side = front | Components = y
Grid conditions/back/Side = back | Components = y
""")


def body(name, keys):
    lines = "".join(f"    set {key} = {value}\n" for key, value in keys.items())
    return (f"subsection Bodies\n  subsection {name}\n{lines}"
            "    set Initial stress = geostatic\n    set K0 = 0.6\n  end\nend\n")


def box(name, lower, upper):
    return body(name, {"Lower corner": lower, "Upper corner": upper})


def at_rest(title, scene, limit, settings=None):
    file = folder / "ground.prm"
    file.write_text(scene)
    ground = run(file, settings)
    upward = 2 if "Dimension = 3" in scene else 1
    points = ground.points("stress", "position")
    bound(f"{title}: vertical stress over weight - 1",
          max(abs(stress[4 * upward] / (19 * x[upward]) - 1)
              for stress, x in points), limit)


FLAT = GROUND.format(dim=2, lower="-4, -6", upper="4, 1", gravity="0; -10")
TWO = (FLAT + box("clay", "-4, -6", "4, -3") + box("a", "-4, -3", "0.75, 0")
       + box("b", "0.75, -3", "4, 0"))
for method in ("material point", "GIMP", "CPDI2"):
    at_rest(f"two fills, {method}", TWO, 1e-9, {"Method/Method": method})
at_rest("two fills, finite element, degree 2", TWO.replace("0.75", "0.5"), 1e-6,
        {"Method/Method": "finite element", "Method/Degree": 2})
at_rest("3D", GROUND.format(dim=3, lower="-2, -2, -4", upper="2, 2, 1",
                            gravity="0; 0; -10") + SIDES_3D
        + box("clay", "-2, -2, -4", "2, 2, -2")
        + box("a", "-2, -2, -2", "0.75, 0.25, 0")
        + box("b", "0.75, -2, -2", "2, 0.25, 0")
        + box("c", "-2, 0.25, -2", "2, 2, 0"), 1e-9)

# A vertex that is half a millimetre too high.
LAYERS = FLAT + body("below", {
    "Shape": "polygon", "Vertices": "-4 -6; 4 -6; 4 -2.4; -4 -3.5"}) + body(
    "above", {"Shape": "polygon",
              "Vertices": "-4 -3.5; 1 {y}; 4 -2.4; 4 0; -4 0"})
at_rest("layers that meet", LAYERS.replace("{y}", "-2.8125"), 2e-3)
at_rest("layers 0.5 mm apart", LAYERS.replace("{y}", "-2.812"), 2e-3)

# Thinner than a cell: with points on both sides of it, next to a larger number it
# would be stepped over.
CRUST = FLAT + box("clay", "-4, -6", "4, -0.7")
for name, expression in (
        ("drawn as a distance", "min(-y, y + 0.7)"),
        ("times 1000", "1e3*min(-y, y + 0.7)"), ("over 1000", "1e-3*min(-y, y + 0.7)"),
        ("as a product", "-y*(y + 0.7)"), ("as a product times 1e5", "-1e5*y*(y + 0.7)")):
    at_rest(f"crust {name}", CRUST + body(
        "crust", {"Shape": "expression", "Expression": expression}), 1e-6,
        {"Method/Method": "GIMP"})
JOINED = "".join(body(name, {"Shape": "expression", "Expression": expression})
                 for name, expression in (
                     ("a", "1e3*min(min(-y, y + 3), 0.75 - x)"),
                     ("b", "1e3*min(min(-y, y + 3), x - 0.75)")))
at_rest("two fills drawn by expressions", FLAT + box("clay", "-4, -6", "4, -3")
        + JOINED, 1e-6)
