# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Points that stay where they are, of bodies that came in another order than they
are drawn in, go on from a checkpoint as if nothing had been."""

scene = scene_file("layers.prm", """
Mesh/Lower corner = 0, 0 | Upper corner = 4, 4 | Cell size = 0.5
Method/Mesh after step = keep
Materials/soil/Young modulus = 1000 | Poisson ratio = 0.3 | Density = 1
Bodies/upper/Lower corner = 0, 2.3 | Upper corner = 4, 3.3
Bodies/lower/Lower corner = 0, 1.2 | Upper corner = 4, 2.3
Bodies/ground/Lower corner = 0, 0 | Upper corner = 4, 1.2
Grid conditions/base/Side = bottom
Grid conditions/side/Side = left | Components = x
Loads/weight/Type = gravity | Value = 1; -4
Stages/ground/Bodies = ground
Stages/lower/Bodies = ground, lower
Stages/lower/Time/End time = 2
Stages/upper/Bodies = ground, lower, upper
Stages/upper/Time/End time = 3 | Steps = 4
Output/Points = false | Mesh = false | Checkpoint every = 1 step
Probes/top/Location = 3.9, 3.2 | Body = upper
""")
for method in "CPDI1", "CPDI2", "GIMP", "material point", "finite element":
    more = {"Method/Method": method}
    if method == "GIMP": # boxes that are not parts of cells
        more.update({"Bodies/ground/Point grid": "12, 4",
                     "Bodies/lower/Point grid": "14, 4",
                     "Bodies/upper/Point grid": "16, 4"})
    if method == "finite element":
        more["Mesh/Cells"], more["Mesh/Cell size"] = "8, 40", 0
    through = run(scene, more)
    history = (through.folder / "history.csv").read_bytes()
    run(through.folder, command="resume", extra=["--from", 5])
    text(f"{method}: history is that of a run without a break",
         history == (through.folder / "history.csv").read_bytes())
