# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""What cannot be resumed, and a disk that is full in mid-checkpoint."""

import json
import resource
import shutil
import subprocess
import time

scene = root / "tests/bad-input/base.prm"


def moraine(*words, limit=None):
    """Exit code and messages; files may have @p limit bytes."""
    def limited():
        if limit:
            resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))
    # Python ignores SIGXFSZ, and so does what it starts then.
    result = subprocess.run([str(program), *map(str, words)], cwd=folder,
                            capture_output=True, text=True,
                            preexec_fn=limited, restore_signals=False)
    return result.returncode, plain(result.stdout + result.stderr)


def refused(name, *words):
    code, output = moraine("resume", *words)
    text(name, f"exit code {code}, " + output.strip())


def copy(name):
    target = folder / name
    shutil.rmtree(target, ignore_errors=True)
    return shutil.copytree(folder / "run", target)


def run_scene(out, *settings):
    words = [word for setting in settings for word in ("--set", setting)]
    return moraine("run", scene, "--output", out, *words)


assert run_scene("run", "Output/Checkpoint every = 1 step")[0] == 0
assert run_scene("none")[0] == 0

refused("no folder given")
refused("folder that is not there", "nowhere")
refused("run without a checkpoint", "none")
refused("step that has none", "run", "--from", "1")
refused("time that has none", "run", "--from", "0.3")
refused("no number", "run", "--from", "end")
refused("changed material", "run", "--set",
        "Materials/soil/Young modulus = 2000")
refused("two changes, one of them new", "run", "--set", "Method/Method = GIMP",
        "--set", "Probes/tip/Location = 1, 1", "--set", "Output/Mesh = false")
refused("another folder", "run", "--set", "Output/Directory = elsewhere")
refused("end before the checkpoint", "run", "--set", "Time/End time = 0.5")
stages = root / "prm/geotechnics/fill-and-dig.prm"
assert moraine("run", stages, "--output", "stages", "--set",
               "Output/Checkpoint every = 1 step")[0] == 0
refused("end of a stage that is over", "stages", "--from", "2", "--set",
        "Stages/alone/Time/End time = 1.5", "--set",
        "Stages/dug/Time/End time = 4")
code, output = moraine("resume", "stages", "--from", "2", "--set",
                       "Stages/dug/Time/End time = 4")
text("end of the next stage", f"exit code {code}, t = "
     + (folder / "stages/history.csv").read_text().split()[-1].split(",")[0])
refused("unknown key", "run", "--set", "Solver/Sover = direct")
refused("an option of run", "run", "--output", "other")

cut = copy("cut")
last = cut / "checkpoints" / (cut / "checkpoints/last").read_text().strip()
whole = last.read_bytes()
last.write_bytes(whole[:-1000])
refused("truncated file", "cut")
text("  the one before", "goes on" if moraine(
    "resume", "cut", "--from", "3")[0] == 0 else "NO")

damaged = copy("damaged")
last = damaged / "checkpoints" / last.name
bit = bytearray(whole)
place = whole.index(b"set Young modulus")  # in the parameters
bit[place + 20] ^= 1
last.write_bytes(bit)
refused("one bit is another", "damaged")
last.write_bytes(b"t,u_x\n0,1\n")
refused("another kind of file", "damaged")
last.unlink()
refused("file that is gone", "damaged")

# A run that reached its end has the same summary again.
copy("done")
text("a finished run, resumed", f"exit code {moraine('resume', 'done')[0]}")
first, second = (json.loads((folder / name / "summary.json").read_text())
                 for name in ("run", "done"))
for key in first:
    if first[key] != second.get(key) and key not in ("wall_seconds", "timings",
                                                     "peak_memory_mib"):
        text("  DIFFERS", f"{key}: {first[key]}, {second.get(key)}")

# What an earlier end left does not speak for a run that went on and was killed.
went_on = copy("went on")
rows = (went_on / "history.csv").read_text().count("\n")
process = subprocess.Popen(
    [str(program), "resume", "went on", "--set", "Time/End time = 1000", "--set",
     "Time/Steps = 100000"], cwd=folder, stdout=subprocess.DEVNULL)
while (went_on / "history.csv").read_text().count("\n") <= rows:
    assert process.poll() is None
    time.sleep(0.01)
refused("folder in which a run is under way", "went on")
code, output = moraine("run", scene, "--output", "went on", "--overwrite")
text("  run in it", f"exit code {code}, " + output.strip())
process.kill()
process.wait()
text("killed when it went on", "no summary"
     if not (went_on / "summary.json").exists() else "NO, one of the past")

for value in ("often", "0 steps", "2.5 steps", "5", "10 hours", "-1 minutes"):
    code, output = run_scene("key", f"Output/Checkpoint every = {value}")
    text(f"'{value}'", f"exit code {code}, " + output.strip())

# The disk is full while the checkpoint is written: other files are smaller.
size = len(whole)
for name, words in (("first checkpoint", ("run", scene, "--output", "full",
                                          "--set",
                                          "Output/Checkpoint every = 2 steps")),
                    ("later checkpoint", ("resume", copy("full later"),
                                          "--from", "3"))):
    code, output = moraine(*words, limit=size // 2)
    text(f"disk full, {name}", f"exit code {code}")
    for line in output.splitlines():
        if "checkpoint" in line and "note" in line:
            text("  log", line.strip())
    out = folder / ("full" if words[0] == "run" else "full later")
    text("  files", ", ".join(sorted(p.name for p in
                                     (out / "checkpoints").iterdir())))
text("  the good one", "goes on" if moraine(
    "resume", "full later", "--from", "3")[0] == 0 else "NO")

# A run that ends early leaves its last step, from which it ends the same way.
failing = {"Strength reduction/Factor": 1.6, "Output/Checkpoint every": "100 steps"}
ended = run("prm/geotechnics/factor-of-safety.prm", failing, expect=1)
before = (ended.folder / "history.csv").read_text()
again = run(ended.folder, command="resume", expect=1)
text("a run that ended early, resumed: the same history",
     before == (ended.folder / "history.csv").read_text())
text("  the same message", ended.summary["message"] == json.loads(
    (ended.folder / "summary.json").read_text())["message"])
at_least("  steps", ended.summary["steps"], 5)
