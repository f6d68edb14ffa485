# ranks: 1
# debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Runs that are killed or told to end (SIGTERM) at random moments and resumed are
those never stopped.

MORAINE_KILLS=50 in the environment kills as often, spread over the scenes."""

import csv
import os
import random
import re
import shutil
import signal
import subprocess
import time

KILLS = int(os.environ.get("MORAINE_KILLS", "8"))
moments = random.Random(2026)

# On several ranks a direct solver (MUMPS) does not repeat itself bit by bit.
SCENES = {
    "plastic CPDI collapse": (
        "prm/large-deformation/collapse.prm", {"Method/Method": "CPDI1"}, 1),
    "domains of CPDI2 that are halved": (
        "prm/large-deformation/bar-stretched.prm",
        {"Method/Method": "CPDI2", "Time/Steps": 40}, 1),
    "twist on a moving mesh": (
        "prm/wang-2018/twist-80-cpdi1.prm", {}, 1),
    "dynamics with absorbing boundaries": (
        "prm/dynamics/cavity-pulse.prm", {}, 1),
    "steps in two parts, points that move": (
        "prm/phuong-2023/column-viscous-gimp.prm",
        {"Time/Integrator": "Bathe", "Loads/pulse/Curve": 0.1,
         "Time/End time": 0.2, "Time/Steps": 80}, 1),
    "pressure that follows": (
        "prm/large-deformation/pressurised-tube.prm",
        {"Mesh/Cells": "10, 10", "Time/Steps": 40}, 1),
    "contact that slides": (
        "prm/dynamics/sliding-block.prm", {}, 1),
    "3D on 3 ranks": (
        "prm/large-deformation/stretch-3d.prm", {"Solver/Solver": "gmres"}, 3),
}


def begin(words, n, quiet=("-q",)):
    launcher = ["mpirun", *quiet, "-n", str(n)] if n > 1 else []
    return subprocess.Popen(launcher + [str(program)] + words, cwd=folder,
                            stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                            text=True)


def children(pid):
    try:
        with open(f"/proc/{pid}/task/{pid}/children") as file:
            return [int(word) for word in file.read().split()]
    except OSError:
        return []


def is_alive(pid):
    try:
        with open(f"/proc/{pid}/stat") as file:
            return file.read().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


def kill(process):
    """All of its ranks at once; False if it has ended."""
    if process.poll() is not None:
        return False
    victims = children(process.pid) + [process.pid]
    for pid in victims:
        try:
            os.kill(pid, signal.SIGKILL)
        except ProcessLookupError:
            pass
    process.communicate()
    while any(is_alive(pid) for pid in victims):
        time.sleep(0.01)
    return True


def tell_to_end(process):
    """By SIGTERM; False if it had ended."""
    process.terminate()
    output = process.communicate(timeout=60)[0]
    if process.returncode == 0:
        return False
    # Before it reads its scene nobody listens.
    assert process.returncode == -signal.SIGTERM or "by the user" in output, output
    return True


def first_words(scene, settings, out):
    words = ["run", str(root / scene), "--output", str(out), "--overwrite"]
    for key, value in settings.items():
        words += ["--set", f"{key} = {value}"]
    return words


def finish(words, n):
    process = begin(words, n)
    output = process.communicate(timeout=600)[0]
    assert process.returncode == 0, output
    return output


def killed_runs(scene, settings, n, out, seconds, kills, compare):
    """Kill runs and go on with them, so often; compare what comes out when one
    ends."""
    while True:
        if not (out / "checkpoints" / "last").exists():
            words = first_words(scene, settings, out)
        else:
            words = ["resume", str(out)]
        start = time.time()
        process = begin(words, n)
        try:
            wait = moments.uniform(0.1, 0.9) * seconds if kills > 0 else 600
            output = process.communicate(timeout=wait)[0]
        except subprocess.TimeoutExpired:
            by_signal = n == 1 and moments.random() < 0.5
            kills -= (tell_to_end if by_signal else kill)(process)
            continue
        assert process.returncode == 0, output
        compare()
        if kills <= 0:
            return
        shutil.rmtree(out)
        if "run" in words:
            seconds = time.time() - start  # it was faster than the first


def pvd_entries(path):
    return re.findall(r"<DataSet.*", path.read_text())


def steps_in_log(path):
    """What the log says of steps, without the notes of those who went on."""
    lines = re.split(r"\n  part[ ,]", path.read_text())[0].splitlines()
    return [line for line in lines
            if "results in" not in line and "goes on after" not in line]


def values(path):
    with open(path) as file:
        rows = list(csv.reader(file))
    return rows[0], [[float(x) for x in row] for row in rows[1:]]


for number_of_scene, (name, (scene, settings, n)) in enumerate(SCENES.items()):
    settings = {**settings, "Output/Checkpoint every": "1 step",
                "Output/Every": 4}
    reference, out = (folder / f"{kind} {number_of_scene}"
                      for kind in ("whole", "killed"))
    start = time.time()
    finish(first_words(scene, settings, reference), n)
    seconds = time.time() - start
    differ = set()

    def compare():
        if (reference / "history.csv").read_bytes() != (
                out / "history.csv").read_bytes():
            differ.add("history.csv")
        for series in ("points", "mesh"):
            a, b = ([*pvd_entries(run / f"{series}.pvd"),
                     *sorted(p.name for p in (run / series).iterdir())]
                    for run in (reference, out))
            if a != b:
                differ.add(f"{series}.pvd")
        if steps_in_log(reference / "log.txt") != steps_in_log(out / "log.txt"):
            differ.add("log.txt")

    kills = KILLS // len(SCENES)
    killed_runs(scene, settings, n, out, seconds, kills, compare)
    text(f"{name}, killed {kills} x", "bits of history.csv, files in the .pvd, "
         "lines of log.txt are the same" if not differ else f"NO: {differ}")


# Begun on one rank, ended on others.
for name in "plastic CPDI collapse", "domains of CPDI2 that are halved":
    scene, settings, n = SCENES[name]
    settings = {**settings, "Output/Checkpoint every": "20 steps"}
    out = folder / "ranks"
    finish(first_words(scene, settings, out), 1)
    titles, one = values(out / "history.csv")
    saved = folder / "saved"
    shutil.rmtree(saved, ignore_errors=True)
    shutil.copytree(out, saved)
    for n in (2, 3):
        shutil.rmtree(out)
        shutil.copytree(saved, out)
        finish(["resume", str(out), "--from", "20"], n)
        more = values(out / "history.csv")
        assert more[0] == titles and len(more[1]) == len(one)
        units = [title.rpartition("[")[2] for title in titles]
        # What is smaller than 1e-3 throughout may be zero but for round-off.
        scale = {unit: max(1e-3, *(abs(row[c]) for row in one
                                   for c in range(len(titles))
                                   if units[c] == unit))
                 for unit in units}
        worst = max(abs(a - b) / scale[unit] for x, y in zip(one, more[1])
                    for a, b, unit in zip(x, y, units))
        bound(f"{name}, resumed on {n} ranks, difference", worst, 1e-12)


# A rank that is killed takes the others with it, at once and with a word.
out = folder / "rank"
settings = {**SCENES["3D on 3 ranks"][1], "Output/Checkpoint every": "1 step",
            "Time/Steps": 2000}
process = begin(first_words(SCENES["3D on 3 ranks"][0], settings, out), 3, ())
while not (out / "checkpoints" / "last").exists():
    time.sleep(0.05)
ranks_of_run = children(process.pid)
os.kill(ranks_of_run[1], signal.SIGKILL)
killed = time.time()
output = process.communicate(timeout=60)[0]
while any(is_alive(pid) for pid in ranks_of_run):
    time.sleep(0.05)
bound("one rank killed: seconds to the end of all", time.time() - killed, 10)
text("  exit code", "an error" if process.returncode != 0 else "NO")
text("  it says so", "yes" if "signal 9" in output else f"NO: {output}")
text("  it can be resumed", "yes" if "goes on after step" in finish(
    ["resume", str(out), "--set", "Time/Steps = 30"], 3) else "NO")
