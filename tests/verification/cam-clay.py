# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Modified Cam-clay: the triaxial test that is shipped; blocks in a mesh against the
point, with all methods; geostatic starts with OCR and POP; strength reduction."""
import csv
import math

SHIPPED = "prm/studies/triaxial-clay.prm"
CLAY = """Materials/clay/Model = Cam-clay | Critical state angle = 30
Materials/clay/Compression index = 0.1 | Swelling index = 0.02
Materials/clay/Minimum pressure = 1"""


def table(result_folder):
    with open(next(result_folder.glob("*.csv"))) as rows:
        return [{key.split(" [")[0]: float(value) for key, value in row.items()}
                for row in csv.DictReader(rows)]


def point(settings):
    """The last row of a test of the point."""
    where = folder / f"point-{len(list(folder.glob('point-*')))}"
    run(SHIPPED, settings, command="test-material", extra=["--output", where])
    return table(where)


rows = point({})
bound("undrained: errors of tangents", max(row["tangent_error"] for row in rows), 2e-5)
bound("undrained: p at 10 % over that of the critical state - 1",
      -rows[-1]["p"] / (100 * 0.5**0.8) - 1, 0.01)
number("undrained: q at 10 %", rows[-1]["q"], 4)

# Oedometer from 100 kPa all around to a height of 95 %.
oedometer = scene_file("oedometer.prm", f"""
Mesh/Lower corner = 0, 0 | Upper corner = 2, 3 | Cell size = 1
{CLAY}
Materials/clay/Shear modulus = 4000 | Normal K0 = 1
Bodies/clay/Shape = box | Lower corner = 0, 0 | Upper corner = 2, 2
Bodies/clay/Initial stress = -100; -100; -100; 0
Grid conditions/left/Side = left | Components = x
Grid conditions/right/Side = right | Components = x
Grid conditions/base/Side = bottom | Components = y
Boundaries/plate/Points = 2 2; 0 2 | Constraint = roller
Time/Steps = 20
""")
for strain, height, axial in (("small", "2 * (1 - 0.05 * t)", -0.05),
                              ("finite", "2 * 0.95^t", math.log(0.95))):
    last = point({"Material test/Kind": "oedometer", "Method/Strain": strain,
                  "Material test/Legs": f"to strain {axial:.15g}",
                  "Material test/Steps": 20})[-1]
    for method in ("finite element", "material point", "GIMP", "CPDI1"):
        if method == ("CPDI1" if strain == "small" else "material point"):
            continue  # points that cross cells leave equilibrium
        result = run(oedometer, {
            "Method/Method": method, "Method/Strain": strain,
            "Boundaries/plate/Displacement": f"0; {height} - 2",
            **({"Method/Mesh after step": "keep"} if strain == "small" else {})})
        volume = math.exp(axial) if strain == "finite" else 1  # of Kirchhoff's stress
        error = max(abs(s[0] * volume / last["sigma_xx"] - 1) +
                    abs(s[4] * volume / last["sigma_zz"] - 1)
                    for s, in result.points("stress"))
        bound(f"oedometer, {strain} strain, {method}: stress over the point's - 1",
              error, 1e-6)
    number(f"oedometer, {strain} strain: vertical stress", last["sigma_zz"], 6)

# Drained triaxial compression by 5 %, a block of 8 cells with 100 kPa on its sides.
triaxial = scene_file("triaxial.prm", f"""
Dimension = 3
Mesh/Lower corner = 0, 0, 0 | Upper corner = 1, 1, 1 | Cell size = 0.5
Method/Method = finite element | Strain = small | Mesh after step = keep
{CLAY}
Materials/clay/Shear modulus = 4000 | Normal K0 = 1
Bodies/clay/Shape = box | Lower corner = 0, 0, 0 | Upper corner = 1, 1, 1
Bodies/clay/Initial stress = -100; -100; -100; 0; 0; 0
Grid conditions/left/Side = left | Components = x
Grid conditions/front/Side = front | Components = y
Grid conditions/base/Side = bottom | Components = z
Grid conditions/plate/Side = top | Components = z | Displacement = 0; 0; -0.05 * t
Loads/x/Type = side traction | Side = right | Value = -100; 0; 0
Loads/y/Type = side traction | Side = back | Value = 0; -100; 0
Time/Steps = 20
""")
last = point({"Material test/Kind": "triaxial drained",
              "Material test/Legs": "to strain -0.05", "Material test/Steps": 20})[-1]
result = run(triaxial)
bound("triaxial drained, 3D: stress over the point's - 1",
      max(abs(s[8] / last["sigma_zz"] - 1) for s, in result.points("stress")), 1e-6)
number("triaxial drained, 3D: vertical stress", last["sigma_zz"], 6)

# Geostatic start: overconsolidated by POP and OCR, surface at y = 10.
ground = scene_file("ground.prm", f"""
Mesh/Lower corner = 0, 0 | Upper corner = 2, 12 | Cell size = 1
{CLAY}
Materials/clay/Shear modulus = 1000 + 300 * (10 - y)
Materials/clay/Density = 0.8 | OCR = 1.2 | POP = 10
Bodies/clay/Shape = box | Lower corner = 0, 0 | Upper corner = 2, 10
Bodies/clay/Initial stress = geostatic
Grid conditions/left/Side = left | Components = x
Grid conditions/right/Side = right | Components = x
Grid conditions/base/Side = bottom | Components = y
Loads/weight/Type = gravity | Value = 0; -10
Time/Steps = 1
""")
for method in ("finite element", "GIMP"):
    result = run(ground, {"Method/Method": method})
    worst = moved = 0
    for x, stress, p_c, u in result.points("position", "stress",
                                           "preconsolidation_pressure",
                                           "displacement"):
        vertical = -stress[4]
        most = 1.2 * vertical + 10
        K0 = 0.5 * (most / vertical)**0.5
        worst = max(worst, abs(-stress[0] / vertical - K0),
                    abs(-stress[8] / vertical - K0),
                    abs(p_c / (most * (2 / 3 + 0.25 / (1.44 * 2 / 3))) - 1))
        moved = max(moved, abs(u[0]), abs(u[1]))
    bound(f"geostatic start, {method}: K0 and p_c", worst, 1e-6)
    bound(f"geostatic start, {method}: displacement", moved, 1e-10)
