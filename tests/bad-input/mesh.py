# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Meshes of generators and files that are wrong: each has its message."""

base = (root / "tests/bad-input/base.prm").read_text()
start = base.index("subsection Mesh")
box = base[start:base.index("end\n", start)]
plane = base.replace(box, "subsection Mesh\n")
shell = {"Mesh/Type": "generator", "Mesh/Generator": "hyper_shell",
         "Mesh/Arguments": "4, 4 : 1 : 6 : 12 : true"}

square = {"Mesh/Type": "generator", "Mesh/Generator": "subdivided_hyper_rectangle",
          "Mesh/Arguments": "8, 8 : 0, 0 : 8, 8 : true"}


def refused(name, settings, scene=plane, until="\n"):
    file = folder / "scene.prm"
    file.write_text(scene)
    result = run(file, settings, expect=2)
    lines = [line for line in result.output.splitlines() if line.strip()]
    text(name, plain(" | ".join(lines)).split(until)[0])
    if (result.folder / "history.csv").exists():
        text(name, "NO, a folder was made")


def in_3d(settings):
    return {"Dimension": 3, **settings}


refused("unknown type", {"Mesh/Type": "sphere"})
refused("key of another type", {**shell, "Mesh/Cell size": 1})
refused("key of another type, a box", {"Mesh/File": "a.msh"}, base)
refused("no generator", {"Mesh/Type": "generator"})
refused("unknown generator", {**shell, "Mesh/Generator": "hyper_shel"})
refused("generator in 3D only", {**shell, "Mesh/Generator": "torus"})
refused("too few arguments", {**shell, "Mesh/Arguments": "4, 4 : 1 : 6"})
refused("text for a number", {**shell, "Mesh/Arguments": "4, 4 : one : 6 : 12 : true"})
refused("a point with three numbers",
        {**shell, "Mesh/Arguments": "4, 4, 4 : 1 : 6 : 12 : true"})
# The rest is deal.II's assertion in Debug and our check of the cells in Release.
refused("radii swapped", {**shell, "Mesh/Arguments": "4, 4 : 6 : 1 : 12 : true"},
        until=": found")
refused("negative refinements", {**shell, "Mesh/Refinements": -1})
refused("side names without numbers", {**shell, "Mesh/Side names": "hole, outer"})
refused("side names the wrong way round", {**shell, "Mesh/Side names": "0: hole"})
refused("side name for no side", {**shell, "Mesh/Side names": "hole: 0, outer: 2"})
refused("side name given twice", {**shell, "Mesh/Side names": "hole: 0, hole: 1"})
refused("side given two names", {**shell, "Mesh/Side names": "hole: 0, rim: 0"})
refused("side of a box on a generator's mesh", {**square, "Grid conditions/a/Side": "left"})
refused("number of a side with a name", {
    **square, "Mesh/Side names": "west: 0", "Grid conditions/a/Side": "0"})
refused("number that is no side", {**square, "Grid conditions/a/Side": "5"})
for method in ("GIMP", "DM", "DM-G", "DM-C", "DM-GC"):
    refused(method, {**square, "Method/Method": method})
refused("body partly in the hole", shell)
refused("a mesh that is turned", {
    **shell, "Bodies/block/Shape": "mesh", "Bodies/block/Lower corner": "",
    "Bodies/block/Upper corner": "", "Bodies/block/Rotation angle": 30})
refused("extrusion in 2D", {**shell, "Mesh/Extrusion layers": 2})
refused("extrusion without height", in_3d({**shell, "Mesh/Extrusion layers": 2}))
refused("extrusion without layers", in_3d({**shell, "Mesh/Extrusion height": 2}))

# Numbers of cells that are none, or more than any machine has room for.
ARGUMENTS = {
    "half_hyper_shell": "4, 4 : 1 : 6 : {} : true",
    "quarter_hyper_shell": "4, 4 : 1 : 6 : {} : true",
    "hyper_shell": "4, 4 : 1 : 6 : {} : true",
    "subdivided_hyper_rectangle": "8, {} : 0, 0 : 8, 8 : true",
    "hyper_cross": "1, 1, {}, 1 : true",
    "concentric_hyper_shells": "4, 4 : 1 : 6 : 3 : 0 : {} : true"}
for generator, arguments in ARGUMENTS.items():
    for count in ("-1", "4294967295", "999999999"):
        refused(f"{generator} with {count} cells",
                {"Mesh/Type": "generator", "Mesh/Generator": generator,
                 "Mesh/Arguments": arguments.format(count)},
                until=", which take")
refused("hyper_cross with -1 cells in 3D",
        in_3d({"Mesh/Type": "generator", "Mesh/Generator": "hyper_cross",
               "Mesh/Arguments": "1, 1, 1, 1, 1, -1 : true"}))
refused("1e10 cells", {"Mesh/Cells": "100000, 100000"},
        base.replace("set Cell size", "# set Cell size"), until=", which take")
refused("too many refinements", {**square, "Mesh/Refinements": 12},
        until=", which take")
refused("too many layers",
        in_3d({**square, "Mesh/Extrusion layers": 1000000,
               "Mesh/Extrusion height": 1, "Mesh/Refinements": 5}),
        until=", which take")
refused("1e10 points", {**square, "Mesh/Arguments":
                        "200, 200 : 0, 0 : 8, 8 : true",
                        "Method/Points per direction": 1000},
        until=", which take")
refused("more ids than there are",
        {**square, "Mesh/Arguments": "400, 400 : 0, 0 : 8, 8 : true",
         "Method/Points per direction": 200,
         "Bodies/block/Upper corner": "0.51, 0.51"})
