# ranks: 2
# debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A run ends where material has passed a surface by more than half a cell."""

# A smooth pipe is pushed into clay; by symmetry only half of it.
PIPE = """
subsection Mesh
  set Lower corner = 0, -2
  set Upper corner = 2.4, 1.2
  set Cell size    = 0.2
end
subsection Method
  set Strain = finite
end
subsection Materials
  subsection clay
    set Model              = von Mises
    set Young modulus      = 5000
    set Poisson ratio      = 0.3
    set Shear yield stress = 10
  end
end
subsection Bodies
  subsection ground
    set Lower corner = 0, -2
    set Upper corner = 2.4, 0
  end
end
subsection Boundaries
  subsection pipe
    set Surface     = circle
    set Centre      = 0, 0.5
    set Radius      = 0.5
    set Body side   = outside
    set Constraint  = roller
    set Translation = 0; -t
  end
end
subsection Grid conditions
  subsection axis
    set Side = left
    set Components = x
  end
  subsection right
    set Side = right
    set Components = x
  end
  subsection base
    set Side = bottom
  end
end
subsection Time
  set End time = 1.4
  set Steps    = 14
end
"""
scene = folder / "pipe.prm"
scene.write_text(PIPE)
result = run(scene, {"Output/Write": "end"}, expect=None)
text("status", result.summary["status"])
text("steps", result.summary["steps"])
text("error names the surface", "behind 'pipe'" in result.output)
depths = [row["penetration of pipe"] for row in result.history()]
bound("depth in cells until then", max(depths[:-1]) / 0.2, 0.5)
text("found", result.ids())
