# debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A cantilever under an axial force N: what 'Strain = small' says of N over Euler's
load, with points or nodes that move; at finite strain and in a linear analysis it
says nothing. Of a string that small strain lets grow without bound it tells although
by the end the stress is another."""

import math
import re

E, LENGTH, HEIGHT = 120000, 10, 0.5
EULER = math.pi**2 * E * HEIGHT**3 / 12 / (4 * LENGTH**2)

STRUT = f"""
subsection Mesh
  set Lower corner = 0, -1
  set Upper corner = 11, 1.5
  set Cell size    = 0.125
end
subsection Materials
  subsection steel
    set Young modulus = {E}
    set Poisson ratio = 0
  end
end
subsection Bodies
  subsection strut
    set Lower corner = 0, 0
    set Upper corner = {LENGTH}, {HEIGHT}
  end
end
subsection Grid conditions
  subsection foot
    set Side = left
  end
end
subsection Loads
  subsection force
    set Type  = surface traction
    set Body  = strut
    set Part  = right
    set Curve = t
  end
end
subsection Time
  set Steps = 4
end
subsection Output
  set Write = end
end
"""

scene = folder / "strut.prm"
scene.write_text(STRUT)


def strut(share, method, steps=4, **keys):
    settings = {"Method/Method": method, "Time/Steps": steps,
                "Loads/force/Value": f"{share * EULER / HEIGHT}; 0.001"}
    settings.update({f"Method/{key.replace('_', ' ')}": value
                     for key, value in keys.items()})
    warnings = run(scene, settings).summary.get("warnings", [])
    told = [re.match("stress is ([0-9.e+-]+) of what makes", warning)
            for warning in warnings]
    return [float(match[1]) for match in told if match]


def show(name, share, *args, **keys):
    told = strut(share, *args, **keys)
    text(f"{name}, N = {share} of Euler's load: told", len(told) == 1)
    if told:
        bound(f"{name}, N = {share}: error of the share told",
              told[0] / abs(share) - 1, 0.1)


for method in ("finite element", "material point"):
    for share in (0.05, -0.05, 0.5, -0.5):
        show(method, share, method)
for method in ("GIMP", "CPDI2"):
    show(method, 0.5, method)
STRING = """
subsection Mesh
  set Lower corner = 0, -1
  set Upper corner = 10, 1
  set Cell size    = 0.25
end
subsection Method
  set Method = finite element
  set Degree = 2
end
subsection Materials
  subsection steel
    set Young modulus = 10000
    set Poisson ratio = 0
  end
end
subsection Bodies
  subsection string
    set Lower corner   = 0, -0.25
    set Upper corner   = 10, 0.25
    set Initial stress = 200; 0; 0; 0
  end
end
subsection Grid conditions
  subsection left
    set Lower corner = -0.01, -0.01
    set Upper corner = 0.01, 0.01
  end
  subsection right
    set Lower corner = 9.99, -0.01
    set Upper corner = 10.01, 0.01
  end
end
subsection Loads
  subsection left
    set Type  = side traction
    set Side  = left
    set Value = -200; 0
  end
  subsection right
    set Type  = side traction
    set Side  = right
    set Value = 200; 0
  end
  subsection across
    set Value = 0; 0.001*sin(pi*x/10)*t
  end
end
subsection Output
  set Write = end
end
"""
string = folder / "string.prm"
string.write_text(STRING)
for steps in (4, 10, 20):
    told = [float(match[1]) for match in (
        re.match("stress is ([0-9.e+-]+) of what makes", warning) for warning in
        run(string, {"Time/Steps": steps}).summary.get("warnings", [])) if match]
    bound(f"pulled string, {steps} steps: error of the share told",
          abs(sum(told) / (200 / (10000 * math.pi**2 * 0.5**2 / 12 / 10**2)) - 1), 0.1)

show("one step", -0.5, "finite element", 1)
show("finite strain", 0.5, "material point", Strain="finite")
show("linear analysis", 0.5, "material point", Mesh_after_step="keep")
show("linear analysis", 0.5, "finite element", Mesh_after_step="keep")
