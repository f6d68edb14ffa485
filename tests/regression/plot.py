# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""`moraine plot` makes pictures of a finished run, each in a file of its own."""

import struct
import subprocess

finished = run("tests/bad-input/base.prm", {
    "Units": "m, kN, s", "Probes/tip/Location": "4.5, 2.5"})


def plot(*words):
    process = subprocess.run([str(program), "plot", *map(str, words)],
                             capture_output=True, text=True, cwd=folder)
    return process.returncode, plain(process.stdout + process.stderr).strip()


def png(path):
    """Size of a picture, and whether it shows more than one colour."""
    content = path.read_bytes()
    if content[:8] != b"\x89PNG\r\n\x1a\n":
        return "NO PNG"
    width, height = struct.unpack(">II", content[16:24])
    shows = "something" if len(content) > width * height / 100 else "NOTHING"
    return f"{width > 400 and height > 200}, shows {shows}"


text("without options", plot(finished.folder))
text("stress", plot(finished.folder, "--field", "stress", "--component", "yy"))
text("another step", plot(finished.folder, "--field", "stress",
                          "--component", "yy", "--step", 1))
text("with the mesh", plot(finished.folder, "--mesh"))
text("a curve", plot(finished.folder, "--history", "u_y at tip", "-o",
                     folder / "curve.png"))
text("mesh of a step", plot(finished.folder, "--of", "mesh", "--step", 1,
                            "--field", "step_displacement", "-o",
                            folder / "mesh.png"))
for path in sorted((finished.folder / "plots").glob("*")) + \
        [folder / "curve.png", folder / "mesh.png"]:
    text(path.name, png(path))
text("unknown field", plot(finished.folder, "--field", "strss"))
text("unknown column", plot(finished.folder, "--history", "u_z"))
text("no such step", plot(finished.folder, "--field", "stress", "--step", 77))
text("no folder", plot(folder / "none", "--history"))
text("nothing of that name", plot(folder / "none"))

solid = run("prm/verification/mesh-quads-3d.prm")
text("in 3D", plot(solid.folder, "--field", "von_mises_stress", "-o",
                   folder / "solid.png"))
text("solid.png", png(folder / "solid.png"))
text("nothing cut away", plot(solid.folder, "--whole"))
text("a table", plot(solid.folder, "--field", "mean_stress", "-o",
                     folder / "table.csv"))
rows = (folder / "table.csv").read_text().splitlines()
text("table.csv", (rows[0], len(rows) - 1 == solid.summary["points"]))

wall = run("prm/geotechnics/retaining-wall.prm", {"Time/Steps": 2})
text("tractions on a rim", plot(wall.folder, "--of", "contact"))
text("of-contact.png", png(wall.folder / "plots" / "of-contact.png"))
text("before the first step", plot(wall.folder, "--of", "contact", "--step", 0))
text("no contact", plot(finished.folder, "--of", "contact"))
text("a field of it", plot(wall.folder, "--of", "contact", "--field", "gap"))
