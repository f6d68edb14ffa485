# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""What begins to act in a later stage, when bodies have moved: conditions act by
their change from then on, springs are attached where their surface is by then,
forces are on the points that were nearest at the start."""

SOLID = """
subsection Materials
  subsection solid
    set Young modulus = 10000
    set Poisson ratio = 0.3
    set Density = 1
  end
end
subsection Output
  set Write = end
end
"""

# A wall beside what was pulled before: at their corner both are at rest.
HELD = SOLID + """
subsection Mesh
  set Lower corner = 0, 0
  set Upper corner = 2, 2
  set Cell size = 1
end
subsection Method
  set Method = finite element
end
subsection Bodies
  subsection block
    set Lower corner = 0, 0
    set Upper corner = 2, 2
  end
end
subsection Grid conditions
  subsection base
    set Side = bottom
  end
  subsection pull
    set Side = top
    set Components = x
    set Displacement = 0.01*min(t, 1); 0
  end
  subsection wall
    set Side = right
    set Components = x
  end
end
subsection Stages
  subsection pulled
    set Grid conditions = base, pull
    subsection Time
      set Steps = 2
    end
  end
  subsection held
    set Grid conditions = base, pull, wall
    subsection Time
      set End time = 2
      set Steps = 2
    end
  end
end
subsection Probes
  subsection middle
    set Location = 1.1, 1.1
    set Kind = interpolated
  end
end
"""
held = folder / "held.prm"
held.write_text(HELD)
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
FLIES = SOLID + f"""
subsection Mesh
  set Lower corner = 0, 0
  set Upper corner = 3, 8
  set Cell size = 0.5
end
subsection Method
  set Method = GIMP
  set Strain = finite
end
subsection Bodies
  subsection block
    set Lower corner = 1, 1
    set Upper corner = 2, 2
    set Initial velocity = 0; 4
  end
end
subsection Boundaries
  subsection foot
    set Points = 1 1; 2 1
    set Constraint = absorbing
    set Dashpot factors = 0, 0
    set Spring stiffness = {STIFFNESS}, 0
  end
end
subsection Loads
  subsection nail
    set Type = force on points
    set Location = 1.5, 1.5
    set Value = 0.3; 0
  end
end
subsection Stages
  subsection springs
    set Loads = none
    subsection Time
      set Integrator = Newmark
      set End time = 0.25
      set Steps = 5
    end
  end
  subsection free
    set Boundaries = none
    subsection Time
      set Integrator = Newmark
      set End time = 0.75
      set Steps = 10
    end
  end
  subsection others
    set Boundaries = foot
    set Loads = nail
    subsection Time
      set Integrator = Newmark
      set End time = 1
      set Steps = 5
    end
  end
end
subsection Probes
  subsection head
    set Location = 1.5, 1.9
  end
  subsection heel
    set Location = 1.5, 1.1
  end
end
"""
flies = folder / "flies.prm"
flies.write_text(FLIES)
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
SHARED = SOLID + """
subsection Mesh
  set Lower corner = 0, 0
  set Upper corner = 4, 2
  set Cell size = 1
end
subsection Method
  set Method = GIMP
end
subsection Bodies
  subsection left
    set Lower corner = 0, 0
    set Upper corner = 2, 1
  end
  subsection right
    set Lower corner = 2, 0
    set Upper corner = 4, 1
  end
end
subsection Grid conditions
  subsection base
    set Side = bottom
  end
end
subsection Loads
  subsection nail
    set Type = force on points
    set Location = 2, 0.75
    set Value = 0; 1
  end
end
subsection Stages
  subsection both
  end
  subsection rest
    set Loads = none
    set Bodies = left
    subsection Time
      set End time = 2
    end
  end
  subsection again
    set Bodies = left
    set Loads = nail
    subsection Time
      set End time = 3
    end
  end
end
"""
shared = folder / "shared.prm"
shared.write_text(SHARED)
for name, settings, left in (
        ("while it rests", {}, 0.5),
        ("while it acts", {"Stages/rest/Loads": "nail"}, 0.5),
        ("with all of it", {"Loads/nail/Location": "2.75, 0.75"}, 0)):
    result = run(shared, settings)
    text(f"body of a force gone, {name}", result.found())
    bound(f"  reaction + {left}", result.reactions["base"][1] + left, 1e-10)

# A load that pauses goes with the ground, also if a body comes as it returns.
PAUSED = SOLID + """
subsection Mesh
  set Lower corner = 0, 0
  set Upper corner = 12, 3
  set Cell size = 0.5
