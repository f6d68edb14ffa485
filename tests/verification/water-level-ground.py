# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Level ground 10 m deep: 16 kN/m3 above a water table, 20 kN/m3 below it, water of 10
kN/m3. Effective stress, pore pressure and total stress at a point are exact, by
gravity and from a geostatic start, which stays where it is."""

GROUND = """
Dimension = 2
Mesh/Lower corner = 0, 0 | Upper corner = 4, 10 | Cell size = 1
Method/Method = finite element | Mesh after step = keep
Materials/soil/Young modulus = 30e3 | Poisson ratio = 0.25 | Density = 1.6 | Saturated density = 2
Bodies/ground/Lower corner = 0, 0 | Upper corner = 4, 10
Grid conditions/left/Side = left | Components = x
Grid conditions/right/Side = right | Components = x
Grid conditions/base/Side = bottom
Loads/weight/Type = gravity | Value = 0; -10
Water/Level = 6 | Unit weight = 10
Time/Steps = 2
Probes/deep/Location = 2.2, 2.2 | Quantities = position, stress, pore pressure, total stress
Probes/above/Location = 2.2, 8.2 | Quantities = position, stress, pore pressure, total stress
"""
SCENE = scene_file("ground.prm", GROUND)
GEOSTATIC = {"Bodies/ground/Initial stress": "geostatic"}


def exact(level, y, surface=10):
    """Total vertical stress and pore pressure, compression positive; soil without
    water above it, with it below."""
    wet = max(0, min(level, surface) - y)
    free = 10 * max(0, level - surface)
    return (20 * wet + 16 * (surface - y - wet) + free, 10 * max(0, level - y))


def check(name, result, level, of_cell=False):
    """Cells of degree 1 have the stress of their middle by gravity."""
    for place in ("deep", "above"):
        values = {key.removesuffix(" at " + place): value for key, value in
                  result.probes.items() if key.endswith(place)}
        pore = exact(level, values["y"])[1]
        if of_cell:
            whole, in_middle = exact(level, int(values["y"]) + 0.5)
            total = whole - in_middle + pore
        else:
            total = exact(level, values["y"])[0]
        for key, value in (("sigma_yy", pore - total), ("pore_pressure", pore),
                           ("total_sigma_yy", -total), ("sigma_xx", (pore - total) / 3)):
            bound(f"{name}, {place}, {key}", values[key] / value - 1 if value else
                  values[key], 1e-10)


def imbalance(result):
    if "initial-imbalance" not in result.ids():
        return "in equilibrium"
    return f"{100 * result.finding('initial-imbalance')['value']:.2g} %"


METHODS = {
    "FE": {},
    "FE Q2": {"Method/Degree": 2},
    "FE, finite strain": {"Method/Strain": "finite",
                          "Method/Mesh after step": "follow material"},
    "MPM": {"Method/Method": "material point"},
    "GIMP": {"Method/Method": "GIMP"},
    "GIMP, finite strain": {"Method/Method": "GIMP", "Method/Strain": "finite",
                            "Method/Mesh after step": "reset"},
    "CPDI1": {"Method/Method": "CPDI1"},
}
for name, settings in METHODS.items():
    if "finite" not in name:
        check(f"{name}, by gravity", run(SCENE, {**settings, **QUIET}), 6, name != "FE Q2")
    result = run(SCENE, {**settings, **GEOSTATIC, **QUIET})
    text(f"{name}, geostatic", imbalance(result))
    check(f"{name}, geostatic", result, 6)
    bound(f"{name}, displacement", result.summary["largest_displacement"], 1e-13)

# Under 3 m of free water, given as one level and as two; a level between points.
for name, settings in (("FE", {}), ("GIMP", METHODS["GIMP"])):
    for water in ({"Water/Level": 13}, {"Water/Level": 13, "Water/Free level": 13}):
        result = run(SCENE, {**settings, **water, **GEOSTATIC, **QUIET})
        text(f"{name}, under water", imbalance(result))
        check(f"{name}, under water", result, 13)
        bound(f"{name}, displacement", result.summary["largest_displacement"], 1e-13)
        bound("reaction of the base less buoyant weight",
              result.reactions["base"][1] / (4 * 10 * 10) - 1, 1e-12)

# An expression of the pressure says the same, and suction is kept where it is told to.
result = run(SCENE, {"Water/Level": "", "Water/Pressure": "10*(6 - y)"})
check("pressure", result, 6, True)
result = run(SCENE, {"Water/Suction": "kept", "Materials/soil/Saturated density": ""})
y = result.probes["y at above"]
bound("suction", result.probes["pore_pressure at above"] / (10 * (6 - y)) - 1, 1e-12)
bound("stress with suction",
      result.probes["sigma_yy at above"] / (-16 * (10 - 8.5) + 10 * (6 - 8.5)) - 1, 1e-10)

# In stages: dry, then water, which leaves again; and a level that rises with time.
STAGES = """
Stages/dry/Time/Steps = 1
Stages/wet/Time/End time = 2 | Steps = 1
Stages/wet/Water/Level = 6
Stages/dry again/Time/End time = 3 | Steps = 1
Stages/dry again/Water/Level = none
"""
staged = scene_file("staged.prm", GROUND.replace("Water/Level = 6 | Unit", "Water/Unit")
                    .replace("Time/Steps = 2\n", ""), STAGES)
rows = run(staged).history()
for row, level in zip(rows, (0, 6, 0)):
    total, pore = exact(level, 2.5)
    bound(f"stage {row['t']:g}", row["sigma_yy at deep"] / (pore - total) - 1, 1e-10)
rows = run(SCENE, {"Water/Level": "3*t", "Time/End time": 2}).history()
for row in rows:
    total, pore = exact(3 * row["t"], 2.5)
    bound(f"rising, t = {row['t']:g}", row["sigma_yy at deep"] / (pore - total) - 1,
          1e-10)
bound("force of water", rows[-1]["force_y of water"] / (4 * 6 * 10) - 1, 1e-12)
