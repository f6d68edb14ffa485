# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Shipped scenes that end with warnings, and these: all that take less than 2.5
seconds."""

# Longer ones, which tests of their own run, and studies.
LONG = {"geotechnics/pile", "geotechnics/slope", "geotechnics/cavity-box",
        "geotechnics/column-collapse", "geotechnics/retrogression",
        "hard-cases/slope-fe", "hard-cases/bearing-cpdi1", "hard-cases/bearing-gimp",
        "geotechnics/footing-sand", "geotechnics/cavity-expansion",
        "geotechnics/footing-cam-clay", "geotechnics/embankment-clay",
        "geotechnics/footing-clay", "hard-cases/bearing-implicit",
        "hard-cases/bearing-fe", "hard-cases/slope-gimp", "hard-cases/cyclic",
        "large-deformation/tube-implicit", "large-deformation/tube-mesh",
        "dynamics/manufactured-cube",
        "dynamics/plastic-wave", "dynamics/disc", "dynamics/oblique-inclined",
        "hard-cases/punch", "wang-2018/twist-10-fine", "cortis-2017/block-study",
        "phuong-2023/footing-fixed-dmgc", "phuong-2023/footing-fixed-gimp",
        "phuong-2023/footing-viscoelastic-dmgc",
        "phuong-2023/footing-viscoelastic-gimp", "phuong-2023/footing-viscous-dmgc",
        "phuong-2023/footing-viscous-gimp", "dynamics/embankment"}

n = 0
for path in sorted((root / "prm").rglob("*.prm")):
    name = str(path.relative_to(root / "prm"))[:-4]
    if name in LONG or name.startswith("studies/"):
        continue
    n += 1
    result = run(path, {"Output/Write": "end"}, expect=None)
    ids = [one["id"] for one in result.summary.get("warnings", [])]
    if ids:
        text(name, ", ".join(ids))
at_least("scenes", n, 100)
