# ranks: 2  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A mesh that is stretched between a plane without ends, far from the origin, and the
top of a block: the plane rests, and so does the mesh there, as between the block's
own bottom and top."""

SCENE = prm("""
Mesh/Lower corner = -1, 4 | Upper corner = 2, 7 | Cell size = 0.25
Method/Method = CPDI1 | Strain = finite
Materials/solid/Young modulus = 1000 | Poisson ratio = 0.3
Bodies/block/Lower corner = 0, 5 | Upper corner = 1, 6
Boundaries/bottom/
{bottom}
Boundaries/top/
{top}
Boundaries/top/Translation = 0; -0.3*t
Mesh motion/Stretch between = bottom, top
Time/Steps = 4
Output/Write = end
""")


def plane(y, normal):
    return (f"set Surface = plane\n    set Point = 0.5, {y}\n"
            f"    set Normal = 0, {normal}")


scene = folder / "scene.prm"
reactions = []
for name, bottom, top in (
        ("rim of the block", "set Body = block\n    set Part = bottom",
         "set Body = block\n    set Part = top"),
        ("a plane below", plane(5, -1), "set Body = block\n    set Part = top"),
        ("planes on both sides", plane(5, -1), plane(6, 1))):
    scene.write_text(SCENE.format(bottom=bottom, top=top))
    result = run(scene)
    reactions.append(result.summary["reactions"]["bottom"])
    text(f"{name}: active cells", result.summary["active_cells"])
    bound(f"{name}: force along the planes", abs(reactions[-1][0]), 1e-8)
    bound(f"{name}: force over that of the rim - 1",
          abs(reactions[-1][1] / reactions[0][1] - 1), 1e-3)
number("force", reactions[0][1], 4)
