# ranks: 2  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""The mesh file has the displacement of all of a step, also of one in two parts."""

scene = scene_file("scene.prm", """
Mesh/Lower corner = 0, 0 | Upper corner = 1, 1 | Cell size = 0.5
Materials/m/Young modulus = 1000 | Poisson ratio = 0.3 | Density = 1
Bodies/b/Lower corner = 0, 0 | Upper corner = 1, 1
Grid conditions/base/Side = bottom
Loads/weight/Type = gravity | Value = 0; -10
Probes/top/Location = 0.5, 1 | Kind = interpolated | Quantities = displacement
Output/Write = end
""")
for method, limit in (("finite element", 1e-5), ("GIMP", 1e-2)):
    for integrator in "Bathe", "Newmark":
        result = run(scene, {"Method/Method": method,
                             "Time/Integrator": integrator, "Time/Steps": 4,
                             "Time/End time": 0.04})
        before, last = result.history()[-2:]
        moved = [u for place, u in result.nodes("position", "step_displacement")
                 if place[0] == 0.5 and abs(place[1] - 1) < 0.1]
        bound(f"{method}, {integrator}: displacement of the last step, of a node "
              "over that of a probe - 1",
              moved[0][1] / (last["u_y at top"] - before["u_y at top"]) - 1, limit)
