# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Soil between walls on a base that holds all of its components: the thrust on a
wall that is an implicit boundary, though nodes of the base hold its lowest cell
too. By the exact stress it is nu/(1 - nu) rho g H^2/2."""

scene = scene_file("scene.prm", """
Mesh/Lower corner = -0.5, 0 | Upper corner = 2.5, 2.5 | Cell size = 0.5
Method/Method = finite element
Materials/soil/Young modulus = 1e6 | Poisson ratio = 0.3 | Density = 1
Bodies/soil/Lower corner = 0, 0 | Upper corner = 2, 2
Boundaries/left/Body = soil | Part = left | Constraint = roller
Boundaries/right/Body = soil | Part = right | Constraint = roller
Grid conditions/base/Side = bottom
Loads/weight/Type = gravity | Value = 0; -9.81
Output/Write = end
""")
EXACT = 0.3 / 0.7 * 9.81 * 2
for method in ("finite element", "material point", "GIMP"):
    for how, keys in (("finite strain", {"Method/Strain": "finite"}),
                      ("multipliers",
                       {"Boundaries/*/Enforcement": "augmented Lagrangian"}),
                      ("penalty", {"Boundaries/*/Enforcement": "penalty"}),
                      ("weighted", {"Boundaries/*/Enforcement": "weighted"})):
        forces = run(scene, {"Method/Method": method, **keys}).summary["reactions"]
        bound(f"{method}, {how}: thrust over the exact one - 1",
              abs(forces["left"][0] / EXACT - 1), 0.01)
        bound(f"{method}, {how}: forces in balance",
              max(abs(sum(force[0] for force in forces.values())),
                  abs(sum(force[1] for force in forces.values()) / 39.24 - 1)),
              1e-6)
