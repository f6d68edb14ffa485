# ranks: 2  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A vertical cut whose weight grows beyond its limit load slides into another shape
where points move, and the run ends as if it had stood: it says so, at the limit that
points which stay end at. What is elastic, or stands, does not."""

scene = scene_file("cut.prm", """
Mesh/Lower corner = 0, 0 | Upper corner = 16, 9 | Cell size = 1
Materials/clay/Model = von Mises | Young modulus = 10000 | Poisson ratio = 0.3
Materials/clay/Shear yield stress = 10 | Density = 1
Bodies/cut/Shape = polygon | Vertices = 0 0; 16 0; 16 4; 8 4; 8 8; 0 8
Grid conditions/left/Side = left | Components = x
Grid conditions/right/Side = right | Components = x
Grid conditions/base/Side = bottom
Loads/weight/Type = gravity | Value = 0; -10*t/4
Time/End time = 4.8 | Steps = 12
Output/Points = false | Mesh = false
""")


def show(title, settings, expect=0):
    result = run(scene, settings, expect=expect)
    slid = "slide" in result.ids()
    text(f"{title}: slides", slid)
    if slid:
        text(f"{title}: by t = 4 to 4.5", 4 <= result.finding("slide")["t"] <= 4.5)


for method in ("GIMP", "material point"):
    show(method, {"Method/Method": method, "Time/End time": 4.5})
# Few steps of a weight that goes on growing: it slides between two of them, and goes
# on faster than before.
show("few steps", {"Method/Method": "GIMP", "Method/Strain": "finite",
                   "Mesh/Cell size": 0.5, "Materials/clay/Poisson ratio": 0.45,
                   "Materials/clay/Shear yield stress": 20,
                   "Materials/clay/Density": 1.8, "Loads/weight/Value": "0; -10*t/3.6",
                   "Time/End time": 4.68, "Time/Steps": 13})
show("points stay", {"Method/Method": "GIMP", "Method/Mesh after step": "keep"}, 1)
show("half of the weight", {"Method/Method": "GIMP", "Time/End time": 2.4,
                            "Time/Steps": 6})
show("elastic", {"Method/Method": "GIMP", "Materials/clay/Model": "linear elastic",
                 "Materials/clay/Shear yield stress": "",
                 "Loads/weight/Value": "0; t < 4 ? -0.1*t : -10*t"})
