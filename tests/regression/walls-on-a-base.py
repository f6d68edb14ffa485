# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Soil between walls on a base that holds all of its components: the thrust on a
wall that is an implicit boundary, though nodes of the base hold its lowest cell
too. By the exact stress it is nu/(1 - nu) rho g H^2/2."""

SCENE = """
subsection Mesh
  set Lower corner = -0.5, 0
  set Upper corner = 2.5, 2.5
  set Cell size = 0.5
end
subsection Method
  set Method = finite element
end
subsection Materials
  subsection soil
    set Young modulus = 1e6
    set Poisson ratio = 0.3
    set Density = 1
  end
end
subsection Bodies
  subsection soil
    set Lower corner = 0, 0
    set Upper corner = 2, 2
  end
end
subsection Boundaries
  subsection left
    set Body = soil
    set Part = left
    set Constraint = roller
  end
  subsection right
    set Body = soil
    set Part = right
    set Constraint = roller
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
    set Value = 0; -9.81
  end
end
subsection Output
  set Write = end
end
"""
scene = folder / "scene.prm"
scene.write_text(SCENE)
EXACT = 0.3 / 0.7 * 9.81 * 2
for method in ("finite element", "material point", "GIMP"):
    for how, keys in (("finite strain", {"Method/Strain": "finite"}),
                      ("multipliers",
                       {"Boundaries/*/Enforcement": "augmented Lagrangian"}),
                      ("penalty", {"Boundaries/*/Enforcement": "penalty"}),
                      ("weighted", {"Boundaries/*/Enforcement": "weighted"})):
        forces = run(scene, {"Method/Method": method, **keys}).summary["reactions"]
        bound(f"{method}, {how}: thrust over the exact one - 1",
              abs(forces["left"][0] / EXACT - 1), 0.01)
        bound(f"{method}, {how}: forces in balance",
              max(abs(sum(force[0] for force in forces.values())),
                  abs(sum(force[1] for force in forces.values()) / 39.24 - 1)),
              1e-6)
