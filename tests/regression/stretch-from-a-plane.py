# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A mesh that is stretched between a plane without ends, far from the origin, and the
top of a block: the plane rests, and so does the mesh there, as between the block's
own bottom and top."""

SCENE = """
subsection Mesh
  set Lower corner = -1, 4
  set Upper corner = 2, 7
  set Cell size = 0.25
end
subsection Method
  set Method = CPDI1
  set Strain = finite
end
subsection Materials
  subsection solid
    set Young modulus = 1000
    set Poisson ratio = 0.3
  end
end
subsection Bodies
  subsection block
    set Lower corner = 0, 5
    set Upper corner = 1, 6
  end
end
subsection Boundaries
  subsection bottom
    {bottom}
  end
  subsection top
    {top}
    set Translation = 0; -0.3*t
  end
end
subsection Mesh motion
  set Stretch between = bottom, top
end
subsection Time
  set Steps = 4
end
subsection Output
  set Write = end
end
"""


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
