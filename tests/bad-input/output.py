# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Output that cannot be written, and results that are not written over."""

scene = "tests/bad-input/base.prm"


def files(path):
    return {p.relative_to(path).as_posix(): p.read_bytes()
            for p in sorted(path.rglob("*")) if p.is_file()}


def message(result):
    """What is on stderr: the lines that begin with the program's name."""
    lines = [line for line in result.output.splitlines()
             if line.startswith("moraine: ")]
    return plain(" | ".join(lines))


first = run(scene)
before = files(first.folder)
second = run(scene, {"Time/Steps": 2}, extra=["--output", str(first.folder)],
             expect=2)
text("results are there", message(second))
text("nothing was written over", "yes" if files(first.folder) == before else "NO")
third = run(scene, {"Time/Steps": 2}, extra=["--output", str(first.folder),
                                             "--overwrite"])
text("with --overwrite", f"{len(list(first.folder.glob('points/*.vtu')))} VTU files")

(folder / "a-file").write_text("mine\n")
refused = run(scene, extra=["--output", str(folder / "a-file/results")], expect=2)
text("folder below a file", message(refused))
refused = run(scene, extra=["--output", str(folder / "a-file")], expect=2)
text("a file instead of a folder", message(refused))
text("the file", (folder / "a-file").read_text().strip())
refused = run(scene, extra=["--output", "/proc/moraine"], expect=2)
text("folder that cannot be made", message(refused))

# /dev/full takes nothing, as a full disk.
full = folder / "full"
(full / "points").mkdir(parents=True)
(full / "points/00003.vtu.part").symlink_to("/dev/full")
result = run(scene, extra=["--output", str(full)], expect=2, on_ranks=ranks)
text("disk full at the third step", message(result))
text("rows in history.csv", len((full / "history.csv").read_text().splitlines()))
text("complete VTU files", ", ".join(sorted(p.name for p in full.glob("points/*"))))
full = folder / "full-at-end"
full.mkdir()
(full / "summary.json.part").symlink_to("/dev/full")
result = run(scene, extra=["--output", str(full)], expect=2, on_ranks=ranks)
text("disk full at the end", message(result))
text("summary.json", "is there" if (full / "summary.json").exists() else "none")
