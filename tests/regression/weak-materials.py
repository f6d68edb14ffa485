# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Newton's tangent is right however small the strains are at which a material
yields, so that a stiff one is no weaker than a soft one."""

import json

scene = scene_file("sheared.prm", """
Mesh/Lower corner = 0, 0 | Upper corner = 1, 1 | Cells = 8, 8
Method/Mesh after step = keep
Materials/block/Model = von Mises | Young modulus = 1000 | Poisson ratio = 0.3
Materials/block/Shear yield stress = 1
Bodies/block/Lower corner = 0, 0 | Upper corner = 1, 1
Grid conditions/bottom/Side = bottom
Grid conditions/top/Side = top | Displacement = 5*$k/1000*t; 0
Constants/k = 1
Time/Steps = 10
Output/Write = end
""")
forces = {}
for strain in "small", "finite":
    for k in (1e-1, 1e-4, 1e-6, 1e-8):
        sheared = run(scene, {
            "Constants/k": k, "Method/Strain": strain,
            "Method/Method": "finite element",
            "Method/Mesh after step": "keep" if strain == "small" else "default",
            "Materials/block/Shear yield stress": k})
        forces[k] = -sheared.history()[-1]["reaction_x of bottom"] / k
        text(f"{strain} strain, yields at {k / 1000:g}: rejected steps",
             sheared.summary["rejected_steps"])
        bound("  Newton iterations", sheared.summary["newton_iterations"], 60)
        bound("  force over that of the largest", forces[k] / forces[0.1] - 1,
              0.01)

slope = run("prm/geotechnics/factor-of-safety.prm", {
    "Mesh/Cell size": 2, "Time/Steps": 4, "Strength reduction/Tolerance": 0.05,
    "Materials/clay/Young modulus": "{{10e3|32e8}}"}, command="study")
factors = [case["factor_of_safety"] for case in
           json.loads((slope.folder / "summary.json").read_text())["cases"]]
bound("factor of safety of clay 3e5 times as stiff differs by",
      factors[1] - factors[0], 1e-12)
