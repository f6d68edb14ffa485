# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Modified Cam-clay: the triaxial test that is shipped; blocks in a mesh against the
point, with all methods; geostatic starts with OCR and POP; strength reduction."""
import csv
import math

SHIPPED = "prm/studies/triaxial-clay.prm"
CLAY = """Materials/clay/Model = Cam-clay | Critical state angle = 30
Materials/clay/Compression index = 0.1 | Swelling index = 0.02 | Shear modulus = 4000
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
      rows[-1]["p"] / (100 * 0.5**0.8) - 1, 0.01)
number("undrained: q at 10 %", rows[-1]["q"], 4)

# Oedometer from 100 kPa all around to a strain of 5 %.
oedometer = scene_file("oedometer.prm", f"""
Mesh/Lower corner = 0, 0 | Upper corner = 2, 3 | Cell size = 1
{CLAY}
Bodies/clay/Shape = box | Lower corner = 0, 0 | Upper corner = 2, 2
Bodies/clay/Initial stress = -100; -100; -100; 0
Grid conditions/left/Side = left | Components = x
Grid conditions/right/Side = right | Components = x
Grid conditions/base/Side = bottom | Components = y
Boundaries/plate/Points = 0 2; 2 2 | Constraint = roller | Displacement = 0; -0.1 * t
Time/Steps = 20
""")
for strain in ("small", "finite"):
    # Logarithmic strains at finite strain: the axial one is ln(0.95).
    last = point({"Material test/Kind": "oedometer", "Method/Strain": strain,
                  "Material test/Legs": "to strain -0.05",
                  "Material test/Steps": 20, "Materials/clay/Normal K0": 1})[-1]
    for method in ("finite element", "material point", "GIMP", "CPDI1"):
        if strain == "small" and method == "CPDI1":
            continue
        result = run(oedometer, {"Method/Method": method, "Method/Strain": strain})
        print(result.output)
