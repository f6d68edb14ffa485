# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""What a Poisson ratio near 0.5 costs with cell means: Newton iterations with the
direct solver, iterations of multigrid, which 'auto' gives up in time, and of the
Schwarz method, which notices much less."""

QUIET = {"Output/Points": "false", "Output/Mesh": "false",
         "Method/Volumetric strain": "cell mean"}
SCENES = {
    "Cook's membrane, GIMP": ("prm/hard-cases/cook-gimp.prm", "panel",
                              {"Mesh/Cell size": 0.375}),
    "block in 3D, FE": ("prm/hard-cases/punch.prm", "block",
                        {"Materials/block/Shear yield stress": 1e9,
                         "Time/Steps": 1})}
# Of more unknowns than a subdomain has.
FINER = {"block in 3D, FE": {"Mesh/Cell size": "1/6"}}


def summary(scene, material, settings, nu):
    return run(scene, {**QUIET, **settings,
                       f"Materials/{material}/Poisson ratio": nu}).summary


for title, (scene, material, settings) in SCENES.items():
    few, more = (summary(scene, material,
                         {**settings, "Solver/Solver": "amg-cg"},
                         nu)["linear_iterations"] for nu in (0.3, 0.49))
    bound(f"{title}: iterations of amg-cg at 0.49 over those at 0.3",
          more / few, 6)
    few, more = (summary(scene, material,
                         {**settings, **FINER.get(title, {}),
                          "Solver/Solver": "schwarz"},
                         nu)["linear_iterations"] for nu in (0.3, 0.4999))
    bound(f"{title}: iterations of schwarz at 0.4999 over those at 0.3",
          more / few, 2)
    found = summary(scene, material,
                    {**settings, "Solver/Solver": "auto",
                     "Solver/Direct limit 2D": 0, "Solver/Direct limit 3D": 0},
                    0.4999)
    text(f"{title}, 0.4999: auto ends with",
         found["linear_solvers"][-1].split()[0])
    bound(f"{title}, 0.4999: iterations of amg-cg before",
          found["linear_iterations"], 500)

FINITE = {"Method/Strain": "finite", "Method/Mesh after step": "default",
          "Time/Steps": 24, "Loads/shear/Curve": "t", "Mesh/Refinements": 4}
for title, scene, material, settings in (
        ("Cook's membrane, finite strain", "prm/hard-cases/cook-fe.prm",
         "panel", FINITE),
        ("bearing, FE", "prm/hard-cases/bearing-fe.prm", "soil", {})):
    few, more = (summary(scene, material, {
        **settings, **({"Materials/panel/Young modulus": 160.3876 * (1 + nu)}
                       if material == "panel" else {})},
        nu)["newton_iterations"] for nu in (0.3, 0.4999))
    bound(f"{title}, direct: Newton iterations at 0.4999 over those at 0.3",
          more / few, 2)
