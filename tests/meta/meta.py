#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors

"""Shared by the meta tests: a command line that checks the repository, and a
self-check that plants a defect in a copy of nothing and must find it."""

import pathlib
import sys
import tempfile

SOURCE_FOLDERS = ("include", "source", "tests", "doc", "benchmarks", "scripts")


def files(root, folders, suffixes):
    """All files below the folders of root with one of the suffixes, sorted."""
    found = []
    for folder in folders:
        for path in sorted((root / folder).rglob("*")):
            if path.suffix in suffixes and path.is_file():
                found.append(path)
    return found


def plant(root, content):
    """Write {path: text} below root."""
    for name, text in content.items():
        path = root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)


def run(check, good, defects):
    """
    check(root) returns a list of complaints. First the self-check: a tree with
    the files of `good` must give none, and each of `defects`, planted on top of
    it, must give one. Then the repository named on the command line.
    """
    for planted in [{}] + defects:
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            plant(root, good)
            plant(root, planted)
            complaints = check(root)
            if bool(complaints) != bool(planted):
                print("self-check failed for", planted, complaints)
                return 1
    complaints = check(pathlib.Path(sys.argv[1]).resolve())
    for complaint in complaints:
        print(complaint)
    print(f"{len(defects)} planted defects found; {len(complaints)} complaints")
    return 1 if complaints else 0
