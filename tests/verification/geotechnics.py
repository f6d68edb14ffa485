# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Scenes of soil with default keys: a slope goes far beyond first yield; a pile
whose tip and shaft are one boundary is pushed in by more than its width; a lining
fits into its tunnel; clay slides along a pile that is moved sideways."""

from math import pi

SLOPE, PILE = "prm/geotechnics/slope.prm", "prm/geotechnics/pile.prm"
TUNNEL = "prm/geotechnics/tunnel.prm"
SIDEWAYS = "prm/geotechnics/pile-sideways.prm"

def slope(**settings):
    return run(SLOPE, {"Mesh/Cell size": 1, **QUIET,
                       **{f"Method/{k.replace('_', ' ')}": v
                          for k, v in settings.items()}})


held = slope(Fictitious_stiffness=1e-6)
default = slope()
elastic = run(SLOPE, {"Mesh/Cell size": 1, **QUIET,
                      "Materials/clay/Model": "linear elastic",
                      "Materials/clay/Shear yield stress": ""})
for name, result in (("slope", default), ("elastic slope", elastic)):
    text(f"{name}: status", result.summary["status"])
    number(f"{name}: last time", result.history()[-1]["t"], 2)
    weight = 2 * 9.81 * 2 * (40 * 4 + 8 * (10 + 26) / 2)
    bound(f"{name}: reaction of the base over the weight - 1",
          result.reactions["base"][1] / weight - 1, 1e-8)
for key in ("u_x at crest", "u_y at crest", "u_x at toe", "u_y at toe"):
    bound(f"slope: {key} over that with 1e-6 - 1",
          default.probes[key] / held.probes[key] - 1, 0.02)
number("slope before yield: largest change by 1e-6",
       max(abs(a[key] / b[key] - 1)
           for a, b in zip(default.history()[:10], held.history()[:10])
           for key in ("u_y at crest", "u_x at toe")), 1)

pushed_in = run(PILE, {**QUIET, "Time/End time": 0.4, "Time/Steps": 24})
text("pile: status", pushed_in.summary["status"])
for row in pushed_in.history()[9::5]:
    bound(f"pile at {1.5 * row['t']:.2f} m: force over 23 kN/m - 1",
          row["reaction_y of pile"] / -23 - 1, 0.15)

# Two curved bodies touch; the hole is made by a body without material.
coarse = {**QUIET, "Mesh/Cell size": 1}
tunnel = run(TUNNEL, coarse)
fitted = run(TUNNEL, {**coarse, "Method/Method": "finite element"})
weight = 9.81 * (2 * (1200 - 9 * pi) + 2.4 * pi * (9 - 2.7**2))
bound("tunnel: reaction of the base over the weight - 1",
      tunnel.reactions["bottom"][1] / weight - 1, 1e-8)
for key in ("u_y at crown", "u_y at surface"):
    number(f"tunnel: {key}", tunnel.probes[key], 3)
    bound(f"tunnel: {key} over that of finite elements - 1",
          tunnel.probes[key] / fitted.probes[key] - 1, 0.01)

# The limit force of Randolph and Houlsby (1984), Geotechnique 34, 613.
for method in ("GIMP", "finite element"):
    pushed = run(SIDEWAYS, {**QUIET, "Method/Method": method})
    bound(f"pile moved sideways, {method}: force over 9.14 k D / 2 - 1",
          pushed.reactions["pile"][0] / 91.4 - 1, 0.025)
