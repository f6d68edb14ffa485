# debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A vertical cut whose weight grows beyond its limit load slides into another shape
where points move, and the run ends as if it had stood: it says so, at the limit that
points which stay end at. What is elastic, or stands, does not."""

CUT = """
subsection Mesh
  set Lower corner = 0, 0
  set Upper corner = 16, 9
  set Cell size    = 1
end
subsection Materials
  subsection clay
    set Model              = von Mises
    set Young modulus      = 10000
    set Poisson ratio      = 0.3
    set Shear yield stress = 10
    set Density            = 1
  end
end
subsection Bodies
  subsection cut
    set Shape    = polygon
    set Vertices = 0 0; 16 0; 16 4; 8 4; 8 8; 0 8
  end
end
subsection Grid conditions
  subsection left
    set Side       = left
    set Components = x
  end
  subsection right
    set Side       = right
    set Components = x
  end
  subsection base
    set Side = bottom
  end
end
subsection Loads
  subsection weight
    set Type  = gravity
    set Value = 0; -10*t/4
  end
end
subsection Time
  set End time = 4.8
  set Steps    = 12
end
subsection Output
  set Points = false
  set Mesh   = false
end
"""
scene = folder / "cut.prm"
scene.write_text(CUT)


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
