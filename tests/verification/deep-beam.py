# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
# Deep beam (Cortis et al. 2017, section 5.2, tables 2 and 3): u_y at the right
# corner against finite elements on the same mesh.
default = {"Boundaries/support/Enforcement": "skew Nitsche"}
paper = {"Boundaries/support/Enforcement": "weighted",
         "Boundaries/support/Band width": 1e-6}
conforming = "prm/cortis-2017/deep-beam-conforming.prm"
implicit = "prm/cortis-2017/deep-beam.prm"


def u_y(scene, h, settings):
    result = run(scene, QUIET | {"Mesh/Cell size": h} | settings)
    return result.probes["u_y at A"]


def points(n):
    return {"Method/Points per direction": n}


fe = {"Method/Method": "finite element"}
reference = {h: u_y(conforming, h, fe) for h in (10, 5, 2, 1)}
number("u_y of finite elements, h = 10", reference[10], 10)
bound("the same with the implicit support, relative",
      u_y(implicit, 10, fe) / reference[10] - 1, 1e-7)

cases = [(10, n) for n in (3, 5, 10, 15, 20, 25, 40)]
cases += [(h, 4) for h in (10, 5, 2, 1)]
for h, n in cases:
    text("h, points per cell", f"{h}, {n}^2")
    difference = u_y(conforming, h, points(n)) / reference[h] - 1
    number("conforming support", difference, 5)
    bound("implicit support - conforming",
          u_y(implicit, h, points(n)) / reference[h] - 1 - difference, 1e-7)
    if h == 10 and n in (3, 40):
        number("default enforcement",
               u_y(implicit, h, points(n) | default) / reference[h] - 1, 3)
        bound("paper's setting - conforming",
              u_y(implicit, h, points(n) | paper) / reference[h] - 1
              - difference, 1e-7)
