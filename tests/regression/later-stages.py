# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""What begins to act in a later stage, when bodies have moved: conditions act by
their change from then on, springs are attached where their surface is by then,
forces are on the points that were nearest at the start."""

SOLID = prm("""
Materials/solid/Young modulus = 10000 | Poisson ratio = 0.3 | Density = 1
Output/Write = end
""")

# A wall beside what was pulled before: at their corner both are at rest.
held = scene_file("held.prm", SOLID, """
Mesh/Lower corner = 0, 0 | Upper corner = 2, 2 | Cell size = 1
Method/Method = finite element
Bodies/block/Lower corner = 0, 0 | Upper corner = 2, 2
Grid conditions/base/Side = bottom
Grid conditions/pull/Side = top | Components = x | Displacement = 0.01*min(t, 1); 0
Grid conditions/wall/Side = right | Components = x
Stages/pulled/Grid conditions = base, pull
Stages/pulled/Time/Steps = 2
Stages/held/Grid conditions = base, pull, wall
Stages/held/Time/End time = 2 | Steps = 2
Probes/middle/Location = 1.1, 1.1 | Kind = interpolated
""")
rows = run(held).history()
at_least("pulled: displacement", rows[1]["u_x at middle"], 1e-3)
# Small strain on nodes that went along is in balance to the square of their motion.
bound("held beside it: moves", rows[-1]["u_x at middle"] - rows[1]["u_x at middle"],
      1e-5)
for stage, conditions in (("first", {"Stages/pulled/Grid conditions":
                                     "base, pull, wall"}),
                          ("second", {})):
    result = run(held, {"Grid conditions/pull/Displacement": "0.01*t; 0",
                        **conditions}, expect=2, on_ranks=1)
    text(f"pulled on in the {stage} stage", plain(result.output.strip())
         .splitlines()[-1])

# What has come to rest has no energy of motion, and counts none.
rests = run(held, {"Stages/pulled/Time/Integrator": "Newmark"})
rows = rests.history()
at_least("in motion: kinetic energy", rows[1]["kinetic energy of nodes"], 1e-9)
bound("at rest: kinetic energy", rows[-1]["kinetic energy of nodes"], 0)
text("at rest: energy in the summary", "energy" in rests.summary)

# A block flies through the mesh: up on springs, without them, on others.
STIFFNESS = 0.4
flies = scene_file("flies.prm", SOLID, f"""
Mesh/Lower corner = 0, 0 | Upper corner = 3, 8 | Cell size = 0.5
Method/Method = GIMP | Strain = finite
Bodies/block/Lower corner = 1, 1 | Upper corner = 2, 2 | Initial velocity = 0; 4
Boundaries/foot/Points = 1 1; 2 1 | Constraint = absorbing | Dashpot factors = 0, 0
Boundaries/foot/Spring stiffness = {STIFFNESS}, 0
Loads/nail/Type = force on points | Location = 1.5, 1.5 | Value = 0.3; 0
Stages/springs/Loads = none
Stages/springs/Time/Integrator = Newmark | End time = 0.25 | Steps = 5
Stages/free/Boundaries = none
Stages/free/Time/Integrator = Newmark | End time = 0.75 | Steps = 10
Stages/others/Boundaries = foot | Loads = nail
Stages/others/Time/Integrator = Newmark | End time = 1 | Steps = 5
Probes/head/Location = 1.5, 1.9
Probes/heel/Location = 1.5, 1.1
""")
rows = run(flies).history()
on_springs, free = ([row for row in rows if row["t"] < end][-1]
                    for end in (0.26, 0.76))
last = rows[-1]
for name, begin, end in (("first springs", None, on_springs),
                         ("other springs", free, last)):
    stretched = end["u_y at heel"] - (begin["u_y at heel"] if begin else 0)
    at_least(f"{name}: extension", stretched, 0.5)
    bound(f"{name}: force over that of the extension - 1",
          end["reaction_y of foot"] / (-STIFFNESS * stretched) - 1, 1e-2)
bound("without springs: force", free["reaction_y of foot"], 0)
at_least("force on points: displacement", last["u_x at head"], 5e-3)
bound("force on points: turns the block by", last["u_x at head"] - last["u_x at heel"],
      1e-3)

# A reset makes the places at the start unknown to what begins to act then.
refused = run(flies, {"Stages/others/Reset displacements": "true"}, expect=2,
              on_ranks=1)
text("displacements reset before a force finds its points",
     plain(refused.output.strip()).splitlines()[-1])

# Two blocks share a nail at their interface; one goes.
shared = scene_file("shared.prm", SOLID, """
Mesh/Lower corner = 0, 0 | Upper corner = 4, 2 | Cell size = 1
Method/Method = GIMP
Bodies/left/Lower corner = 0, 0 | Upper corner = 2, 1
Bodies/right/Lower corner = 2, 0 | Upper corner = 4, 1
Grid conditions/base/Side = bottom
Loads/nail/Type = force on points | Location = 2, 0.75 | Value = 0; 1
Stages/both/
Stages/rest/Loads = none | Bodies = left
Stages/rest/Time/End time = 2
Stages/again/Bodies = left | Loads = nail
Stages/again/Time/End time = 3
""")
for name, settings, left in (
        ("while it rests", {}, 0.5),
        ("while it acts", {"Stages/rest/Loads": "nail"}, 0.5),
        ("with all of it", {"Loads/nail/Location": "2.75, 0.75"}, 0)):
    result = run(shared, settings)
    text(f"body of a force gone, {name}", result.found())
    bound(f"  reaction + {left}", result.reactions["base"][1] + left, 1e-10)

# A load that pauses goes with the ground, also if a body comes as it returns.
paused = scene_file("paused.prm", SOLID, """
Mesh/Lower corner = 0, 0 | Upper corner = 12, 3 | Cell size = 0.5
Method/Method = GIMP
Bodies/ground/Lower corner = 0, 0 | Upper corner = 4, 1
Bodies/later/Lower corner = 9, 0 | Upper corner = 10, 1
Grid conditions/base/Side = bottom | Displacement = 1.5*min(max(t - 1, 0), 1); 0
Loads/plate/Type = surface traction | Points = 1.9 1; 1.1 1 | Value = 0; -1
Probes/under/Location = 1.5, 0.9
Stages/first/Bodies = ground
Stages/moves/Bodies = ground | Loads = none
Stages/moves/Time/End time = 2 | Steps = 4
Stages/again/Bodies = ground, later | Loads = plate
Stages/again/Time/End time = 3
""")
alone, with_it = (run(paused, settings).history()[-1]["u_y at under"]
                  for settings in ({}, {"Stages/*/Bodies": "ground, later"}))
at_least("a load that paused: settlement", -alone, 1e-5)
bound("a load that paused: settlement over that with the other body there - 1",
      alone / with_it - 1, 1e-10)

# The same after an interruption while it pauses.
whole = run(paused, {"Output/Checkpoint every": "4 steps"})
expected = (whole.folder / "history.csv").read_bytes()
run(whole.folder, command="resume", extra=("--from", "4"))
text("a load that paused, resumed", "the same history" if
     (whole.folder / "history.csv").read_bytes() == expected else "NO")

# A load that has sunk with a body is as drawn again when the body comes back.
COLUMN = SOLID.replace("10000", "100").replace("0.3", "0") + prm("""
Mesh/Lower corner = 0, 0 | Upper corner = 4, 12 | Cell size = 1
Method/Method = {method} | Strain = finite
Bodies/base/Lower corner = 0, 0 | Upper corner = 1, 2
Bodies/block/Lower corner = 0, 2 | Upper corner = 1, 10
Bodies/other/Lower corner = 3, 0 | Upper corner = 4, 1
Grid conditions/sides/Lower corner = 0, 0 | Upper corner = 4, 12 | Components = x
Grid conditions/bottom/Side = bottom
Loads/push/Type = surface traction | Points = 1 {top}; 0 {top} | Value = 0; {force}
Loads/weight/Type = gravity | Value = 0; {weight}
Probes/top/Location = 0.5, {top} | Body = block | Quantities = displacement, stress
""")
STEPS = """
    subsection Time
      set End time = {end}
      set Steps = 10
    end
  end
