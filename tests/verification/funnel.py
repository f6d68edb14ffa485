# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
# A strip pushed through a funnel: points stay in front of the walls, its right
# end stays straight, none is lost.
import base64
import re
import struct
import zlib


def positions(folder, number):
    """x of all points by their id, from the binary arrays of a VTU file."""
    data = (folder / "points" / f"{number:05d}.vtu").read_text()

    def arrays(name, stride, letter="f"):
        size = struct.calcsize(letter)
        for text in re.findall(rf'<DataArray type="Float{8 * size}" {name}'
                               r'[^>]*format="binary">\s*([^<]*?)\s*<', data):
            # a header of four numbers (16 bytes, 24 letters), then one block
            values = zlib.decompress(base64.b64decode(text[24:]))
            yield from struct.unpack(f"<{len(values) // size}{letter}",
                                     values)[::stride]

    x = list(arrays('NumberOfComponents="3"', 3, "d"))
    return dict(zip(arrays('Name="id"', 1), x))


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

# The walls and the pushed end are all that holds the strip, and the frictionless
# bottom is flat: it carries nothing along x, the wall all of the push.
for c, names in (("x", ("top", "right")), ("y", ("bottom", "top"))):
    bound(f"sum of forces along {c} over the largest",
          max(abs(step[f"reaction_{c} of {names[0]}"] +
                  step[f"reaction_{c} of {names[1]}"]) /
              abs(step[f"reaction_{c} of {names[0]}"]) for step in history),
          1e-7)
number("push of the last step", -history[-1]["reaction_x of right"], 3)
number("force on the bottom in the last step",
       history[-1]["reaction_y of bottom"], 3)

start, end = (positions(result.folder, step) for step in (0, 6))
text("points in the files", (len(start), len(end)))
last = [i for i, x in start.items() if x > max(start.values()) - 0.5]
text("points of the last column", len(last))
spread = max(end[i] for i in last) - min(end[i] for i in last)
bound("spread of x over the last column over h", spread / h, 1e-2)
