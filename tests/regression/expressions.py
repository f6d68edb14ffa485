# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Bodies and surfaces drawn by expressions: results depend neither on the number
an expression is multiplied with, nor on where the scene lies."""

LOADED = prm("""
Mesh/Lower corner = 0, 0 | Upper corner = 10, 4 | Cell size = 1
Method/Method = finite element
Materials/soil/Young modulus = 1e4 | Poisson ratio = 0.3
Bodies/soil/Shape = expression | Expression = {scale} * (4.5 - abs(x - 5))
Grid conditions/base/Side = bottom
Loads/crest/Type = surface traction | Points = 10 3.5; 0 3.5 | Value = 0; -2
""")
for scale in 1, 1e-3, 1e-6, 1e4:
    (folder / "loaded.prm").write_text(LOADED.format(scale=scale))
    result = run(folder / "loaded.prm")
    force = result.summary["reactions"]["base"][1]
    bound(f"level times {scale:g}: force on 9 of width, off 18",
          abs(force / 18 - 1), 1e-9)

ROLLER = prm("""
Mesh/Lower corner = {x}, {y} | Upper corner = {x} + 4, {y} + 3 | Cell size = 0.25
Method/Method = material point
Method/Strain = finite
Materials/soil/Young modulus = 1000 | Poisson ratio = 0.3 | Density = 1
Bodies/soil/Shape = expression
Bodies/soil/Expression = min(y - {y} - 0.6 - 0.2*sin(2*(x - {x})), {y} + 2.6 - y)
Boundaries/bed/Surface = expression
Boundaries/bed/Expression = y - {y} - 0.6 - 0.2*sin(2*(x - {x})) | Constraint = roller
Grid conditions/left/Side = left | Components = x
Loads/weight/Type = gravity | Value = 0; -10
Probes/toe/Location = {x} + 3.9, {y} + 1.2
Time/Steps = 4
""")
results = []
for x, y in (0, 0), (4.2e5, 4.6e6):
    (folder / "roller.prm").write_text(
        ROLLER.replace("{x} + 4", repr(x + 4)).replace("{y} + 3", repr(y + 3))
        .replace("{x} + 3.9, {y} + 1.2", f"{x + 3.9!r}, {y + 1.2!r}")
        .format(x=x, y=y))
    results.append(run(folder / "roller.prm"))
here, there = results
for name, value in here.probes.items():
    number(name, value, 5)
bound("far from the origin they differ by", max(
    abs(there.probes[name] - value) for name, value in here.probes.items()) /
    max(map(abs, here.probes.values())), 1e-5)
bound("force of the bed differs by", max(
    abs(a - b) for a, b in zip(there.summary["reactions"]["bed"],
                               here.summary["reactions"]["bed"])) /
    max(map(abs, here.summary["reactions"]["bed"])), 1e-5)
