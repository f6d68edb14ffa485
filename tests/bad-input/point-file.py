# ranks: 1
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Rows of a point file that are wrong are named by their line."""

good = "x,y,volume\n1.25,1.25,0.25\n1.75,1.25,0.25\n"


def refused(name, content, settings=None):
    file = folder / "points.csv"
    if content is None:
        file.unlink(missing_ok=True)
    else:
        file.write_text(content)
    result = run("tests/bad-input/base.prm", {
        "Bodies/block/Shape": "points-from-file",
        "Bodies/block/Lower corner": "", "Bodies/block/Upper corner": "",
        "Bodies/block/Point file": file, **(settings or {})}, expect=2)
    lines = [line for line in result.output.splitlines() if line.strip()]
    text(name, plain(" | ".join(lines)))
    if (result.folder / "history.csv").exists():
        text(name, "NO, a folder was made")


refused("no file", None)
refused("no points", "x,y,volume\n")
refused("wrong header", good.replace("volume", "mass"))
refused("text for a number", good + "two,1.25,0.25\n")
refused("nan", good + "nan,1.25,0.25\n")
refused("a value too few", good + "2.25,1.25\n")
refused("negative volume", good + "2.25,1.25,-0.25\n")
refused("zero volume", good + "2.25,1.25,0\n")
refused("outside the mesh", good + "20,1.25,0.25\n")
refused("outside the mesh, after an empty line", good + "\n20,1.25,0.25\n")
refused("a point twice", good + "2.25,1.25,0.25\n\n1.25,1.25,0.3\n")
refused("a point twice, but for round-off", good + "1.7500000001,1.25,0.25\n")
refused("one long line", ",".join(["1"] * 2000000))
refused("one long row", good + ",".join(["1"] * 2000000))
refused("a column that every point has", good.replace("volume", "volume,stress")
        .replace("0.25\n", "0.25,1\n"))
refused("a column that XML would not take", good.replace("volume", 'volume,"a"')
        .replace("0.25\n", "0.25,1\n"))
refused("a column that archives have", good.replace("volume", "volume,order")
        .replace("0.25\n", "0.25,1\n"))
for column in "velocity", "initial_volume", "phi/deg":
    refused(f"a column {column}", good.replace("volume", f"volume,{column}")
            .replace("0.25\n", "0.25,1\n"))
other = folder / "other.csv"
other.write_text("x,y,volume\n2.25,1.25,0.25\n1.75,1.25,0.25\n")
refused("a point in two bodies", good, {
    "Bodies/more/Shape": "points-from-file", "Bodies/more/Point file": other})
for key, value in ("Rotation angle", "25"), ("Translation", "1, 0"):
    refused(f"points that are to move, {key}", good, {f"Bodies/block/{key}": value})
