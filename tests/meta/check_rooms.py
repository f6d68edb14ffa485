#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors

"""Rooms include only the rooms that the table of doc/developer/rooms.md allows
them; p4est is included nowhere."""

import re
import sys

import meta

# What a room may include besides itself and core. A room above another in this
# table is never included by it.
MAY_INCLUDE = {
    "core": [],
    "mesh": [],
    "material": [],
    "solver": [],
    "time": [],
    "geometry": ["mesh"],
    "points": ["mesh", "geometry"],
    "basis": ["mesh", "geometry", "points"],
    "state": ["mesh", "material", "points", "time", "basis"],
    # multipliers turn with the surface by the measure of strain (spectral.h)
    "boundary": ["mesh", "material", "geometry"],
    "load": ["mesh", "geometry", "points"],
    "assembly": ["mesh", "material", "solver", "geometry", "points", "basis",
                 "state", "boundary", "load"],
    "output": ["mesh", "points", "basis"],
    "scene": ["mesh", "material", "solver", "time", "geometry", "points",
              "basis", "state", "boundary", "load", "assembly", "output"],
    "diagnostics": ["mesh", "material", "time", "geometry", "points", "basis",
                    "state", "boundary", "load", "assembly", "scene"],
    "run": ["mesh", "material", "solver", "time", "geometry", "points",
            "basis", "state", "boundary", "load", "assembly", "output",
            "scene", "diagnostics"],
    "study": ["output", "scene", "diagnostics", "run"],
}
ROOMS = list(MAY_INCLUDE)

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


def complaints_about_table():
    """The table has no cycles: rooms stand below all that they include."""
    return [f"table: '{room}' stands above '{other}', which it may include"
            for room, others in MAY_INCLUDE.items() for other in others
            if ROOMS.index(other) >= ROOMS.index(room)]


def complaints_about_includes(relative, room, text):
    complaints = []
    for header in INCLUDE.findall(text):
        if P4EST.match(header):
            complaints.append(f"{relative}: includes p4est by {header}")
        if room is None or not header.startswith("moraine/"):
            continue
        other = header.split("/")[1]
        if other not in MAY_INCLUDE:
            complaints.append(f"{relative}: {header} is in no room")
        elif other not in [room, "core"] + MAY_INCLUDE[room]:
            complaints.append(f"{relative}: room '{room}' may not include "
                              f"{header}")
    return complaints


def check(root):
    complaints = complaints_about_table()
    for path in meta.files(root, meta.SOURCE_FOLDERS,
                           {".h", ".cc", ".in", ".inc"}):
        relative = path.relative_to(root)
        room = room_of(relative)
        if room is not None and room not in MAY_INCLUDE:
            complaints.append(f"{relative}: '{room}' is not a room")
            continue
        complaints += complaints_about_includes(relative, room,
                                                path.read_text())
    return complaints


GOOD = {
    "include/moraine/mesh/a.h": "#include <moraine/core/b.h>\n",
    "source/mesh/a.cc": "#include <moraine/mesh/a.h>\n"
                        "#include <deal.II/distributed/shared_tria.h>\n",
    "source/main.cc": "#include <moraine/study/x.h>\n",
    "source/geometry/a.cc": "#include <moraine/mesh/a.h>\n",
    "source/load/a.cc": "#include <moraine/points/a.h>\n",
    "source/precompiled.h": "#include <deal.II/base/tensor.h>\n",
    "tests/core/a_test.cc": "#include <moraine/run/a.h>\n",
}
DEFECTS = [
    {"include/moraine/mesh/c.h": "#include <moraine/run/b.h>\n"},
    {"source/mesh/c.cc": "#  include \"moraine/solver/b.h\"\n"},
    {"source/core/c.cc": "#include <moraine/mesh/a.h>\n"},
    {"source/attic/c.cc": "int a;\n"},
    {"source/scene/c.cc": "#include <moraine/run/a.h>\n"},
    {"source/run/c.cc": "#include <moraine/attic/a.h>\n"},
    {"source/run/c.cc": "#include <p4est.h>\n"},
    {"source/mesh/c.cc": "#include <moraine/geometry/a.h>\n"},
    {"source/geometry/c.cc": "#include <moraine/points/a.h>\n"},
    # lower levels, but not allowed
    {"source/output/c.cc": "#include <moraine/state/a.h>\n"},
    {"source/load/c.cc": "#include <moraine/boundary/a.h>\n"},
    {"source/boundary/c.cc": "#include <moraine/points/a.h>\n"},
    {"source/points/c.cc": "#include <moraine/material/a.h>\n"},
    {"tests/mesh/c_test.cc": "#include <p8est_bits.h>\n"},
    {"doc/steps/step-1/step-1.cc":
     "#include <deal.II/distributed/tria.h>\n"},
]

if __name__ == "__main__":
    sys.exit(meta.run(check, GOOD, DEFECTS))
