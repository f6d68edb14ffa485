# ranks: 1
# debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""One, two and three ranks give the same numbers."""

SCENES = {
    "contained block": ("prm/cortis-2017/block-30.prm", {}),
    "loads, MPM": ("prm/verification/loads.prm", {}),
    "loads, GIMP": ("prm/verification/loads.prm", {"Method/Method": "GIMP"}),
    "loads, FE Q2": ("prm/verification/loads.prm",
                     {"Method/Method": "finite element", "Method/Degree": 2}),
    "motion through the mesh": ("prm/verification/rigid-motion.prm",
                                {"Boundaries/sides/Rotation angle": "20+t"}),
    # The expression is no number above the block, where cells are empty.
    "cut by a root": ("prm/verification/loads.prm",
                      {"Bodies/body/Shape": "intersection",
                       "Bodies/body/Operands": "block, root",
                       "Bodies/root/Shape": "expression",
                       "Bodies/root/Expression": "1+sqrt(61-y)",
                       "Loads/drag/Bodies": "body"}),
    "random points": ("prm/verification/patch-random.prm", {}),
    "ring, gmres": ("prm/boundaries/ring.prm", {"Solver/Solver": "gmres"}),
    "ring on a roller": ("prm/boundaries/ring-roller.prm", {}),
    "column": ("prm/verification/column.prm", {}),
    # Boxes and domains that come to lie across cells of two ranks.
    "cell means, GIMP": (
        "prm/hard-cases/bearing-gimp.prm",
        {"Method/Strain": "finite", "Mesh/Cell size": 0.25,
         "Mesh/Upper corner": "5, 0.25",
         "Grid conditions/footing/Displacement": "0; -0.04 * t",
         "Time/Steps": 4}),
    "cell means, CPDI1": ("prm/large-deformation/collapse.prm",
                          {"Method/Method": "CPDI1", "Time/Steps": 4,
                           "Method/Volumetric strain": "cell mean",
                           "Loads/weight/Value": "0; -5"}),
    "cell means, ring": ("prm/boundaries/ring.prm",
                         {"Method/Volumetric strain": "cell mean"}),
    "aggregation, dynamics": (
        "prm/hard-cases/cut-block.prm",
        {"Method/Strain": "finite", "Mesh/Lower corner": "-1.03, -1.57",
         "Mesh/Upper corner": "2.97, 2.43", "Time/Integrator": "Newmark",
         "Time/End time": 0.1, "Time/Steps": 10}),
    "ghost term, dynamics": (
        "prm/hard-cases/cut-block.prm",
        {"Method/Strain": "finite", "Method/Cut cells": "ghost",
         "Mesh/Lower corner": "-1.03, -1.57", "Mesh/Upper corner": "2.97, 2.43",
         "Time/Integrator": "Newmark", "Time/End time": 0.1, "Time/Steps": 10}),
    "ghost term, 3D": ("prm/cortis-2017/block-3d.prm",
                       {"Method/Aggregate below": 0.5,
                        "Method/Cut cells": "ghost"}),
    "aggregation, 3D": ("prm/cortis-2017/block-3d.prm",
                        {"Method/Aggregate below": 0.5}),
    "hollow sphere": ("prm/boundaries/hollow-sphere.prm",
                      {"Mesh/Cells": "5, 5, 5"}),
}


def worst_difference(one, many):
    """Over errors and probes, relative to each number or to a thousandth of
    the largest of its kind; over reactions, relative to the largest component:
    net forces of closed boundaries vanish by symmetry."""
    pairs = []
    for a, b in ((one.errors, many.errors), (one.probes, many.probes)):
        assert a.keys() == b.keys()
        pairs.append(([(a[key], b[key]) for key in a
                       if a[key] is not None or b[key] is not None], 1e-3))
    assert one.reactions.keys() == many.reactions.keys()
    pairs.append(([(x, y) for key in one.reactions
                   for x, y in zip(one.reactions[key], many.reactions[key])],
                  1))
    worst = 0
    for group, share in pairs:
        largest = max((abs(a) for a, b in group), default=0)
        if largest > 1e-9:  # below, both are round-off
            worst = max(worst, max(abs(a - b) / max(abs(a), share * largest)
                                   for a, b in group))
    return worst


for name, (scene, settings) in SCENES.items():
    settings = {**settings, "Output/Points": "false", "Output/Mesh": "false"}
    one = run(scene, settings, on_ranks=1)
    text(name + ", points", one.summary["points"])
    others = [run(scene, settings, on_ranks=n) for n in (2, 3)]
    same = all(many.summary[key] == one.summary[key] for many in others
               for key in ("points", "active_cells", "unknowns", "steps"))
    text(f"{name}, sizes and steps", "the same" if same else "NO, different")
    bound(f"{name}, difference",
          max(worst_difference(one, many) for many in others), 1e-8)

# The cube fills four ninths of its mesh; ranks share points, not cells.
for n in (2, 3):
    many = run("prm/large-deformation/slump-3d.prm",
               {"Time/Steps": 1, "Time/End time": 0.1,
                "Output/Points": "false", "Output/Mesh": "false"}, on_ranks=n)
    largest = int(many.output.split(" on a process")[0].split()[-1])
    bound(f"cube, {n} ranks, most points over mean - 1",
          largest * n / many.summary["points"] - 1, 0.1)

# A small body in a mesh that is empty elsewhere: no rank is without cells.
text("a body in one of four cells, 3 ranks",
     run("tests/bad-input/base.prm",
         {"Mesh/Cell size": 4, "Bodies/block/Upper corner": "3.5, 3.5",
          "Boundaries/left/Points": "0.5 3.5; 0.5 0.5", "Time/Steps": 1,
          "Probes/tip/Location": "3, 3"}, on_ranks=3).summary["status"])
refused = run("tests/bad-input/base.prm", {"Mesh/Cell size": 8}, expect=2,
              on_ranks=3)
text("more ranks than cells", [line.strip() for line in
                               plain(refused.output).splitlines()
                               if line.startswith("moraine: ")][0])
