# debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""What a place of a boundary carries is its own: not that of the next side of a
corner, of another body further along, nor of a stage before one in which the
boundary did not act."""

SOLID = prm("""
Materials/elastic/Young modulus = 20 | Poisson ratio = 0.3 | Density = 1
Output/Write = end | Mesh = false
""")

# A block spreads under its weight until walls stop it: the box in one piece or
# in three, of which the ledge is for the right one to touch something.
SPREAD = SOLID + prm("""
Mesh/Lower corner = -0.37, -0.33 | Upper corner = 2.03, 2.67 | Cell size = 0.2
Method/Method = GIMP | Strain = finite
Bodies/block/Lower corner = 0, 0 | Upper corner = 1, 2
Bodies/ledge/Lower corner = 1.1, 2.35 | Upper corner = 1.33, 2.6
Grid conditions/shelf/Lower corner = 0, 2.2 | Upper corner = 3, 3
Loads/weight/Type = gravity | Bodies = block | Value = 0; -12*t
Time/Steps = 20
Probes/foot/Location = 0.95, 0.05
""")


def roller(name, points):
    return prm(f"""
Boundaries/{name}/Points = {points} | Constraint = roller
""")


def written(name, scene):
    file = folder / f"{name}.prm"
    file.write_text(scene)
    return file


whole = run(written("whole", SPREAD + roller("box", "0 3; 0 0; 1.33 0; 1.33 3")))
parts = run(written("parts", SPREAD + roller("left", "0 3; 0 0")
                    + roller("floor", "0 0; 1.33 0")
                    + roller("right", "1.33 0; 1.33 3")))
at_least("block that spreads: foot", whole.history()[-1]["u_x at foot"], 0.2)
for run_of, name in ((whole, "box of one boundary"), (parts, "box of three")):
    text(f"{name}: rejected steps", run_of.summary["rejected_steps"])
bound("  feet differ by", abs(whole.history()[-1]["u_x at foot"]
                             / parts.history()[-1]["u_x at foot"] - 1), 0.01)

# The floor under a light block that falls holds nothing of the heavy one beside.
LAND = SOLID + roller("floor", "-0.5 0; 4.5 0") + prm("""
Mesh/Lower corner = -0.5, -0.3 | Upper corner = 4.5, 1.7 | Cell size = 0.25
Method/Method = GIMP
Materials/heavy/Young modulus = 20 | Poisson ratio = 0.3 | Density = {density}
Bodies/left/Material = heavy | Lower corner = 0, 0 | Upper corner = 1.5, 1
Bodies/right/Material = elastic | Lower corner = 3, 0.3 | Upper corner = 4, 1.3
Bodies/right/Initial velocity = 0; -0.3
Loads/weight/Type = gravity | Bodies = left | Value = 0; -0.1
Probes/light/Location = 3.5, 1.2 | Quantities = velocity
Time/Integrator = Newmark | End time = 2 | Steps = 60
""")
light, heavy = (run(written(f"land-{d}", LAND.replace("{density}", d))).history()
                for d in ("1", "50"))
at_least("light block bounces to", light[-1]["v_y at light"], 0.1)
bound("  beside a heavy one it differs by",
      abs(heavy[-1]["v_y at light"] - light[-1]["v_y at light"]), 1e-6)

# A boundary that pauses, and one in its place that never acted.
PAUSE = SOLID + prm("""
Mesh/Lower corner = -0.3, -0.3 | Upper corner = 2.2, 2.7 | Cell size = 0.25
Method/Method = GIMP
Bodies/block/Lower corner = 0, 0.1 | Upper corner = 1.5, 2
Boundaries/A/Points = 0 0.1; 1.5 0.1
Boundaries/B/Points = 0 0.1; 1.5 0.1
Loads/weight/Type = gravity | Value = 0; -0.2
Stages/rests/Boundaries = A
Stages/falls/Boundaries = none
Stages/falls/Time/Integrator = Newmark | End time = 1.01
Stages/held/Boundaries = {last}
Stages/held/Time/Integrator = Newmark | End time = 1.05 | Steps = 8
""")
for enforcement in "symmetric Nitsche", "penalty", "augmented Lagrangian":
    again, new = (
        [row[f"reaction_y of {name}"] for row in
         run(written(f"pause-{name}", PAUSE.replace("{last}", name)),
             {"Boundaries/*/Enforcement": enforcement}).history()[-9:]]
        for name in "AB")
    at_least(f"{enforcement}: reaction", abs(new[-1]), 1e-3)
    bound("  of a boundary that paused differs by",
          max(abs(a - b) for a, b in zip(again, new)), 1e-9)
