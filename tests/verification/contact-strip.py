# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A rigid rough strip on clay, pushed straight down and at 60 degrees from it, where its
force must be H/(B k) = 1/2, V/(B k) = 1 + pi - asin(1/2) + cos(asin(1/2)) by normality."""

from math import asin, cos, pi, radians, sin

B, H = 2, 0.25
SCENE = f"""
Dimension = 2
Mesh/Lower corner = -3.5, -2 | Upper corner = 3.5, 0 | Cell size = {H}
Method/Method = finite element | Mesh after step = keep
Materials/clay/Model = von Mises | Shear yield stress = 1
Materials/clay/Young modulus = 5000 | Poisson ratio = 0.49
Bodies/ground/Lower corner = -3.5, -2 | Upper corner = 3.5, 0
Boundaries/strip/Points = {B / 2} 0; {-B / 2} 0 | Constraint = contact
Boundaries/strip/Adhesion = 1 | Separation = false
Grid conditions/left/Side = left | Components = x
Grid conditions/right/Side = right | Components = x
Grid conditions/base/Side = bottom
Time/Steps = 20
"""


def capacity(angle, way, rise=1e-3, **keys):
    """H and V over B k, of a motion at an angle from straight down."""
    c, s = cos(radians(angle)), sin(radians(angle))
    rows = run(scene_file("strip.prm", SCENE), {
        **QUIET, **keys,
        "Boundaries/strip/Translation": f"{way * s!r}*t; {-way * c!r}*t"
    }).history()
    bound(f"{angle} degrees: rise in the last step",
          rows[-1]["reaction_y of strip"] / rows[-2]["reaction_y of strip"] - 1, rise)
    return [abs(rows[-1][f"reaction_{d} of strip"]) / B for d in "xy"]


def with_normality(h):
    """V/(B k) at H/(B k) = h."""
    return 1 + pi - asin(h) + cos(asin(h))


DEGREE_2 = {"Method/Degree": 2, "Time/Steps": 10}
_, down = capacity(0, 0.006, **DEGREE_2)
number("degree 2, vertical: V/(B k), exact 5.1416", down, 3)
bound("error", down / (2 + pi) - 1, 0.01)
# What is elastic still turns the force: it is compared with V that belongs to H.
across, down = capacity(60, 0.004, 0.02, **DEGREE_2)
number("degree 2, inclined: H/(B k)", across, 2)
number(f"V/(B k), exact {with_normality(across):.3g}", down, 3)
bound("error", down / with_normality(across) - 1, 0.04)

# The last node that it holds works for half a cell more: h/B on V.
_, straight = capacity(0, 0.006)
number("degree 1, vertical: V/(B k), exact 5.1416", straight, 3)
bound("error over h/B", (straight / (2 + pi) - 1) / (H / B), 1)
# That cancels.
h = 0.5
exact = with_normality(h)
across, down = (f / straight * (2 + pi) for f in capacity(60, 0.012))
number("degree 1, inclined: H/(B k) for that of vertical load, exact 0.5", across, 3)
bound("error", across / h - 1, 0.04)
number(f"degree 1, inclined: V/(B k), exact {exact:.5g}", down, 3)
bound("error", down / exact - 1, 0.04)
