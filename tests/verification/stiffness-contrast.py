# ranks: 2  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Two bodies in one mesh, one 1e9 times as stiff as the other: all linear
solvers find the same forces on each of them, side by side and one on the other,
and auto the same as each alone."""

SIDE_BY_SIDE = (("0, 0.03", "1, 2.03"), ("1, 0.03", "2, 2.03"))
STACKED = (("0, 0.03", "2, 1"), ("0, 1", "2, 2.03"))


def scene(bodies, method, enforcement):
    text = f"""
set Dimension = 2
subsection Mesh
  set Lower corner = -0.25, -0.25
  set Upper corner = 2.25, 2.25
  set Cells = 60, 60
end
subsection Method
  set Method = {method}
end
subsection Materials
  subsection stiff
    set Young modulus = 1e9
    set Poisson ratio = 0.3
  end
  subsection soft
    set Young modulus = 1
    set Poisson ratio = 0.3
  end
end
subsection Boundaries
  subsection base
    set Points = -1 0.03; 3 0.03
    set Constraint = fixed
    set Enforcement = {enforcement}
  end
  subsection top
    set Points = 3 2.03; -1 2.03
    set Constraint = fixed
    set Translation = 0.01*t; -0.02*t
    set Enforcement = {enforcement}
  end
end
subsection Time
  set Steps = 1
end
subsection Probes
  subsection inside
    set Location = 1.4, 1.4
    set Kind = nearest point
    set Quantities = displacement, stress
  end
end
subsection Bodies
"""
    for name, (lower, upper) in zip(("stiff", "soft"), bodies):
        text += prm(f"""
{name}/Shape = box | Lower corner = {lower} | Upper corner = {upper}
{name}/Material = {name}
""")
    file = folder / "contrast.prm"
    file.write_text(text + "end\n")
    return file


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
