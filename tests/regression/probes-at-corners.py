# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""The corner of a body that reaches into a cell by less than points are made for:
an interpolated probe there moves as its surroundings."""

scene = folder / "corner.prm"
SCENE = prm("""
Dimension = {dim}
Mesh/Lower corner = {zero} | Upper corner = {upper} | Cell size = 0.5
Materials/m/Young modulus = 1000 | Poisson ratio = 0.3 | Density = 1
Bodies/block/Lower corner = {zero} | Upper corner = {corner}
Grid conditions/base/Side = bottom
Loads/weight/Type = gravity | Value = {force}
Probes/corner/Location = {corner} | Kind = interpolated
Probes/beside/Location = {beside} | Kind = interpolated
""")


def all_of(number, dim):
    return ", ".join([str(number)] * dim)


for dim, parts in ((2, (1e-8, 1e-7, 9e-7)), (3, (1e-8, 1e-5))):
    for part in parts:
        scene.write_text(SCENE.format(
            dim=dim, zero=all_of(0, dim), upper=all_of(2, dim),
            corner=all_of(1 + 0.5 * part, dim), beside=all_of(1, dim),
            force="1; -10" if dim == 2 else "1; 0.5; -10"))
        probes = run(scene).probes
        for c in "xyz"[:dim]:
            u, beside = (probes[f"u_{c} at {name}"] for name in ("corner", "beside"))
            bound(f"{dim}D, {part:g} of a cell: u_{c} over that beside - 1",
                  u / beside - 1, 1e-6 + 10 * part)
