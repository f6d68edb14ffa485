# ranks: 2  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
# Simple shear across partly filled cells (Cortis et al. 2017, section 5.3,
# figure 16) at 13 places against the mesh. The paper's setting is on the ranks of
# the test where a sliver is cut off, and in the middle; else on one.
paper = {"Boundaries/*/Enforcement": "weighted",
         "Boundaries/*/Band width": 1e-6}

for x_A in ("0", "1e-6", "1e-3", "0.1", "1", "10", "25", "50", "75", "90",
            "99.9", "99.999", "100"):
    keys = QUIET | {"Constants/x_A": x_A}
    result = run("prm/cortis-2017/simple-shear.prm", keys)
    text("x_A", x_A)
    number("points", result.summary["points"], 3)
    bound("r_sigma_xy", result.errors["r_sigma_xy"],
          1e-9 if 1 <= float(x_A) <= 99 else 2e-8)
    bound("r_u", result.errors["r_u"], 1e-9)
    result = run("prm/cortis-2017/simple-shear.prm", keys | paper,
                 on_ranks=None if x_A in ("1e-6", "50", "99.999") else 1)
    number("with the paper's setting, r_sigma_xy",
           result.errors["r_sigma_xy"], 1)