refused("a grid of 1e10 points",
        {**square, "Bodies/block/Point grid": "100000, 100000"},
        until=", which take")

HEADER = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
NODES = ["0 0", "4 0", "8 0", "0 8", "4 8", "8 8"]
CELLS = ["3 2 9 9 1 2 5 4", "3 2 9 9 2 3 6 5"]
LINES = ["1 2 1 1 1 2", "1 2 1 1 2 3", "1 2 2 2 4 5", "1 2 2 2 5 6"]


def msh(nodes=NODES, elements=LINES + CELLS):
    def numbered(rows):
        return "".join(f"{i} {row}\n" for i, row in enumerate(rows, 1))

    return (f"{HEADER}$Nodes\n{len(nodes)}\n"
            + numbered([node + " 0" for node in nodes])
            + f"$EndNodes\n$Elements\n{len(elements)}\n" + numbered(elements)
            + "$EndElements\n")


def file_refused(name, content, settings=None):
    (folder / "mesh.msh").write_text(content)
    refused(name, {"Mesh/Type": "file", "Mesh/File": "mesh.msh",
                   **(settings or {})})


refused("no file name", {"Mesh/Type": "file"})
refused("missing file", {"Mesh/Type": "file", "Mesh/File": "nowhere.msh"})
refused("a folder", {"Mesh/Type": "file", "Mesh/File": "."})
file_refused("empty file", "")
file_refused("another format", "vertices 3\n")
file_refused("format from the future", msh().replace("2.2 0 8", "5.0 0 8"))
file_refused("file cut off", msh()[:120])
file_refused("node that is not there", msh(nodes=NODES[:5]))
file_refused("lines only", msh(elements=LINES))
file_refused("triangle", msh(elements=LINES + CELLS[:1] +
                             ["2 2 9 9 2 3 6", "2 2 9 9 2 6 5"]))
file_refused("tetrahedron", msh(nodes=NODES + ["0 1"],
                                elements=["4 2 9 9 1 2 4 7"]))
file_refused("crossed cell", msh(elements=[CELLS[0], "3 2 9 9 2 3 5 6"]))
file_refused("concave cell", msh(nodes=NODES[:4] + ["5.9 2"] + NODES[5:] + ["1 1"],
                                 elements=["3 2 9 9 1 2 7 4"]))
file_refused("flat cell", msh(nodes=NODES[:2] + ["4 4"] + NODES[3:]))
file_refused("line inside", msh(elements=LINES + ["1 2 3 3 2 5"] + CELLS))
file_refused("quadrilaterals in 3D", msh(), {"Dimension": 3})
file_refused("side name for no line", msh(), {"Mesh/Side names": "low: 1, up: 3"})
file_refused("side that has no name", msh(),
             {"Mesh/Side names": "low: 1, up: 2", "Grid conditions/a/Side": "lo"})
file_refused("side that has no number", msh(), {"Grid conditions/a/Side": "3"})

# A side is called by its name or, without one, by its number; gmsh's own names
# are names, where 'Side names' gives no other.
NAMES = '$PhysicalNames\n3\n1 1 "low end"\n1 2 "up"\n2 9 "plate"\n$EndPhysicalNames\n'
named = msh().replace("$Nodes", NAMES + "$Nodes", 1)
for name, mesh, side, settings in (
        ("number beside a name", msh(), "2", {"Mesh/Side names": "low: 1"}),
        ("name of gmsh", named, "low end", {}),
        ("name of gmsh beside one of the scene", named, "up",
         {"Mesh/Side names": "low: 1"}),
        ("number of a side that gmsh names", named, "2", {})):
    (folder / "mesh.msh").write_text(mesh)
    (folder / "scene.prm").write_text(plane)
    result = run(folder / "scene.prm", {
        "Mesh/Type": "file", "Mesh/File": "mesh.msh", "Grid conditions/a/Side": side,
        **settings}, command="check")
    text(name, result.found())
file_refused("side that neither names", named, {
    "Mesh/Side names": "foot: 1", "Grid conditions/a/Side": "low end"})
# Two blocks that touch and are not joined, but by a physical curve.
TORN = NODES + ["4 0", "4 8"]
APART = [CELLS[0], "3 2 9 9 7 3 6 8"]
OUTER = ["1 2 1 1 1 2", "1 2 1 1 7 3", "1 2 2 2 4 5", "1 2 2 2 8 6"]
file_refused("cells that are not joined", msh(nodes=TORN, elements=OUTER + APART))
file_refused("cells that share a part of a face",
             msh(nodes=NODES + ["4 -3", "4 5"],
                 elements=["3 2 9 9 1 2 5 4", "3 2 9 9 7 3 6 8"]))
# With one the slit stays, and cuts the block in two.
file_refused("slit with a physical curve",
             msh(nodes=TORN, elements=OUTER + ["1 2 3 3 2 5"] + APART),
             {"Mesh/Refinements": 3})

# Clockwise cells are turned, not refused.
(folder / "mesh.msh").write_text(msh(elements=LINES + ["3 2 9 9 4 5 2 1", CELLS[1]]))
(folder / "scene.prm").write_text(plane)
fine = run(folder / "scene.prm", {"Mesh/Type": "file", "Mesh/File": "mesh.msh",
                                  "Mesh/Refinements": 3,
                                  "Mesh/Side names": "low: 1, up: 2"})
text("clockwise cell", fine.summary["status"])
number("clockwise cell, active cells", fine.summary["active_cells"], 3)
