# debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Volume that hardly changes: Cook's membrane, and the bearing capacity of a strip
footing, with the mean change of volume of each cell and, on one rank, without."""

from math import atan2, pi

from mean_stress import alternating

# Of fine meshes; F-bar's at finite strain with G = 80.1938, K = 400942 (de Souza
# Neto et al. 1996), number of cells: displacement.
SMALL = {1 / 3: 32.3007, 0.4999: 27.755}
PUBLISHED = {15: 6.8242, 20: 6.8589, 30: 6.8914}
PLATEAU = 2 + pi
MEAN, POINT = "cell mean", "pointwise"


FE, GIMP = "prm/hard-cases/cook-fe.prm", "prm/hard-cases/cook-gimp.prm"


def tip(scene, settings, on_ranks=None):
    return run(scene, settings, on_ranks=on_ranks).history()[-1]["u_y at tip"]


for title, scene in (("fe", FE), ("gimp", GIMP)):
    for nu, exact in SMALL.items():
        for how in (MEAN, POINT):
            u = tip(scene, {"Materials/panel/Poisson ratio": nu,
                            "Method/Volumetric strain": how},
                    on_ranks=None if how == MEAN else 1)
            name = f"Cook, {title}, nu = {nu:.4f}, {how}"
            number(f"{name}: tip over exact - 1", u / exact - 1, 2)
            if how == MEAN:
                bound(f"{name}: tip", u / exact - 1, 1e-2)
for method in ("CPDI1", "material point", "finite element"):
    u = tip(GIMP, {"Method/Method": method}, on_ranks=1)
    bound(f"Cook, unfitted, {method}", u / SMALL[0.4999] - 1, 1.2e-2)

finite = {"Method/Strain": "finite", "Method/Mesh after step": "default",
          "Materials/panel/Young modulus": 240.565, "Time/Steps": 24,
          "Loads/shear/Curve": "t"}
for refinements, published in (
        (4, PUBLISHED[15] + (PUBLISHED[20] - PUBLISHED[15]) / 5),
        (5, PUBLISHED[30])):
    result = run(FE,
                 {**finite, "Mesh/Refinements": refinements},
                 on_ranks=None if refinements == 4 else 1)
    u = result.history()[-1]["u_y at tip"]
    name = f"Cook, finite strain, {2 ** refinements} cells"
    number(f"{name}: tip", u, 4)
    bound(f"{name}: over published - 1", u / published - 1, 1.5e-2)
    number(f"{name}: Newton iterations of a step",
           result.summary["newton_iterations"] / 24, 2)

for title, scene, allowed in (
        ("fe", "prm/hard-cases/bearing-fe.prm", 3e-2),
        ("gimp", "prm/hard-cases/bearing-gimp.prm", 3e-2),
        ("cpdi1", "prm/hard-cases/bearing-cpdi1.prm", 3e-2)):
    result = run(scene)
    rows = result.history()
    force = [-row["reaction_y of footing"] for row in rows]
    number(f"bearing, {title}: plateau over (2 + pi) k - 1",
           force[-1] / PLATEAU - 1, 2)
    bound(f"bearing, {title}: plateau", force[-1] / PLATEAU - 1, allowed)
    bound(f"bearing, {title}: rise in the last tenth of the way",
          force[-1] / force[-3] - 1, 2e-2)
    h = 2 / 15 if title == "fe" else 0.125
    for name, (low, high, usual, largest) in alternating(result, h).items():
        if name == "smoothed":
            bound(f"bearing, {title}: smoothed mean stress, what alternates "
                  "over the range", largest, 5e-2)
        else:
            number(f"bearing, {title}: mean stress of {name}, root of the mean "
                   "square of what alternates over the range", usual, 2)



class Prandtl:
    """The exact field about the edge of the footing at x = 1, by means over the
    squares of points: triangles with -k and -(1 + pi) k, a fan between them."""

    def __init__(self, h):
        n, size = 8, h / 2
        self.rows = []
        for i in range(round(3 / size)):
            for j in range(1, round(1.5 / size)):
                mean = sum(self.mean_stress((i + (a + 0.5) / n) * size,
                                            ((b + 0.5) / n - j) * size)
                           for a in range(n) for b in range(n)) / n**2
                place = ((i + 0.5) * size, (0.5 - j) * size)
                self.rows.append((place, (0, 0), mean, mean, size**2))

    @staticmethod
    def mean_stress(x, y):
        angle = atan2(-y, x - 1) - pi / 4
        return -1 - 2 * min(max(angle, 0), pi / 2)

    def points(self, *_):
        return self.rows


# What no method can be below: the stress jumps at the edge.
for title, beside in (("", None), (" beyond 3 h of the edge", (1, 0))):
    for name, values in alternating(Prandtl(0.125), 0.125,
                                    beside=beside).items():
        if name != "smoothed":
            number(f"bearing, exact: mean stress of {name}{title}, the largest of "
                   "what alternates over the range", values[3], 2)

# Domains that reach over faces of cells in a uniform strain: their parts in cells
# are found by where those faces cross them.
scene = scene_file("stretched.prm", """
Mesh/Lower corner = 0, 0 | Upper corner = 6, 3 | Cell size = 0.25
Method/Strain = finite
Materials/rubber/Young modulus = 100 | Poisson ratio = 0.49
Bodies/sheet/Lower corner = 0, 0 | Upper corner = 4, 2
Grid conditions/left/Side = left | Components = x
Grid conditions/bottom/Side = bottom | Components = y
Boundaries/right/Body = sheet | Part = right | Constraint = roller
Boundaries/right/Translation = 0.04*t; 0
Time/Steps = 8
""")
mean = {}
for method in "GIMP", "CPDI1", "CPDI2":
    stresses = run(scene, {"Method/Method": method}, on_ranks=1).points("stress")
    mean[method] = [(s[0] + s[4] + s[8]) / 3 for (s,) in stresses]
exact = mean["GIMP"][0]
for method in "GIMP", "CPDI1", "CPDI2":
    bound(f"stretched sheet, {method}: mean stress, largest deviation",
          max(abs(m / exact - 1) for m in mean[method]), 1e-6)
