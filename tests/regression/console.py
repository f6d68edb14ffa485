# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""What is shown on a terminal, in a file, with --quiet and --verbose; --help."""

import os
import pty
import re
import subprocess

scene = "tests/bad-input/base.prm"
hencky = {"Method/Strain": "finite", "Method/Mesh after step": "reset"}


def lines(result):
    return result.output.splitlines()


def on_terminal(words):
    """What a program writes to a terminal."""
    own, of_program = pty.openpty()
    process = subprocess.Popen(words, stdout=of_program, stderr=of_program,
                               cwd=folder)
    os.close(of_program)
    shown = b""
    while True:
        try:
            piece = os.read(own, 4096)
        except OSError:
            break
        if not piece:
            break
        shown += piece
    text("terminal: exit code", process.wait())
    return shown.decode()


normal = run(scene, hencky)
text("in a file: progress", "YES" if "\033" in normal.output else "none")
text("in a file: lines of steps",
     sum(line.startswith("  step ") for line in lines(normal)))
text("in a file: lines of iterations",
     sum(line.startswith("      iteration ") for line in lines(normal)))

quiet = run(scene, hencky, extra=["--quiet"])
shown = [line for line in lines(quiet) if line.strip()]
text("quiet: lines", len(shown))
text("quiet: last line", re.sub(r"in \S+ s", "in ... s", shown[-1]))
log = (quiet.folder / "log.txt").read_text()
text("quiet: lines of steps in log.txt", log.count("\n  step "))
faulty = run(scene, {**hencky, "Boundaries/left/Translation": "0; -0.8*t"},
             extra=["--quiet"], expect=1)
text("quiet: a failure is shown", "ended early" in faulty.output)

verbose = run(scene, hencky, extra=["--verbose"])
n_iterations = verbose.summary["newton_iterations"]
found = [line for line in lines(verbose)
         if line.startswith("      iteration ")]
text("verbose: one line for each iteration", len(found) == n_iterations)
text("verbose: first line", re.sub(r"residual \S+", "residual ...", found[0]))
gmres = run(scene, {**hencky, "Solver/Solver": "gmres"}, extra=["--verbose"])
linear = re.findall(r"iteration \d+ .* linear (\d+)", gmres.output)
text("verbose: linear iterations add up",
     sum(map(int, linear)) == gmres.summary["linear_iterations"] > 0)

shown = on_terminal([str(program), "run", str(root / scene), "--output",
                     str(folder / "terminal"), "--set", "Method/Strain = finite"])
progress = re.findall(r"\r\033\[K(  step [^\r\033]+)", shown)
progress = [line for line in progress if "iteration " in line]
text("terminal: progress", "is shown" if progress else "NONE")
text("terminal: first", re.sub(r"residual \S+", "residual ...", progress[0]))
text("terminal: time left", bool(re.search(r"about \d+ s left$", progress[-1])))
text("log of it: progress",
     "YES" if "about" in (folder / "terminal/log.txt").read_text() else "none")

# An order is printed only where three residuals near the solution show it.
orders = [float(o) for o in re.findall(r"order (\S+)", normal.output)]
text("order of few iterations", "none" if not orders else f"PRINTED {orders}")

# The clock of a run that goes on begins anew, and its table says so.
def times(result):
    return ", ".join(
        re.sub(r"\d+\.\d+", "...", " ".join(line.split()))
        for line in (result.folder / "log.txt").read_text().splitlines()
        if "share" in line or line.startswith(("  whole run", "  all since")))


saved = run(scene, {"Output/Checkpoint every": "1 step"})
text("times of it, run", times(saved))
run(saved.folder, command="resume", extra=["--from", "3"])
text("times of it, resumed", times(saved))

for words in (["--help"], ["run", "--help"], ["parameters", "--help"]):
    process = subprocess.run([str(program)] + words, capture_output=True,
                             text=True)
    text("moraine " + " ".join(words), process.returncode)
    for line in process.stdout.splitlines():
        text(" ", line)
wrong = run(scene, extra=["--from", "3"], expect=2)
text("option of another command", wrong.output.strip())
