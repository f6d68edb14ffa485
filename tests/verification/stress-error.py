# ranks: 2  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""The estimated error of stress, squared, is the share of the deflection that coarse
cells hold back (Galerkin's orthogonality: by forces, the energy of the error is the
energy that is missing)."""

from math import cos, hypot, radians, sin

# Cantilever of length 10 and height 1, anywhere in its mesh.
scene = scene_file("beam.prm", """
Mesh/Lower corner = -1.03, -1.03 | Upper corner = 12.97, 12.97
Method/Strain = small | Mesh after step = keep
Materials/steel/Young modulus = 1000 | Poisson ratio = 0.3
Bodies/beam/Shape = box | Lower corner = 0, 0 | Upper corner = 10, 1
Boundaries/wall/Body = beam | Part = left | Constraint = fixed
Loads/end/Type = surface traction | Body = beam | Part = right
Probes/tip/
""")


def bend(angle, method, h, degree=1):
    c, s = cos(radians(angle)), sin(radians(angle))
    result = run(scene, {
        "Mesh/Cell size": h, "Method/Method": method, "Method/Degree": degree,
        "Bodies/beam/Rotation angle": angle,
        "Loads/end/Value": f"{1e-3 * s!r}; {-1e-3 * c!r}",
        "Probes/tip/Location": f"{9.99 * c - 0.5 * s!r}, {9.99 * s + 0.5 * c!r}"})
    tip = hypot(*list(result.probes.values())[:2])
    return (tip, result.summary["estimated_stress_error"],
            [one for one in result.ids() if one == "coarse-stress"])


for angle in 0, 45:
    exact, error, _ = bend(angle, "finite element", 0.25, degree=2)
    bound(f"{angle} degrees, degree 2: estimated error", error, 0.05)
    for method in "finite element", "GIMP", "CPDI1":
        for h in 0.5, 0.25:
            tip, error, told = bend(angle, method, h)
            name = f"{angle} degrees, {method}, h = {h}"
            number(f"{name}: tip over that of degree 2", tip / exact, 2)
            number(f"{name}: estimated error", error, 2)
            if method == "finite element":
                # Boxes of GIMP are softer than the functions of elements.
                bound(f"{name}: share that is missing by the estimate, less that "
                      "which is", error ** 2 - (1 - tip / exact), 0.05)
            text(f"{name}: told of", len(told))

# Uniform stress, and nothing at all.
result = run("prm/verification/patch.prm", {})
bound("uniform stress: estimated error",
      result.summary["estimated_stress_error"], 1e-10)
result = run("prm/verification/rigid-motion.prm", {})
text("rigid motion: an estimate", "estimated_stress_error" in result.summary)

# Where the solution is known the estimate is near the error.
result = run("prm/verification/column.prm", {})
number("column: estimated error over that of stress",
       result.summary["estimated_stress_error"] / result.errors["l2_sigma"], 2)
