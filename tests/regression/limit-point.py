# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A shallow arch snaps through under its weight; after that, steps grow again,
although multipliers take more iterations in each than an easy step has."""

SCENE = "prm/large-deformation/arch.prm"
for name, settings in (("augmented Lagrangian", {}),
                       ("skew Nitsche",
                        {"Boundaries/left/Enforcement": "skew Nitsche",
                         "Boundaries/right/Enforcement": "skew Nitsche"})):
    arch = run(SCENE, {**QUIET, **settings})
    history = arch.history()
    text(f"{name}: status", arch.summary["status"])
    bound(f"{name}: steps, 20 asked for", len(history), 100)
    drop = max((after["u_y at crown"] - before["u_y at crown"], after["t"])
               for before, after in zip(history[1:], history)
               if after["t"] < before["t"])
    number(f"{name}: crown falls through by", drop[0], 1)
    number(f"{name}: at t", drop[1], 2)
    number(f"{name}: crown at the end", history[-1]["u_y at crown"], 2)
    # A force per volume of now, which has shrunk.
    bound(f"{name}: reactions over the weight at the start - 1",
          sum(r[1] for r in arch.reactions.values()) / 600 - 1, 5e-3)
