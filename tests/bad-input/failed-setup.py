# debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Nothing of an earlier run is left that could be taken for that of a run that
failed in its set-up, or was killed."""

import json
import os
import signal
import subprocess
import time

scene = "tests/bad-input/base.prm"


def state_of(result):
    """What is in a folder: status and message, and results."""
    summary = result.folder / "summary.json"
    told = json.loads(summary.read_text()) if summary.exists() else {}
    results = [p.name for p in result.folder.rglob("*")
               if p.suffix in (".vtu", ".pvd", ".csv")]
    return (f"{told.get('status', 'no summary')}: "
            f"{plain(told.get('message', ''))}; "
            f"{'RESULTS' if results else 'no results'}")


def again(name, settings, expect):
    """Over the results of a run that went well."""
    good = run(scene)
    text(f"{name}: before", good.summary["status"])
    bad = run(scene, settings, expect=expect,
              extra=["--output", str(good.folder), "--overwrite"])
    text("  message", plain(" ".join(bad.output.split("moraine: ")[1].split())))
    text("  after", state_of(good))
    refused = run(scene, {"Time/Steps": 2},
                  extra=["--output", str(good.folder)])
    text("  the next run needs no --overwrite", refused.code)


again("surface beside the body", {"Boundaries/left/Points": "6 6; 6 5"}, 2)
again("body that is not held", {"Boundaries/left/Constraint": "roller"}, 2)
again("mistake in the text", {"Materials/soil/Poisson ratio": "0.7"}, 2)

fresh = run(scene, {"Boundaries/left/Points": "6 6; 6 5"}, expect=2)
text("in a new folder", state_of(fresh))
fresh = run(scene, {"Materials/soil/Poisson ratio": "0.7"}, expect=2)
text("mistake in the text, new folder",
     "is there" if fresh.folder.exists() else "nothing is written")

# Killed before its first step: the old summary is gone.
good = run(scene)
words = [str(program), "run", str(root / scene), "--output", str(good.folder),
         "--overwrite", "--set", "Mesh/Cell size = 0.0125",
         "--set", "Output/Points = false", "--set", "Output/Mesh = false"]
process = subprocess.Popen(words, stdout=subprocess.DEVNULL,
                           stderr=subprocess.DEVNULL, cwd=folder,
                           start_new_session=True)
parameters = good.folder / "parameters.prm"
for _ in range(600):
    if parameters.exists() and "0.0125" in parameters.read_text():
        break
    time.sleep(0.05)
os.killpg(process.pid, signal.SIGKILL)
process.wait()
text("killed", state_of(good))
