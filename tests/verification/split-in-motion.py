# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Domains that split while material moves: halves have the velocity and the
displacement of their own places.

A body without stiffness whose velocity is v = x/2 stretches without end; each
point keeps its velocity, so that x = X (1 + t/2). The lower half of the point
that a probe follows ends 0.95 of the way from the origin to (3.8, 0.2)."""

STRETCH = """
set Dimension = 2
subsection Mesh
  set Lower corner = -12, -3
  set Upper corner = 12, 3
  set Cell size = 0.5
end
subsection Method
  set Method = {method}
  set Strain = finite
  set Split domains = {split}
end
subsection Materials
  subsection dust
    set Young modulus = 1e-6
    set Poisson ratio = 0
    set Density = 1
  end
end
subsection Bodies
  subsection cloud
    set Lower corner = -2, -1
    set Upper corner = 2, 1
    set Initial velocity = 0.5*x; 0
  end
end
subsection Probes
  subsection tip
    set Location = 1.9, 0.1
    set Quantities = velocity, position
  end
end
subsection Time
  set Integrator = {integrator}
  set Steps = {steps}
  set End time = {end}
end
subsection Output
  set Points = false
  set Mesh = false
end
"""


def stretch(method, split, integrator, steps, end):
    scene = folder / "stretch.prm"
    scene.write_text(STRETCH.format(method=method, split=split, steps=steps,
                                    integrator=integrator, end=end))
    result = run(scene)
    first, last = result.history()[0], result.history()[-1]
    name = f"{method}, {steps} steps, {integrator}, split {split}"
    start = 1.875  # the point nearest to the probe
    part = last["x at tip"] / (start * (1 + end / 2))
    bound(f"{name}: v = x/(2 + t), relative error",
          abs(last["v_x at tip"] / (start / 2) / part - 1), 2e-4)
    if split == "true":
        number(f"{name}: place over that of the whole", part, 3)
    else:
        bound(f"{name}: place, relative error", abs(part - 1), 2e-4)
    bound(f"{name}: kinetic energy over that at the start - 1",
          abs(last["kinetic energy"] / first["kinetic energy"] - 1), 4e-3)


for method in ("GIMP", "CPDI1", "CPDI2"):
    stretch(method, "false", "Newmark", 15, 1.5)
    stretch(method, "true", "Newmark", 60, 6)
stretch("CPDI1", "true", "generalised-alpha", 60, 6)
stretch("material point", "false", "Newmark", 3, 1.5)

# Displacements that count from a reset, of points that split later.
BAR = """
set Dimension = 2
subsection Mesh
  set Lower corner = 0, 0
  set Upper corner = 4, 1
  set Cell size = 0.25
end
subsection Method
  set Method = {method}
  set Strain = finite
end
subsection Materials
  subsection soft
    set Young modulus = 1
    set Poisson ratio = 0
  end
end
subsection Bodies
  subsection bar
    set Lower corner = 0, 0
    set Upper corner = 2, 1
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
subsection Boundaries
  subsection grip
    set Body = bar
    set Part = right
    set Constraint = components
    set Components = x
    set Translation = 0: 0, 1: 0.8, 2: 1.2; 0
  end
end
subsection Stages
  subsection pull
    subsection Time
      set End time = 1
      set Steps = 8
    end
  end
  subsection more
    set Reset displacements = true
    subsection Time
      set End time = 2
      set Steps = 4
    end
  end
end
subsection Probes
  subsection middle
    set Location = 1, 0.5
    set Quantities = position, displacement
  end
end
subsection Output
  set Points = false
  set Mesh = false
end
"""
for method in ("GIMP", "CPDI1"):
    scene = folder / "bar.prm"
    scene.write_text(BAR.format(method=method))
    last = run(scene).history()[-1]
    # x = 1.6 X by now, 1.4 X at the reset.
    bound(f"{method}, displacement since a reset over that of its place - 1",
          abs(last["u_x at middle"] / (last["x at middle"] * (1 - 1.4 / 1.6)) - 1),
          1e-3)
