# debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A bar that a roller stretches to 1.5 times its length while it turns by 90 degrees
through the cells: the force is that of finite elements. See 'Means over cells' in
doc/theory/implicit-boundaries.md."""

from math import hypot

scene = folder / "bar.prm"
scene.write_text("""
subsection Mesh
  set Lower corner = -2, -2
  set Upper corner = 8, 8
  set Cell size    = 0.25
end
subsection Method
  set Strain = finite
end
subsection Materials
  subsection rubber
    set Young modulus = 1000
    set Poisson ratio = 0.3
  end
end
subsection Bodies
  subsection bar
    set Lower corner = 0, 0
    set Upper corner = 4, 1
  end
end
subsection Boundaries
  subsection hinge
    set Body = bar
    set Part = left
    set Rotation angle = 90*t
    set Rotation centre = 0, 0.5
  end
  subsection pull
    set Body = bar
    set Part = right
    set Constraint = roller
    set Rotation angle = 90*t
    set Rotation centre = 0, 0.5
    set Translation = 2*t*cos(pi*t/2); 2*t*sin(pi*t/2)
  end
end
subsection Time
  set Steps = 40
end
""")
NITSCHE = {"Boundaries/*/Enforcement": "skew Nitsche"}
PLACES = {"Boundaries/*/Held in a cell": "places", "Method/Aggregate below": 0.5}


def force(method, settings):
    """At the end, along the bar."""
    last = run(scene, {"Method/Method": method, "Output/Points": "false",
                       "Output/Mesh": "false", **settings}).history()[-1]
    return hypot(last["reaction_x of pull"], last["reaction_y of pull"])


exact = force("finite element", {})
number("finite elements", exact, 4)
for method in ("CPDI1", "CPDI2"):
    for name, settings in (("skew Nitsche", NITSCHE), ("places", PLACES)):
        bound(f"{method}, {name}: force over that of finite elements - 1",
              force(method, settings) / exact - 1, 0.02)
