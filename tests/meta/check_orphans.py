#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors

"""Every prm/**/*.prm is named, by its path below prm/, in a file of tests/."""

import sys

import meta

SUFFIXES = {".txt", ".cmake", ".py", ".sh", ".cc", ".h", ".json", ".csv"}


def check(root):
    texts = [path.read_text() for path in meta.files(root, ["tests"], SUFFIXES)
             if path.name != "check_orphans.py"]
    complaints = []
    for path in meta.files(root, ["prm"], {".prm"}):
        name = path.relative_to(root / "prm").as_posix()
        if not any(name in text or name.removesuffix(".prm") + " " in text or
                   name.removesuffix(".prm") + "\n" in text or
                   name.removesuffix(".prm") + ")" in text
                   for text in texts):
            complaints.append(f"prm/{name}: no file below tests/ names it")
    return complaints


GOOD = {
    "prm/a/block-0.prm": "set A = 1\n",
    "prm/a/block-30.prm": "set A = 1\n",
    "tests/CMakeLists.txt": "add_scene(a/block-0.prm)\nadd_scene(a/block-30)\n",
}
DEFECTS = [
    {"prm/a/block-3.prm": "set A = 1\n"},
    {"prm/lost.prm": "set A = 1\n"},
    {"tests/CMakeLists.txt": "add_scene(a/block-0.prm)\n"},
]

if __name__ == "__main__":
    sys.exit(meta.run(check, GOOD, DEFECTS))
