#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Error and cost of contact: peak and L2 error of Hertz's pressure under a cylinder, torque
of a ring that slides on a shaft (prm/studies/contact.prm), for methods, cells and
enforcements.

    contact_study.py PROGRAM [PAGE]

writes the table of doc/topics/contact.md. Times are processor seconds of whole runs."""

import csv
import math
import pathlib
import re
import resource
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "source" / "output"))
import render  # noqa: E402
from render import np  # noqa: E402

E, NU, R, P = 1000, 0.3, 10, 50
A = math.sqrt(4 * P * R * (1 - NU * NU) / (math.pi * E))
P0 = 2 * P / (math.pi * A)
# Method, width of the band of the augmented Lagrangian or none for Nitsche's method, size.
CASES = [("GIMP", None, 0), ("GIMP", None, 1), ("GIMP", None, 2), ("CPDI1", None, 2),
         ("finite element", None, 2), ("GIMP", 0.05, 0), ("GIMP", 0.05, 1),
         ("GIMP", 0.05, 2), ("GIMP", 0.1, 2), ("GIMP", 0.03, 2)]


def cylinder(h):
    """Half of the lower part of a cylinder, 7.5 wide, pressed on a plane."""
    n = math.ceil((7.5 + 1.37 * h) / h)
    sections = {
        "Mesh": {"Lower corner": f"0, {-1.37 * h}",
                 "Upper corner": f"{n * h}, {(n - 1.37) * h}",
                 "Cell size": h},
        "Method": {"Mesh after step": "keep"},
        "Materials/steel": {"Young modulus": E, "Poisson ratio": NU},
        "Bodies/disc": {"Shape": "disc", "Centre": f"0, {R}", "Radius": R},
        "Bodies/box": {"Lower corner": "0, 0", "Upper corner": "7.5, 7.5"},
        "Bodies/cylinder": {"Shape": "intersection", "Operands": "disc, box"},
        "Boundaries/plane": {"Points": "-1 0; 9 0", "Constraint": "contact"},
        "Grid conditions/axis": {"Side": "left", "Components": "x"},
        "Loads/top": {"Type": "surface traction", "Points": "7 7.5; 0 7.5",
                      "Value": f"0; {-P / 14}", "Curve": "t"},
        "Time": {"Steps": 2}}
    lines = ["set Dimension = 2"]
    for section, keys in sections.items():
        path = section.split("/")
        lines += [f"subsection {name}" for name in path]
        lines += [f"set {key} = {value}" for key, value in keys.items()]
        lines += ["end"] * len(path)
    return "\n".join(lines) + "\n"


def ring(h):
    """The scene of the study with one size of cells and without its series."""
    text = (ROOT / "prm" / "studies" / "contact.prm").read_text()
    text = text[:text.index("subsection Study")]
    return re.sub(r"\{\{.*?\}\}", str(h), text)


def settings(boundary, band):
    of = f"Boundaries/{boundary}/"
    if band is None:
        return "--set", of + "Enforcement = incomplete Nitsche"
    return ("--set", of + "Enforcement = augmented Lagrangian", "--set",
            of + f"Band width = {band}")


def run(program, text, boundary, method, band):
    """Last row of the history, last file of contact, processor seconds, Newton iterations."""
    with tempfile.TemporaryDirectory() as folder:
        scene = pathlib.Path(folder, "scene.prm")
        scene.write_text(text)
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        ended = subprocess.run([program, "run", scene, "--output", folder + "/o", "--set",
                        f"Method/Method = {method}",
                        *settings(boundary, band), "--set",
                        "Output/Points = false", "--set", "Output/Write = end"],
                       capture_output=True, text=True)
        if ended.returncode:
            sys.exit(f"{method}, band {band}: {ended.stdout[-500:]}{ended.stderr}")
        seconds = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
        with open(folder + "/o/history.csv") as file:
            row = list(csv.DictReader(file))[-1]
        files = sorted(pathlib.Path(folder, "o", "contact").glob("*.vtu"))
        data = render.Vtu(str(files[-1]))
        data = data.points, *(data.field(name) for name in ("traction", "size"))
    return {key.split(" [")[0]: float(value) for key, value in row.items()}, data, seconds


def hertz(program, h, method, band):
    _, (x, traction, size), seconds = run(program, cylinder(h), "plane", method, band)
    low = (x[:, 1] < 0.05 * R) & ((x[:, 0] > 1e-6) | (x[:, 1] < 1e-6))
    x, p, size = x[low, 0], traction[low, 1], size[low]
    exact = P0 * np.sqrt(np.maximum(0, 1 - (x / A) ** 2))
    l2 = math.sqrt((size * (p - exact) ** 2).sum() / (size * exact ** 2).sum())
    return p.max() / P0 - 1, l2, seconds


def torque(program, h, method, band):
    row, _, seconds = run(program, ring(h), "shaft", method, band)
    return row["moment of shaft"] / math.pi - 1, seconds


def main():
    program = str(pathlib.Path(sys.argv[1]).resolve())
    page = pathlib.Path(sys.argv[2]) if len(sys.argv) > 2 else \
        ROOT / "doc" / "topics" / "contact.md"
    lines = ["| method, band | h | p₀ | L2 error of pressure | time [s] | h of the ring | torque | time [s] |",
             "|---|---|---|---|---|---|---|---|"]
    for method, band, size in CASES:
        h, of_ring = 0.6 / 2 ** size, 0.25 / 2 ** size
        peak, l2, time = hertz(program, h, method, band)
        moment, time_of_ring = torque(program, of_ring, method, band)
        how = "Nitsche" if band is None else band
        lines.append(f"| {method}, {how} | {h} | {100 * peak:+.1f} % | {100 * l2:.0f} % | "
                     f"{time:.1f} | {of_ring} | {100 * moment:+.2f} % | "
                     f"{time_of_ring:.1f} |")
        print(lines[-1], flush=True)
    begin, end = "<!-- made by doc/figures/contact_study.py -->\n", "<!-- end -->"
    text = page.read_text()
    at = text.index(begin) + len(begin)
    page.write_text(text[:at] + "\n".join(lines) + "\n" + text[text.index(end, at):])


main()
