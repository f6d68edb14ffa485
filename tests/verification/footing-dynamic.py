# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A footing on softening clay under repeated load, beside boundaries that reflect
or absorb waves, on cells of 0.25 m: when reflections come,
how far stresses are from those of a mesh from whose ends nothing returns, and how
deep the clay yields."""

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
COARSE = {"Mesh/Cell size": 0.25, "Output/Mesh": "false"}

# More ground of the same stiffness below and beside, 16 m deep and 10 m wide, for
# as long as nothing returns from there.
LARGE = {"Stages/waves/Time/End time": 0.56, "Stages/waves/Time/Steps": 62,
         "Mesh/Lower corner": "0, -16", "Mesh/Upper corner": "10, 0.25",
         "Bodies/ground/Material": "clay", "Output/Points": "false",
         "Bodies/outside/Shape": "polygon",
         "Bodies/outside/Vertices": "3 0; 3 -4; 0 -4; 0 -16; 10 -16; 10 0",
         "Bodies/outside/Initial stress": "geostatic",
         "Bodies/outside/Material": "rest",
         "Materials/rest/Young modulus": 2000,
         "Materials/rest/Poisson ratio": 0.41, "Materials/rest/Density": 1}


def sigma(row):
    return row["sigma_yy at one"]


def deviatoric(row):
    x, y, z, s = (row[f"sigma_{c} at two"] for c in ("xx", "yy", "zz", "xy"))
    return sqrt(((x - y) ** 2 + (y - z) ** 2 + (z - x) ** 2) / 2 + 3 * s * s)


def depth_of_yield(result, level=1e-3):
    """To which the largest plastic strain of a row of points is above the level,
    from where it is largest down."""
    largest = {}
    for (_, y, _), (_, u, _), kappa in result.points("position", "displacement",
                                                     "plastic_strain"):
        row = round((u - y) / 0.125 - 0.5)
        largest[row] = max(largest.get(row, 0), kappa)
    row = max(largest, key=largest.get)
    while largest[row + 1] > level:
        row += 1
    above, below = largest[row], largest[row + 1]
    return 0.125 * (row + 0.5 + (above - level) / (above - below))


results = {name: run(scene, COARSE) for name, scene in SCENES.items()}
rows = {name: result.history()[2:] for name, result in results.items()}
large = {method: run(SCENES[f"fixed, {method}"],
                     {**COARSE, **LARGE}).history()[2:]
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

depths = {name: depth_of_yield(result) for name, result in results.items()}
for name in SCENES:
    second = [row for row in rows[name] if row["t"] > 0.675]
    number(f"{name}: largest deviatoric stress at two, second load",
           max(map(deviatoric, second)), 3)
    number(f"{name}: largest pressure at one, second load",
           -min(map(sigma, second)), 3)
    number(f"{name}: plastic strain above 1e-3 down to", depths[name], 3)

# What the paper says of fixed boundaries: more deviatoric stress, and bands that
# are less deep.
for method in ("DM-GC", "GIMP"):
    for kind in ("viscous", "viscoelastic"):
        at_least(f"{method}: deviatoric stress, fixed over {kind}",
                 max(map(deviatoric, rows[f"fixed, {method}"]))
                 / max(map(deviatoric, rows[f"{kind}, {method}"])), 1.02)
        # Where little yields, depths are those of waves, not of a band.
        at_least(f"{method}: depth of the band, {kind} over fixed",
                 depth_of_yield(results[f"{kind}, {method}"], 5e-3)
                 / depth_of_yield(results[f"fixed, {method}"], 5e-3), 1.05)
