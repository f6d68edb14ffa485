# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
# The scene of the README: slope and stop together carry the weight of 500 N.
from math import cos, hypot, radians, sin

alpha = radians(25)
result = run("prm/boundaries/tilted-roller.prm")
text("status", result.summary["status"])
number("points", result.summary["points"], 3)
slope, stop = result.reactions["slope"], result.reactions["stop"]
bound("slope over exact - 1", hypot(*slope) / (500 * cos(alpha)) - 1, 1e-10)
bound("stop over exact - 1", hypot(*stop) / (500 * sin(alpha)) - 1, 1e-10)
for step in result.history():
    weight = 500 * step["t"]
    bound("sum of x reactions over weight",
          (step["reaction_x of slope"] + step["reaction_x of stop"]) / weight,
          1e-11)
    bound("sum of y reactions over weight - 1",
          (step["reaction_y of slope"] + step["reaction_y of stop"]) / weight
          - 1, 1e-11)
bound("violation of slope over cell size",
      max(step["violation of slope"] for step in result.history()) / 5, 2e-5)
bound("penetration over cell size",
      max(step["penetration of slope"] for step in result.history()) / 5, 1e-6)
