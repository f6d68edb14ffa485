#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors

"""Every file of code begins with the licence and the copyright line."""

import sys

import meta

LICENCE = "SPDX-License-Identifier: LGPL-2.1-or-later"
COPYRIGHT = "by the Moraine authors"
SUFFIXES = {".h", ".cc", ".in", ".py", ".sh", ".cmake", ".gp"}


def sources(root):
    found = meta.files(root, meta.SOURCE_FOLDERS + ("cmake",), SUFFIXES)
    found += sorted(path for path in root.rglob("CMakeLists.txt")
                    if "build" not in path.relative_to(root).parts[:1])
    found += [path for path in (root / "moraine", root / ".ci/run")
              if path.is_file()]
    return found


def check(root):
    complaints = []
    for path in sources(root):
        head = path.read_text().split("\n")[:4]
        if not any(line.endswith(LICENCE) and COPYRIGHT in following
                   for line, following in zip(head, head[1:])):
            complaints.append(f"{path.relative_to(root)}: must begin with the "
                              "two lines of licence and copyright")
    return complaints


HEAD = f"// {LICENCE}\n// Copyright (C) 2026 {COPYRIGHT}\n"
GOOD = {
    "source/core/a.cc": HEAD,
    "moraine": "#!/bin/bash\n" + HEAD,
    "CMakeLists.txt": HEAD,
    "build/CMakeLists.txt": "",
}
DEFECTS = [
    {"source/core/b.cc": "int a;\n"},
    {"include/moraine/core/b.h": "\n\n\n\n" + HEAD},
    {"tests/a.py": f"# {LICENCE}\n"},
    {"moraine": "#!/bin/bash\n"},
    {"doc/CMakeLists.txt": "\n"},
]

if __name__ == "__main__":
    sys.exit(meta.run(check, GOOD, DEFECTS))
