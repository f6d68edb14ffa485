# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Domains that are whole cells of a mesh of unlike cells are as long as they were
at the start, and none is halved in a body that turns."""

TURN = {"Method/Points per direction": 1, "Time/End time": 3, "Time/Steps": 3}
for method in "CPDI1", "CPDI2":
    points = {split: run("prm/large-deformation/rotation-quads.prm",
                         {**TURN, "Method/Method": method,
                          "Method/Split domains": split}).summary["points"]
              for split in ("true", "false")}
    text(f"{method}, points that were added", points["true"] - points["false"])
