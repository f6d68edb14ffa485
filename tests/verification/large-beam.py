# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A cantilever bent to a quarter turn: all 50 steps, near to finite elements."""

SCENE = "prm/large-deformation/beam-gimp.prm"


def tip(result):
    """(v, u) / l of the straight end."""
    first, second = ([result.probes[f"u_{c} at {place}"] for c in "yx"]
                     for place in ("first", "second"))
    return [-(2 * b - a) / 10 for a, b in zip(first, second)]


def beam(**settings):
    keys = {"h": "Mesh/Cell size", "n": "Method/Points per direction",
            "method": "Method/Method", "degree": "Method/Degree",
            "empty": "Method/Fictitious stiffness", "load": "Loads/end/Type"}
    return run(SCENE, {"Output/Points": "false", "Output/Mesh": "false",
                       **{keys[k]: v for k, v in settings.items()}})


FE = dict(method="finite element", degree=2, empty=0)
coarse, v_u = (tip(beam(h=h, **FE)) for h in (0.5, 0.25))
number("FE Q2, h = 0.25: v / l", v_u[0], 4)
number("FE Q2, h = 0.25: u / l", v_u[1], 4)
for name, a, b in zip("vu", coarse, v_u):
    bound(f"FE Q2: {name} at h = 0.5 over 0.25 - 1", a / b - 1, 1e-3)

# Beam theory with extension and shear, and the end of AMPLE's published curve
# (6x6 points); the elastica alone is 0.8062, 0.5461.
for name, found, theory, ample in zip("vu", v_u, (0.8175, 0.5480),
                                      (0.825, 0.555)):
    bound(f"FE Q2, h = 0.25: {name} against beam theory - 1",
          found / theory - 1, 0.015)
    bound(f"FE Q2, h = 0.25: {name} against AMPLE - 1", found / ample - 1,
          0.005)

# Limits on v and u against FE Q2.
for title, settings, limits in (
        ("GIMP 2x2, h = 0.5", dict(h=0.5, n=2), (0.01, 0.04)),
        ("GIMP 3x3, h = 0.5", dict(h=0.5, n=3), (0.005, 0.005)),
        ("GIMP 6x6, h = 0.5", dict(h=0.5, n=6), (0.02, 0.02)),
        ("GIMP 2x2, h = 0.25", dict(h=0.25, n=2), (0.005, 0.025)),
        ("GIMP 2x2, h = 0.125, force on points",
         dict(h=0.125, n=2, load="force on points"), (0.005, 0.02)),
        ("CPDI1 2x2, h = 0.5", dict(h=0.5, n=2, method="CPDI1"), (0.02, 0.02)),
        ("CPDI2 2x2, h = 0.5", dict(h=0.5, n=2, method="CPDI2"), (0.02, 0.02))):
    result = beam(**settings)
    text(f"{title}: steps, rejected", (result.summary["steps"],
                                       result.summary["rejected_steps"]))
    for name, found, exact, limit in zip("vu", tip(result), v_u, limits):
        number(f"{title}: {name} / l", found, 3)
        bound(f"{title}: {name} against FE Q2 - 1", found / exact - 1, limit)
    if "6x6" in title:
        for name, found, ample in zip("vu", tip(result), (0.825, 0.555)):
            bound(f"{title}: {name} against AMPLE - 1", found / ample - 1, 0.015)
    bound(f"{title}: force at the pin over load - 1",
          result.reactions["pin"][1] / 100e3 - 1, 1e-8)
