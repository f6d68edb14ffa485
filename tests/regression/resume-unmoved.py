# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Points that stay where they are, of bodies that came in another order than they
are drawn in, go on from a checkpoint as if nothing had been."""

LAYERS = """
subsection Mesh
  set Lower corner = 0, 0
  set Upper corner = 4, 4
  set Cell size    = 0.5
end
subsection Method
  set Mesh after step = keep
end
subsection Materials
  subsection soil
    set Young modulus = 1000
    set Poisson ratio = 0.3
    set Density       = 1
  end
end
subsection Bodies
  subsection upper
    set Lower corner = 0, 2.3
    set Upper corner = 4, 3.3
  end
  subsection lower
    set Lower corner = 0, 1.2
    set Upper corner = 4, 2.3
  end
  subsection ground
    set Lower corner = 0, 0
    set Upper corner = 4, 1.2
  end
end
subsection Grid conditions
  subsection base
    set Side = bottom
  end
  subsection side
    set Side       = left
    set Components = x
  end
end
subsection Loads
  subsection weight
    set Type  = gravity
    set Value = 1; -4
  end
end
subsection Stages
  subsection ground
    set Bodies = ground
  end
  subsection lower
    set Bodies = ground, lower
    subsection Time
      set End time = 2
    end
  end
  subsection upper
    set Bodies = ground, lower, upper
    subsection Time
      set End time = 3
      set Steps    = 4
    end
  end
end
subsection Output
  set Points           = false
  set Mesh             = false
  set Checkpoint every = 1 step
end
subsection Probes
  subsection top
    set Location = 3.9, 3.2
    set Body     = upper
  end
end
"""
scene = folder / "layers.prm"
scene.write_text(LAYERS)
for method in "CPDI1", "CPDI2", "GIMP", "material point", "finite element":
    more = {"Method/Method": method}
    if method == "GIMP": # boxes that are not parts of cells
        more.update({"Bodies/ground/Point grid": "12, 4",
                     "Bodies/lower/Point grid": "14, 4",
                     "Bodies/upper/Point grid": "16, 4"})
    if method == "finite element":
        more["Mesh/Cells"], more["Mesh/Cell size"] = "8, 40", 0
    through = run(scene, more)
    history = (through.folder / "history.csv").read_bytes()
    run(through.folder, command="resume", extra=["--from", 5])
    text(f"{method}: history is that of a run without a break",
         history == (through.folder / "history.csv").read_bytes())
