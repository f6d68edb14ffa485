# ranks: 1
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Lists of a stage: nothing is none, and only a key left out keeps what acted before;
'check' says what acts in each stage."""

scene = folder / "stages.prm"
scene.write_text("""
subsection Mesh
  set Lower corner = 0, 0
  set Upper corner = 1, 4
  set Cells = 1, 8
end
subsection Method
  set Method = finite element
  set Mesh after step = keep
end
subsection Materials
  subsection m
    set Young modulus = 1000
    set Poisson ratio = 0
  end
end
subsection Bodies
  subsection column
    set Shape = mesh
  end
end
subsection Boundaries
  subsection wall
    set Points = 0 4; 0 0
    set Constraint = roller
  end
end
subsection Grid conditions
  subsection base
    set Side = bottom
  end
  subsection crown
    set Side = top
    set Components = x
  end
end
subsection Loads
  subsection pull
    set Type = side traction
    set Side = top
    set Value = 0; 1
  end
end
subsection Stages
  subsection first
  end
  subsection second
    subsection Time
      set End time = 2
    end
  end
end
subsection Probes
  subsection top
    set Location = 0.5, 4
    set Kind = interpolated
  end
end
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
