# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Bodies under water are those with their buoyant weight in air: displacements and
stresses of a block and of a slope on an inclined boundary, by all methods. What holds
a disc has its weight less that of the water that it displaces, with its moment."""

from math import pi

BLOCK = """
Dimension = 2
Mesh/Lower corner = 0, 0 | Upper corner = 6, 6 | Cell size = 1
Method/Method = finite element | Mesh after step = keep
Materials/soil/Young modulus = 1000 | Poisson ratio = 0.3 | Density = 2
Bodies/block/Lower corner = 0, 0 | Upper corner = 4, 3
Grid conditions/base/Side = bottom
Loads/weight/Type = gravity | Value = 0; -10
Water/Level = 12 | Unit weight = 10
Time/Steps = 1
Probes/top/Location = 2.9, 2.9 | Quantities = displacement, stress
Probes/corner/Location = 0.1, 0.1 | Quantities = displacement, stress
"""
SLOPE = """
Dimension = 2
Mesh/Lower corner = -1, -1 | Upper corner = 11, 8 | Cell size = 0.75
Method/Method = GIMP | Mesh after step = keep
Materials/soil/Young modulus = 1000 | Poisson ratio = 0.3 | Density = 2
Bodies/slope/Shape = polygon | Vertices = 0 0; 9.3 1.2; 6 4; 0 6.1
Boundaries/base/Points = 0 0; 9.3 1.2 | Constraint = fixed
Boundaries/left/Points = 0 6.1; 0 0 | Constraint = roller
Loads/weight/Type = gravity | Value = 0; -10
Water/Level = 12 | Unit weight = 10
Time/Steps = 1
Probes/top/Location = 2.9, 4.5 | Quantities = displacement, stress
Probes/toe/Location = 8, 1.5 | Quantities = displacement, stress
"""
METHODS = {"FE": {"Method/Method": "finite element"},
           "MPM": {"Method/Method": "material point"},
           "MPM, fitted weights": {"Method/Method": "material point",
                                   "Method/Mesh after step": "reset",
                                   "Method/Point weights": "fitted to cells"},
           "GIMP": {"Method/Method": "GIMP"}, "CPDI1": {"Method/Method": "CPDI1"},
           "GIMP, points move": {"Method/Method": "GIMP",
                                 "Method/Mesh after step": "reset"}}
for name, scene in (("block", BLOCK), ("slope on boundaries", SLOPE)):
    wet = scene_file("wet.prm", scene)
    dry = scene_file("dry.prm", scene.replace("Water/Level = 12 | Unit weight = 10\n", "")
                     .replace("Density = 2", "Density = 1"))
    for method, settings in METHODS.items():
        if method == ("FE" if name != "block" else "MPM"):
            continue
        a, b = (run(scene, {**settings, **QUIET}) for scene in (wet, dry))
        for kind in ("u_", "sigma_"):
            size = max(abs(b.probes[key]) for key in b.probes if key.startswith(kind))
            bound(f"{name}, {method}: difference of {kind}",
                  max(abs(a.probes[key] - b.probes[key]) for key in b.probes
                      if key.startswith(kind)) / size, 1e-10)
        for condition, reaction in b.reactions.items():
            bound(f"{name}, {method}: reaction of {condition}",
                  max(abs(x - y) for x, y in zip(a.reactions[condition], reaction))
                  / 120, 1e-10)

# A disc that a boundary holds along its rim, in a pressure that grows in both
# directions: force and moment are those of the volume of its points.
DISC = """
Dimension = 2
Mesh/Lower corner = -1.35, -1.35 | Upper corner = 1.35, 1.35 | Cell size = 0.3
Method/Method = GIMP | Mesh after step = keep
Materials/soil/Young modulus = 1000 | Poisson ratio = 0.3 | Density = 0
Bodies/disc/Shape = disc | Centre = 0.1, 0.2 | Radius = 1
Boundaries/rim/Body = disc | Constraint = fixed | Enforcement = augmented Lagrangian
Water/Pressure = 100 + 3*x - 10*y | Unit weight = 10
Time/Steps = 1
"""
disc = scene_file("disc.prm", DISC)
for method in ("MPM", "GIMP", "CPDI1"):
    for outer, force in (({}, (-3, 10)), ({"Water/Free level": 8}, (0, 10))):
        result = run(disc, {**METHODS[method], **outer, **QUIET})
        row = result.history()[-1]
        which = f"disc, {method}" + (", free level" if outer else "")
        volume = row["force_y of water"] / 10
        bound(f"{which}: volume of points", volume / pi - 1, 2e-3)
        for d, name in enumerate("xy"):
            bound(f"{which}: force_{name} of water",
                  row[f"force_{name} of water"] - force[d] * volume, 1e-10)
            bound(f"{which}: reaction_{name}",
                  result.reactions["rim"][d] + force[d] * volume, 1e-8)
