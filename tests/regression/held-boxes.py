# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Nodes in the box of a grid condition are those of the mesh as it was built, and so
are the places of 'Displacement': where nodes have gone out of the box, also with
checkpoints and stages between, by 'Mesh motion' and with finite elements."""


TIME = prm("""
Time/End time = 4 | Steps = 4
""")
STAGES = prm("""
Stages/one/Time/End time = 2 | Steps = 2
Stages/two/Time/End time = 4 | Steps = 2
""")


def scene_of(name, method, cells, more, time=TIME):
    return scene_file(f"{name}.prm", f"""
Mesh/Lower corner = 0, 0 | Upper corner = {cells[0] / 2}, {cells[1] / 2}
Mesh/Cells = {cells[0]}, {cells[1]}
Method/Method = {method} | Strain = finite
Materials/soil/Young modulus = 1000 | Poisson ratio = {0.3 if cells[0] == 8 else 0}
Bodies/block/Shape = mesh
""", more, time)


PULLED = prm("""
Grid conditions/base/Side = left
Grid conditions/pull/Lower corner = 3.9, -0.1 | Upper corner = 4.1, 2.1
Grid conditions/pull/Displacement = 0.3*t; 0
""")
pulled = scene_of("pulled", "finite element", (8, 4), PULLED)
staged = scene_of("staged", "finite element", (8, 4), PULLED, STAGES)
force = run(pulled, QUIET).history()[-1]["reaction_x of pull"]
number("pulled out of the box: force", force, 8)
for name, scene, settings in (
        ("a checkpoint in each step", pulled, {"Output/Checkpoint every": "1 steps"}),
        ("one after the third", pulled, {"Output/Checkpoint every": "3 steps"}),
        ("two stages", staged, {})):
    bound(f"  {name}: over that",
          run(scene, {**QUIET, **settings}).history()[-1]["reaction_x of pull"]
          / force - 1, 1e-12)

lifted = scene_of("lifted", "GIMP", (4, 4), prm("""
Grid conditions/bottom/Side = bottom
Grid conditions/top/Lower corner = -0.1, 1.9 | Upper corner = 2.1, 2.1
Grid conditions/top/Translation = 0; 0.08*t
Mesh motion/Stretch between = bottom, top
"""))
BY_SIDE = {"Grid conditions/top/Lower corner": "", "Grid conditions/top/Upper corner": "",
           "Grid conditions/top/Side": "top"}
bound("box that the mesh leaves: force over that of the side",
      run(lifted, QUIET).history()[-1]["reaction_y of top"]
      / run(lifted, {**QUIET, **BY_SIDE}).history()[-1]["reaction_y of top"] - 1,
      1e-12)

stretched = scene_of("stretched", "GIMP", (4, 4), prm("""
Grid conditions/left/Side = left | Displacement = 0; 0.1*t*y
Grid conditions/right/Side = right | Displacement = 0; 0.1*t*y | Components = y
Grid conditions/bottom/Side = bottom | Components = y
Grid conditions/top/Side = top | Components = y | Displacement = 0; 0.2*t
Mesh motion/Stretch between = bottom, top
"""))
last = run(stretched, QUIET).history()[-1]
at_least("stretched with its mesh: force of the top", last["reaction_y of top"], 100)
for side in ("left", "right"):
    bound(f"  of the {side}, over that of the top",
          last[f"reaction_y of {side}"] / last["reaction_y of top"], 1e-10)
