# debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Nodes that too few points touch: the run goes on, says so, and the result is
that of the material. What only empty parts would hold is refused."""

scene = "prm/boundaries/tilted-roller.prm"
effect = "stiffness of empty parts"


def largest_difference(a, b):
    """Of a probe's displacements, over the largest of them."""
    return max(abs(a.probes[key] - b.probes[key]) for key in a.probes) / max(
        map(abs, b.probes.values()))


free = {"Method/Method": "material point", "Method/Aggregate below": 0}
at = {**free, "Mesh/Cell size": 2.5, "Probes/top/Location": "60, 70",
      "Probes/top/Quantities": "displacement"}
on_its_own = run(scene, at)
text("status", on_its_own.summary["status"])
number("its stiffness", on_its_own.finding("fictitious-stiffness")["value"], 1)
text("named as an effect", effect in on_its_own.summary["effects"])
text("also where none is needed", effect in run(scene, free).summary["effects"])
for epsilon, limit in ((1e-8, 1e-6), (1e-4, 1e-5)):
    bound(f"largest change of displacements with {epsilon:g}",
          largest_difference(on_its_own,
                             run(scene, {**at, "Method/Fictitious stiffness":
                                         epsilon})), limit)

unloaded = run(scene, {**at, "Loads/weight/Value": "0; -0.1",
                       "Loads/weight/Curve": "0: 0, 0.5: 1, 1: 0",
                       "Method/Mesh after step": "keep"})
text("loaded and unloaded", unloaded.summary["status"])
text("rejected steps", unloaded.summary["rejected_steps"])
bound("displacement left over the largest",
      max(map(abs, unloaded.probes.values())) /
      max(abs(step["u_y at top"]) for step in unloaded.history()), 1e-6)

turning = run(scene, {**free, "Boundaries/slope/Rotation angle": "25+5*t",
                      "Boundaries/stop/Rotation angle": "25+5*t"})
text("a slope that tilts", turning.summary["status"])
number("stiffness from t", turning.finding("fictitious-stiffness")["t"], 3)

# One row of cells with one point each does not resist bending.
ROW = {"Method/Points per direction": 1,
       "Bodies/block/Lower corner": "0.5, 1.2",
       "Bodies/block/Upper corner": "4.5, 1.8",
       "Boundaries/left/Points": "0.5 1.8; 0.5 1.2"}
for name, material in (("elastic", {}),
                       ("yields", {"Materials/soil/Model": "von Mises",
                                   "Materials/soil/Shear yield stress": 1e6})):
    row = run("tests/bad-input/base.prm", {
        **ROW, "Boundaries/left/Enforcement": "skew Nitsche", **material},
        expect=1)
    text(f"refused, {name}", row.summary["message"].split(". ")[0])

# What was no cure for steps that Newton's method could not end is one for a grain
# that comes later.
later = scene_file("later.prm", """
Mesh/Lower corner = 0, 0 | Upper corner = 6, 12 | Cell size = 1
Method/Method = material point | Strain = finite
Materials/soft/Young modulus = 100 | Poisson ratio = 0 | Density = 1
Bodies/column/Lower corner = 0, 0 | Upper corner = 1, 10
Bodies/grain/Lower corner = 4.1, 0.1 | Upper corner = 4.9, 0.9 | Point grid = 1, 1
Grid conditions/sides/Lower corner = 0, 0 | Upper corner = 1, 12 | Components = x
Grid conditions/bottom/Side = bottom
Loads/push/Type = surface traction | Points = 1 10; 0 10 | Value = 0; -60*min(t, 0.12)
Loads/weight/Type = gravity | Value = 0; -1 | Bodies = grain
Solver/Maximum iterations = 3
Stages/one/Bodies = column
Stages/two/Bodies = column, grain
Stages/two/Time/End time = 2
Output/Write = end
""")
grain = run(later)
text("a grain after steps without a cure", grain.summary["status"])
text("  found", grain.found())
