# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A footing on softening clay under repeated load, beside boundaries that reflect
or absorb waves, on cells of 0.25 m with steps of 0.01 s: when reflections come,
and how far stresses are from those of a mesh from whose ends nothing returns."""

from math import hypot, sqrt

SCENES = {
    "fixed, DM-GC": "prm/phuong-2023/footing-fixed-dmgc.prm",
    "viscous, DM-GC": "prm/phuong-2023/footing-viscous-dmgc.prm",
    "viscoelastic, DM-GC": "prm/phuong-2023/footing-viscoelastic-dmgc.prm",
    "fixed, GIMP": "prm/phuong-2023/footing-fixed-gimp.prm",
    "viscous, GIMP": "prm/phuong-2023/footing-viscous-gimp.prm",
    "viscoelastic, GIMP": "prm/phuong-2023/footing-viscoelastic-gimp.prm"}
C_P = sqrt(2000 * 0.59 / 1.41 / 0.18)
BEGIN = 0.275  # of the load
COARSE = {"Mesh/Cell size": 0.25, "Output/Points": "false",
          "Output/Mesh": "false"}

# More ground of the same stiffness below and beside, 16 m deep and 10 m wide.
LARGE = {"Mesh/Lower corner": "0, -16", "Mesh/Upper corner": "10, 0.25",
         "Bodies/ground/Material": "clay",
         "Bodies/outside/Shape": "polygon",
         "Bodies/outside/Vertices": "3 0; 3 -4; 0 -4; 0 -16; 10 -16; 10 0",
         "Bodies/outside/Initial stress": "geostatic",
         "Bodies/outside/Material": "rest",
         "Materials/rest/Young modulus": 2000,
         "Materials/rest/Poisson ratio": 0.41, "Materials/rest/Density": 1}


def shake(scene, end, settings):
    steps = round((end - 0.25) / 0.01)
    result = run(scene, {**COARSE, "Stages/waves/Time/End time": end,
                         "Stages/waves/Time/Steps": steps, **settings})
    return result.history()[2:]


def sigma(row):
    return row["sigma_yy at one"]


def deviatoric(row):
    x, y, z, s = (row[f"sigma_{c} at two"] for c in ("xx", "yy", "zz", "xy"))
    return sqrt(((x - y) ** 2 + (y - z) ** 2 + (z - x) ** 2) / 2 + 3 * s * s)


rows = {name: shake(scene, 0.7, {}) for name, scene in SCENES.items()}
large = {method: shake(SCENES[f"fixed, {method}"], 0.56, LARGE)
         for method in ("DM-GC", "GIMP")}
first = [row["t"] for row in large["DM-GC"]]


def differences(kind, method, value, scale):
    there = large[method]
    return [abs(value(a) - value(b)) / scale
            for a, b in zip(rows[f"{kind}, {method}"], there)]


# Along the surface from the edge of the footing to the side and to the point at
# a depth of 1 m, and from the footing down and up.
side = BEGIN + hypot(2.5 + 3, 1) / C_P
base = BEGIN + (4 + 3) / C_P
number("first reflection of the side at one", side, 3)
number("first reflection of the base at one", base, 3)
for method, there in large.items():
    of_load = max(abs(sigma(row) - sigma(there[0])) for row in there)
    peak = max(map(deviatoric, there))
    differs = differences("fixed", method, sigma, of_load)
    bound(f"fixed, {method}: stress at one before the first reflection, over "
          "the load's",
          max(d for t, d in zip(first, differs) if t < side - 0.005), 5e-3)
    number(f"fixed, {method}: at one it differs by 2 % from t =",
           next(t for t, d in zip(first, differs) if d > 0.02), 2)
    text(f"fixed, {method}: stress at one within 3 %",
         "yes" if max(differs) < 0.03 else "no")
    for kind in ("fixed", "viscous", "viscoelastic"):
        for point, value, scale in (
                ("vertical stress at one", sigma, of_load),
                ("deviatoric stress at two", deviatoric, peak)):
            found = max(differences(kind, method, value, scale))
            number(f"{kind}, {method}: {point}, largest difference", found, 2)
            if kind != "fixed":
                bound(f"{kind}, {method}: {point}", found, 0.03)
    # Dashpots give way to what is static, springs of the right radius do not.
    for kind in ("viscous", "viscoelastic"):
        found = max(differences(kind, method, lambda row: row["u_y at one"],
                                max(abs(row["u_y at one"]) for row in there)))
        number(f"{kind}, {method}: settlement of one, largest difference",
               found, 2)
        if kind == "viscoelastic":
            bound(f"{kind}, {method}: settlement of one", found, 0.05)

for name in SCENES:
    second = [row for row in rows[name] if row["t"] > 0.55]
    number(f"{name}: largest deviatoric stress at two, second load",
           max(map(deviatoric, second)), 3)
    number(f"{name}: largest pressure at one, second load",
           -min(map(sigma, second)), 3)
