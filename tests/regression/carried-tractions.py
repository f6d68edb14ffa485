# debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""What a place of a boundary carries is its own: not that of the next side of a
corner, of another body further along, nor of a stage before one in which the
boundary did not act."""

SOLID = """
subsection Materials
  subsection elastic
    set Young modulus = 20
    set Poisson ratio = 0.3
    set Density = 1
  end
end
subsection Output
  set Write = end
  set Mesh = false
end
"""

# A block spreads under its weight until walls stop it: the box in one piece or
# in three, of which the ledge is for the right one to touch something.
SPREAD = SOLID + """
subsection Mesh
  set Lower corner = -0.37, -0.33
  set Upper corner = 2.03, 2.67
  set Cell size = 0.2
end
subsection Method
  set Method = GIMP
  set Strain = finite
end
subsection Bodies
  subsection block
    set Lower corner = 0, 0
    set Upper corner = 1, 2
  end
  subsection ledge
    set Lower corner = 1.1, 2.35
    set Upper corner = 1.33, 2.6
  end
end
subsection Grid conditions
  subsection shelf
    set Lower corner = 0, 2.2
    set Upper corner = 3, 3
  end
end
subsection Loads
  subsection weight
    set Type = gravity
    set Bodies = block
    set Value = 0; -12*t
  end
end
subsection Time
  set Steps = 20
end
subsection Probes
  subsection foot
    set Location = 0.95, 0.05
  end
end
"""


def roller(name, points):
    return f"""
subsection Boundaries
  subsection {name}
    set Points = {points}
    set Constraint = roller
  end
end
"""


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
LAND = SOLID + roller("floor", "-0.5 0; 4.5 0") + """
subsection Mesh
  set Lower corner = -0.5, -0.3
  set Upper corner = 4.5, 1.7
  set Cell size = 0.25
end
subsection Method
  set Method = GIMP
end
subsection Materials
  subsection heavy
    set Young modulus = 20
    set Poisson ratio = 0.3
    set Density = {density}
  end
end
subsection Bodies
  subsection left
    set Material = heavy
    set Lower corner = 0, 0
    set Upper corner = 1.5, 1
  end
  subsection right
    set Material = elastic
    set Lower corner = 3, 0.3
    set Upper corner = 4, 1.3
    set Initial velocity = 0; -0.3
  end
end
subsection Loads
  subsection weight
    set Type = gravity
    set Bodies = left
    set Value = 0; -0.1
  end
end
subsection Probes
  subsection light
    set Location = 3.5, 1.2
    set Quantities = velocity
  end
end
subsection Time
  set Integrator = Newmark
  set End time = 2
  set Steps = 60
end
"""
light, heavy = (run(written(f"land-{d}", LAND.replace("{density}", d))).history()
                for d in ("1", "50"))
at_least("light block bounces to", light[-1]["v_y at light"], 0.1)
bound("  beside a heavy one it differs by",
      abs(heavy[-1]["v_y at light"] - light[-1]["v_y at light"]), 1e-6)

# A boundary that pauses, and one in its place that never acted.
PAUSE = SOLID + """
subsection Mesh
  set Lower corner = -0.3, -0.3
  set Upper corner = 2.2, 2.7
  set Cell size = 0.25
end
subsection Method
  set Method = GIMP
end
subsection Bodies
  subsection block
    set Lower corner = 0, 0.1
    set Upper corner = 1.5, 2
  end
end
subsection Boundaries
  subsection A
    set Points = 0 0.1; 1.5 0.1
  end
  subsection B
    set Points = 0 0.1; 1.5 0.1
  end
end
subsection Loads
  subsection weight
    set Type = gravity
    set Value = 0; -0.2
  end
end
subsection Stages
  subsection rests
    set Boundaries = A
  end
  subsection falls
    set Boundaries = none
    subsection Time
      set Integrator = Newmark
      set End time = 1.01
    end
  end
  subsection held
    set Boundaries = {last}
    subsection Time
      set Integrator = Newmark
      set End time = 1.05
      set Steps = 8
    end
  end
end
"""
for enforcement in "symmetric Nitsche", "penalty", "augmented Lagrangian":
    again, new = (
        [row[f"reaction_y of {name}"] for row in
         run(written(f"pause-{name}", PAUSE.replace("{last}", name)),
             {"Boundaries/*/Enforcement": enforcement}).history()[-9:]]
        for name in "AB")
    at_least(f"{enforcement}: reaction", abs(new[-1]), 1e-3)
    bound("  of a boundary that paused differs by",
          max(abs(a - b) for a, b in zip(again, new)), 1e-9)
