# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Keys of damping that contradict each other or lack what they need."""

scene = "tests/bad-input/base.prm"
dynamic = {"Time/Integrator": "Newmark", "Materials/soil/Density": 1}


def refused(name, settings):
    result = run(scene, settings, expect=2)
    lines = [line for line in result.output.splitlines() if line.strip()]
    text(name, plain(" | ".join(lines)))


block = "Bodies/block/"
refused("quasi-static", {block + "Mass damping": 1})
refused("ratio, quasi-static", {block + "Damping ratio": 0.05,
                                block + "Damping frequencies": "1, 2"})
refused("factor and ratio", {**dynamic, block + "Stiffness damping": 0.1,
                             block + "Damping ratio": 0.05,
                             block + "Damping frequencies": "1, 2"})
refused("ratio without frequencies", {**dynamic, block + "Damping ratio": 0.05})
refused("one frequency", {**dynamic, block + "Damping ratio": 0.05,
                          block + "Damping frequencies": 1})
refused("frequencies in the wrong order",
        {**dynamic, block + "Damping ratio": 0.05,
         block + "Damping frequencies": "2, 1"})
refused("frequencies without a ratio",
        {**dynamic, block + "Damping frequencies": "1, 2"})
refused("negative factor", {**dynamic, block + "Mass damping": -1})