end
subsection Method
  set Method = GIMP
end
subsection Bodies
  subsection ground
    set Lower corner = 0, 0
    set Upper corner = 4, 1
  end
  subsection later
    set Lower corner = 9, 0
    set Upper corner = 10, 1
  end
end
subsection Grid conditions
  subsection base
    set Side = bottom
    set Displacement = 1.5*min(max(t - 1, 0), 1); 0
  end
end
subsection Loads
  subsection plate
    set Type = surface traction
    set Points = 1.9 1; 1.1 1
    set Value = 0; -1
  end
end
subsection Probes
  subsection under
    set Location = 1.5, 0.9
  end
end
subsection Stages
  subsection first
    set Bodies = ground
  end
  subsection moves
    set Bodies = ground
    set Loads = none
    subsection Time
      set End time = 2
      set Steps = 4
    end
  end
  subsection again
    set Bodies = ground, later
    set Loads = plate
    subsection Time
      set End time = 3
    end
  end
end
"""
paused = folder / "paused.prm"
paused.write_text(PAUSED)
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
COLUMN = SOLID.replace("10000", "100").replace("0.3", "0") + """
subsection Mesh
  set Lower corner = 0, 0
  set Upper corner = 4, 12
  set Cell size = 1
end
subsection Method
  set Method = {method}
  set Strain = finite
end
subsection Bodies
  subsection base
    set Lower corner = 0, 0
    set Upper corner = 1, 2
  end
  subsection block
    set Lower corner = 0, 2
    set Upper corner = 1, 10
  end
  subsection other
    set Lower corner = 3, 0
    set Upper corner = 4, 1
  end
end
subsection Grid conditions
  subsection sides
    set Lower corner = 0, 0
    set Upper corner = 4, 12
    set Components = x
  end
  subsection bottom
    set Side = bottom
  end
end
subsection Loads
  subsection push
    set Type = surface traction
    set Points = 1 {top}; 0 {top}
    set Value = 0; {force}
  end
  subsection weight
    set Type = gravity
    set Value = 0; {weight}
  end
end
subsection Probes
  subsection top
    set Location = 0.5, {top}
    set Body = block
    set Quantities = displacement, stress
  end
end
"""
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
LINED = SOLID.replace("0.3", "0") + """
subsection Mesh
  set Lower corner = 0, 0
  set Upper corner = 1, 2
  set Cell size = 1
end
subsection Method
  set Method = finite element
end
subsection Bodies
  subsection ground
    set Lower corner = 0, 0
    set Upper corner = 1, 1
  end
  subsection core
    set Lower corner = 0, 1
    set Upper corner = 1, 2
  end
  subsection lining
    set Lower corner = 0, 1
    set Upper corner = 1, 2
  end
end
subsection Grid conditions
  subsection base
    set Side = bottom
  end
end
subsection Loads
  subsection weight
    set Type = gravity
    set Value = 0; -10
  end
end
subsection Stages
  subsection core
    set Bodies = ground, core
  end
  subsection dug
    set Bodies = ground
    subsection Time
      set End time = 2
    end
  end
  subsection lined
    set Bodies = ground, lining
    subsection Time
      set End time = 3
    end
  end
end
subsection Probes
  subsection crown
    set Location = 0.5, 1.5
    set Body = lining
    set Quantities = stress
  end
end
"""
lined = folder / "lined.prm"
lined.write_text(LINED)
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
COMES = SOLID + """
subsection Mesh
  set Lower corner = -0.5, 0
  set Upper corner = 1.5, 3
  set Cell size = 0.25
end
subsection Method
  set Method = finite element
  set Mesh after step = keep
end
subsection Bodies
  subsection low
    set Lower corner = 0, 0
    set Upper corner = 1, 1
  end
  subsection up
    set Lower corner = 0, 1
    set Upper corner = 1, 2
  end
