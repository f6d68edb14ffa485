# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Expressions that give no number, at the start, later or at a place: one message
with section, key, value and, where it has one, time. Boundaries meet in the scene."""

scene = folder / "scene.prm"
BASE = prm("""
Mesh/Lower corner = 0, -1
Mesh/Upper corner = 5, 3
Mesh/Cell size = 0.5
Materials/m/Young modulus = 1000
Materials/m/Poisson ratio = 0.3
Materials/m/Density = 1
Bodies/b/Lower corner = 0, 0
Bodies/b/Upper corner = 3, 1
Boundaries/end/Points = 3 0; 3 1
Boundaries/base/Points = 0 0; 3 0
Boundaries/base/Constraint = roller
Grid conditions/side/Side = left
Loads/weight/Type = gravity
Loads/weight/Value = 0; -1
Loads/pressure/Type = surface traction
Loads/pressure/Points = 3 1; 0 1
Loads/pressure/Value = 0; -1
Loads/place/Type = point force
Loads/place/Location = 1.1, 0.9
Loads/place/Value = 0; -1
Loads/points/Type = force on points
Loads/points/Location = 2.1, 0.9
Loads/points/Value = 0; -1
""")
STAGES = prm("""
Stages/before/Time/End time = 0.4
Stages/now/Time/End time = 1
Stages/now/Time/Steps = 3
Stages/now/Time/Integrator = Bathe
""")
NEVER = "sqrt(-1)"
LATER = "0.001*(sqrt(0.5-t)-sqrt(0.5))"
PLACE = "0.001*(t >= 0.1 ? sqrt(y > 0.4 ? -1 : 1) : t)"
STEPS = {"Time/Steps": 4}
DYNAMIC = {**STEPS, "Time/Integrator": "generalised-alpha"}


def refused(key, value, settings=STEPS, stages=False):
    scene.write_text(BASE + (STAGES if stages else ""))
    result = run(scene, {**settings, key: value}, expect=2)
    lines = [line for line in result.output.splitlines()
             if line.startswith("moraine: ")]
    section, name = key.rsplit("/", 1)
    ok = (len(lines) == 1 and
          f"section '{section}', key '{name}'" in lines[0] and
          "not a finite number, at" in lines[0])
    text(f"{key} = {value}" + (", stages" if stages else "") +
         (", followed by the mesh" if "Mesh motion/Follow" in settings else ""),
         "named" if ok else f"NO: {lines}")


for where in ("Boundaries/end", "Boundaries/base", "Grid conditions/side"):
    for stages in (False, True):
        settings = {} if stages else STEPS
        for value in (NEVER, LATER, PLACE):
            if value != PLACE or where != "Boundaries/base":  # y is 0 there
                refused(f"{where}/Displacement", f"{value}; 0", settings, stages)
        for value in (NEVER, LATER):
            refused(f"{where}/Translation", f"{value}; 0", settings, stages)
            refused(f"{where}/Rotation angle", value, settings, stages)

for value in (NEVER, LATER):
    refused("Boundaries/end/Translation", f"0; {value}",
            {**STEPS, "Mesh motion/Follow": "end"})

for load in ("weight", "pressure", "place", "points"):
    for value in (NEVER, LATER, PLACE):
        refused(f"Loads/{load}/Value", f"0; {value}")
    for value in (NEVER, LATER, "1/0"):
        refused(f"Loads/{load}/Curve", value)
        refused(f"Loads/{load}/Curve", value, {}, stages=True)
for value in (NEVER, "log(x-1)"):
    refused("Bodies/b/Initial velocity", f"{value}; 0", DYNAMIC)
    refused("Bodies/b/Initial stress", f"{value}; 0; 0; 0")
    for key in ("K0", "Surcharge"):
        refused(f"Bodies/b/{key}", value,
                {**STEPS, "Bodies/b/Initial stress": "geostatic"})
    refused("Exact solution/Displacement", f"0; {value}")
    refused("Exact solution/Stress", f"0; 0; 0; {value}")
    refused("Bodies/b/Expression", value, {
        **STEPS, "Bodies/b/Shape": "expression",
        "Bodies/b/Lower corner": "", "Bodies/b/Upper corner": ""})
for where, settings in (
        ("Boundaries/base", DYNAMIC), ("Grid conditions/side", DYNAMIC)):
    settings = {**settings, f"{where}/Constraint": "absorbing"}
    for value in (NEVER, LATER):
        refused(f"{where}/Incident velocity", f"{value}; 1", settings)
        refused(f"{where}/Incident curve", value,
                {**settings, f"{where}/Incident velocity": "0; 1"})
