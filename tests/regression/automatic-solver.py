# debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A nearly incompressible layer that cuts the cells of its mesh: multigrid
fails; auto notices at once, goes on directly, says so and finds what direct
finds."""
SETTINGS = {
    "Mesh/Cell size": 0.1,
    "Materials/elastic/Poisson ratio": 0.4999,
    "Time/End time": 0.03,
    "Time/Steps": 3,
    "Solver/Direct limit 2D": 0,
    "Output/Points": "false",
    "Output/Mesh": "false",
}

for strain, iterative in (("small", "gmres"), ("finite", "amg-cg")):
    settings = {**SETTINGS, "Method/Strain": strain, "Method/Method": "material point",
                "Mesh/Lower corner": "-0.33, -0.35", "Mesh/Upper corner": "3.27, 3.65"}
    exact = run("prm/cortis-2017/footing.prm",
                {**settings, "Solver/Solver": "direct"})
    found = run("prm/cortis-2017/footing.prm", settings)
    text(f"{strain} strain", found.summary["status"])
    for name, value in (*found.probes.items(),
                        ("reaction", found.reactions["footing"][1])):
        other = exact.probes.get(name, exact.reactions["footing"][1])
        bound(f"  {name}: auto over direct - 1", value / other - 1, 1e-7)
    choices = found.summary["linear_solvers"]
    change = "direct from linear system 1 on, 2048 unknowns: " \
        f"{iterative} did not converge in 25 iterations"
    text("  first", choices[0])
    text("  one change, to direct", choices[1:] == [change])
    text("  in the log", change in (found.folder / "log.txt").read_text())
    text("  linear iterations, all before it", found.summary["linear_iterations"])