end
subsection Boundaries
  subsection left
    set Points = 0 3; 0 0
    set Constraint = roller
  end
  subsection right
    set Points = 1 0; 1 3
    set Constraint = roller
  end
end
subsection Grid conditions
  subsection base
    set Side = bottom
    set Components = y
  end
end
subsection Loads
  subsection pressure
    set Type = surface traction
    set Body = low
    set Part = top
    set Value = 0; -100*t
  end
  subsection weight
    set Bodies = up
    set Value = 0; -10*(t-1)
  end
end
subsection Stages
  subsection pressed
    set Bodies = low
    set Loads = pressure
  end
  subsection filled
    set Bodies = low, up
    set Loads = weight
    subsection Time
      set End time = 2
    end
  end
end
"""
comes = folder / "comes.prm"
comes.write_text(COMES)
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
JOINS = SOLID.replace("10000", "100") + """
subsection Mesh
  set Lower corner = 0, 0
  set Upper corner = 12, 4
  set Cell size = 1
end
subsection Method
  set Method = finite element
end
subsection Bodies
  subsection flying
    set Lower corner = 1, 1
    set Upper corner = 3, 3
    set Initial velocity = 1; 0
  end
  subsection new
    set Lower corner = 3, 1
    set Upper corner = 4, 3
  end
end
subsection Stages
  subsection one
    set Bodies = flying
    subsection Time
      set Integrator = Newmark
      set End time = 0.1
      set Steps = 2
    end
  end
  subsection two
    set Bodies = flying, new
    subsection Time
      set Integrator = Newmark
      set End time = 0.2
      set Steps = 2
    end
  end
end
"""
joins = folder / "joins.prm"
joins.write_text(JOINS)
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
FILLED = SOLID.replace("10000", "100") + """
subsection Mesh
  set Lower corner = 0, 0
  set Upper corner = 4, 8
  set Cell size = 1
end
subsection Method
  set Method = finite element
  set Strain = finite
end
subsection Bodies
  subsection ground
    set Lower corner = 0, 0
    set Upper corner = 4, 6
  end
  subsection fill
    set Lower corner = 0, 6
    set Upper corner = 4, 8
  end
end
subsection Grid conditions
  subsection base
    set Side = bottom
  end
end
subsection Loads
  subsection weight
    set Type = gravity
    set Value = 0; -5
  end
end
subsection Stages
  subsection one
    set Bodies = ground
    subsection Time
      set Steps = 2
    end
  end
  subsection two
    set Bodies = ground, fill
    subsection Time
      set End time = 2
      set Steps = 2
    end
  end
end
subsection Probes
  subsection point
    set Location = 0.21132486540518713, 6.2113248654051871
    set Body = fill
    set Quantities = displacement, position
  end
  subsection place
    set Location = 0.21132486540518713, 6.2113248654051871
    set Kind = interpolated
    set Quantities = displacement, position
  end
end
"""
filled = folder / "filled.prm"
filled.write_text(FILLED)
row = run(filled).history()[-1]
at_least("a place on what comes: has settled by", 6.2 - row["y at place"], 0.4)
for key in ("x", "y", "u_x", "u_y"):
    bound(f"  {key} over that of the point there - 1",
          row[f"{key} at place"] / row[f"{key} at point"] - 1, 1e-10)

# A place leaves the cells; then the body of the point that it follows is gone.
LEAVES = SOLID + """
subsection Mesh
  set Lower corner = 0, 0
  set Upper corner = 4, 4
  set Cell size = 1
end
subsection Method
  set Method = material point
  set Strain = finite
end
subsection Bodies
  subsection left
    set Lower corner = 0, 0
    set Upper corner = 1, 2
  end
  subsection right
    set Lower corner = 3, 0
    set Upper corner = 4, 2
  end
end
subsection Grid conditions
  subsection base
    set Side = bottom
    set Displacement = 0; 0.1*min(t, 1)
  end
end
subsection Stages
  subsection both
    subsection Time
      set Steps = 4
    end
  end
  subsection one
    set Bodies = right
    subsection Time
      set End time = 2
    end
  end
end
subsection Probes
  subsection top
    set Location = 0.5, 2
    set Kind = interpolated
    set Quantities = displacement, position
  end
end
"""
leaves = folder / "leaves.prm"
leaves.write_text(LEAVES)
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
