#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors

"""
Every header below include/moraine has a guard named after its path and, if a
source mirrors it, is what that source includes first, which shows that it needs
no other header before it; no header hides in source/. For headers without such a
source see CMakeLists.txt beside this file.
"""

import re
import sys

import meta

INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', re.MULTILINE)


def check(root):
    complaints = []
    for path in meta.files(root, ["include"], {".h", ".in"}):
        relative = path.relative_to(root / "include")
        name = str(relative).removesuffix(".in")
        guard = re.sub(r"\W", "_", name)
        text = path.read_text()
        if f"#ifndef {guard}\n#define {guard}\n" not in text:
            complaints.append(f"{relative}: the guard must be {guard}")
        source = root / "source" / relative.relative_to("moraine")
        source = source.with_suffix(".cc")
        if source.is_file() and \
                INCLUDE.findall(source.read_text())[:1] != [name]:
            complaints.append(f"{source.relative_to(root)}: does not include "
                              f"{name} first")
    for path in meta.files(root, ["source"], {".h"}):
        if path.relative_to(root).as_posix() != "source/precompiled.h":
            complaints.append(f"{path.relative_to(root)}: headers belong below "
                              "include/moraine")
    return complaints


GUARDED = "#ifndef moraine_core_a_h\n#define moraine_core_a_h\n#endif\n"
GOOD = {
    "include/moraine/core/a.h": GUARDED,
    "source/core/a.cc": "#include <moraine/core/a.h>\n",
    "source/core/b.cc": "int b;\n",
    "source/precompiled.h": "",
}
DEFECTS = [
    {"include/moraine/core/b.h": GUARDED},
    {"include/moraine/core/b.h": "#pragma once\n"},
    {"source/core/a.cc": "#include <moraine/core/b.h>\n"},
    {"source/core/a.cc": "#include <moraine/core/b.h>\n"
                         "#include <moraine/core/a.h>\n"},
    {"source/core/hidden.h": GUARDED},
]

if __name__ == "__main__":
    sys.exit(meta.run(check, GOOD, DEFECTS))
