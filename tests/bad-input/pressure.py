# ranks: 1
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Loads of type pressure that cannot be."""

scene = scene_file("block.prm", """
Mesh/Lower corner = 0, 0 | Upper corner = 2, 2 | Cell size = 0.5
Method/Strain = finite
Materials/soil/Young modulus = 1e4 | Poisson ratio = 0.3
Bodies/block/Lower corner = 0, 0 | Upper corner = 2, 2
Grid conditions/base/Side = bottom
Loads/gas/Type = pressure | Value = 1
""")
TOP = {"Loads/gas/Side": "top"}
for name, settings in (
        ("nowhere", {}),
        ("a side and a surface", {**TOP, "Loads/gas/Body": "block"}),
        ("a vector", {**TOP, "Loads/gas/Value": "0; -1"}),
        ("no value", {**TOP, "Loads/gas/Value": ""}),
        ("keys of others", {**TOP, "Loads/gas/Bodies": "block"}),
        ("a place", {**TOP, "Loads/gas/Location": "1, 2"}),
        ("a part that the body has not", {"Loads/gas/Body": "block",
                                          "Loads/gas/Part": "roof"}),
        ("beside the body", {"Loads/gas/Points": "0 5; 2 5"}),
        ("a solver for symmetric tangents", {**TOP, "Solver/Solver": "amg-cg"})):
    result = run(scene, settings, expect=2)
    text(name, plain(" | ".join(
        line.strip() for line in result.output.splitlines()
        if line.startswith("moraine: "))))
