#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Runs mutated scenes: whatever is in a file, the program ends in order.

    fuzz.py MORAINE [--seed 1] [--cases 100] [--first 0] [--keep DIR]

Each case is a scene of prm/, shortened to two steps, with one to three changes:
numbers, words, lines, sections, bytes, methods, motions, a boundary that meets
others, inertia, stages. Every third has checkpoints and goes on from one. It must end with 0, 1 or 2; say
why in one line if that is not 0; get no signal; not be silent until its time is
over (a scene that says what it simulates may take its time: it is stopped); and
leave either no folder or one that is complete, with summary.json. A case follows
from seed and number alone; --first N --cases 1 repeats it, --keep shows it.
"""

import argparse
import json
import pathlib
import random
import re
import shutil
import subprocess
import sys
import tempfile

root = pathlib.Path(__file__).resolve().parents[2]
sys.dont_write_bytecode = True  # in a folder of sources
sys.path.insert(0, str(root / "tests"))
from fork_server import Starter

TIMEOUT = 30  # seconds

# Too long until the first step ends, or studies: run one by one elsewhere.
LONG = {"twist-10-fine", "tube-implicit", "tube-mesh", "slump-3d", "collapse",
        "block-study", "hollow-sphere", "twist-3d", "stretch-3d"}

NUMBERS = ["0", "-1", "1", "-0.5", "1e-300", "1e300", "1e9", "2147483648",
           "4294967295", "nan", "inf", "-inf", "1e-8", "0.49999999", "0.5",
           "7", "3.3", "1/0", "sqrt(-1)", "2*3", "$none", "1e", "--1", "0x10"]
# Where a large number is a large computation, which is nobody's mistake.
SIZES = ("Cell", "Points per direction", "Point grid", "Refinements",
         "Arguments", "Extrusion", "Steps", "step")
SMALL = [n for n in NUMBERS if n not in ("1e9", "1e-8", "7")]
WORDS = ["", "text", "x", "t", "x;y", "0,0", "0;0;0;0", "rand()", "true",
         "sin(50*x)*sin(50*y)", "x*", "(", "1/x", "log(x-1e9)", "{{1|2}}",
         "{{", "0: 0, 1: 1", "1: 0, 0: 1", "a: b", "left", "../x", "é", "'",
         '"', "|", "<b>", "$", "%s", "0 0; 1 0", "\\"]
# Of place and time; some are numbers at the start only.
EXPRESSIONS = ["0", "0.01*t", "sqrt(-1)", "0.01*sqrt(0.5-t)", "1/(t-1)", "log(x)",
               "0.01*(sqrt(0.5-t)-sqrt(0.5))", "0.01*t*sqrt(y-1)", "1e300*t"]
# Keys of these sections, and whether they have one for each coordinate.
OF_TIME = {("Boundaries", "Displacement"): True, ("Boundaries", "Translation"): True,
           ("Boundaries", "Rotation angle"): False, ("Loads", "Value"): True,
           ("Grid conditions", "Displacement"): True,
           ("Grid conditions", "Translation"): True, ("Loads", "Curve"): False,
           ("Boundaries", "Incident velocity"): True,
           ("Bodies", "Initial velocity"): True}
INTEGRATORS = ["Newmark", "generalised-alpha", "Bathe",
               "energy-momentum"]
CHOICES = {
    "Method/Method": ["finite element", "material point", "GIMP", "CPDI1",
                      "CPDI2"],
    "Method/Degree": ["1", "2"],
    "Method/Points per direction": ["1", "3"],
    "Method/Point layout": ["Gauss", "equally spaced"],
    "Method/Strain": ["small", "finite"],
    "Method/Mesh after step": ["reset", "keep", "follow material"],
    "Method/Domain update": ["frozen", "stretch", "corners"],
    "Method/Split domains": ["true"],
    "Boundaries/*/Enforcement": ["weighted", "penalty", "skew Nitsche",
                                 "symmetric Nitsche"],
    "Boundaries/*/Constraint": ["fixed", "roller", "components"],
    "Boundaries/*/Carry reaction": ["true", "false"],
    "Boundaries/*/Flip": ["true"],
    "Boundaries/*/Band width": ["1e-12", "1"],
    "Solver/Solver": ["direct", "auto", "amg-cg", "ilu-gmres"],
    "Solver/Line search": ["true", "false"],
    "Materials/*/Model": ["linear elastic", "neo-Hookean", "von Mises"],
    "Materials/*/Poisson ratio": ["0", "-0.9", "0.4999999"],
    "Bodies/*/Shape": ["box", "disc", "ring", "mesh", "expression", "union"],
    "Bodies/*/Rotation angle": ["10", "90", "1e6"],
    "Loads/*/Type": ["body force", "gravity", "side traction", "point force",
                     "surface traction", "pressure", "force on points"],
    "Mesh/Type": ["box", "generator", "file"],
}


def shortened(text):
    text = re.sub(r"set Steps( *)= .*", r"set Steps\1= 2", text)
    for key, value in (("Time/Smallest step", "0.25"),
                       ("Time/Steps", "2"),
                       ("Solver/Maximum iterations", "8")):
        # Beside stages, which have times of their own, this would be refused.
        if key.startswith("Time/") and "subsection Stages\n" in text:
            continue
        if not re.search(rf"set {key.split('/')[1]} *=", text):
            text += setting(key, value)
    return text


def setting(path, value):
    *sections, key = path.split("/")
    return ("".join(f"subsection {s}\n" for s in sections) +
            f"  set {key} = {value}\n" + "end\n" * len(sections))


def with_choice(rng, text):
    path = rng.choice(sorted(CHOICES))
    value = rng.choice(CHOICES[path])
    section, *middle, key = path.split("/")
    if middle:
        names = names_of(section, text)
        if not names:
            return text
        path = f"{section}/{rng.choice(names)}/{key}"
    return with_setting(text, path, value)


def dimension(text):
    return 3 if re.search(r"set Dimension *= *3", text) else 2


def sections_of(text):
    """The path of the section that each line stands in or opens."""
    path, paths = [], []
    for line in text.splitlines():
        if opens := re.match(r"\s*subsection (.*)", line):
            path.append(opens[1].strip())
        paths.append("/".join(path))
        if line.strip() == "end" and path:
            path.pop()
    return paths


def names_of(section, text):
    names = [path.split("/")[1] for path in sections_of(text)
             if path.startswith(section + "/")]
    return sorted(set(names))


def with_setting(text, path, value):
    """The key with this value, in place of the one that it has."""
    section, key = path.rsplit("/", 1)
    lines = text.splitlines()
    for i, here in enumerate(sections_of(text)):
        if here == section and re.match(rf"\s*set {key}\s*=", lines[i]):
            lines[i] = f"set {key} = {value}"
            return "\n".join(lines) + "\n"
    return text + "\n" + setting(path, value)


def with_expression(rng, text):
    """A motion, load or velocity that may be no number, now or later."""
    (section, key), is_vector = rng.choice(sorted(OF_TIME.items()))
    names = names_of(section, text)
    if not names:
        return text
    value = rng.choice(EXPRESSIONS)
    if is_vector:
        value = "; ".join([value] + ["0"] * (dimension(text) - 1))
    return with_setting(text, f"{section}/{rng.choice(names)}/{key}", value)


def with_boundary(rng, text):
    """A plane through the mesh, which meets what is there."""
    dim = dimension(text)
    corners = [re.search(rf"set {which} corner *= *(.*)", text)
               for which in ("Lower", "Upper")]
    try:
        low, high = ([float(x) for x in corner[1].split(",")] for corner in corners)
        place = [a + rng.random() * (b - a) for a, b in zip(low, high)]
    except (TypeError, ValueError):
        return text
    motion = rng.choice(["Displacement", "Translation"])
    value = [rng.choice(EXPRESSIONS)] + ["0"] * (dim - 1)
    return text + setting("Boundaries/fuzz/Surface", "plane") + "".join(
        setting(f"Boundaries/fuzz/{key}", value) for key, value in (
            ("Point", ", ".join(f"{x:.6g}" for x in place)),
            ("Normal", ", ".join(rng.choice(["1", "-1", "0.3"])
                                 for _ in range(dim))),
            ("Constraint", rng.choice(["fixed", "roller"])),
            (motion, "; ".join(value))))


def with_inertia(rng, text, section="Time"):
    if "set Density" not in text:
        text = re.sub(r"( *)(set Young modulus)", r"\1set Density = 1\n\1\2", text)
    return with_setting(text, f"{section}/Integrator", rng.choice(INTEGRATORS))


def with_stages(rng, text):
    """Two stages; the second may have other members, and inertia."""
    if "subsection Stages\n" in text:
        return text
    # Beside stages, a section 'Time' would be refused.
    text = re.sub(r"^subsection Time\n(?:.*\n)*?end\n", "", text, flags=re.M) + \
        setting("Stages/one/Time/Steps", "1") + \
        setting("Stages/two/Time/End time", "2")
    if rng.random() < 0.5:
        text = with_inertia(rng, text, "Stages/two/Time")
    for key in ("Boundaries", "Grid conditions", "Loads", "Bodies"):
        if rng.random() < 0.4:
            names = ["", "none", *names_of(key, text)]
            stage = rng.choice(["one", "two"])
            text = with_setting(text, f"Stages/{stage}/{key}", rng.choice(names))
    return text


def replaced(rng, text, pattern, values):
    """One match of the pattern replaced by one of values(line of the match)."""
    found = list(re.finditer(pattern, text, re.M))
    if not found:
        return text
    match = rng.choice(found)
    begin = text.rfind("\n", 0, match.start()) + 1
    line = text[begin:text.find("\n", match.end())]
    return (text[:match.start()] + rng.choice(values(line)) +
            text[match.end():])


def mutated(rng, text):
    """@p text with one change; odd bytes are characters 0 to 255."""
    lines = text.splitlines(True)
    i, j = rng.randrange(len(lines)), rng.randrange(len(lines))
    kind = rng.randrange(20)
    if kind >= 14:
        return rng.choice([with_expression, with_expression, with_boundary,
                           with_inertia, with_stages])(rng, text)
    if kind <= 2:
        return replaced(rng, text, r"(?<![A-Za-z])[-+]?\d+\.?\d*(e[-+]?\d+)?",
                        lambda line: SMALL if any(s in line for s in SIZES)
                        else NUMBERS)
    if kind <= 4:
        return replaced(rng, text, r"(?<== ).*$", lambda line: WORDS)
    if kind <= 7:
        return with_choice(rng, text)
    if kind == 8:
        del lines[i]
    elif kind == 9:
        lines.insert(i, lines[j])
    elif kind == 10:
        lines[i], lines[j] = lines[j], lines[i]
    elif kind == 11:
        at = rng.randrange(len(text))
        return text[:at] + rng.choice(["", "\n", "end\n"])
    elif kind == 12:
        at = rng.randrange(len(text))
        odd = [chr(rng.randrange(256)), "\0", "\xe9", "\x7f", "#", "\\\n", "$",
               "set ", "subsection a\n", "=", "{{", "x" * 200000]
        return text[:at] + rng.choice(odd) + text[at + rng.randrange(2):]
    else:
        at = rng.randrange(len(text))
        letters = list(text)
        letters[at] = rng.choice("abcxyz0189-+;,: ")
        return "".join(letters)
    return "".join(lines)


def make_case(folder, seed, number):
    """The scene of a case, in a folder with what scenes refer to, and whether its
    run is to go on from a checkpoint."""
    rng = random.Random(f"{seed} {number}")
    scenes = [s for s in sorted((root / "prm").rglob("*.prm"))
              if s.stem not in LONG and "studies" not in s.parts]
    source = rng.choice(scenes)
    for pattern in ("*.msh", "*.csv"):
        for file in (root / "prm").rglob(pattern):
            if "studies" in file.parts:
                continue
            text = file.read_text()
            if rng.random() < 0.1:
                text = mutated(rng, text)
            (folder / file.name).write_bytes(text.encode("latin-1", "replace"))
    text = shortened(source.read_text())
    resumes = rng.random() < 1 / 3
    if resumes and "Checkpoint every" not in text:
        text = with_setting(text, "Output/Checkpoint every", "1 steps")
    for _ in range(rng.choice([1, 1, 1, 2, 3])):
        text = mutated(rng, text) if text else text
    scene = folder / "scene.prm"
    utf8 = rng.random() < 0.5
    scene.write_bytes(text.encode("utf-8" if utf8 else "latin-1", "replace"))
    return source, scene, resumes


def one_run(starter, folder, words):
    """Exit code, what was printed, and whether its time was over."""
    files = [folder / "standard-output", folder / "standard-error"]
    process = starter.start(words, folder, *files)
    late = False
    try:
        process.wait(TIMEOUT)
    except subprocess.TimeoutExpired:
        late = True
        process.kill()
        process.wait()
    return (process.returncode,
            *[file.read_text("utf-8", "replace") for file in files], late)


def complaints_about_folder(output, code):
    if not output.exists():
        return ["no folder after a run that ended well"] if code == 0 else []
    complaints = []
    summary = output / "summary.json"
    if not summary.exists():
        return ["a folder without summary.json"]
    try:
        status = json.loads(summary.read_text())["status"]
        if (status == "ok") != (code == 0):
            complaints.append(f"status {status} with exit code {code}")
    except (ValueError, KeyError) as problem:
        complaints.append(f"summary.json: {problem}")
    for file in output.rglob("*"):
        if file.suffix == ".part":
            complaints.append(f"half written: {file.name}")
        elif file.suffix in (".vtu", ".pvd") and "</VTKFile>" not in \
                file.read_text(errors="replace"):
            complaints.append(f"not complete: {file.name}")
    return complaints


def complaints_about(starter, folder, words, output):
    code, out, err, late = one_run(starter, folder, words)
    if late:
        return [] if "  steps " in out else [f"silent for {TIMEOUT} s"]
    complaints = []
    if code not in (0, 1, 2):
        complaints.append(f"exit code {code}: {err.strip()[-300:]}")
    messages = [line for line in err.splitlines() if line.strip()]
    if code == 2 and len(messages) != 1:
        complaints.append(f"{len(messages)} lines for exit code 2: {messages}")
    if code == 1 and len(messages) > 1:
        complaints.append(f"{len(messages)} lines for exit code 1: {messages}")
    if code == 1 and not messages and "ended early: " not in out:
        complaints.append("exit code 1 without a message")
    if messages and len(messages[0]) > 3000:
        complaints.append(f"a message of {len(messages[0])} characters")
    return complaints + complaints_about_folder(output, code)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--seed", default="1")
    parser.add_argument("--cases", type=int, default=100)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--keep", type=pathlib.Path)
    arguments = parser.parse_args()
    starter = Starter(arguments.program.resolve())
    n_bad = 0
    for number in range(arguments.first, arguments.first + arguments.cases):
        with tempfile.TemporaryDirectory(prefix="moraine-fuzz-") as name:
            folder = pathlib.Path(name)
            source, scene, resumes = make_case(folder, arguments.seed, number)
            output = folder / "output"
            complaints = complaints_about(
                starter, folder, ["run", scene, "--output", output], output)
            if resumes and not complaints and list(output.glob("checkpoints/*1*")):
                complaints = complaints_about(
                    starter, folder, ["resume", output, "--from", "1"], output)
            if arguments.keep:
                shutil.copytree(folder, arguments.keep, dirs_exist_ok=True)
        if complaints:
            n_bad += 1
            print(f"case {number} of seed {arguments.seed} ({source.name}): "
                  + "; ".join(complaints), flush=True)
    print(f"{arguments.cases} cases, {n_bad} with complaints")
    return 1 if n_bad else 0


if __name__ == "__main__":
    sys.exit(main())
