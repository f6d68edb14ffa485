# ranks: 1 # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""The parameters.prm that a run leaves, with every key written out, is the
scene again: of every scene that runs, 'check' says of them what the run did, and of
some the run ends with the same summary."""

from subprocess import TimeoutExpired


LATER = "  later stages are checked as they begin"
FINDINGS = ("  warning ", "  hint ")


def begun(scene):
    """What a run says of a scene, and its parameters.prm; the run is ended when
    that has been written."""
    target = folder / "begun" / f"{scene.parent.name}-{scene.stem}"
    said = target.with_suffix(".txt")
    said.parent.mkdir(exist_ok=True)
    said.touch()
    process = start(["run", scene, "--output", target], folder, said, said)
    while "\n  results in" not in said.read_text():
        try:
            process.wait(0.01)
            break
        except TimeoutExpired:
            pass
    else:
        process.kill()
        process.wait()
    head = said.read_text().split("  results in")[0].splitlines()
    # A short run may have ended by now, with findings of its end.
    log = (target / "log.txt").read_text().split("  results in")[0]
    found = [line for line in log.splitlines() if line.startswith(FINDINGS)]
    return head + found, target / "parameters.prm"


def is_same(scene):
    head, parameters = begun(scene)
    told = run(parameters, command="check").output.splitlines()
    if LATER in told:  # which only 'check' says
        told.remove(LATER)
    return told == head + ([] if any(line.startswith(FINDINGS) for line in head)
                           else ["  nothing wrong was found"])


def has_choices(scene):
    return "{{" in scene.read_text()


# This one takes a minute until it begins.
slow = {"twist-10-fine"}
scenes = [scene for scene in sorted((root / "prm").rglob("*.prm"))
          if not has_choices(scene) and scene.stem not in slow
          and "subsection Bodies" in scene.read_text()]
different = [scene.stem for scene in scenes if not is_same(scene)]
text("scenes, 50 or more", len(scenes) >= 50)
text("scenes whose written parameters say something else",
     ", ".join(different) or "none")


def result_of(scene):
    result = run(scene)
    summary = dict(result.summary)
    for key in ("wall_seconds", "timings", "peak_memory_mib", "scene"):
        summary.pop(key, None)
    return result, summary


for name in ("cortis-2017/block-30", "verification/patch-random",
             "verification/mesh-quads", "verification/loads",
             "large-deformation/column-gimp"):
    first, expected = result_of(f"prm/{name}.prm")
    again, found = result_of(first.folder / "parameters.prm")
    text(f"{name} again", "equal" if found == expected else
         str([k for k in expected if found.get(k) != expected[k]]))

# Every key has a value that stands for "not given".
block = run("prm/cortis-2017/block-30.prm")
text("from a cell size to a number of cells", run(
    block.folder / "parameters.prm",
    {"Mesh/Cell size": 0, "Mesh/Cells": "12, 12"},
    command="check").output.splitlines()[-1].strip())
