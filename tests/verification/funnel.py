# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
# A strip pushed through a funnel: points stay in front of the walls, its right
# end stays straight, none is lost.
import base64
import re
import struct
import zlib


def column(folder, number, name):
    """The values of a field of all points, from the binary arrays of a VTU."""
    data = (folder / "points" / f"{number:05d}.vtu").read_text()
    array = re.search(rf'<DataArray type="Float32" {name}[^>]*format="binary">'
                      r"\s*([A-Za-z0-9+/=]+?==)?([A-Za-z0-9+/=]+)\s*<", data)
    values = zlib.decompress(base64.b64decode(array.group(2)))
    return [v for (v,) in struct.iter_unpack("<f", values)]


h = 4
result = run("prm/cortis-2017/funnel.prm")
history = result.history()
text("status", result.summary["status"])
text("end time", history[-1]["t"])
text("points", result.summary["points"])
text("rejected steps", result.summary["rejected_steps"])
for name in sorted(result.reactions):
    bound(f"deepest point behind {name} over h",
          max(step[f"penetration of {name}"] for step in history) / h, 1e-2)

start = column(result.folder, 0, 'NumberOfComponents="3"')[0::3]
end = column(result.folder, 6, 'NumberOfComponents="3"')[0::3]
text("points in the files", (len(start), len(end)))
last = [i for i, x in enumerate(start) if x > max(start) - 0.5]
text("points of the last column", len(last))
spread = max(end[i] for i in last) - min(end[i] for i in last)
bound("spread of x over the last column over h", spread / h, 1e-2)
