# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Walls that are pushed into soil or give way, by contact: earth pressure of Rankine on
sand; passive and active force of clay on smooth walls, where they hold the soil and
where they let it go."""

WALL = """
Dimension = 2
Method/Method = GIMP
Boundaries/wall/Points = 0 12; 0 -1 | Constraint = contact
Grid conditions/base/Side = bottom | Components = y
Grid conditions/right/Side = right | Components = x
Loads/weight/Type = gravity | Value = 0; -10
Time/Steps = 20
"""
SAND = "prm/geotechnics/retaining-wall.prm"
CLAY = scene_file("clay.prm", WALL + """
Mesh/Lower corner = -2, 0 | Upper corner = 30, 12 | Cell size = 1
Materials/clay/Model = Tresca | Shear strength = 20
Materials/clay/Young modulus = 2e4 | Poisson ratio = 0.49 | Density = 2
Bodies/fill/Lower corner = 0, 0 | Upper corner = 30, 10
Bodies/fill/Initial stress = geostatic | K0 = 1
""")


def force(scene, motion, method, **keys):
    """Per metre, at the end of the way."""
    result = run(scene, {"Boundaries/wall/Translation": f"{motion}*t; 0", **method, **{
        f"Boundaries/wall/{key}": value for key, value in keys.items()}, **QUIET})
    return result.history()[-1]["reaction_x of wall"]


def then_lets_go():
    """The same fill, held by a roller as its weight grows; then by contact."""
    scene = scene_file("later.prm", (root / SAND).read_text().replace(
        "subsection Time\n  set Steps = 20\nend\n", ""), """
Boundaries/held/Points = 0 6; 0 -1 | Constraint = roller
Stages/filled/Time/Steps = 4
Stages/filled/Boundaries = held
Stages/gives way/Time/End time = 2 | Steps = 20
Stages/gives way/Boundaries = wall
""")
    return run(scene, {"Boundaries/wall/Translation": "-0.02*(max(t, 1) - 1); 0",
                       "Bodies/fill/Initial stress": "", "Bodies/fill/K0": "",
                       "Loads/weight/Curve": "min(t, 1)", **QUIET}).history()


FINITE, SMALL = {}, {"Method/Strain": "small", "Method/Mesh after step": "keep"}
for name, found, exact in (
        ("sand, active", force(SAND, -0.02, FINITE), 20 * 5 ** 2 / 2 / 3),
        ("sand, passive", force(SAND, 0.3, SMALL), 20 * 5 ** 2 / 2 * 3),
        ("clay, passive", force(CLAY, 0.1, SMALL), 20 * 10 ** 2 / 2 + 2 * 20 * 10),
        ("clay, active, held", force(CLAY, -0.1, SMALL, Separation="false"),
         20 * 10 ** 2 / 2 - 2 * 20 * 10)):
    number(f"{name}: exact {exact:.6g} kN/m", found, 4)
    bound(f"{name}: error", found / exact - 1, 0.01)
rows = then_lets_go()
number("in a later stage: roller before", rows[3]["reaction_x of held"], 4)
number("contact, first step", rows[4]["reaction_x of wall"], 4)
bound("at the end: error", rows[-1]["reaction_x of wall"] / (250 / 3) - 1, 0.01)
# Bounds: a wall that pulls, and a crack that is dry down to 2 k/gamma.
found = force(CLAY, -0.1, SMALL)
number("clay, active, let go: 600 to 640 kN/m", found, 4)
at_least("clay, active, let go: force", found, 600)
at_least("clay, active, let go: 640 - force", 640 - found, 0)
