# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Expressions that give no number, at the start, later or at a place: one message
with section, key, value and, where it has one, time. Boundaries meet in the scene."""

scene = folder / "scene.prm"
BASE = prm("""
Mesh/Lower corner = 0, -1 | Upper corner = 5, 3 | Cell size = 0.5
Materials/m/Young modulus = 1000 | Poisson ratio = 0.3 | Density = 1
Bodies/b/Lower corner = 0, 0 | Upper corner = 3, 1
Boundaries/end/Points = 3 0; 3 1
Boundaries/base/Points = 0 0; 3 0 | Constraint = roller
Grid conditions/side/Side = left
Loads/weight/Type = gravity | Value = 0; -1
Loads/pressure/Type = surface traction | Points = 3 1; 0 1 | Value = 0; -1
Loads/place/Type = point force | Location = 1.1, 0.9 | Value = 0; -1
Loads/points/Type = force on points | Location = 2.1, 0.9 | Value = 0; -1
""")
STAGES = prm("""
Stages/before/Time/End time = 0.4
Stages/now/Time/End time = 1 | Steps = 3 | Integrator = Bathe
""")
NEVER = "sqrt(-1)"
LATER = "0.001*(sqrt(0.5-t)-sqrt(0.5))"
PLACE = "0.001*(t >= 0.1 ? sqrt(y > 0.4 ? -1 : 1) : t)"
STEPS = {"Time/Steps": 4}
DYNAMIC = {**STEPS, "Time/Integrator": "generalised-alpha"}


tried = []


def refused(key, value, settings=STEPS, stages=False):
    scene.write_text(BASE + (STAGES if stages else ""))
    result = run(scene, {**settings, key: value}, expect=2)
    lines = [line for line in result.output.splitlines()
             if line.startswith("moraine: ")]
    section, name = key.rsplit("/", 1)
    ok = (len(lines) == 1 and
          f"section '{section}', key '{name}'" in lines[0] and
          "not a finite number, at" in lines[0])
    tried.append(key)
    if not ok:
        text(f"NO: {key} = {value}", lines)


for where in ("Boundaries/end", "Boundaries/base", "Grid conditions/side"):
    for stages in (False, True):
        settings = {} if stages else STEPS
        for value in (NEVER, LATER):
            refused(f"{where}/Displacement", f"{value}; 0", settings, stages)
        if where != "Boundaries/base":  # y is 0 there
            refused(f"{where}/Displacement", f"{PLACE}; 0",
                    {**settings, "Method/Mesh after step": "keep"}, stages)
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
text("expressions that give no number, each named", len(tried))
