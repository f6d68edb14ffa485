# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""`moraine plot` makes pictures of a finished run, on a display or without."""

import os
import struct
import subprocess

finished = run("tests/bad-input/base.prm", {
    "Probes/tip/Location": "4.5, 2.5"})


def plot(*words, environment=None):
    process = subprocess.run([str(program), "plot", *map(str, words)],
                             capture_output=True, text=True, cwd=folder,
                             env={**os.environ, **(environment or {})})
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
# A display that does not answer must not end in a core dump.
text("no display", plot(finished.folder, "--field", "volume",
                        environment={"DISPLAY": ":4321"}))
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
