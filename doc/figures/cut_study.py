# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""What helps where the mesh cuts little off a body: nothing, a stiffness of the empty
parts of cells, or nodes that follow their neighbours, or are held to them by springs.
Called with the program; writes cut-study.csv: a row for each way, method and place
with the displacement of the tip and the largest von Mises stress over those of the
block on mesh lines, iterations of GMRES with multigrid (500 if they do not do), the
seconds of the run, and, on cells of 1/8, the condition number over that on mesh
lines."""

import csv
import json
import pathlib
import random
import subprocess
import sys
from math import cos, hypot, radians, sin

from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

PROGRAM = sys.argv[1]
SCENE = str(pathlib.Path(__file__).parents[2] / "prm/hard-cases/cut-block.prm")
WAYS = {"free nodes": {"Aggregate below": 0},
        "stiffness 1e-8": {"Aggregate below": 0, "Fictitious stiffness": 1e-8},
        "stiffness 1e-4": {"Aggregate below": 0, "Fictitious stiffness": 1e-4},
        "stiffness 1e-2": {"Aggregate below": 0, "Fictitious stiffness": 1e-2},
        "aggregated below 0.1": {"Aggregate below": 0.1},
        "aggregated below 0.5": {"Aggregate below": 0.5},
        **{f"ghost factor {factor}": {"Cut cells": "ghost", "Ghost factor": factor}
           for factor in (0.01, 0.1, 1, 10)}}
METHODS = ("GIMP", "finite element")
H, COARSE = 1 / 32, 1 / 8


def places(n):
    random.seed(1)
    for _ in range(n):
        angle = random.choice([0, 17, 30, 45, random.uniform(0, 90)])
        little = [10 ** random.uniform(-8, -2) for _ in "xy"]
        yield angle, *(random.choice([random.random(), e, 1 - e])
                       for e in little)


def run(way, method, place, h, solver):
    angle, x, y = place
    c, s = cos(radians(angle)), sin(radians(angle))
    down = f"sin({angle}*pi/180); -cos({angle}*pi/180)"
    settings = {
        "Bodies/block/Rotation angle": angle,
        "Boundaries/support/Rotation angle": angle,
        "Loads/weight/Value": down, "Loads/end/Value": down,
        "Mesh/Lower corner": f"{-1 - x * h!r},{-1.5 - y * h!r}",
        "Mesh/Upper corner": f"{3 - x * h!r},{2.5 - y * h!r}",
        "Mesh/Cell size": h,
        "Probes/tip/Location": f"{1.99 * c - 0.5 * s!r},{1.99 * s + 0.5 * c!r}",
        "Method/Method": method, **solver,
        **{f"Method/{key}": value for key, value in WAYS[way].items()}}
    subprocess.run(
        [PROGRAM, "run", SCENE, "--output", "block", "--overwrite"] +
        [word for key, value in settings.items()
         for word in ("--set", f"{key} = {value}")],
        stdout=subprocess.DEVNULL, check=False)
    return json.loads(pathlib.Path("block/summary.json").read_text())


def measure(way, method, place):
    summary = run(way, method, place, H, {"Solver/Solver": "gmres"})
    iterations, seconds = summary["linear_iterations"], summary["wall_seconds"]
    if summary["status"] != "ok":
        summary = run(way, method, place, H, {"Solver/Solver": "direct"})
        iterations = 500
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(sorted(pathlib.Path("block/points").glob("*.vtu"))[-1]))
    reader.Update()
    stresses = reader.GetOutput().GetPointData().GetArray("von_mises_stress")
    stress = stresses.GetRange()[1]
    return (hypot(*list(summary["probes"].values())[:2]), stress, iterations,
            seconds)


def condition(way, method, place):
    return run(way, method, place, COARSE,
               {"Solver/Solver": "direct",
                "Solver/Estimate condition number": "true"})["condition_number"]


with open("cut-study.csv", "w", newline="") as file:
    table = csv.writer(file)
    table.writerow(("way", "method", "displacement", "stress", "iterations",
                    "seconds", "condition"))
    for method in METHODS:
        tip, stress, _, _ = measure("free nodes", method, (0, 0, 0))
        aligned = condition("free nodes", method, (0, 0, 0))
        for way in WAYS:
            for k, place in enumerate(places(40)):
                u, s, n, seconds = measure(way, method, place)
                table.writerow((way, method, u / tip - 1, s / stress, n, seconds,
                                condition(way, method, place) / aligned
                                if k < 12 else ""))
