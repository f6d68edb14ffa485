# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Writes slope.msh, the mesh of slope-fe.prm: cells of about 2 that follow the
slope, 20 by 2 in the ground and 13 by 4 above it.

    python3 prm/hard-cases/slope_mesh.py > prm/hard-cases/slope.msh
"""

nodes, quads, lines = {}, [], []


def node(x, y):
    return nodes.setdefault((round(x, 9), round(y, 9)), len(nodes) + 1)


def block(nx, ny, place):
    """Cells between place(i, j); anticlockwise."""
    for j in range(ny):
        for i in range(nx):
            quads.append([node(*place(i + a, j + b))
                          for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))])


block(20, 2, lambda i, j: (2 * i, 2 * j))
block(13, 4, lambda i, j: (i / 13 * (26 - 4 * j), 4 + 2 * j))
for side, (axis, value) in {1: (0, 0), 2: (0, 40), 3: (1, 0)}.items():
    on_side = sorted((at[1 - axis], n) for at, n in nodes.items() if at[axis] == value)
    lines += [(side, a, b) for (_, a), (_, b) in zip(on_side, on_side[1:])]

print("$MeshFormat\n2.2 0 8\n$EndMeshFormat")
print(f"$Nodes\n{len(nodes)}")
for (x, y), n in nodes.items():
    print(n, f"{x:.9g} {y:.9g} 0")
print(f"$EndNodes\n$Elements\n{len(lines) + len(quads)}")
for n, (side, a, b) in enumerate(lines, 1):
    print(n, 1, 2, side, side, a, b)
for n, corners in enumerate(quads, 1 + len(lines)):
    print(n, 3, 2, 4, 4, *corners)
print("$EndElements")
