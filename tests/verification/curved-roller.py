# ranks: 2
# debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A ring on a curved roller over which it may slide: each method and enforcement with
its default factors solves each step at once, however stiff its penalty, and has the
displacement of a ring whose points stay."""

SLIDES = {"Method/Mesh after step": "default", "Output/Mesh": "false",
          "Output/Points": "false"}

for method in ("GIMP", "material point", "finite element"):
    for enforcement in ("augmented Lagrangian", "weighted", "penalty",
                        "skew Nitsche"):
        result = run("prm/boundaries/ring-roller.prm",
                     {**SLIDES, "Method/Method": method,
                      "Boundaries/inner/Enforcement": enforcement,
                      "Time/Steps": 2})
        case = f"{method}, {enforcement}"
        text(f"{case}: rejected steps", result.summary["rejected_steps"])
        bound(f"{case}: Newton iterations in two steps",
              result.summary["newton_iterations"], 10)
        bound(f"{case}: l2_u", result.errors["l2_u"], 0.012)
