# ranks: 2  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Linear buckling of a cantilever under an axial force N: factors over those of
Euler's column, (2 k - 1)^2 pi^2 E I / (4 L^2 N); and what it refuses."""

import math

E, LENGTH, HEIGHT = 120000, 10, 0.5
EULER = math.pi**2 * E * HEIGHT**3 / 12 / (4 * LENGTH**2)

scene = scene_file("column.prm", f"""
Mesh/Lower corner = 0, -1 | Upper corner = 11, 1.5 | Cell size = 0.125
Materials/steel/Young modulus = {E} | Poisson ratio = 0
Bodies/column/Lower corner = 0, 0 | Upper corner = {LENGTH}, {HEIGHT}
Grid conditions/foot/Side = left
Loads/force/Type = surface traction | Body = column | Part = right | Curve = t
Loads/force/Value = {-0.2 * EULER / HEIGHT}; 0
Study/Kind = buckling
""")


def study(settings, expect=0, **keys):
    result = run(scene, settings, command="study", expect=expect, **keys)
    result.cases = result.summary.get("cases", [])
    return result


def factors(settings):
    return study(settings).cases[0]["load_factors"]


Q2 = {"Method/Method": "finite element", "Method/Degree": 2}
for k, factor in enumerate(factors(Q2), 1):
    # With Engesser's shear; the second term of K_g adds the stress to E.
    euler = (2 * k - 1)**2 * 5
    strain = euler * 0.2 * EULER / (E * HEIGHT)
    bound(f"degree 2, mode {k}: factor over that of a column - 1",
          factor / euler * (1 + strain / (5 / 6 / 2)) / (1 + strain) - 1, 1e-3)
for method in ("finite element", "GIMP", "CPDI2", "material point"):
    factor = factors({"Method/Method": method})[0]
    bound(f"{method}: over Euler's - 1", factor / 5 - 1,
          0.04 if method == "finite element" else 0.01)

# The factor is one over the load, with points that stay; and of two cases.
result = study({**Q2, "Loads/force/Curve": "{{t|2*t}}"})
first, second = (case["load_factors"][0] for case in result.cases)
bound("twice the load: factor over a half - 1", 2 * second / first - 1, 1e-8)
text("said", [line.strip() for line in result.output.splitlines()
              if "times the load" in line])
rows = (result.folder / "study.csv").read_text().splitlines()[1:]
text("rows of study.csv", len(rows))
text("no load: factors", factors({"Loads/force/Value": "0; 0"}))
at_least("pulled: smallest factor over modulus over stress",
         factors({"Loads/force/Value": "60; 0"})[0] * 60 / E, 0.99)

for settings in ({"Method/Strain": "finite"},
                 {"Time/Integrator": "Newmark", "Materials/steel/Density": 1},
                 {"Study/Error": "r_u"}):
    refused = study(settings, expect=2)
    text("refused", plain(next(line for line in refused.output.splitlines()
                               if "moraine: " in line)))
result = study({"Mesh/Cell size": 10, "Mesh/Upper corner": "20, 9"}, expect=1,
               on_ranks=1)
text("too few unknowns", result.cases[0]["message"])
