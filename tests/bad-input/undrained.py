# ranks: 1
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""What water in the pores cannot be or do."""

WET = {"Materials/soil/Drainage": "undrained"}
RATIO = "Materials/soil/Undrained Poisson ratio"
BULK = "Materials/soil/Bulk modulus of water"
POROSITY = "Materials/soil/Porosity"
SUCTION = "Materials/soil/Cavitation suction"
BASE = "tests/bad-input/base.prm"
STAGED = scene_file("staged.prm", """
Mesh/Lower corner = 0, 0 | Upper corner = 2, 2 | Cell size = 1
Materials/soil/Young modulus = 1000 | Poisson ratio = 0.3
Bodies/block/Lower corner = 0, 0 | Upper corner = 2, 2
Grid conditions/base/Side = bottom
Stages/one/Time/Steps = 1
Stages/two/Time/End time = 2
""")


def refused(name, settings, scene=BASE):
    result = run(scene, settings, expect=2)
    text(name, plain(" | ".join(
        line.strip() for line in result.output.splitlines()
        if line.startswith("moraine: "))))


for key, value in ((RATIO, 0.49), (BULK, 2e6), (POROSITY, 0.3), (SUCTION, 100)):
    refused(f"{key.split('/')[-1]} of drained soil", {key: value})
refused("drains partly", {"Materials/soil/Drainage": "partly"})
refused("water without pores", {**WET, BULK: 2e6})
refused("pores without water", {**WET, POROSITY: 0.3})
refused("two stiffnesses", {**WET, BULK: 2e6, POROSITY: 0.3, RATIO: 0.49})
refused("ratio of the skeleton", {**WET, RATIO: 0.3})
refused("ratio of an incompressible body", {**WET, RATIO: 0.5})
refused("ratio that is no number", {**WET, RATIO: "high"})
refused("skeleton stiffer than both", {**WET, "Materials/soil/Poisson ratio": 0.496})
refused("skeleton stiffer than both somewhere", {
    **WET, "Materials/soil/Poisson ratio": "0.3 + 0.04*y", RATIO: 0.42})
refused("pores that are all", {**WET, BULK: 2e6, POROSITY: 1})
refused("negative modulus", {**WET, BULK: -2e6, POROSITY: 0.3})
refused("negative suction", {**WET, SUCTION: -1})
refused("UMAT", WET, scene_file("umat.prm", """
Materials/soil/Model = UMAT | Library = a.f
Mesh/Lower corner = 0, 0 | Upper corner = 2, 2 | Cell size = 1
Bodies/block/Lower corner = 0, 0 | Upper corner = 2, 2
"""))
refused("energy-momentum", {**WET, "Materials/soil/Density": 1,
                            "Time/Integrator": "energy-momentum"})
refused("drained anyway", {"Stages/two/Drained": "soil"}, STAGED)
refused("another material", {**WET, "Stages/two/Drained": "soul"}, STAGED)
refused("drains along a path", {**WET, "Stages/two/Drained": "soil",
                                "Stages/two/Time/Arc length": 0.1}, STAGED)

REDUCED = {"Materials/soil/Model": "Tresca", "Materials/soil/Shear strength": 5,
           "Strength reduction/Factor": 1.2}
refused("frozen without water", {**REDUCED, "Strength reduction/Stage": "two",
                                 "Strength reduction/Excess pressure": "frozen"},
        STAGED)
refused("frozen before there is pressure", {
    **WET, **REDUCED, "Strength reduction/Excess pressure": "frozen"})
refused("reduced in a stage that is not there", {
    **REDUCED, "Strength reduction/Stage": "tow"}, STAGED)
