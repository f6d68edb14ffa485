# ranks: 2  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Two bodies in one mesh, one 1e9 times as stiff as the other: all linear
solvers find the same forces on each of them, side by side and one on the other,
and auto the same as each alone."""

SIDE_BY_SIDE = (("0, 0.03", "1, 2.03"), ("1, 0.03", "2, 2.03"))
STACKED = (("0, 0.03", "2, 1"), ("0, 1", "2, 2.03"))


def scene(bodies, method, enforcement):
    return scene_file("contrast.prm", f"""
Dimension = 2
Mesh/Lower corner = -0.25, -0.25 | Upper corner = 2.25, 2.25 | Cells = 60, 60
Method/Method = {method}
Materials/stiff/Young modulus = 1e9 | Poisson ratio = 0.3
Materials/soft/Young modulus = 1 | Poisson ratio = 0.3
Boundaries/base/Points = -1 0.03; 3 0.03 | Constraint = fixed
Boundaries/base/Enforcement = {enforcement}
Boundaries/top/Points = 3 2.03; -1 2.03 | Constraint = fixed
Boundaries/top/Translation = 0.01*t; -0.02*t | Enforcement = {enforcement}
Time/Steps = 1
Probes/inside/Location = 1.4, 1.4 | Kind = nearest point
Probes/inside/Quantities = displacement, stress
""", *(f"Bodies/{name}/Shape = box | Lower corner = {lower} | Upper corner = {upper}"
       f" | Material = {name}"
       for name, (lower, upper) in zip(("stiff", "soft"), bodies)))


def worst(found, exact):
    """Over the forces of each side, and over displacement and stress."""
    groups = [(found.reactions[side], exact.reactions[side])
              for side in exact.reactions]
    for kind in ("u_", "sigma"):
        names = [name for name in exact.probes if name.startswith(kind)]
        groups.append(([found.probes[name] for name in names],
                       [exact.probes[name] for name in names]))
    return max(max(abs(a - b) for a, b in zip(one, other))
               / max(map(abs, other)) for one, other in groups)


for name, bodies in (("side by side", SIDE_BY_SIDE), ("stacked", STACKED)):
    for method, enforcement in (("material point", "skew Nitsche"),
                                ("GIMP", "symmetric Nitsche")):
        file = scene(bodies, method, enforcement)
        quiet = {"Output/Points": "false", "Output/Mesh": "false"}
        exact = run(file, {**quiet, "Solver/Solver": "direct"})
        text(f"{name}, {method}", exact.summary["status"])
        for solver in ("amg-cg", "gmres", "auto"):
            if enforcement == "skew Nitsche" and solver == "amg-cg":
                continue
            found = run(file, {**quiet, "Solver/Solver": solver,
                               "Solver/Direct limit 2D": 0})
            bound(f"  {solver} against direct", worst(found, exact), 1e-6)
