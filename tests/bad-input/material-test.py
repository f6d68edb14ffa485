# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Material tests that cannot be, and ends of tests: each has its message."""

scene = scene_file("scene.prm", """
Materials/clay/Model = von Mises | Uniaxial yield stress = 20
Materials/clay/Young modulus = 1000 | Poisson ratio = 0.25
Materials/rubber/Model = neo-Hookean | Young modulus = 1 | Poisson ratio = 0.3
Material test/Legs = to strain -0.1 | Initial stress = -8, -8, -8
""")
TEST = "Material test/"


def refused(name, settings=None, *words, code=2, file=scene):
    result = run(file, settings, command="test-material",
                 extra=[*(words or ("--material", "clay")), "--output",
                        folder / "out"], expect=code)
    text(name, plain(" | ".join(result.output.splitlines())))
    table = folder / "out/material-test-clay.csv"
    text("  rows", len(table.read_text().splitlines()) if table.exists() else 0)
    table.unlink(missing_ok=True)


refused("unknown material", None, "--material", "clya")
refused("which material", None, "--set", "Title = two")
refused("no materials", file=scene_file("none.prm", "Material test/Legs = to 1"))
refused("not an option of others", None, "--overwrite")
refused("no legs", {TEST + "Legs": ""})
for leg in ("to strain", "to strain big", "until q", "until z = 3", "to 1",
            "0 cycles", "1.5 cycles", "3 cycles",
            "to strain 1, 1e6 cycles"):
    refused(f"leg '{leg}'", {TEST + "Legs": leg})
refused("q in shear", {TEST + "Legs": "until q = 1",
                       TEST + "Kind": "simple shear constant height"})
refused("unknown kind", {TEST + "Kind": "triaxial"})
for stress in ("-8, -8", "-8, -8, -8, 0, 0, 0, 0", "much"):
    refused(f"initial stress '{stress}'", {TEST + "Initial stress": stress})
refused("initial stress beyond yield", {TEST + "Initial stress": "-8, -8, -32"})
refused("no steps", {TEST + "Steps": 0})
GENERAL = {TEST + "Kind": "general", TEST + "Legs": "to 1"}
refused("general without control", GENERAL)
for control in ("strain zz", "pressure zz 1", "strain z 1", "strain zz x",
                "strain zz 1; stress zz 2"):
    refused(f"control '{control}'", {**GENERAL, TEST + "Control": control})
refused("strain in a general leg", {**GENERAL, TEST + "Control": "strain zz 1",
                                    TEST + "Legs": "to strain 1"})
refused("control of another kind", {TEST + "Control": "strain zz 1"})
refused("no such file", {TEST + "Measured": "none.csv"})
refused("small strain", None, "--material", "rubber")
refused("bad modulus", {"Materials/clay/Young modulus": "-1"})
refused("modulus that depends on place", {
    "Materials/clay/Young modulus": "1000*(1 + y)"})
refused("unknown key", {TEST + "Knd": "general"})

refused("beyond the strength", {TEST + "Legs": "to strain -0.01, to stress -40",
                                TEST + "Steps": 4}, code=1)
refused("mean stress without volume", {TEST + "Legs": "until p = -9",
                                       TEST + "Kind": "triaxial undrained"},
        code=1)
