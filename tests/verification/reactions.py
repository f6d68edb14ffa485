# debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A block comes to rest under its weight: the reaction of its base is the weight
by every integrator, and a base that absorbs from then on holds it. One integrator
without and one with parts of steps are on all ranks."""

SCENE = prm("""
Mesh/Lower corner = 20, 50 | Upper corner = 22, 54 | Cell size = 0.5
Method/Method = {method}
Materials/soil/Young modulus = 50000 | Poisson ratio = 0.3 | Density = 2
Bodies/block/Lower corner = 20, 50 | Upper corner = 22, 53.5 | Mass damping = 60
/
{base}
Loads/weight/Type = gravity | Value = 0; -9.81 | Curve = 0: 0, 0.2: 1
Stages/settle/Time/Steps = 100
{time}
Stages/rest/Absorbing = base | Reset displacements = true
Stages/rest/Time/Steps = 50 | End time = 1.5
{time}
Probes/top/Location = 21, 53.5 | Kind = interpolated
Probes/top/Quantities = displacement, velocity
""")
WEIGHT = 2 * 3.5 * 2 * 9.81
BASES = {"nodes": prm("Grid conditions/base/Side = bottom"),
         "surface": prm("Boundaries/base/Body = block | Part = bottom"
                        " | Enforcement = augmented Lagrangian")}

for integrator, radius in (("Newmark", None), ("generalised-alpha", 0.8), ("generalised-alpha", 0),
                           ("Bathe", 0.8), ("energy-momentum", None)):
    for method, base in (("finite element", "nodes"), ("GIMP", "nodes"),
                         ("finite element", "surface"), ("GIMP", "surface")):
        time = f"set Integrator = {integrator}"
        if radius is not None:
            time += f"\nset Spectral radius = {radius}"
        scene = folder / "scene.prm"
        scene.write_text(SCENE.format(method=method, base=BASES[base], time=time))
        rows = run(scene, {"Output/Write": "end"},
                   on_ranks=None if integrator in ("Newmark", "Bathe") else 1
                   ).history()
        name = f"{integrator} {'' if radius is None else radius}, {method}, {base}"
        last = [row for row in rows if row["t"] <= 1][-1]
        bound(f"{name}: reaction over weight - 1",
              last["reaction_y of base"] / WEIGHT - 1, 2e-4)
        bound(f"{name}: what moves once the base absorbs, over the settlement",
              max(abs(row["u_y at top"]) for row in rows if row["t"] > 1)
              / abs(last["u_y at top"]), 1e-3)
