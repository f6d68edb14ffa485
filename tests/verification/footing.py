# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Rough rigid footing, as shipped and as published (material points at small strain,
an edge inside cells): no point behind a boundary, reactions in balance."""
h = 0.2
shipped = run("prm/cortis-2017/footing.prm")
text("shipped: status", shipped.summary["status"])
text("shipped: found", shipped.found() or "nothing")
number("shipped: force on the footing in the end",
       shipped.history()[-1]["reaction_y of footing"], 6)
result = run("prm/cortis-2017/footing.prm", {
    "Method/Method": "material point", "Method/Strain": "small",
    "Mesh/Lower corner": "-0.33, -0.35", "Mesh/Upper corner": "3.27, 3.65"})
history = result.history()
names = sorted(result.reactions)
text("status", result.summary["status"])
text("points", result.summary["points"])
text("steps", len(history))
text("rejected steps", result.summary["rejected_steps"])
for name in names:
    bound(f"deepest point behind {name} over h",
          max(step[f"penetration of {name}"] for step in history) / h, 1e-3)


def out_of_balance(step):
    force = {c: [step[f"reaction_{c} of {name}"] for name in names]
             for c in "xy"}
    largest = max((x**2 + y**2)**0.5 for x, y in zip(force["x"], force["y"]))
    return max(abs(sum(force["x"])), abs(sum(force["y"]))) / largest


for i, step in enumerate(history):
    bound(f"step {i + 1}: sum of reactions over the largest",
          out_of_balance(step), 1e-8)
number("force on the footing in step 1", history[0]["reaction_y of footing"], 6)
number("force on the footing in the end", history[-1]["reaction_y of footing"],
       6)
number("horizontal displacement beside", history[-1]["u_x at beside"], 6)
number("vertical displacement beside", history[-1]["u_y at beside"], 6)
