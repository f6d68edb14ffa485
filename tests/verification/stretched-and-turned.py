# debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A bar that a roller stretches to 1.5 times its length while it turns by 90 degrees
through the cells: the force is that of finite elements. See 'Means over cells' in
doc/topics/implicit-boundaries.md."""

from math import hypot

scene = scene_file("bar.prm", """
Mesh/Lower corner = -2, -2 | Upper corner = 8, 8 | Cell size = 0.25
Method/Strain = finite
Materials/rubber/Young modulus = 1000 | Poisson ratio = 0.3
Bodies/bar/Lower corner = 0, 0 | Upper corner = 4, 1
Boundaries/hinge/Body = bar | Part = left | Rotation angle = 90*t
Boundaries/hinge/Rotation centre = 0, 0.5
Boundaries/pull/Body = bar | Part = right | Constraint = roller
Boundaries/pull/Rotation angle = 90*t | Rotation centre = 0, 0.5
Boundaries/pull/Translation = 2*t*cos(pi*t/2); 2*t*sin(pi*t/2)
Time/Steps = 40
""")
NITSCHE = {"Boundaries/*/Enforcement": "skew Nitsche"}
YIELDS = {"Materials/rubber/Model": "von Mises",
          "Materials/rubber/Uniaxial yield stress": "0: 30, 1: 230"}
SOFT = {"Materials/rubber/Poisson ratio": 0.49}


def bar(method, settings):
    """At the end: the force along it, and of the moments about the hinge what is
    left of the largest one in the run."""
    rows = run(scene, {"Method/Method": method, "Output/Points": "false",
                       "Output/Mesh": "false", **settings}).history()
    last = rows[-1]
    # The moment of the roller is about an axis that moves with it.
    pull = last["moment of pull"] - 2 * last["reaction_x of pull"]
    return (hypot(last["reaction_x of pull"], last["reaction_y of pull"]),
            (pull + last["moment of hinge"])
            / max(abs(row["moment of hinge"]) for row in rows))


exact = {}
for name, settings in (("elastic", {}), ("yields", YIELDS), ("0.49", SOFT)):
    exact[name] = bar("finite element", settings)[0]
    number(f"finite elements, {name}", exact[name], 4)
for method, name, settings, allowed in (
        ("CPDI1", "elastic", {}, 0.02), ("CPDI2", "elastic", {}, 0.01),
        ("CPDI1", "yields", YIELDS, 0.04), ("CPDI2", "yields", YIELDS, 0.02),
        ("CPDI1", "0.49", SOFT, 0.06), ("CPDI2", "0.49", SOFT, 0.04)):
    force, unbalanced = bar(method, settings)
    bound(f"{method}, {name}: force over that of finite elements - 1",
          force / exact[name] - 1, allowed)
    bound("  moments in balance", unbalanced, 1e-7)
for method in ("CPDI1", "CPDI2"):
    bound(f"{method}, skew Nitsche: force over that of finite elements - 1",
          bar(method, NITSCHE)[0] / exact["elastic"] - 1, 0.02)
