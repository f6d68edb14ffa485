# debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Nodes that stay while they push material are told of, and end the run when they have
lost it. Surfaces and loads go with the material, and nothing is said."""

import json

SCENE = prm("""
Mesh/Lower corner = 0, 0 | Upper corner = 1, 2 | Cell size = 0.25
Method/Method = GIMP | Strain = finite
Materials/soil/Young modulus = 1000 | Poisson ratio = 0.3
Bodies/soil/Lower corner = 0, 0 | Upper corner = 1, 2
Grid conditions/left/Side = left | Components = x
Grid conditions/right/Side = right | Components = x
Grid conditions/base/Side = bottom | Components = y
Grid conditions/
{condition}
/
{more}
Output/Points = false | Mesh = false | Checkpoint every = {checkpoint}
Time/Steps = 12
""")
scene = folder / "column.prm"
PRESSED = prm("""
top/Side = top | Components = y | Displacement = 0; -0.6*t
""")
WALL = prm("""
Boundaries/top/Body = soil | Part = top | Constraint = roller | {key} = 0; -0.6*t
""")
LOAD = prm("""
Loads/load/Type = side traction
Loads/load/Side = top
Loads/load/Value = 0; -400*t
""")


def write(condition="", more="", checkpoint="never"):
    scene.write_text(SCENE.format(condition=condition, more=more,
                                  checkpoint=checkpoint))


def show(name, settings=None, expect=1):
    result = run(scene, settings, expect=expect)
    for one in result.found():
        text(f"{name}: found", one)
    text(f"{name}: ended", result.summary.get("message", "as it should"))
    return result


write(PRESSED)
for method in ("GIMP", "material point", "CPDI1"):
    # Domains that are stretched still touch the nodes.
    show(f"nodes, {method}", {"Method/Method": method},
         expect=0 if method == "CPDI1" else 1)
# All nodes may be lost in one step.
show("nodes, two steps", {"Time/Steps": 2})
STRETCH = {"Mesh motion/Stretch between": "base, top"}
for name, settings in (("nodes, FE", {"Method/Method": "finite element"}),
                       ("nodes that go along", STRETCH),
                       ("nodes, pressed a little",
                        {"Grid conditions/top/Displacement": "0; -0.05*t"})):
    show(name, settings, expect=0)

for key in ("Displacement", "Translation"):
    write(more=WALL.format(key=key))
    show(f"surface, {key}", expect=0)

write(more=LOAD)
show("load on a side", expect=0)

# What was told, and what was held, goes on after a checkpoint.
write(PRESSED, checkpoint="1 steps")
whole = show("nodes, with checkpoints")
before = dict(whole.summary)
run(whole.folder, command="resume", extra=("--from", "7"), expect=1)
after = json.loads((whole.folder / "summary.json").read_text())
text("resumed: ended alike", after["message"] == before["message"])
text("resumed: told", after.get("warnings", []) == before["warnings"])

# What goes with the material and has lost it is told of: a block leaves its floor.
scene = scene_file("leaves.prm", """
Mesh/Lower corner = 0, 0 | Upper corner = 5, 2 | Cell size = 0.25
Method/Method = GIMP
Materials/soil/Young modulus = 1000 | Poisson ratio = 0.3
Bodies/block/Lower corner = 0.5, 0.4 | Upper corner = 1.5, 1.4
Boundaries/floor/Points = 0.5 0.4; 2 0.4 | Constraint = roller
Boundaries/carrier/Body = block | Part = top | Translation = 2.5*t; 0
Time/Steps = 20
""")
show("floor that ends", expect=0)
show("floor that goes on", {"Boundaries/floor/Points": "0.5 0.4; 4.5 0.4"}, expect=0)
