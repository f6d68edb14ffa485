# ranks: 1 # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Scenes that are right and were told that something is wrong: waves, of which
the end is one moment, and material that yields in full cells."""


def told(result):
    return result.found()


for scene in ("impact", "impact-roller"):
    text(f"{scene}: told", told(run(f"prm/dynamics/{scene}.prm")))

# A block of full cells is pulled until it flows.
PLATEAU = """
subsection Mesh
  set Lower corner = 0, 0
  set Upper corner = 4, 6
  set Cell size = 0.5
end
subsection Method
  set Method = GIMP
end
subsection Materials
  subsection clay
    set Model = von Mises
    set Young modulus = 1000
    set Poisson ratio = 0.3
    set Uniaxial yield stress = 1
  end
end
subsection Bodies
  subsection block
    set Lower corner = 0, 0
    set Upper corner = 2, 4
  end
end
subsection Grid conditions
  subsection left
    set Side = left
    set Components = x
  end
  subsection bottom
    set Side = bottom
    set Components = y
  end
end
subsection Loads
  subsection pull
    set Type = surface traction
    set Points = 2 4; 0 4
    set Value = 0; 1.3*t
  end
end
subsection Time
  set End time = 1
  set Steps = 10
end
subsection Output
  set Write = end
end
"""
plateau = folder / "plateau.prm"
plateau.write_text(PLATEAU)
for strain in ("small", "finite"):
    result = run(plateau, {"Method/Strain": strain}, expect=1)
    text(f"plateau, {strain} strain: too few points",
         "fictitious-stiffness" in result.ids())
    # Plane strain: 2/sqrt(3) of the yield stress.
    bound(f"plateau, {strain} strain: load over exact - 1",
          1.3 * result.summary["time"] / (2 / 3**0.5) - 1, 0.01)
