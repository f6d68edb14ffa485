# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Nodes that too few points touch: the run goes on, says so, and the reactions
are those of the material. What only empty parts would hold is refused."""

scene = "prm/boundaries/tilted-roller.prm"
at = {"Mesh/Cell size": 2.5}
on_its_own = run(scene, at)
text("status", on_its_own.summary["status"])
text("note", next(line.strip() for line in on_its_own.output.splitlines()
                  if "note:" in line))
text("named as an effect",
     "stiffness of empty parts" in on_its_own.summary["effects"])
text("also where none is needed", "stiffness of empty parts" in
     run(scene).summary["effects"])
other = run(scene, {**at, "Method/Empty stiffness": 1e-4})
bound("largest difference of reactions from those with 1e-4, over the weight",
      max(abs(a - b) / 500 for name in ("slope", "stop")
          for a, b in zip(on_its_own.reactions[name], other.reactions[name])),
      1e-10)

# One row of cells with one point each does not resist bending.
row = run("tests/bad-input/base.prm", {
    "Method/Points per direction": 1,
    "Bodies/block/Lower corner": "0.5, 1.2",
    "Bodies/block/Upper corner": "4.5, 1.8",
    "Boundaries/left/Points": "0.5 1.8; 0.5 1.2"}, expect=1)
text("refused", row.summary["message"].split(". ")[0])
