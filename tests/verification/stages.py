# debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Gravity in a quasi-static stage, then a pulse; the base, fixed at first,
absorbs and holds the weight. Integrators are on one rank."""

IMPULSE, RHO_C = 75., 189.7367
SCENE = "prm/dynamics/gravity-then-wave.prm"


def compare(name, settings, scene=SCENE, length=20., balance=1e-10,
            rest=1e-7, on_ranks=None):
    result = run(scene, settings, on_ranks=on_ranks)
    weight = 15 * length
    rows = result.history()
    static = rows[0]
    bound(f"{name}: reaction of the first stage over the weight - 1",
          static["reaction_y of base"] / weight - 1, 1e-8)
    exact = -15 * (length ** 2 - 10 ** 2) / 2 / 24e3
    bound(f"{name}: settlement of the middle over the exact one - 1",
          static["u_y at middle"] / exact - 1, 0.01)
    # Long before the pulse arrives, at t = 1.16, nothing moves.
    quiet = [row for row in rows if 1 < row["t"] < 1.02]
    bound(f"{name}: reaction before the wave over the weight - 1",
          max(abs(row["reaction_y of base"] / weight - 1) for row in quiet), rest)
    bound(f"{name}: displacement at the end over impulse / (rho c) - 1",
          rows[-1]["u_y at middle"] / (-IMPULSE / RHO_C) - 1, 2e-3)
    bound(f"{name}: energy out of balance",
          result.summary["energy"]["balance_error"], balance)
    return rows


plain_rows = compare("finite element", {})
for integrator in ("generalised-alpha", "Bathe"):
    compare(integrator, {"Stages/pulse/Time/Integrator": integrator},
            balance=1e-6, on_ranks=1)  # it dissipates
compare("GIMP", {"Method/Method": "GIMP"})

# An implicit boundary that cuts cells.
text_of_scene = (root / SCENE).read_text()
on_side = """  subsection base
    set Side = bottom
  end
end
"""
assert on_side in text_of_scene
cut = folder / "cut.prm"
cut.write_text(text_of_scene.replace(on_side, """end

subsection Boundaries
  subsection base
    set Points = 0 0.4; 1 0.4
  end
end
""").replace("set Lower corner = 0, 0\n    set Upper corner = 1, 20",
             "set Lower corner = 0, 0.4\n    set Upper corner = 1, 20"))
# Nitsche's method puts forces on nodes that are no traction.
compare("cut cells, finite element", {}, cut, 19.6, rest=4e-3)
compare("cut cells, finite element, skew Nitsche",
        {"Boundaries/base/Enforcement": "skew Nitsche"}, cut, 19.6, rest=3e-3,
        on_ranks=1)
lagrangian = {"Boundaries/base/Enforcement": "augmented Lagrangian"}
compare("cut cells, augmented Lagrangian", lagrangian, cut, 19.6)
compare("cut cells, GIMP, augmented Lagrangian",
        {"Method/Method": "GIMP", **lagrangian}, cut, 19.6)

# Without a pulse the layer stays where it is, whatever held it.
quiet = {"Stages/pulse/Loads": "weight", "Stages/pulse/Time/Steps": 100}
for how, settings in (("weighted", {}), ("penalty", {}), ("skew Nitsche", {}),
                      ("symmetric Nitsche", {}),
                      ("skew Nitsche", {"Method/Method": "GIMP"}),
                      ("symmetric Nitsche", {"Method/Method": "CPDI1"})):
    settings = {**quiet, "Boundaries/base/Enforcement": how, **settings}
    name = f"no pulse, {how}, {settings.get('Method/Method', 'finite element')}"
    rows = run(cut, settings).history()
    bound(f"{name}: move of the last quarter over the settlement",
          (rows[-1]["u_y at middle"] - rows[-26]["u_y at middle"])
          / rows[0]["u_y at middle"], 1e-5)
    bound(f"{name}: largest displacement over the settlement",
          max(abs(row["u_y at middle"]) for row in rows[1:])
          / rows[0]["u_y at middle"], 2e-3)
    if how in ("weighted", "penalty"):
        for integrator in ("Newmark", "generalised-alpha", "Bathe",
                           "energy-momentum"):
            rows = run(cut, {**settings, "Stages/pulse/Absorbing": "",
                             "Stages/pulse/Time/Integrator": integrator},
                       on_ranks=1).history()
            bound(f"{name}, held on, {integrator}: reaction over the weight - 1",
                  max(abs(row["reaction_y of base"] / (15 * 19.6) - 1)
                      for row in rows), 1e-4)

# Without the reset displacements go on.
kept = run(SCENE, {"Stages/pulse/Reset displacements": "false"}).history()
bound("displacement with reset and without, less the settlement",
      kept[-1]["u_y at middle"] - plain_rows[-1]["u_y at middle"]
      - plain_rows[0]["u_y at middle"], 1e-12)

# The material carries a surface that is loaded in the second stage alone, in the
# first by more than a cell.
carried = folder / "carried.prm"
side_traction = "    set Type  = side traction\n    set Side  = top\n"
assert side_traction in text_of_scene
carried.write_text(text_of_scene.replace(
    side_traction,
    "    set Type   = surface traction\n    set Points = 1 20; 0 20\n"))
heavy = {"Method/Method": "GIMP", "Method/Mesh after step": "reset",
         "Loads/weight/Value": "0; -100", "Stages/gravity/Time/Steps": 4,
         "Stages/pulse/Time/Steps": 50, "Stages/pulse/Absorbing": ""}
late = run(carried, heavy).history()
early = run(carried, {**heavy, "Stages/gravity/Loads": "weight, pulse"}).history()
bound("end with a load of the second stage over one that was nothing before - 1",
      late[-1]["u_y at middle"] / early[-1]["u_y at middle"] - 1, 1e-10)

# The estimate of the error makes steps as small as it takes.
for tolerance in (1e-4, 1e-5):
    result = run(SCENE, {"Stages/pulse/Time/Error tolerance": tolerance,
                         "Stages/pulse/Time/Steps": 20,
                         "Stages/pulse/Time/Smallest step": 1e-3},
                 on_ranks=1 if tolerance == 1e-5 else None)
    number(f"Error tolerance {tolerance}: steps", result.summary["steps"], 2)
    end = result.history()[-1]
    bound(f"Error tolerance {tolerance}: end over impulse / (rho c) - 1",
          end["u_y at middle"] / (-IMPULSE / RHO_C) - 1, 1e-3)
    bound(f"Error tolerance {tolerance}: time at the end", end["t"] - 2, 0.)

# No step is small enough for this.
result = run(SCENE, {"Stages/pulse/Time/Error tolerance": 1e-13,
                     "Stages/pulse/Time/Steps": 20,
                     "Stages/pulse/Time/Smallest step": 0.1}, expect=1)
text("a tolerance that no step meets", result.summary["message"])
