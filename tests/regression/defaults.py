# ranks: 1
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Defaults: the method, and means of the volumetric strain where a material yields or has
a Poisson ratio above 0.4, if nothing in the scene excludes them."""

BLOCK = "prm/hard-cases/cut-block.prm"
NU = "Materials/elastic/Poisson ratio"
MODEL, YIELD = "Materials/elastic/Model", "Materials/elastic/Uniaxial yield stress"
SOFT = {NU: 0.45}
NEWMARK = {"Time/Integrator": "Newmark", "Time/End time": 1e-3, "Time/Steps": 1,
           "Materials/elastic/Density": 1}
for name, settings in (
        ("nu = 0.4", {NU: 0.4}),
        ("nu = 0.41", {NU: 0.41}),
        ("von Mises", {MODEL: "von Mises", YIELD: 1e6}),
        ("said", {**SOFT, "Method/Volumetric strain": "pointwise"}),
        ("degree 2", {**SOFT, "Method/Method": "finite element",
                      "Method/Degree": 2}),
        ("double mapping", {**SOFT, "Method/Method": "DM-GC"}),
        ("Newmark", {**SOFT, **NEWMARK}),
        ("energy-momentum", {**SOFT, **NEWMARK, "Method/Strain": "finite",
                             "Time/Integrator": "energy-momentum"}),
        ("stiffness damping", {**SOFT, **NEWMARK,
                               "Bodies/block/Stiffness damping": 1e-3})):
    result = run(BLOCK, {"Output/Points": "false", "Output/Mesh": "false",
                         **settings})
    text(f"{name}: means", "volumetric strain: cell means" in result.output)
    text(f"{name}: found", result.found())

# A scene that names no method has GIMP where its boxes fit the cells.
for name, scene in (("a box", "prm/boundaries/tilted-roller.prm"),
                    ("quadrilaterals", "prm/verification/mesh-quads.prm"),
                    ("a box that stretches", "prm/large-deformation/stretch-3d.prm")):
    result = run(scene, {"Method/Method": "auto"}, command="check")
    text(f"method on {name}", result.output.split("  method      ")[1].split(",")[0])
