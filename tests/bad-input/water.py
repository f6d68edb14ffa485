# ranks: 1
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Water that cannot be."""


def refused(name, settings, scene="tests/bad-input/base.prm"):
    result = run(scene,
                 {(key if "/" in key else f"Water/{key}"): value
                  for key, value in settings.items()}, expect=2)
    text(name, plain(" | ".join(
        line.strip() for line in result.output.splitlines()
        if line.startswith("moraine: "))))


LEVEL = {"Level": 1, "Unit weight": 10}
refused("level and pressure", {**LEVEL, "Pressure": "10*(1 - y)"})
refused("no unit weight", {"Level": 1})
refused("no unit weight of free water", {"Pressure": "10*(1 - y)", "Free level": 2})
refused("free water alone", {"Free level": 2, "Unit weight": 10})
refused("unit weight alone", {"Unit weight": 10})
refused("negative unit weight", {"Level": 1, "Unit weight": -10})
refused("level below the bodies", {"Level": -1, "Unit weight": 10})
refused("negative pressure", {"Pressure": "-1 - y"})
refused("level that names its own axis", {"Level": "2 - y", "Unit weight": 10})
refused("no number somewhere", {"Level": "log(x - 1)", "Unit weight": 10})
refused("no expression", {"Level": "high", "Unit weight": 10})
refused("suction", {**LEVEL, "Suction": "yes"})
refused("saturated density without water", {"Materials/soil/Saturated density": 2})
refused("saturated density below the other", {
    **LEVEL, "Materials/soil/Density": 2, "Materials/soil/Saturated density": 1.8})
refused("saturated density that is none", {
    **LEVEL, "Materials/soil/Saturated density": "wet"})
refused("saturated density in dynamics", {
    **LEVEL, "Materials/soil/Density": 1, "Materials/soil/Saturated density": 2,
    "Time/Integrator": "Newmark"})
refused("energy-momentum", {**LEVEL, "Materials/soil/Density": 1,
                            "Time/Integrator": "energy-momentum"})
refused("double mapping", {**LEVEL, "Method/Method": "DM"})
refused("probe without water", {"Probes/a/Location": "0.5, 0.5",
                                "Probes/a/Quantities": "pore pressure"})
refused("probe of no point", {**LEVEL, "Probes/a/Location": "0.5, 0.5",
                              "Probes/a/Kind": "interpolated",
                              "Probes/a/Quantities": "total stress"})
# Stages have no section 'Time' beside them.
base = (root / "tests/bad-input/base.prm").read_text()
staged = folder / "staged.prm"
staged.write_text(base[:base.index("subsection Time")] +
                  prm("Stages/a/Time/Steps = 1"))
refused("level and pressure in a stage", {
    "Stages/a/Water/Level": 1, "Stages/a/Water/Pressure": 1, "Unit weight": 10}, staged)
refused("level of a stage that is none", {
    "Stages/a/Water/Level": "high", "Unit weight": 10}, staged)
