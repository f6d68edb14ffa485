# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A body turned by 360 degrees in 36 steps, in 9 and in 360, comes back without
stress. Every other run of 36 is on two ranks, so that each scene and each method
is."""

from itertools import cycle

E = 1000
n_ranks = cycle([2, 1])
METHODS = {"FE": {"Method/Method": "finite element"},
           "MPM": {"Method/Method": "material point"},
           "GIMP, frozen": {"Method/Method": "GIMP",
                            "Method/Domain update": "frozen"},
           "GIMP, stretch": {"Method/Method": "GIMP",
                             "Method/Domain update": "stretch"},
           "GIMP, corners": {"Method/Method": "GIMP",
                             "Method/Domain update": "corners"},
           "CPDI1": {"Method/Method": "CPDI1"},
           "CPDI2": {"Method/Method": "CPDI2"}}


def turn(title, scene, settings, stress, on_ranks=None):
    done = run(scene,
               {"Output/Points": "false", "Output/Mesh": "false", **settings},
               on_ranks=on_ranks or next(n_ranks))
    bound(f"{title}: stress over E", done.errors["max_sigma"] / E, stress)
    bound(f"{title}: displacement", done.errors["max_u"], stress)
    sums = [abs(sum(value for key, value in row.items()
                    if key.startswith(f"reaction_{c}")))
            for row in done.history() for c in "xy"]
    bound(f"{title}: sum of reactions over E", max(sums) / E, 1e-11)


for name, settings in METHODS.items():
    turn(f"implicit boundary, {name}",
         "prm/large-deformation/rotation-implicit.prm", settings, 1e-10)
    if name.startswith("GIMP"):
        continue
    if name == "FE":
        settings = {**settings, "Mesh motion/Follow": ""}
    turn(f"annulus, {name}", "prm/large-deformation/rotation-annulus.prm",
         settings, 1e-10)
    if name in ("FE", "CPDI2"):
        turn(f"quads, {name}", "prm/large-deformation/rotation-quads.prm",
             settings, 1e-10)

# Steps of 40 degrees and of one.
for name in ("FE", "MPM", "GIMP, corners", "CPDI1", "CPDI2"):
    for n in (9, 360) if name in ("GIMP, corners", "CPDI2") else (9,):
        turn(f"implicit boundary, {name}, {n} steps",
             "prm/large-deformation/rotation-implicit.prm",
             {**METHODS[name], "Time/Steps": n}, 1e-10, on_ranks=1)

for name, factor in (("skew Nitsche", 10), ("symmetric Nitsche", 40)):
    turn(f"implicit boundary, {name}",
         "prm/large-deformation/rotation-implicit.prm",
         {"Boundaries/sides/Enforcement": name,
          "Boundaries/sides/Nitsche factor": factor}, 1e-10)
    turn(f"implicit boundary, {name}, 9 steps",
         "prm/large-deformation/rotation-implicit.prm",
         {"Boundaries/sides/Enforcement": name, "Time/Steps": 9,
          "Boundaries/sides/Nitsche factor": factor}, 1e-10)
