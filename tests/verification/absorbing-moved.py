# ranks: 2  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A base that was placed by its motion and then absorbs does so where it stands:
a block at rest under gravity stays at rest, whatever has brought its base there,
also when the run goes on from the middle of it."""

scene = scene_file("base.prm", """
Mesh/Lower corner = -0.5, -0.5 | Upper corner = 5, 3.5 | Cell size = 0.25
Method/Method = GIMP
Materials/soil/Young modulus = 10000 | Poisson ratio = 0.3 | Density = 2
Bodies/block/Lower corner = 0, 0.1 | Upper corner = 4, 2.1 | Rotation angle = 12
Bodies/block/Translation = 0, 0.2
Boundaries/base/Points = 0 0.1; 4 0.1 | Rotation angle = 12 | Translation = 0; 0.2
Loads/weight/Type = gravity | Value = 0; -10
Stages/rest/Time/Steps = 2
Stages/absorbing/Time/Integrator = Newmark | End time = 1.5 | Steps = 20
Stages/absorbing/Absorbing = base
Output/Write = end
Probes/top/Location = 2.5, 2.3 | Kind = interpolated
""")


def drift(name, result):
    """Of the settlement and the reaction since the block came to rest."""
    rows = result.history()
    rest, last = rows[1], rows[-1]
    bound(f"{name}: drift", last["u_y at top"] / rest["u_y at top"] - 1, 0.01)
    bound("  reaction", last["reaction_y of base"] / 160 - 1, 0.01)


drawn = {"Boundaries/base/Rotation angle": "", "Boundaries/base/Translation": "",
         "Boundaries/base/Points": "-0.0207911690817759 0.2978147600733806; "
                                   "3.8917992331534 1.1294615231018"}
# Elements take their base along, points leave it to where it then stands.
moving = {"Boundaries/base/Rotation angle": "12 + 0.02*min(t, 1)",
          "Boundaries/base/Translation": "0; 0.2 - 0.05*min(t, 1)"}
for name, settings in (("drawn", drawn), ("placed", {}), ("moved", moving)):
    drift(name, run(scene, settings))
    drift(f"{name}, elements",
          run(scene, {**settings, "Method/Method": "finite element"}))

# Where cells count as filled by what the base holds they do so as it absorbs: else
# the block would drift by 1.6 %.
for method in ("GIMP", "CPDI1"):
    rows = run(scene, {"Method/Method": method, "Method/Strain": "finite",
                       "Materials/soil/Young modulus": 1000,
                       "Mesh/Lower corner": "-0.5, -0.05",
                       "Mesh/Upper corner": "5, 3.95"}).history()
    bound(f"finite strain, {method}: drift",
          rows[-1]["u_y at top"] / rows[1]["u_y at top"] - 1, 1e-4)

# Resumed before and after the base begins to absorb.
def kept(steps, end):
    return {**moving, "Output/Checkpoint every": "1 step",
            "Stages/absorbing/Time/Steps": steps,
            "Stages/absorbing/Time/End time": end}


def history(result):
    return (result.folder / "history.csv").read_bytes()


whole = run(scene, kept(8, 1.5), on_ranks=1)
for step in (2, 3):
    halted = run(scene, kept(1, 1.0625), on_ranks=1)
    run(halted.folder, {"Stages/absorbing/Time/Steps": 8,
                        "Stages/absorbing/Time/End time": 1.5},
        command="resume", extra=("--from", step), on_ranks=1)
    text(f"resumed after step {step}",
         "the same bits" if history(halted) == history(whole) else "NO")

# Small strain has found equilibrium before points moved: a soft column on a side of
# the mesh, 20 m high, that has settled by 0.12 m. Forces of where it was then would
# lift it by 0.07 m in this time, and on for ever.
COLUMN = root / "prm/dynamics/gravity-then-wave.prm"
AT_REST = {"Method/Mesh after step": "default", "Stages/pulse/Loads": "weight",
           "Stages/pulse/Time/End time": 5, "Stages/pulse/Time/Steps": 80,
           "Probes/top/Location": "0.5, 20", "Probes/top/Kind": "interpolated"}


def rises(name, scene, method):
    rows = run(scene, {**AT_REST, "Method/Method": method}).history()
    bound(f"soft column on a {name}, {method}: rises, over its settlement",
          rows[-1]["u_y at top"] / rows[0]["u_y at top"], 0.02)


for method in ("finite element", "GIMP", "CPDI1"):
    rises("side", COLUMN, method)
surface = folder / "surface.prm"
surface.write_text(COLUMN.read_text().replace("""  subsection base
    set Side = bottom
  end
end
""", """end

subsection Boundaries
  subsection base
    set Points      = 0 0; 1 0
    set Enforcement = augmented Lagrangian
  end
end
""").replace("set Lower corner = 0, 0\n  set Upper corner = 1, 20\n  set Cell",
             "set Lower corner = 0, -1.3\n  set Upper corner = 1, 20.7\n  set Cell"))
for method in ("finite element", "GIMP"):
    rises("surface", surface, method)
