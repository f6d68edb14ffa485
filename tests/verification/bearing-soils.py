# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Strip footings on soil with and without weight beside exact limit loads, by GIMP
and by finite elements of degree 2 with reduced integration, both with default keys.
N_c and N_q: Prandtl (1921), Reissner (1924). N_gamma for phi = psi = 30 degrees: the
slip-line field after Martin (2005). Cells: 2/15 and 1/4 of the half width."""

from math import pi

SAND, CLAY = "prm/geotechnics/footing-sand.prm", "prm/geotechnics/footing-clay.prm"
DEGREE_2 = {"Method/Method": "finite element", "Method/Degree": 2,
            "Mesh/Cell size": 0.25, "Mesh/Upper corner": "6, 0"}
# Degree 2 is at its plateau (to 0.3 %) after a quarter of the way.
SHORT = {"Grid conditions/footing/Displacement": "0; -0.02 * t", "Time/Steps": 25}
METHODS = {"GIMP": {}, "FE Q2": DEGREE_2}
SMOOTH = {"Grid conditions/footing/Components": "y"}
WEIGHTLESS = {"Loads/weight/Type": "body force", "Loads/weight/Value": "0; 0",
              "Bodies/ground/K0": "", "Bodies/ground/Initial stress": ""}
COHESIVE = {**WEIGHTLESS, "Materials/sand/Cohesion": 10,
            "Materials/sand/Tensile strength": "none"}
# A surcharge of 1 kPa, as the stress and on the surface, under the footing too.
LOADED = {**WEIGHTLESS, "Bodies/ground/Initial stress": "-0.5; -1; -0.5; 0",
          "Loads/weight/Type": "surface traction",
          "Loads/weight/Points": "6 0; 0 0", "Loads/weight/Value": "0; -1",
          "Materials/sand/Young modulus": 5000}
TRESCA = {"Materials/clay/Young modulus": 5000,
          "Materials/clay/Shear strength": 10}


def pressed(scene, method, *settings):
    """The largest force of half the footing, and what the last quarter of the way
    adds to it."""
    asked = {key: value for group in settings for key, value in group.items()}
    rows = run(scene, {**METHODS[method], **asked, **QUIET}).history()
    forces = [-row["reaction_y of footing"] for row in rows]
    before = max(f for f, row in zip(forces, rows) if row["t"] <= 0.75 + 1e-9)
    return max(forces), max(forces) / before - 1


def against(name, method, footing, exact, allowed, unit=1, surcharge=0):
    force, rise = footing
    found = surcharge + force / unit
    number(f"{name}, exact {exact:.3f}: {method}", found, 3)
    bound(f"{name}: error of {method}", abs(found / exact - 1), allowed)
    if method == "GIMP":
        bound(f"{name}: rise in the last quarter of the way", rise, 0.01)


for method in METHODS:
    quadratic = method == "FE Q2"
    short = SHORT if quadratic else {}
    against("N_c, Tresca, smooth", method, pressed(CLAY, method, TRESCA), 2 + pi, 0.03,
            unit=10)
    against("N_c, phi = psi = 30, rough", method,
            pressed(SAND, method, COHESIVE, short), 30.140,
            0.04 if quadratic else 0.06, unit=10)

against("N_gamma, smooth", "FE Q2", pressed(SAND, "FE Q2", SMOOTH, SHORT), 7.653, 0.04,
        unit=18)
method = "GIMP"
against("N_q, rough", method, pressed(SAND, method, LOADED), 18.401, 0.06, surcharge=1)
against("N_gamma, rough", method, pressed(SAND, method), 14.754, 0.1, unit=18)
# Davis and Booker (1973): F is 1 for uniform strength and grows with rho B / s_u.
force, _ = pressed(CLAY, method)
factor = force / ((2 + pi) * 10 + 3 * 2 / 4)
at_least("clay that is stronger below: F", factor, 1)
bound("clay that is stronger below: F", factor, 1.25)
# Less dilation: no more than the associated value and no less than Davis'.
force, _ = pressed(SAND, method, COHESIVE, SHORT, {
    "Mesh/Cell size": 0.25, "Mesh/Upper corner": "6, 0",
    "Materials/sand/Dilation angle": 0, "Materials/sand/Tensile strength": 17})
number("phi = 30, psi = 0: N_c", force / 10, 3)
at_least("phi = 30, psi = 0: N_c", force / 10, 20)
bound("phi = 30, psi = 0: N_c", force / 10, 30.14)

# The study that compares cures, cut short.
rows = run("prm/studies/footing-sand.prm", {"Time/Steps": 1, "Time/End time": 0.01},
           command="study").study_rows()
text("cases of the study", f"{len(rows)} " +
     " ".join(sorted({row["status"] for row in rows})))
