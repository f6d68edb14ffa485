# debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A block comes to rest under its weight: the reaction of its base is the weight
by every integrator, and a base that absorbs from then on holds it. One integrator
without and one with parts of steps are on all ranks."""

SCENE = """
subsection Mesh
  set Lower corner = 20, 50
  set Upper corner = 22, 54
  set Cell size = 0.5
end
subsection Method
  set Method = {method}
end
subsection Materials
  subsection soil
    set Young modulus = 50000
    set Poisson ratio = 0.3
    set Density = 2
  end
end
subsection Bodies
  subsection block
    set Lower corner = 20, 50
    set Upper corner = 22, 53.5
    set Mass damping = 60
  end
end
{base}
subsection Loads
  subsection weight
    set Type = gravity
    set Value = 0; -9.81
    set Curve = 0: 0, 0.2: 1
  end
end
subsection Stages
  subsection settle
    {time} set Steps = 100
    end
  end
  subsection rest
    set Absorbing = base
    set Reset displacements = true
    {time} set Steps = 50
    set End time = 1.5
    end
  end
end
subsection Probes
  subsection top
    set Location = 21, 53.5
    set Kind = interpolated
    set Quantities = displacement, velocity
  end
end
"""
WEIGHT = 2 * 3.5 * 2 * 9.81
BASES = {"nodes": "subsection Grid conditions\n subsection base\n"
                  "  set Side = bottom\n end\nend",
         "surface": "subsection Boundaries\n subsection base\n"
                    "  set Body = block\n  set Part = bottom\n"
                    "  set Enforcement = augmented Lagrangian\n end\nend"}

for integrator, radius in (("Newmark", None), ("generalised-alpha", 0.8), ("generalised-alpha", 0),
                           ("Bathe", 0.8), ("energy-momentum", None)):
    for method, base in (("finite element", "nodes"), ("GIMP", "nodes"),
                         ("finite element", "surface"), ("GIMP", "surface")):
        time = f"subsection Time\n set Integrator = {integrator}\n"
        if radius is not None:
            time += f" set Spectral radius = {radius}\n"
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
