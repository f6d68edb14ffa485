# ranks: 2  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Large strain in 3D must give the numbers of plane strain: stretch of a block,
twist of a tube."""

from math import pi

METHODS = ("finite element", "material point", "GIMP", "CPDI1", "CPDI2")
NO_FILES = {"Output/Points": "false", "Output/Mesh": "false"}
# sigma_xx, sigma_zz (out of plane) and height/2 of the homogeneous solution
EXACT = {6: (293.752268279, 0., 1.),
         7: (297.805136051, 9.415124697, 0.982825665951),
         20: (266.240969173, 85.958533770, 0.693870973915)}

plane = run("prm/wang-2018/stretch-cpdi1.prm", NO_FILES).history()
for method in METHODS:
    settings = {**NO_FILES, "Method/Method": method}
    if method == "finite element":
        settings["Mesh motion/Stretch between"] = ""
    solid = run("prm/large-deformation/stretch-3d.prm", settings).history()
    error = max(abs(a["sigma_xx at point"] / b["sigma_xx at point"] - 1)
                for a, b in zip(solid, plane))
    bound(f"stretch, {method}: stress against 2D, 20 steps", error, 1e-8)
    error = max(abs(a["reaction_x of right"] / b["reaction_x of right"] - 1)
                for a, b in zip(solid, plane))
    bound(f"stretch, {method}: reaction against 2D, 20 steps", error, 1e-8)
    for step, (xx, zz, height) in EXACT.items():
        row = solid[step - 1]
        bound(f"stretch, {method}, step {step}: stress and height", max(
            abs(row["sigma_xx at point"] - xx) / xx,
            abs(row["sigma_yy at point"] - zz) / xx,
            abs(row["z at corner"] / 2 - height)), 1e-8)

HEIGHT = 2
for method, scene in (
        ("finite element", "prm/wang-2018/twist-80-fe.prm"),
        ("material point", "prm/wang-2018/twist-80-mpm.prm"),
        ("CPDI1", "prm/wang-2018/twist-80-cpdi1.prm"),
        ("CPDI2", "prm/wang-2018/twist-80-cpdi2.prm")):
    settings = {**NO_FILES, "Method/Method": method}
    if method == "finite element":
        settings["Mesh motion/Follow"] = ""
    solid = run("prm/large-deformation/twist-3d.prm", settings).history()[-1]
    plane = run(scene,
                {**NO_FILES, "Time/End time": 10, "Time/Steps": 2}
                ).history()[-1]
    torque = abs(solid["moment of hole"]) / HEIGHT
    number(f"twist, {method}: torque / (2 pi 25 E)", torque / (50e6 * pi), 5)
    bound(f"twist, {method}: torque against 2D",
          torque / abs(plane["moment of hole"]) - 1, 1e-8)
