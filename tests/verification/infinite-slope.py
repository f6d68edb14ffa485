# ranks: 1
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Factor of safety of a long slope by strength reduction, beside that of planes
along it, F = c/(gamma z sin(b) cos(b)) + tan(phi)/tan(b)."""

import json
from math import asin, cos, radians, sin, tan

SCENE = "prm/geotechnics/infinite-slope.prm"
PHI = radians(30)


def exact(slope, c):
    b = radians(slope)
    return c / (20 * 5 * sin(b) * cos(b)) + tan(PHI) / tan(b)


# Sand whose volume stays bears sin(phi) of the normal stress along planes that
# shear, and there is no excess of the stress along the slope.
COHESIVE = {"Materials/sand/Cohesion": 10, "Constants/b": "(30*pi/180)",
            "Constants/m": tan(PHI) / exact(30, 10)}
CASES = (("sand", {}, exact(20, 0), 1e-2),
         ("with cohesion", COHESIVE, exact(30, 10), 1e-2),
         ("without dilation", {"Materials/sand/Dilation angle": 0,
                               "Constants/m": 0},
          tan(PHI) / tan(asin(tan(radians(20)))), 1e-2))
for name, settings, factor, allowed in CASES:
    result = run(SCENE, settings, command="study")
    case, = json.loads((result.folder / "summary.json").read_text())["cases"]
    number(f"{name}: exact factor", factor, 7)
    bound(f"{name}: error", case["factor_of_safety"] / factor - 1, allowed)
