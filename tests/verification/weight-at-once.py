# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Sand between rough walls on a rough floor that gets all its weight in the first step. No
equilibrium is found in one step, so the weight comes in parts: the end is that of a weight
that grows, and a run that goes on from a step in between is that of one without a break."""

BIN = """
Dimension = 2
Mesh/Lower corner = 0, -0.5 | Upper corner = 4, 6.5 | Cell size = 0.5
Materials/sand/Model = Mohr-Coulomb | Friction angle = 32 | Cohesion = 1
Materials/sand/Young modulus = 20e3 | Poisson ratio = 0.3 | Density = 1.8
Bodies/fill/Shape = box | Lower corner = 0.5, 0 | Upper corner = 3.5, 6
Boundaries/left/Points = 0.5 7; 0.5 -1 | Constraint = contact | Friction angle = 20
Boundaries/right/Points = 3.5 -1; 3.5 7 | Constraint = contact | Friction angle = 20
Boundaries/floor/Points = 0 0; 4 0 | Constraint = contact | Friction angle = 20
Loads/weight/Type = gravity | Value = 0; -9.81
Output/Points = false | Mesh = false | Checkpoint every = 1 step
Time/Steps = 1
"""
WEIGHT = 1.8 * 9.81 * 18
for name, keys in (("small strain", {"Method/Mesh after step": "keep"}),
                   ("finite strain", {"Method/Strain": "finite"})):
    scene = scene_file("bin.prm", BIN)
    grows = run(scene, {**QUIET, **keys, "Method/Method": "GIMP",
                        "Loads/weight/Curve": "t"}).history()[-1]
    once = run(scene, {**QUIET, **keys, "Method/Method": "GIMP"})
    rows = once.history()
    text(f"{name}: comes in parts", len(rows) > 2)
    sides = [rows[-1][f"reaction_y of {side}"] for side in ("left", "right", "floor")]
    bound(f"{name}: walls and floor over the weight - 1", sum(sides) / WEIGHT - 1, 1e-7)
    of = "reaction_y of floor"
    bound(f"{name}: floor, over that of a weight that grows - 1",
          rows[-1][of] / grows[of] - 1, 0.01 if name == "small strain" else 0.03)
    history = (once.folder / "history.csv").read_bytes()
    half = len(rows) - 1
    run(once.folder, command="resume", extra=["--from", half])
    text(f"{name}: resumed in between, as without a break",
         history == (once.folder / "history.csv").read_bytes())
