#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors

"""doc/parameters.md and doc/diagnostics.md are what the program writes.

    check_parameters.py ROOT MORAINE            compare
    check_parameters.py ROOT MORAINE --update   write them anew
"""

import difflib
import pathlib
import subprocess
import sys
import tempfile

FILES = {"doc/parameters.md": "parameters", "doc/diagnostics.md": "explain"}


def differences(root, written):
    """Complaints about the files below root, given what they should be."""
    complaints = []
    for name, text in written.items():
        path = root / name
        found = path.read_text() if path.exists() else ""
        if found != text:
            diff = difflib.unified_diff(found.splitlines(), text.splitlines(),
                                        name, "moraine parameters", lineterm="")
            complaints.append("\n".join(diff))
    return complaints


def self_check(written):
    """A default that changed, and a file that is missing, must be found."""
    name = next(iter(FILES))
    changed = written[name].replace("`0.5`", "`0.6`").replace("`2`", "`7`")
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        (root / "doc").mkdir()
        for planted, defect in ((written, False),
                               ({**written, name: changed}, True),
                               ({**written, name: None}, True)):
            for file, text in planted.items():
                (root / file).unlink(missing_ok=True)
                if text is not None:
                    (root / file).write_text(text)
            if bool(differences(root, written)) != defect:
                sys.exit("the self-check failed")


def main():
    root, program = pathlib.Path(sys.argv[1]), sys.argv[2]
    written = {
        name: subprocess.run([program, command],
                             check=True, capture_output=True, text=True).stdout
        for name, command in FILES.items()}
    if "--update" in sys.argv:
        for name, text in written.items():
            (root / name).write_text(text)
        return
    self_check(written)
    complaints = differences(root, written)
    for complaint in complaints:
        print(complaint)
    if complaints:
        sys.exit("write them anew: tests/meta/check_parameters.py ROOT MORAINE "
                 "--update")


if __name__ == "__main__":
    main()
