# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Factors of safety with water: clay under water, a long slope with seepage along it,
and the drawdown of a reservoir after Griffiths and Lane (1999), example 5, within 4 %.
A search begins at both ends of what is allowed: a factor that is too low or too high
ends the test."""

import json
from math import cos, radians, sin, tan


def factor(scene, settings, lower, upper, tolerance):
    result = run(scene, {**settings, "Strength reduction/Lower factor": lower,
                         "Strength reduction/Upper factor": upper,
                         "Strength reduction/Tolerance": tolerance}, command="study")
    case, = json.loads((result.folder / "summary.json").read_text())["cases"]
    return case["factor_of_safety"]


# Without friction the buoyant weight alone counts.
CLAY = "prm/geotechnics/submerged-slope.prm"
under_water = factor(CLAY, {"Mesh/Cell size": 2}, 3.8, 4.6, 0.05)
dry = factor(CLAY, {"Mesh/Cell size": 2, "Water/Level": 10, "Water/Pressure": "",
                    "Water/Curve": "0"}, 1.9, 2.3, 0.025)
number("clay, dry", dry, 4)
bound("clay under water: over dry, less gamma/gamma'", under_water / dry - 2, 1e-10)

# phi' = 30 degrees, c' = 10 kPa, 20 degrees steep, 5 m deep, water table at the
# surface.
b = radians(20)
exact = (10 + (20 - 10) * 5 * cos(b)**2 * tan(radians(30))) / (20 * 5 * sin(b) * cos(b))
SEEPAGE = {"Materials/sand/Cohesion": 10, "Constants/m": tan(radians(30)) / exact,
           "Constants/normal": "t*10*cos($b)*($H - y)",
           "Water/Pressure": "10*cos($b)*($H - y)", "Water/Curve": "t"}
number("seepage along a slope, exact", exact, 5)
found = factor("prm/geotechnics/infinite-slope.prm", SEEPAGE, 1, 1.3, 0.002)
bound("seepage along a slope: error", found / exact - 1, 1e-2)

# Slow drawdown: one level in and beside the slope.
DRAWDOWN = "prm/geotechnics/drawdown.prm"
METHODS = {"GIMP": {}, "FE Q2": {"Method/Method": "finite element", "Method/Degree": 2,
                                 "Mesh/Cell size": 2}}
for drawdown, published in ((0, 1.85), (0.7, 1.30)):
    for method, settings in list(METHODS.items())[:2 if drawdown else 1]:
        found = factor(DRAWDOWN, {**settings, "Constants/drawdown": drawdown},
                       0.96 * published, 1.04 * published, 0.02)
        number(f"F, L/H = {drawdown:g}, {published}: {method}", found, 4)
# Water stays in the slope as it falls outside; inside the pressure of the reservoir may
# be continued as one likes.
for name, free in (("", {}), (", continued", {"Water/Free level": ""})):
    found = factor(DRAWDOWN, {"Constants/drawdown": 0.3, "Constants/inside": 0, **free},
                   1.15, 1.35, 0.03)
    number(f"F, L/H = 0.3, rapid{name}: GIMP", found, 3)