"""


def column(name, stages, **values):
    """The scene with stages, of which each has its bodies and loads."""
    scene = COLUMN.format(**values) + "subsection Stages\n"
    for end, (bodies, loads) in enumerate(stages, 1):
        scene += f"subsection s{end}\nset Bodies = {bodies}\nset Loads = {loads}\n"
        scene += STEPS.format(end=end)
    file = folder / f"{name}.prm"
    file.write_text(scene + "end\n")
    return run(file, {"Output/Checkpoint every": "5 steps"})


def compare(name, result, reference):
    for quantity in ("u_y", "sigma_yy"):
        a, b = (of.history()[-1][f"{quantity} at top"] for of in (result, reference))
        at_least(f"{name}: {quantity}", abs(b), 0.1)
        bound("  differs by", abs(a - b), 1e-8)


for method, rests in (("GIMP", 1), ("finite element", 0)):
    values = {"method": method, "top": 10, "force": f"-30*(t-{2 + rests}*(t>1))",
              "weight": 0}
    back = [("base", "none"), *[("base, block", "none")] * rests,
            ("base, block", "push")]
    again = column("again", [("base, block", "push"), *back], **values)
    first = column("first", [("base", "none"), *back], **values)
    compare(f"{method}, load on a body that comes back", again, first)
expected = (again.folder / "history.csv").read_bytes()
run(again.folder, command="resume", extra=("--from", "25"))
text("  resumed", "the same history" if
     (again.folder / "history.csv").read_bytes() == expected else "NO")

# A load goes with what it lies on, whatever comes elsewhere as it begins to act.
values = {"method": "GIMP", "top": 8, "force": "-20*(t-1)", "weight": "-3*min(t,1)"}
alone = column("alone", [("base, block", "weight"),
                         ("base, block, other", "weight, push")], **values)
beside = column("beside", [("base, block, other", "weight"),
                           ("base, block, other", "weight, push")], **values)
compare("load that begins as another body comes", alone, beside)

# A lining takes the place of what is dug out. A probe beside both follows the body
# that it names: the stress of its one cell is that of half its weight.
lined = scene_file("lined.prm", SOLID.replace("0.3", "0"), """
Mesh/Lower corner = 0, 0 | Upper corner = 1, 2 | Cell size = 1
Method/Method = finite element
Bodies/ground/Lower corner = 0, 0 | Upper corner = 1, 1
Bodies/core/Lower corner = 0, 1 | Upper corner = 1, 2
Bodies/lining/Lower corner = 0, 1 | Upper corner = 1, 2
Grid conditions/base/Side = bottom
Loads/weight/Type = gravity | Value = 0; -10
Stages/core/Bodies = ground, core
Stages/dug/Bodies = ground
Stages/dug/Time/End time = 2
Stages/lined/Bodies = ground, lining
Stages/lined/Time/End time = 3
Probes/crown/Location = 0.5, 1.5 | Body = lining | Quantities = stress
""")
result = run(lined)
text("probe of the lining", [round(row["sigma_yy at crown"], 1) + 0.
                             for row in result.history()])
text("probe of any body", [
    round(row["sigma_yy at crown"], 1) + 0.
    for row in run(lined, {"Probes/crown/Body": ""}).history()])
for name, keys in (("of no body", {"Body": "linning"}),
                   ("of a place", {"Kind": "interpolated",
                                   "Quantities": "displacement"}),
                   ("far from its body", {"Body": "ground",
                                          "Location": "0.5, 3.5"})):
    result = run(lined, {f"Probes/crown/{key}": value
                         for key, value in keys.items()}, expect=2, on_ranks=1)
    text(f"probe {name}", plain(result.output.strip()).splitlines()[-1])
# Warnings are for those too who want to see only how it ends.
result = run(lined, {"Materials/solid/Young modulus": 20, "Probes/crown/Body": ""},
             on_ranks=1, extra=("--quiet",))
text("quiet: all warnings", [
    one["id"] for one in result.summary.get("warnings", [])
    if f"  {one['id']}" not in result.output])

# Walls that go on hold a body that comes by its own stress, not by that of the body
# below, which is pressed until then: nu/(1 - nu) times its weight, over two walls.
comes = scene_file("comes.prm", SOLID, """
Mesh/Lower corner = -0.5, 0 | Upper corner = 1.5, 3 | Cell size = 0.25
Method/Method = finite element | Mesh after step = keep
Bodies/low/Lower corner = 0, 0 | Upper corner = 1, 1
Bodies/up/Lower corner = 0, 1 | Upper corner = 1, 2
Boundaries/left/Points = 0 3; 0 0 | Constraint = roller
Boundaries/right/Points = 1 0; 1 3 | Constraint = roller
Grid conditions/base/Side = bottom | Components = y
Loads/pressure/Type = surface traction | Body = low | Part = top | Value = 0; -100*t
Loads/weight/Bodies = up | Value = 0; -10*(t-1)
Stages/pressed/Bodies = low | Loads = pressure
Stages/filled/Bodies = low, up | Loads = weight
Stages/filled/Time/End time = 2
""")
THRUST = 0.3 / 0.7 * (10 / 2 + 10)  # of the body itself, and of the one below
for how in ("skew Nitsche", "symmetric Nitsche", "augmented Lagrangian"):
    reaction = run(comes, {"Boundaries/*/Enforcement": how}).summary["reactions"]
    bound(f"comes beside walls, {how}: thrust over the exact one - 1",
          abs(reaction["left"][0] / THRUST - 1), 1e-6)

# A displacement that begins to act with a value: only its change acts, which is
# told. Where it acts is a place of the mesh as it was built, also in a later stage.
for name, keys in (
        ("a constant that begins later",
         {"Grid conditions/wall/Displacement": "-0.01; 0"}),
        ("places of the mesh as it was built",
         {"Grid conditions/pull/Displacement": "0.001*t*sqrt(2-y); 0",
          "Grid conditions/pull/Translation": "0; 0.1*t",
          "Grid conditions/wall/Components": "",
          "Stages/held/Grid conditions": "base, pull"})):
    result = run(held, keys, on_ranks=1)
    text(name, result.found())

# A body that comes before one in flight is at rest, also at the nodes they share.
joins = scene_file("joins.prm", SOLID.replace("10000", "100"), """
Mesh/Lower corner = 0, 0 | Upper corner = 12, 4 | Cell size = 1
Method/Method = finite element
Bodies/flying/Lower corner = 1, 1 | Upper corner = 3, 3 | Initial velocity = 1; 0
Bodies/new/Lower corner = 3, 1 | Upper corner = 4, 3
Stages/one/Bodies = flying
Stages/one/Time/Integrator = Newmark | End time = 0.1 | Steps = 2
Stages/two/Bodies = flying, new
Stages/two/Time/Integrator = Newmark | End time = 0.2 | Steps = 2
""")
for name, settings in (
        ("finite element", {"Method/Mesh after step": "keep"}),
        ("lumped", {"Method/Mesh after step": "keep",
                    "Stages/*/Time/Mass": "lumped"}),
        ("finite element that follows", {"Method/Strain": "finite"}),
        ("GIMP", {"Method/Method": "GIMP", "Method/Mesh after step": "keep"}),
        ("GIMP that moves", {"Method/Method": "GIMP"})):
    result = run(joins, settings)
    bound(f"{name}, a body comes: momentum - 4",
          result.history()[-1]["momentum_x"] - 4, 1e-10)
    if settings.get("Method/Strain") != "finite":
        bound(f"{name}, a body comes: energy out of balance",
              result.summary["energy"]["balance_error"], 1e-10)

# What comes fills the cells as they are, and so does a place on it.
filled = scene_file("filled.prm", SOLID.replace("10000", "100"), """
Mesh/Lower corner = 0, 0 | Upper corner = 4, 8 | Cell size = 1
Method/Method = finite element | Strain = finite
Bodies/ground/Lower corner = 0, 0 | Upper corner = 4, 6
Bodies/fill/Lower corner = 0, 6 | Upper corner = 4, 8
Grid conditions/base/Side = bottom
Loads/weight/Type = gravity | Value = 0; -5
Stages/one/Bodies = ground
Stages/one/Time/Steps = 2
Stages/two/Bodies = ground, fill
Stages/two/Time/End time = 2 | Steps = 2
Probes/point/Location = 0.21132486540518713, 6.2113248654051871 | Body = fill
Probes/point/Quantities = displacement, position
Probes/place/Location = 0.21132486540518713, 6.2113248654051871 | Kind = interpolated
Probes/place/Quantities = displacement, position
""")
row = run(filled).history()[-1]
at_least("a place on what comes: has settled by", 6.2 - row["y at place"], 0.4)
for key in ("x", "y", "u_x", "u_y"):
    bound(f"  {key} over that of the point there - 1",
          row[f"{key} at place"] / row[f"{key} at point"] - 1, 1e-10)

# A place leaves the cells; then the body of the point that it follows is gone.
leaves = scene_file("leaves.prm", SOLID, """
Mesh/Lower corner = 0, 0 | Upper corner = 4, 4 | Cell size = 1
Method/Method = material point | Strain = finite
Bodies/left/Lower corner = 0, 0 | Upper corner = 1, 2
Bodies/right/Lower corner = 3, 0 | Upper corner = 4, 2
Grid conditions/base/Side = bottom | Displacement = 0; 0.1*min(t, 1)
Stages/both/Time/Steps = 4
Stages/one/Bodies = right
Stages/one/Time/End time = 2
Probes/top/Location = 0.5, 2 | Kind = interpolated
Probes/top/Quantities = displacement, position
""")
result = run(leaves)
text("notes of a place out of the cells", [
    " ".join(line.split())
    for line in (result.folder / "log.txt").read_text().splitlines()
    if "probe 'top'" in line])
before, after = result.history()[-2:]
bound("  goes along: y - 2.1", before["y at top"] - 2.1, 1e-6)
text("  its body is gone", [after[f"{key} at top"] for key in ("y", "u_y")])

# The order of names is no change, at which accelerations would be found anew and
# nothing may begin to absorb.
histories = [
    (run(held, {"Stages/*/Time/Integrator": "generalised-alpha",
                "Stages/held/Grid conditions": names}).folder /
     "history.csv").read_bytes() for names in ("base, pull", "pull, base")]
text("names in another order", "the same history" if
     histories[0] == histories[1] else "NO")
run(paused, {"Stages/first/Bodies": "ground, later",
             "Stages/moves/Bodies": "later, ground",
             "Stages/again/Bodies": "ground, later",
             "Grid conditions/base/Displacement": "",
             "Stages/moves/Time/Integrator": "Newmark",
             "Stages/again/Time/Integrator": "Newmark",
             "Stages/moves/Absorbing": "base"})
