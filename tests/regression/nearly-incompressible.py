# ranks: 2  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A nearly incompressible deep beam at large displacement: in each step the
residual grows with the first corrections, for what turns changes its volume a
little and that is stiff. The line search has to take them."""
result = run("prm/cortis-2017/deep-beam.prm", {
    "Mesh/Cell size": 5,
    "Method/Strain": "finite",
    "Method/Volumetric strain": "pointwise",
    "Materials/elastic/Poisson ratio": 0.4999,
    "Time/Steps": 5,
    "Output/Points": "false",
    "Output/Mesh": "false",
})
text("status", result.summary["status"])
text("steps", result.summary["steps"])
text("rejected steps", result.summary["rejected_steps"])
bound("Newton iterations", result.summary["newton_iterations"], 85)
number("u_x at the corner", result.probes["u_x at A"], 6)
number("u_y at the corner", result.probes["u_y at A"], 6)
