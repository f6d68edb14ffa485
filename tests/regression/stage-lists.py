# ranks: 1
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Lists of a stage: nothing is none, and only a key left out keeps what acted before;
'check' says what acts in each stage."""

scene = scene_file("stages.prm", """
Mesh/Lower corner = 0, 0 | Upper corner = 1, 4 | Cells = 1, 8
Method/Method = finite element | Mesh after step = keep
Materials/m/Young modulus = 1000 | Poisson ratio = 0
Bodies/column/Shape = mesh
Boundaries/wall/Points = 0 4; 0 0 | Constraint = roller
Grid conditions/base/Side = bottom
Grid conditions/crown/Side = top | Components = x
Loads/pull/Type = side traction | Side = top | Value = 0; 1
Stages/first/
Stages/second/Time/End time = 2
Probes/top/Location = 0.5, 4 | Kind = interpolated
""")


def top(settings):
    return run(scene, settings).history()[-1]["u_y at top"]


def listed(settings):
    output = run(scene, settings, command="check").output.splitlines()
    begin = [line.startswith("  stage ") for line in output].index(True)
    return [" ".join(line.split()) for line in output[begin:begin + 4]]


bound("left out: u_y over that of the load - 1", top({}) / 4e-3 - 1, 1e-12)
for value in ("", "none"):
    bound(f"Loads = {value}: u_y", top({"Stages/second/Loads": value}), 1e-15)
bound("as before: u_y over that of the load - 1",
      top({"Stages/second/Loads": "as before"}) / 4e-3 - 1, 1e-12)
for key in "Boundaries", "Grid conditions":
    for value in ("", "none"):
        text(f"{key} = {value}", listed({f"Stages/second/{key}": value})[3])
for lines in (listed({}), listed({"Stages/first/Loads": ""})):
    for line in lines:
        text("check", line)
for value in ("", "none"):
    result = run(scene, {"Stages/second/Bodies": value}, expect=2, on_ranks=1)
    text(f"Bodies = {value}", plain(result.output.strip()).split(": ", 2)[-1])
