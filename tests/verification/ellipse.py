# ranks: 1 2  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Elliptical hole turned by 70 degrees (Wang et al. 2018, section 3.2.2): torque
over 2 pi 5^2 E and force over 2 pi 5 E, as for the circular hole."""

from math import pi

SCENES = {"fe": "prm/wang-2018/ellipse-fe.prm",
          "mpm": "prm/wang-2018/ellipse-mpm.prm",
          "cpdi1": "prm/wang-2018/ellipse-cpdi1.prm",
          "cpdi2": "prm/wang-2018/ellipse-cpdi2.prm"}
for scene, file in SCENES.items():
    result = run(file, {"Output/Points": "false",
                        "Output/Mesh": "false"})
    text(scene, result.summary["status"])
    text(f"{scene}, rejected steps", result.summary["rejected_steps"])
    for row in result.history():
        if row["t"] in (5, 20, 30, 60, 70):
            number(f"{scene}, {row['t']:g} degrees, torque",
                   abs(row["moment of hole"]) / (2 * pi * 25e6), 3)
            number(f"{scene}, {row['t']:g} degrees, force",
                   row["force magnitude of hole"] / (2 * pi * 5e6), 3)
