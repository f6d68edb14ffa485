# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Runs scenes and prints what a test compares.

A test is tests/<label>/<name>.py beside <name>.output. It runs scenes with
run(), and prints with bound(), number() and text(). What it prints must equal
the .output file line by line; numbers are printed with the digits that matter,
so the comparison is exact and nothing passes by a tolerance hidden elsewhere.

    run("prm/cortis-2017/block-30.prm", {"Mesh/Cell size": 5})  -> Run
    bound("r_u", value, 1e-10)      prints  r_u <= 1e-10: yes
    number("torque", value, 4)      prints  torque 1.234e+00 (4 digits)
    text("status", "ok")

Runs are copies of a process that stands ready if ctest calls; see fork_server.py.
The first line may say '# ranks: 1', '# ranks: 2', and so on; else see CMakeLists.txt.
RANKS may be 1-2: every third run, the first one too, is on two ranks.
Called as  python3 scene_test.py TEST.py MORAINE RANKS [--update].
"""

import base64
import csv
import itertools
import json
import os
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import zlib

sys.dont_write_bytecode = True  # in a folder of sources
from fork_server import Starter

root = pathlib.Path(__file__).resolve().parent.parent
program = None
ranks = 1
printed = []
QUIET = {"Output/Points": "false", "Output/Mesh": "false"}
_folder = None
_starter = None
_count = 0
# Of scenes that must be refused every fourth runs on two ranks: starting them
# takes longest.
_refused = itertools.count()
_alternate = None


class Run:
    """The result of one run: exit code, output text, summary and history."""

    def __init__(self, code, output, folder):
        self.code = code
        self.output = output
        self.folder = folder
        summary = folder / "summary.json"
        self.summary = json.loads(summary.read_text()) if summary.exists() else {}
        self.errors = self.summary.get("errors", {})
        self.probes = self.summary.get("probes", {})
        self.reactions = self.summary.get("reactions", {})

    def found(self):
        """Ids of the diagnostics that found something, with their objects."""
        if "status" not in self.summary:  # 'check' has the console alone
            return re.findall(r"^  (?:warning|hint) +([a-z-]+(?: \([^)]*\))?):",
                              self.output, re.MULTILINE)
        return [one["id"] + (f" ({one['object']})" if one["object"] else "")
                for kind in ("warnings", "hints")
                for one in self.summary.get(kind, [])]

    def ids(self):
        return [one.split(" ")[0] for one in self.found()]

    def finding(self, which):
        """The one with this id."""
        return next(one for kind in ("warnings", "hints")
                    for one in self.summary.get(kind, []) if one["id"] == which)

    def history(self):
        """history.csv as a list of dictionaries; units are cut off names."""
        with open(self.folder / "history.csv") as file:
            return [
                {key.split(" [")[0]: float(value) for key, value in row.items()}
                for row in csv.DictReader(file)
            ]

    def study_rows(self):
        """Of study.csv."""
        with open(self.folder / "study.csv") as file:
            return list(csv.DictReader(file))

    def points(self, *names):
        """Fields of the points in the last VTU file, a tuple for each point;
        'position' is where they are, vectors have three numbers."""
        return self._fields("points", names)

    def nodes(self, *names):
        """The same of the mesh, for the nodes of each cell."""
        return self._fields("mesh", names)

    def contact(self, *names):
        """The same of the places of rims that may touch a surface."""
        return self._fields("contact", names)

    def _fields(self, kind, names):
        text = sorted((self.folder / kind).glob("*.vtu"))[-1].read_text()
        columns = []
        for name in names:
            label = r"<Points>\s*<DataArray" if name == "position" else \
                f'Name="{name}"'
            values = []
            for tag, data in re.findall(
                    label + r"([^>]*)>\s*(?:<Info.*?</InformationKey>)?"
                    r"\s*(\S+)\s*<", text):  # of each rank
                n = re.search(r'NumberOfComponents="(\d)"', tag)
                size = struct.unpack("<4I", base64.b64decode(data[:24]))[1]
                raw = zlib.decompress(base64.b64decode(data[24:]))
                letter = "d" if "Float64" in tag else "f"
                found = struct.unpack(
                    f"<{size // struct.calcsize(letter)}{letter}", raw)
                values += zip(*[iter(found)] * int(n[1])) if n else found
            columns.append(values)
        return list(zip(*columns))


def run(scene, settings=None, command="run", extra=(), expect=0, on_ranks=None):
    """Run a scene (path from the top of the project) into a fresh folder."""
    global _count
    _count += 1
    folder = _folder / str(_count)
    words = [command, str(root / scene)]
    n = on_ranks or ranks
    if _alternate is not None and not on_ranks and command != "check":
        if command != "resume":  # which is of the run before
            _alternate.append(2 if len(_alternate) % 3 == 0 else 1)
        n = (_alternate or [1])[-1]
    if expect == 2 and not on_ranks:
        n = 2 if next(_refused) % 4 == 0 else 1
    if command in ("run", "study"):
        words += ["--output", str(folder)]
    for key, value in (settings or {}).items():
        words += ["--set", f"{key} = {value}"]
    code, output = _ended(words + list(map(str, extra)), n, expect == 2)
    # What the event loop of MPI says under load is none of ours.
    output = re.sub(r"^\[warn\] Epoll .*\n", "", output, flags=re.MULTILINE)
    if expect is not None and code != expect:
        print(output)
        sys.exit(f"exit code {code}, expected {expect}: {words}")
    return Run(code, output, folder)


def _ended(words, n, refused):
    """Exit code and text of the program with these arguments on n ranks."""
    if n > 1:
        # Ranks that refuse end together: mpirun need not give the second, when
        # the first has ended, a second of time before it looks again.
        quick = ["--mca", "odls_base_sigkill_timeout", "0"] if refused else []
        process = subprocess.run(
            _starter.command(words, n, ["mpirun", "-q", *quick]),
            capture_output=True, text=True, cwd=_folder,
            env=_starter.environment())
        return process.returncode, process.stdout + process.stderr
    with tempfile.TemporaryDirectory(prefix="moraine-text-") as name:
        files = [pathlib.Path(name) / "out", pathlib.Path(name) / "err"]
        code = _starter.start(words, _folder, *files).wait()
        return code, "".join(file.read_text() for file in files)


def prm(text):
    """A scene of lines 'Section/Name/Key = value | Key = value'; 'Section/Name/' opens
    a section for the lines after it that are none of these, '/' closes all."""
    opened, lines = [], []
    for line in text.strip("\n").split("\n"):
        if line.startswith(("set ", "subsection ", "#", " ")) or not (
                " =" in line or line.endswith("/")):
            lines.append(line)
            continue
        path, _, key = line.partition(" =")[0].rpartition("/")
        path = path.split("/") if path else []
        same = len(os.path.commonprefix([path, opened]))
        lines += ["end"] * (len(opened) - same)
        lines += [f"subsection {name}" for name in path[same:]]
        opened = path
        if key:
            lines += [f"set {one}" for one in
                      line[line.index(key + " ="):].split(" | ")]
    return "\n".join(lines + ["end"] * len(opened)) + "\n"


def scene_file(name, *texts):
    path = _folder / name
    path.write_text("".join(map(prm, texts)))
    return path


def plain(output):
    """Text that a program printed, without folders that differ."""
    return output.replace(f"{_folder}/", "").replace(f"{root}/", "")


def text(name, value):
    printed.append(f"{name}: {value}")


def bound(name, value, limit):
    """Whether |value| <= limit; shows the value only if it is not."""
    ok = value is not None and abs(value) <= limit
    printed.append(f"{name} <= {limit:g}: " + ("yes" if ok else f"NO, {value}"))


def at_least(name, value, limit):
    ok = value is not None and value >= limit
    printed.append(f"{name} >= {limit:g}: " + ("yes" if ok else f"NO, {value}"))


def number(name, value, digits):
    printed.append(f"{name} {value:.{digits - 1}e}")


def main():
    global program, ranks, _alternate, _folder, _starter
    test = pathlib.Path(sys.argv[1]).resolve()
    program = pathlib.Path(sys.argv[2]).resolve()
    ranks = int(sys.argv[3][0])
    if sys.argv[3] == "1-2":
        _alternate = []
    _starter = Starter(program)
    _folder = pathlib.Path(tempfile.mkdtemp(prefix="moraine-"))
    try:
        names = {n: globals()[n] for n in
                 ("run", "prm", "scene_file", "plain", "text", "bound", "at_least",
                  "number", "root", "QUIET")}
        names["ranks"] = ranks
        names["program"] = program
        names["start"] = _starter.start
        names["folder"] = _folder
        exec(compile(test.read_text(), str(test), "exec"), names)
    finally:
        shutil.rmtree(_folder, ignore_errors=True)
    reference = test.with_suffix(".output")
    found = "\n".join(printed) + "\n"
    print(found, end="")
    if "--update" in sys.argv:
        reference.write_text(found)
        return
    expected = reference.read_text()
    if found != expected:
        import difflib
        sys.stdout.writelines(
            difflib.unified_diff(expected.splitlines(True),
                                 found.splitlines(True),
                                 "expected", "found"))
        sys.exit(1)


if __name__ == "__main__":
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    main()
