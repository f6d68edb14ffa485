# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Moments at small strain balance in the places in which forces do, those at the
start of a step: of the weight of a block whose base is turned, and of the two rims
of a ring, which cancel."""

from math import cos, pi, radians, sin

MATERIAL = prm("""
Materials/m/Young modulus = {E} | Poisson ratio = {nu} | Density = 1
Output/Write = end
""")
scene = folder / "scene.prm"

# Weight 40, arm 4.
scene.write_text(MATERIAL.format(E=1e6, nu=0.3) + prm("""
Mesh/Lower corner = -1, -1 | Upper corner = 6, 4 | Cell size = 0.25
Bodies/b/Lower corner = 3, 0.1 | Upper corner = 5, 2.1
Boundaries/base/Body = b | Part = bottom | Rotation angle = 5*t
Loads/weight/Type = gravity | Value = 0; -10
"""))
KEEP = {"Method/Mesh after step": "keep"}
for method in "material point", "GIMP", "finite element":
    for name, settings, turned in (
            ("one step, places kept", KEEP, 0),
            ("four steps, places kept", {**KEEP, "Time/Steps": 4}, 0),
            ("one step", {}, 0), ("four steps", {"Time/Steps": 4}, 3.75),
            ("four steps, pushed meanwhile", {
                "Time/Steps": 4, "Boundaries/base/Translation": "0.5*t; 0"}, 3.75)):
        last = run(scene, {"Method/Method": method, **settings},
                   on_ranks=None if name == "four steps" else 1).history()[-1]
        angle = radians(turned)
        bound(f"block, {method}, {name}: moment over that of the weight - 1",
              last["moment of base"] / (40 * (4 * cos(angle) - 1.1 * sin(angle))) - 1,
              1e-3 if turned else 1e-8)

# Both rims of a ring, by surfaces and by nodes.
RIMS = ("inner", "5*t"), ("outer", "0*t")
G = 1e4 / 2.6
EXACT = 4 * pi * G * 0.25 * 2.25 / 2 * sin(radians(5))
SURFACES = MATERIAL.format(E=1e4, nu=0.3) + prm("""
Mesh/Lower corner = -1.63, -1.61 | Upper corner = 1.67, 1.69 | Cell size = 0.1
Bodies/b/Shape = ring | Centre = 0, 0 | Radius = 1.5 | Inner radius = 0.5
""" + "\n".join(f"Boundaries/{name}/Body = b | Part = {name} | Rotation angle = {angle}"
                for name, angle in RIMS))
NODES = MATERIAL.format(E=1e4, nu=0.3) + prm("""
Mesh/Type = generator | Generator = hyper_shell | Refinements = 2
Mesh/Arguments = 0,0 : 0.5 : 1.5 : 32 : true | Side names = inner: 0, outer: 1
Bodies/b/Shape = mesh
""" + "\n".join(f"Grid conditions/{name}/Side = {name} | Rotation angle = {angle}"
                for name, angle in RIMS))
for name, words, settings in (
        ("surfaces, points move", SURFACES, {}),
        ("surfaces, points move in five steps", SURFACES, {"Time/Steps": 5}),
        ("surfaces, places kept", SURFACES, KEEP),
        ("nodes, places kept", NODES, {"Method/Method": "finite element", **KEEP}),
        ("nodes that move in five steps", NODES,
         {"Method/Method": "finite element", "Time/Steps": 5})):
    scene.write_text(words)
    last = run(scene, settings).history()[-1]
    inner, outer = last["moment of inner"], last["moment of outer"]
    bound(f"ring, {name}: sum of moments over one", (inner + outer) / inner, 1e-8)
    if "kept" in name:
        bound(f"ring, {name}: moment over the exact one - 1", inner / EXACT - 1, 0.03)
