# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Supports balance every kind of load, at every step; uniform stress is exact."""

CURVE = {0.5: 1.0, 1.0: 2.0, 1.5: 1.5, 2.0: 1.0}
FORCES = {
    "side": (-8 * 60, 1.5 * 60),
    "top": (0.5 * 60, -8 * 60),
    "push": (30, -50),
    "nail": (-20, 35),
    "drag": (0.004 * 3600, -0.01 * 3600),
    "weight": (0, -10 * 2e-3 * 3600),
}
METHODS = {
    "MPM": {},
    "GIMP": {"Method/Method": "GIMP"},
    "FE Q1": {"Method/Method": "finite element"},
    "FE Q2": {"Method/Method": "finite element", "Method/Degree": 2},
}
SCENE = "prm/verification/loads.prm"


def unbalance(result, loads):
    """Largest force left over at any step, over the largest reaction."""
    worst = largest = 0
    for row in result.history():
        for d in (0, 1):
            reaction = sum(row[f"reaction_{'xy'[d]} of {support}"]
                           for support in ("left", "base"))
            load = CURVE[round(row["t"], 9)] * sum(FORCES[name][d]
                                                  for name in loads)
            worst = max(worst, abs(reaction + load))
            largest = max(largest, abs(reaction))
    return worst / largest


def without(names):
    return {f"Loads/{name}/Value": "0; 0" for name in names}


for name, settings in METHODS.items():
    bound(f"{name}, all loads: unbalance",
          unbalance(run(SCENE, settings), FORCES), 1e-8)
for load in FORCES:
    others = [name for name in FORCES if name != load]
    bound(f"MPM, {load} alone: unbalance",
          unbalance(run(SCENE, without(others)), [load]), 1e-8)
for name, settings in METHODS.items():
    result = run(SCENE, {**settings, **without(["push", "nail", "drag", "weight"]),
                         "Loads/side/Value": "-8; 0",
                         "Loads/top/Value": "0; -8",
                         "Method/Mesh after step": "keep"})
    bound(f"{name}, pressure: r_u", result.errors["r_u"], 1e-12)
    bound(f"{name}, pressure: l2_sigma", result.errors["l2_sigma"], 1e-12)
    bound(f"{name}, pressure: left reaction - 480",
          result.reactions["left"][0] - 480, 1e-8)

# Through the mesh both go with the material: the rest is what its sides shorten.
result = run(SCENE, {"Method/Method": "GIMP",
                     **without(["push", "nail", "drag", "weight"]),
                     "Loads/side/Value": "-8; 0", "Loads/top/Value": "0; -8"})
bound("GIMP, pressure, through the mesh: l2_sigma", result.errors["l2_sigma"], 0.007)

# The traction on a line inside cells, and displacements prescribed on the grid:
# strain (-0.001, -(1+nu)(1-2nu)/(1-nu)/E*8 + nu/(1-nu)*0.001).
result = run(SCENE, {
    **without(["push", "nail", "drag", "weight", "side"]),
    "Bodies/block/Upper corner": "60, 65",
    "Loads/top/Points": "60 65; 0 65",
    "Loads/top/Value": "0; -8",
    "Grid conditions/right/Side": "right",
    "Grid conditions/right/Components": "x",
    "Grid conditions/right/Displacement": "-0.03*t; 0",
    "Method/Mesh after step": "keep",
    "Exact solution/Displacement":
        "-0.001*x; (-8/1000*1.3*0.4/0.7+0.3/0.7*0.001)*y",
    "Exact solution/Stress":
        "-0.3/0.7*8-1/0.91; -8; -0.3*(8+0.3/0.7*8+1/0.91); 0",
})
bound("line in cells, moved side: r_u", result.errors["r_u"], 1e-12)
bound("line in cells, moved side: l2_sigma", result.errors["l2_sigma"], 1e-12)
bound("line in cells, moved side: base reaction - 480",
      result.reactions["base"][1] - 480, 1e-8)

# A surface that ends the mesh, drawn either way and off by round-off, and an arc
# whose chords end the mesh.
at_side = {**without(["push", "nail", "drag", "weight", "side"]),
           "Loads/top/Value": "0; -8", "Mesh/Upper corner": "60, 60"}
for points in ("60 60; 0 60", "0 60; 60 60", "60 60+1e-12; 0 60+1e-12"):
    result = run(SCENE, {**at_side, "Loads/top/Points": points})
    bound(f"side of the mesh, {points}: base reaction - 480",
          result.reactions["base"][1] - 480, 1e-8)
half = run(SCENE, {**at_side, "Loads/top/Points": "60 90; 30 60; 0 60"})
bound("half of it outside the mesh: base reaction - 240",
      half.reactions["base"][1] - 240, 1e-8)
text("  found", half.found())

scene = scene_file("arc.prm", """
Mesh/Type = generator | Generator = hyper_shell
Mesh/Arguments = 0, 0 : 5 : 10 : 12 : true | Refinements = 1
Method/Method = finite element
Materials/solid/Young modulus = 1000 | Poisson ratio = 0.3
Bodies/ring/Shape = mesh
Grid conditions/inside/Side = 0
Loads/pull/Type = surface traction | Surface = circle | Centre = 0, 0 | Radius = 10
Loads/pull/Body side = inside | Value = 1; 0
""")
bound("arc: reaction over its length + 1",
      run(scene).reactions["inside"][0] / 62.8319 + 1, 0.01)
