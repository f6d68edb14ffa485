# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Embankment of undrained clay: settlement, the weight at which it fails, and the
mean stress of points, with the mean change of volume of each cell and without."""

from mean_stress import alternating

SMALL = "prm/hard-cases/embankment.prm"
LARGE = "prm/geotechnics/slope.prm"
POINT = {"Method/Volumetric strain": "pointwise"}
MEAN = {"Method/Volumetric strain": "cell mean"}
FE = {"Method/Method": "finite element"}
Q2 = {**FE, **POINT, "Method/Degree": 2, "Method/Points per direction": 3}


def settlement(result):
    return -result.history()[-1]["u_y at crest"]


reference = settlement(run(SMALL, Q2))
number("small strain, FE Q2: settlement", reference, 4)
for title, settings in (("GIMP, cell mean", MEAN), ("FE, cell mean",
                                                   {**FE, **MEAN}),
                        ("GIMP, pointwise", POINT)):
    result = run(SMALL, settings)
    number(f"small strain, {title}: settlement over Q2 - 1",
           settlement(result) / reference - 1, 2)
    for name, (low, high, usual, largest) in alternating(result, 0.5).items():
        number(f"  {name}: least", low, 3)
        number(f"  {name}: largest", high, 3)
        if settings == POINT:
            number(f"  {name}: what alternates, at most", largest, 2)
        else:
            bound(f"  {name}: what alternates", largest, 5e-2)

# Weaker clay, until no equilibrium is found.
WEAK = {"Materials/clay/Shear yield stress": 20, "Mesh/Cell size": 1}
last = [run(SMALL, {**WEAK, **settings}, expect=1).history()[-1]["t"]
        for settings in (Q2, MEAN, {**FE, **MEAN})]
number("small strain, k = 20, FE Q2: last equilibrium", last[0], 3)
bound("  GIMP, cell mean, over it - 1", last[1] / last[0] - 1, 1e-2)
bound("  FE, cell mean, over it - 1", last[2] / last[0] - 1, 1e-2)
number("  GIMP, pointwise: settlement at 2",
       settlement(run(SMALL, {**WEAK, **POINT, "Time/End time": 2})), 2)

FAR = {"Materials/clay/Poisson ratio": 0.49, "Mesh/Cell size": 1,
       "Time/End time": 0.9, "Time/Steps": 18}
reference = settlement(run(LARGE, {**FAR, **Q2}))
number("finite strain, FE Q2: settlement", reference, 3)
for title, settings in (("cell mean", MEAN), ("pointwise", POINT)):
    result = run(LARGE, {**FAR, **settings})
    number(f"finite strain, GIMP, {title}: settlement over Q2 - 1",
           settlement(result) / reference - 1, 2)
    for name, (low, high, usual, largest) in alternating(result, 1).items():
        number(f"  {name}: least", low, 2)
        number(f"  {name}: largest", high, 2)
        if settings == MEAN and name == "smoothed":
            bound(f"  {name}: what alternates", largest, 5e-2)
