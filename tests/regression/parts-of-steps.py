# debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""The mesh file has the displacement of all of a step, also of one in two parts."""

scene = folder / "scene.prm"
scene.write_text("""
subsection Mesh
  set Lower corner = 0, 0
  set Upper corner = 1, 1
  set Cell size = 0.5
end
subsection Materials
  subsection m
    set Young modulus = 1000
    set Poisson ratio = 0.3
    set Density = 1
  end
end
subsection Bodies
  subsection b
    set Lower corner = 0, 0
    set Upper corner = 1, 1
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
subsection Probes
  subsection top
    set Location = 0.5, 1
    set Kind = interpolated
    set Quantities = displacement
  end
end
subsection Output
  set Write = end
end
""")
for method, limit in (("finite element", 1e-5), ("GIMP", 1e-2)):
    for integrator in "Bathe", "Newmark":
        result = run(scene, {"Method/Method": method,
                             "Time/Integrator": integrator, "Time/Steps": 4,
                             "Time/End time": 0.04})
        before, last = result.history()[-2:]
        moved = [u for place, u in result.nodes("position", "step_displacement")
                 if place[0] == 0.5 and abs(place[1] - 1) < 0.1]
        bound(f"{method}, {integrator}: displacement of the last step, of a node "
              "over that of a probe - 1",
              moved[0][1] / (last["u_y at top"] - before["u_y at top"]) - 1, limit)
