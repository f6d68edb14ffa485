# ranks: 1
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Numbers that soils cannot have."""


def refused(name, settings, model="Mohr-Coulomb"):
    result = run("tests/bad-input/base.prm",
                 {"Materials/soil/Model": model,
                  **{(key if "/" in key else f"Materials/soil/{key}"): value
                     for key, value in settings.items()}}, expect=2)
    text(name, plain(" | ".join(
        line.strip() for line in result.output.splitlines()
        if line.startswith("moraine: "))))


refused("radians", {"Friction angle": 0.52})
refused("dilation in radians", {"Friction angle": 30, "Dilation angle": 0.17})
refused("too much friction", {"Friction angle": 61})
refused("dilation above friction", {"Friction angle": 30, "Dilation angle": 35})
refused("dilation above friction later", {
    "Friction angle": "0: 40, 0.1: 20", "Dilation angle": "0: 30, 0.1: 25"})
refused("dilation above friction somewhere", {
    "Friction angle": "40 - 5*y", "Dilation angle": 25})
refused("friction that falls below dilation", {
    "Friction angle": "0: 40, 0.1: 20", "Dilation angle": 25})
refused("no strength", {})
refused("negative cohesion", {"Cohesion": -1})
refused("tension beyond the apex", {
    "Cohesion": 10, "Friction angle": 30, "Tensile strength": 30})
refused("no limit of tension", {
    "Cohesion": 10, "Friction angle": 30, "Tensile strength": "none"})
refused("dilation that ends at once", {
    "Friction angle": 30, "Largest plastic dilation": 0})
refused("nothing that softens", {"Cohesion": 10, "Softening length": 1})
refused("conjugate gradients", {"Cohesion": 10, "Friction angle": 30,
                                "Solver/Solver": "amg-cg"})
refused("negative shear strength somewhere", {"Shear strength": "3 - y"},
        "Tresca")
refused("no shear strength", {}, "Tresca")
refused("cohesion of Tresca", {"Shear strength": 3, "Cohesion": 3}, "Tresca")
refused("unknown cone", {"Friction angle": 30, "Cone": "inner"},
        "Drucker-Prager")
refused("tension of a cone", {"Friction angle": 30, "Tensile strength": 1},
        "Drucker-Prager")
refused("negative modulus somewhere", {
    "Young modulus": "1000*(2 - y)", "Cohesion": 10})

CLAY = {"Young modulus": "", "Poisson ratio": "", "Critical state angle": 25,
        "Compression index": 0.1, "Swelling index": 0.02, "Shear modulus": 1000,
        "Minimum pressure": 1}
for name, settings in {
        "no angle of clay": {"Critical state angle": ""},
        "angle of clay in radians": {"Critical state angle": 0.4},
        "compression below swelling": {"Compression index": 0.02,
                                       "Swelling index": 0.05},
        "no swelling": {"Swelling index": 0},
        "no word": {"Swelling index": "small"},
        "no least pressure": {"Minimum pressure": ""},
        "no shear modulus": {"Shear modulus": ""},
        "OCR below 1": {"OCR": 0.8},
        "OCR below 1 somewhere": {"OCR": "3 - y"},
        "negative POP": {"POP": -5},
        "Young's modulus of clay": {"Young modulus": 1000},
        "start beyond yield": {"Density": 1, "/Initial": ""},
        "energy-momentum": {"Method/Strain": "finite", "Time/Integrator": "energy-momentum",
                            "Density": 1}}.items():
    if settings.pop("/Initial", None) is not None:
        settings["Bodies/block/Initial stress"] = "-10; -100 + 20*y; -10; 0"
    refused(name, {**CLAY, **settings}, "Cam-clay")

# c cot(phi) = 17.3205; a number as rounded in the message is taken.
result = run("tests/bad-input/base.prm",
             {"Materials/soil/Model": "Mohr-Coulomb", "Materials/soil/Cohesion": 10,
              "Materials/soil/Friction angle": 30,
              "Materials/soil/Tensile strength": 17.33}, command="check")
text("tension at the apex, rounded up", "taken" if result.code == 0 else "REFUSED")
