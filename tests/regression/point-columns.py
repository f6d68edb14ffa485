# ranks: 2  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A column of a point file beyond place and volume is a field of the points. Files
of spreadsheets begin with a byte-order mark, which is no part of the header."""

import base64
import re
import struct
import zlib


def array(file, name):
    """All pieces of a field of a VTU file that deal.II has written."""
    values = []
    for data in re.findall(
            rf'Name="{name}"[^>]*>\s*(?:<Info.*?</InformationKey>)?\s*(\S+)\s*<',
            file.read_text()):
        size = struct.unpack("<4I", base64.b64decode(data[:24]))[1]
        raw = zlib.decompress(base64.b64decode(data[24:]))
        values += struct.unpack(f"<{size // 4}f", raw)
    return values


rows = (root / "prm/verification/patch-random.csv").read_text().split()
with_layer = [f"{row},{'layer' if i == 0 else 3 * i}"
              for i, row in enumerate(rows)]
(folder / "points.csv").write_text(
    "\ufeff" + "\n".join(with_layer) + "\n", encoding="utf-8")
result = run("prm/verification/patch-random.prm",
             {"Bodies/square/Point file": folder / "points.csv"})
text("status", result.summary["status"])
files = sorted((result.folder / "points").glob("*.vtu"))
for file in (files[0], files[-1]):
    ids, layers = array(file, "id"), array(file, "layer")
    first = min(ids)
    text("points", len(ids) == len(rows) - 1)
    text("each has its own value", all(
        layer == 3 * (i - first + 1) for i, layer in zip(ids, layers)))
