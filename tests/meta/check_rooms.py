#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors

"""Rooms include only rooms to their left; p4est is included nowhere."""

import re
import sys

import meta

LEVELS = [["core"], ["mesh", "material", "solver"], ["geometry"],
          ["points", "time"], ["basis"], ["state"], ["boundary"], ["load"],
          ["assembly", "output"], ["run"]]
LEVEL = {room: n for n, rooms in enumerate(LEVELS) for room in rooms}

INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', re.MULTILINE)
P4EST = re.compile(r"^(p[48]est|sc\.h|sc_)|^deal\.II/distributed/"
                   r"(tria\.h|p4est_wrappers\.h)$")


def room_of(path):
    """Room of a header or source, by its folder below include or source."""
    parts = path.parts
    if parts[:2] == ("include", "moraine"):
        return parts[2] if len(parts) > 3 else None
    if parts[0] == "source":
        return parts[1] if len(parts) > 2 else None
    return None


def check(root):
    complaints = []
    for path in meta.files(root, meta.SOURCE_FOLDERS,
                           {".h", ".cc", ".in", ".inc"}):
        relative = path.relative_to(root)
        room = room_of(relative)
        if relative.parts[0] in ("include", "source") and \
                room is not None and room not in LEVEL:
            complaints.append(f"{relative}: '{room}' is not a room")
            continue
        for header in INCLUDE.findall(path.read_text()):
            if P4EST.match(header):
                complaints.append(f"{relative}: includes p4est by {header}")
            if room is None or not header.startswith("moraine/"):
                continue
            other = header.split("/")[1]
            if other not in LEVEL:
                complaints.append(f"{relative}: {header} is in no room")
            elif other != room and LEVEL[other] >= LEVEL[room]:
                complaints.append(f"{relative}: room '{room}' may not include "
                                  f"{header}")
    return complaints


GOOD = {
    "include/moraine/mesh/a.h": "#include <moraine/core/b.h>\n",
    "source/mesh/a.cc": "#include <moraine/mesh/a.h>\n"
                        "#include <deal.II/distributed/shared_tria.h>\n",
    "source/run/main.cc": "#include <moraine/output/x.h>\n",
    "source/precompiled.h": "#include <deal.II/base/tensor.h>\n",
    "tests/core/a_test.cc": "#include <moraine/run/a.h>\n",
}
FAULTS = [
    {"include/moraine/mesh/c.h": "#include <moraine/run/b.h>\n"},
    {"source/mesh/c.cc": "#  include \"moraine/solver/b.h\"\n"},
    {"source/core/c.cc": "#include <moraine/mesh/a.h>\n"},
    {"source/attic/c.cc": "int a;\n"},
    {"source/run/c.cc": "#include <moraine/attic/a.h>\n"},
    {"source/run/c.cc": "#include <p4est.h>\n"},
    {"tests/mesh/c_test.cc": "#include <p8est_bits.h>\n"},
    {"doc/steps/step-1/step-1.cc":
     "#include <deal.II/distributed/tria.h>\n"},
]

if __name__ == "__main__":
    sys.exit(meta.run(check, GOOD, FAULTS))
