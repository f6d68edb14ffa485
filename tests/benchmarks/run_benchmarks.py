#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors

"""Speed and memory: run the benchmark program, write a CSV with what was
measured and what is allowed, and exit with 1 if a threshold is missed.

Ratios compare runs on the same machine a moment apart; times are medians. Of
one process they are processor seconds, of several ranks and of whole programs
wall seconds, so the cases "ranks", "contact", "plastic3d" and "peers" need an
idle machine.
"""

import argparse
import csv
import json
import math
import os
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
from fork_server import Starter

COLUMNS = ["case", "quantity", "value", "unit", "allowed", "holds", "revision",
           "host", "load_before"]


class Bench:
    def __init__(self, arguments):
        self.benchmark = Starter(arguments.program)
        self.moraine = Starter(
            pathlib.Path(arguments.program).parents[2] / "moraine")
        self.source = arguments.source
        self.repeats = arguments.repeats
        self.smoke = arguments.smoke
        self.rows = []
        self.common = {
            "revision": subprocess.run(
                ["git", "-C", self.source, "describe", "--always", "--dirty"],
                capture_output=True, text=True).stdout.strip() or "unknown",
            "host": os.uname().nodename + ", " + str(os.cpu_count()) + " cores",
        }

    def run(self, benchmark, ranks=1, **options):
        """The numbers that one run of the program prints."""
        words = [benchmark]
        for name, value in options.items():
            words += ["--" + name.replace("_", "-"), str(value)]
        command = self.benchmark.command(words, ranks, ["mpirun"])
        result = subprocess.run(command, capture_output=True, text=True,
                                env=self.benchmark.environment())
        if result.returncode != 0:
            sys.exit(" ".join(command) + " failed: " + result.stderr)
        numbers = {}
        for line in result.stdout.splitlines():
            name, value = line.rsplit(" ", 1)
            numbers[name] = float(value)
        return numbers

    def run_scene(self, scene, settings, ranks=1):
        """Seconds of the whole program, and its summary."""
        with tempfile.TemporaryDirectory() as output:
            words = ["run", pathlib.Path(self.source) / scene,
                     "--output", output + "/o"]
            for key, value in {**settings, "Output/Points": "false",
                               "Output/Mesh": "false"}.items():
                words += ["--set", f"{key} = {value}"]
            command = self.moraine.command(words, ranks, ["mpirun"])
            environment = self.moraine.environment()
            start = time.monotonic()
            subprocess.run(command, check=True, capture_output=True,
                           env=environment)
            seconds = time.monotonic() - start
            summary = pathlib.Path(output, "o/summary.json").read_text()
            return seconds, json.loads(summary)

    def record(self, case, quantity, value, unit, allowed=None, at_least=False):
        holds = ""
        if allowed is not None and not self.smoke:
            holds = "yes" if (value >= allowed if at_least
                              else value <= allowed) else "NO"
        bound = "" if allowed is None else f"{'>=' if at_least else '<='} {allowed}"
        self.rows.append({"case": case, "quantity": quantity,
                          "value": f"{value:.4g}", "unit": unit,
                          "allowed": bound, "holds": holds,
                          "load_before": f"{os.getloadavg()[0]:.1f}",
                          **self.common})
        print(f"{case:10} {quantity:52} {value:10.4g} {unit:8} {bound:10} "
              f"{holds}", flush=True)

    def record_parts(self, case, prefix, numbers):
        for name, value in numbers.items():
            if name.startswith(prefix) and not name.endswith("iterations"):
                self.record(case, name, value, "s")
            elif name.endswith("iterations"):
                self.record(case, name, value, "-")

    # One process against a plain deal.II program.
    def case_fe(self):
        n = 20 if self.smoke else 400
        r = self.run("compare", cells=n, repeats=self.repeats)
        self.record_parts("fe", "", r)
        self.record("fe", "stencils + assembly over FEValues assembly",
                    (r["points stencils"] + r["points external forces"] +
                     r["points assembly"]) / r["elements assembly"], "-", 1.25)
        self.record("fe", "whole step over FE step",
                    r["points step"] / r["elements step"], "-", 1.4)

    # Many points in a cell against few.
    def case_points(self):
        n = 10 if self.smoke else 100
        own = {}
        for per_direction in (2, 10):
            r = self.run("points", cells=n, points=per_direction,
                         repeats=self.repeats * (1 if per_direction > 2 else 5))
            own[per_direction] = 1e6 / r["n_points"] * sum(
                r["points " + part] for part in
                ("stencils", "external forces", "assembly", "update and search"))
            self.record("points", f"own work at {per_direction ** 2} per cell",
                        own[per_direction], "us/point")
        self.record("points", "own work per point, 100 over 4 per cell",
                    own[10] / own[2], "-", 0.6)

    # 1.7 million points in 3D.
    def case_3d(self):
        n = 6 if self.smoke else 60
        r = self.run("points", dimension=3, cells=n, repeats=1)
        self.record("3d", "number of points", r["n_points"], "-")
        self.record("3d", "step", r["points step"], "s")
        self.record("3d", "peak memory", r["memory_peak_mib"] / 1024, "GiB", 8)

    # Growth with size.
    def case_growth(self):
        sizes = (10, 20) if self.smoke else (100, 200, 400, 800)
        time, memory = {}, {}
        for n in sizes:
            r = self.run("points", cells=n,
                         repeats=max(3, self.repeats * 200 // (n + 200)))
            time[n] = r["points step"]
            memory[n] = r["memory_peak_mib"] - r["memory_before_mib"]
            self.record("growth", f"step with {n}^2 cells", time[n], "s")
            self.record("growth", f"memory with {n}^2 cells", memory[n], "MiB")
        self.record("growth", "bytes of fields of a 2D elastic point",
                    r["bytes_per_point"], "B", 120)
        first, last = sizes[0], sizes[-1]
        for name, of in (("time", time), ("memory", memory)):
            self.record("growth", f"exponent of {name}, {first}^2 to {last}^2",
                        math.log(of[last] / of[first]) /
                        (2 * math.log(last / first)), "-", 1.1)

    # Two ranks against one.
    def case_ranks(self):
        n = 20 if self.smoke else 400
        one, two = [], []
        for _ in range(1 if self.smoke else 3):
            one.append(self.run("points", cells=n, repeats=self.repeats,
                                wall=1)["points step"])
            two.append(self.run("points", ranks=2, cells=n,
                                repeats=self.repeats, wall=1)["points step"])
        self.record("ranks", "step on 1 rank", statistics.median(one), "s")
        self.record("ranks", "step on 2 ranks", statistics.median(two), "s")
        self.record("ranks", "1 rank over 2 ranks",
                    statistics.median(one) / statistics.median(two), "-", 1.7,
                    at_least=True)

    # The same body on a mesh nine tenths empty.
    def case_empty(self):
        n = 20 if self.smoke else 400
        tight = self.run("points", cells=n, height=n // 10,
                         repeats=self.repeats)
        empty = self.run("points", cells=n, height=n // 10, mesh_cells=n,
                         repeats=self.repeats)
        self.record("empty", "step on the tight mesh", tight["points step"], "s")
        self.record("empty", "step on the empty mesh", empty["points step"], "s")
        self.record("empty", "empty over tight mesh",
                    empty["points step"] / tight["points step"], "-", 1.5)

    # What finite strain and domains cost in an assembly.
    def case_methods(self):
        n = 20 if self.smoke else 200
        per_point = {}
        for method, strain, material in (
                ("mpm", "small", "elastic"), ("mpm", "finite", "plastic"),
                ("gimp", "finite", "plastic"), ("cpdi1", "finite", "plastic"),
                ("cpdi2", "finite", "plastic")):
            r = self.run("assembly", cells=n, repeats=3 * self.repeats,
                         method=method, strain=strain, material=material)
            per_point[method, strain] = r["points assembly"] / r["n_points"]
            self.record("methods", f"assembly, {method}, {strain} strain, "
                        f"{material}", 1e6 * per_point[method, strain], "us/point")
        finite = per_point["mpm", "finite"]
        self.record("methods", "finite strain, plastic over small, elastic",
                    finite / per_point["mpm", "small"], "-", 3)
        for method in ("gimp", "cpdi1", "cpdi2"):
            self.record("methods", f"{method} over standard MPM",
                        per_point[method, "finite"] / finite, "-", 2)

    # What means of cells cost in an assembly, both ways in turn, and in a scene
    # whose rim leaves cells filled to less than a tenth.
    def case_means(self):
        for dimension, n in ((2, 10), (3, 4)) if self.smoke else ((2, 80), (3, 14)):
            for method in ("fe", "gimp"):
                for strain, material, allowed in (
                        ("small", "elastic", 1.3), ("small", "plastic", 1.3),
                        ("finite", "plastic", 1.6)):
                    r = self.run("means", dimension=dimension, cells=n,
                                 method=method, strain=strain,
                                 material=material, repeats=5 * self.repeats)
                    title = f"{dimension}D {method}, {strain} strain, {material}, "
                    self.record("means", title + "pointwise assembly",
                                1e6 * r["pointwise assembly"] / r["n_points"],
                                "us/point")
                    self.record("means", title + "means over pointwise",
                                r["means assembly"] / r["pointwise assembly"],
                                "-", allowed)
                    self.record("means", title + "residual",
                                r["means residual"] / r["pointwise residual"],
                                "-")
                    self.record("means", title + "entries of the matrix",
                                r["means nonzeros"] / r["pointwise nonzeros"],
                                "-")
        for strain, allowed in (("small", 1.3), ("finite", 1.6)):
            assembly, iterations = {}, {}
            for _ in range(min(3, self.repeats)):
                for volumetric in ("pointwise", "cell mean"):
                    _, summary = self.run_scene(
                        "prm/large-deformation/slump-3d.prm",
                        {"Method/Method": "GIMP", "Method/Strain": strain,
                         "Method/Volumetric strain": volumetric,
                         "Mesh/Cells": "6, 6, 4" if self.smoke else "24, 24, 16",
                         "Solver/Direct limit 3D": 1000})
                    iterations[volumetric] = summary["newton_iterations"]
                    assembly.setdefault(volumetric, []).append(
                        summary["timings"]["assembly"]
                        / summary["newton_iterations"])
            title = f"cube, GIMP, {strain} strain, "
            for volumetric, of in assembly.items():
                self.record("means", f"{title}{volumetric}, iterations",
                            iterations[volumetric], "-")
            self.record("means", title + "means over pointwise",
                        min(assembly["cell mean"]) / min(assembly["pointwise"]),
                        "-", allowed)

    # A million points in 3D at finite strain: mean Newton iteration of a run.
    def case_plastic3d(self):
        n, margin = (8, 0.125) if self.smoke else (50, 0.02)
        iteration = {}
        for ranks in (1, 2):
            _, summary = self.run_scene(
                "prm/large-deformation/slump-3d.prm",
                {"Mesh/Lower corner": f"{-margin}, {-margin}, 0",
                 "Mesh/Upper corner": f"{1 + margin}, {1 + margin}, 1",
                 "Mesh/Cells": f"{n + 2}, {n + 2}, {n}",
                 "Solver/Direct limit 3D": 1000}, ranks)
            prefix = f"{ranks} rank{'s' * (ranks - 1)}, "
            for name in ("points", "unknowns", "newton_iterations",
                         "linear_iterations"):
                self.record("plastic3d", prefix + name, summary[name], "-")
            parts = {name: summary["timings"][name]
                     / summary["newton_iterations"]
                     for name in ("assembly", "residual", "solver set up",
                                  "solve")}
            for name, seconds in parts.items():
                self.record("plastic3d", f"{prefix}an iteration, {name}",
                            seconds, "s")
            iteration[ranks] = sum(parts.values())
            self.record("plastic3d", f"{prefix}an iteration",
                        iteration[ranks], "s")
            self.record("plastic3d", f"{prefix}peak memory",
                        summary["peak_memory_mib"] / 1024, "GiB", 12)
        self.record("plastic3d", "an iteration, 1 rank / 2 ranks",
                    iteration[1] / iteration[2], "-", 1.5, at_least=True)

    # A step with inertia against a static one of the same scene, which is one
    # Newton iteration: what ten further steps of a run take.
    def case_dynamics(self):
        n = 20 if self.smoke else 400
        block = {"Mesh/Upper corner": f"1, {1 + 1 / n}",
                 "Mesh/Cells": f"{n}, {n + 1}", "Solver/Direct limit 2D": 100}
        seconds = {"quasi-static": [], "Newmark": []}
        iterations = {}
        for _ in range(min(3, self.repeats)):
            for integrator, of in seconds.items():
                taken, linear = {}, {}
                for steps in (2, 12):
                    _, summary = self.run_scene(
                        "prm/large-deformation/block-100.prm",
                        {**block, "Time/Integrator": integrator,
                         "Time/Steps": steps, "Time/End time": 0.001 * steps})
                    taken[steps] = (summary["wall_seconds"]
                                    - summary["timings"]["set up"])
                    linear[steps] = summary["linear_iterations"]
                    if summary["newton_iterations"] != steps:
                        sys.exit("a step took more than one iteration")
                of.append((taken[12] - taken[2]) / 10)
                iterations[integrator] = (linear[12] - linear[2]) / 10
        for integrator, of in seconds.items():
            self.record("dynamics", f"{integrator}, a step", min(of), "s")
            self.record("dynamics", f"{integrator}, CG iterations of a step",
                        iterations[integrator], "-")
        self.record("dynamics", "dynamic over static step",
                    min(seconds["Newmark"]) / min(seconds["quasi-static"]), "-",
                    1.15)
        self.record("dynamics", "CG iterations, dynamic over static step",
                    iterations["Newmark"] / iterations["quasi-static"], "-", 1)

    # A million points of GIMP in 3D at finite strain, ten steps with inertia.
    def case_dynamics3d(self):
        n = 8 if self.smoke else 50
        seconds = {}
        for ranks in (1, 2):
            _, summary = self.run_scene(
                "prm/large-deformation/slump-3d.prm",
                {"Mesh/Lower corner": f"{-1 / n}, {-1 / n}, 0",
                 "Mesh/Upper corner": f"{1 + 1 / n}, {1 + 1 / n}, 1",
                 "Mesh/Cells": f"{n + 2}, {n + 2}, {n}",
                 "Method/Method": "GIMP", "Time/Integrator": "Newmark",
                 "Time/Steps": 10, "Time/End time": 0.05,
                 "Solver/Direct limit 3D": 1000}, ranks)
            prefix = f"{ranks} rank{'s' * (ranks - 1)}, "
            for name in ("points", "unknowns", "newton_iterations",
                         "linear_iterations"):
                self.record("dynamics3d", prefix + name, summary[name], "-")
            for name, part in sorted(summary["timings"].items()):
                self.record("dynamics3d", prefix + name, part, "s")
            seconds[ranks] = summary["wall_seconds"]
            self.record("dynamics3d", f"{prefix}ten steps", seconds[ranks], "s")
            self.record("dynamics3d", f"{prefix}peak memory",
                        summary["peak_memory_mib"] / 1024, "GiB", 4)
        self.record("dynamics3d", "1 rank / 2 ranks", seconds[1] / seconds[2],
                    "-", 1.7, at_least=True)

    # Against the seconds that other programs took on a machine of the same kind:
    # whole runs of AMPLE 1.1 under Octave 7.3, start of our program included, and
    # a step of geomechanics/mpm (sparse LDL^T), all that follows the set-up.
    def case_peers(self):
        column = "prm/large-deformation/column-gimp.prm"
        collapse = "prm/large-deformation/collapse.prm"
        beam = "prm/large-deformation/beam-gimp.prm"
        block = "prm/large-deformation/block-100.prm"
        six = {"Method/Points per direction": 6}
        for title, scene, settings, seconds, n_steps, allowed in (
                ("AMPLE, column, 64 cells", column, {}, 34.6, 1, 300),
                ("AMPLE, collapse, h = 1", collapse, {"Mesh/Cell size": 1},
                 68, 1, None),
                ("AMPLE, collapse, h = 0.5", collapse, {}, 288, 1, 300),
                ("AMPLE, cantilever, 6x6, h = 0.5", beam, six, 383, 1, None),
                ("AMPLE, cantilever, 6x6, h = 0.25", beam,
                 {**six, "Mesh/Cell size": 0.25}, 1784, 1, None),
                ("mpm, block, a step, small strain", block, {}, 0.36, 10, 5),
                ("mpm, block, a step, finite strain", block,
                 {"Method/Strain": "finite"}, 0.60, 10, 5)):
            if self.smoke and scene != block:
                continue
            if self.smoke:
                settings = {**settings, "Mesh/Cells": "10, 11", "Mesh/Upper corner":
                            "1, 1.1", "Time/Steps": 1}
            times, computed = [], []
            for _ in range(min(3, self.repeats)):
                seconds_taken, summary = self.run_scene(scene, settings)
                computed.append(summary["wall_seconds"])
                if scene == block:
                    seconds_taken = computed[-1] - summary["timings"]["set up"]
                times.append(seconds_taken)
            taken = statistics.median(times)
            self.record("peers", title, taken / n_steps, "s")
            if scene != block:
                self.record("peers", f"{title}, without the start",
                            statistics.median(computed), "s")
            self.record("peers", f"{title}, times faster",
                        seconds * n_steps / taken, "-", allowed, at_least=True)

    # A footing that touches the ground against one that holds it.
    def case_contact(self):
        text = (pathlib.Path(self.source) / "prm/cortis-2017/footing.prm").read_text()
        contact = "set Constraint = contact\n"
        for name, held, touches in (("smooth", "roller", contact),
                                    ("rough", "fixed", contact + "set Friction = 0.5")):
            taken = {"held": [], "touches": []}
            for _ in range(self.repeats):
                for how, keys in (("held", f"set Constraint = {held}"),
                                  ("touches", touches)):
                    with tempfile.TemporaryDirectory() as folder:
                        scene = pathlib.Path(folder, "footing.prm")
                        # The face of the footing alone: it presses by a cell or two.
                        scene.write_text(re.sub(
                            r"  subsection footing\n.*?\nend\n",
                            "subsection footing\nset Points = 0.5 3; 0 3\n"
                            f"set Translation = 0; -0.2*t\n{keys}\nend\nend\n",
                            text, flags=re.DOTALL))
                        whole_run, _ = self.run_scene(scene, {
                            "Mesh/Cell size": 0.2 if self.smoke else 0.1,
                            "Mesh/Lower corner": "-0.3, -0.25",
                            "Mesh/Upper corner": "3.3, 3.75",
                            "Time/Steps": 1 if self.smoke else 10})
                        taken[how].append(whole_run)
            seconds = {how: statistics.median(times) for how, times in taken.items()}
            self.record("contact", f"{name} footing that touches", seconds["touches"], "s")
            self.record("contact", f"{name} footing, touches over held",
                        seconds["touches"] / seconds["held"], "-", 1.3)

    # Cells of points on a mesh that is no box against a box.
    def case_search(self):
        for dimension, n in ((2, 16), (3, 4)) if self.smoke else ((2, 200), (3, 30)):
            r = self.run("search", dimension=dimension, cells=n,
                         repeats=self.repeats)
            for mesh in ("bent", "annulus") if dimension == 2 else ("bent",):
                if r[f"{mesh} points"] != r["box points"]:
                    sys.exit("the meshes have different numbers of points")
                self.record("search", f"points that cross, {mesh}, {dimension}D",
                            r[f"{mesh} crossings"], "-")
                self.record("search", f"{mesh} cells over box, {dimension}D",
                            r[f"{mesh} search"] / r["box search"], "-", 2)
            self.record("search", f"points that cross, box, {dimension}D",
                        r["box crossings"], "-")
            self.record("search", f"box, {dimension}D",
                        1e6 * r["box search"] / r["box points"], "us/point")


CASES = ["fe", "points", "3d", "growth", "ranks", "empty", "search", "methods",
         "means", "contact", "plastic3d", "dynamics", "dynamics3d", "peers"]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", required=True)
    parser.add_argument("--source",
                        default=str(pathlib.Path(__file__).resolve().parents[2]))
    parser.add_argument("--csv", default="benchmarks.csv")
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--smoke", action="store_true",
                        help="smallest sizes; nothing is judged")
    parser.add_argument("cases", nargs="*", metavar="case",
                        help="of " + ", ".join(CASES) + "; all if none")
    arguments = parser.parse_args()
    unknown = set(arguments.cases) - set(CASES)
    if unknown:
        parser.error("unknown case " + ", ".join(sorted(unknown)))
    if arguments.smoke:
        arguments.repeats = 1

    bench = Bench(arguments)
    try:
        for case in arguments.cases or CASES:
            getattr(bench, "case_" + case)()
    finally:
        with open(arguments.csv, "w", newline="") as file:
            writer = csv.DictWriter(file, COLUMNS)
            writer.writeheader()
            writer.writerows(bench.rows)
    missed = [row for row in bench.rows if row["holds"] == "NO"]
    for row in missed:
        print(f"missed: {row['case']}: {row['quantity']} is {row['value']}, "
              f"allowed {row['allowed']}")
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
