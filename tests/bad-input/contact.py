# ranks: 1
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Contact that cannot be."""

scene = scene_file("block.prm", """
Mesh/Lower corner = -0.5, -0.5 | Upper corner = 2.5, 2.5 | Cell size = 0.5
Materials/soil/Young modulus = 1e4 | Poisson ratio = 0.3
Bodies/block/Lower corner = 0, 0 | Upper corner = 2, 2
Boundaries/floor/Points = -1 0; 3 0 | Constraint = contact
Loads/weight/Type = body force | Value = 0; -1
""")


def refused(name, settings):
    result = run(scene, {(key if "/" in key else f"Boundaries/floor/{key}"): value
                         for key, value in settings.items()}, expect=2)
    text(name, plain(" | ".join(
        line.strip() for line in result.output.splitlines()
        if line.startswith("moraine: "))))


refused("friction with a bilateral constraint", {"Constraint": "roller",
                                                 "Friction": 0.3})
refused("separation with a bilateral constraint", {"Constraint": "fixed",
                                                   "Separation": "false"})
refused("negative friction", {"Friction": -0.3})
refused("negative adhesion", {"Adhesion": -1})
refused("negative friction angle", {"Friction angle": -5})
refused("negative tensile strength", {"Tensile strength": -1})
refused("friction twice", {"Friction": 0.3, "Friction angle": 20})
refused("friction angle of a cliff", {"Friction angle": 90})
refused("adhesion that the least tension breaks", {"Adhesion": 1})
refused("tension that has no end", {"Tensile strength": 1, "Separation": "false"})
refused("another enforcement", {"Enforcement": "penalty"})
refused("flux in dynamics", {"Enforcement": "incomplete Nitsche",
                             "Materials/soil/Density": 1,
                             "Time/Integrator": "Newmark"})
refused("flux at finite strain", {"Enforcement": "incomplete Nitsche",
                                  "Method/Strain": "finite"})
refused("flux for contact", {"Enforcement": "incomplete Nitsche",
                             "Constraint": "roller"})
refused("keys of others", {"Enforcement": "augmented Lagrangian",
                           "Nitsche factor": 5})
refused("keys of others", {"Penetration limit": 0.1})
refused("surface that is bent on the way", {"Displacement": "0; 0.1*x*t"})
refused("no surface", {"Points": ""})
refused("rim of a body that is not there", {"Points": "", "Body": "blok"})
refused("surface the other way round", {"Points": "3 0; -1 0"})
refused("overlap", {"Points": "-1 0.3; 3 0.3"})
refused("nothing near it", {"Points": "-1 -2; 3 -2"})
