# ranks: 2
# debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A ring on a curved roller over which it may slide: each method and enforcement with
its default factors solves each step at once, however stiff its penalty, and has the
displacement of a ring whose points stay. A cylinder pressed in a tube."""

from math import log, pi

SLIDES = {"Method/Mesh after step": "default", "Output/Mesh": "false",
          "Output/Points": "false"}

for method in ("GIMP", "material point", "finite element"):
    for enforcement in ("augmented Lagrangian", "weighted", "penalty",
                        "skew Nitsche"):
        result = run("prm/boundaries/ring-roller.prm",
                     {**SLIDES, "Method/Method": method,
                      "Boundaries/inner/Enforcement": enforcement,
                      "Time/Steps": 2})
        case = f"{method}, {enforcement}"
        text(f"{case}: rejected steps", result.summary["rejected_steps"])
        bound(f"{case}: Newton iterations in two steps",
              result.summary["newton_iterations"], 15)
        bound(f"{case}: l2_u", result.errors["l2_u"], 0.012)

# A shaft in a bearing that does not follow the mesh. Turned at its bore, it has
# neither stress nor torque; pressed in, what its rim carries is that of Lame's
# solution for u(12) = 0, u(30) = -0.03.
SHAFT = """
subsection Mesh
  set Lower corner = 67, -43
  set Upper corner = 137, 27
  set Cell size    = 5
end
subsection Method
  set Strain = finite
end
subsection Materials
  subsection steel
    set Young modulus = 210000
    set Poisson ratio = 0.3
  end
end
subsection Bodies
  subsection shaft
    set Shape        = ring
    set Centre       = 101.3, -7.9
    set Radius       = 30
    set Inner radius = 12
  end
end
subsection Boundaries
  subsection bore
    set Body            = shaft
    set Part            = inner
    set Rotation angle  = if(t > 1, 60 * (t - 1), 0)
    set Rotation centre = 101.3, -7.9
  end
  subsection bearing
    set Surface         = circle
    set Centre          = 101.3, -7.9
    set Radius          = 30
    set Body side       = inside
    set Constraint      = roller
    set Rotation angle  = 0
    set Rotation centre = 101.3, -7.9
    {press}
  end
end
subsection Time
  set End time = 2
  set Steps    = 8
end
"""
SHRINK = """set Displacement = -0.03 * if(t > 1, 1, t) * (x - 101.3) / sqrt((x - 101.3)^2 + (y + 7.9)^2); -0.03 * if(t > 1, 1, t) * (y + 7.9) / sqrt((x - 101.3)^2 + (y + 7.9)^2)"""
E, NU, A, B, U = 210000, 0.3, 12, 30, -0.03
LAME = E / (1 + NU) / (1 - 2 * NU)  # sigma_r = LAME (C + (1 - 2 nu) D / r^2)
C = U / (B - A * A / B)
FORCE = -2 * 3.141592653589793 * B * LAME * (C + (1 - 2 * NU) * C * A * A / B**2)

scene = folder / "shaft.prm"
for method in ("GIMP", "finite element"):
    scene.write_text(SHAFT.format(press=""))
    turned = run(scene, {"Method/Method": method})
    bound(f"shaft, {method}: stress over E",
          max(abs(s) for (stress,) in turned.points("stress") for s in stress) /
          E, 1e-11)
    text(f"shaft, {method}: rejected steps", turned.summary["rejected_steps"])
    scene.write_text(SHAFT.format(press=SHRINK))
    last = run(scene, {"Method/Method": method}).history()[-1]
    force = last["force magnitude of bearing"]
    bound(f"pressed in, {method}: force on the rim, off by",
          force / FORCE - 1, 0.01)
    bound(f"pressed in, {method}: moment over force times radius",
          last["moment of bearing"] / force / B, 1e-9)

# A cylinder in a smooth tube, pressed to 0.8 of its length: uniaxial strain.
CONFINED = """
set Dimension = 3
subsection Mesh
  set Lower corner = -0.86, -0.86, -0.86
  set Upper corner = 0.94, 0.94, 1.94
  set Cells        = 9, 9, 14
end
subsection Method
  set Method = finite element
  set Strain = finite
end
subsection Materials
  subsection rubber
    set Model         = neo-Hookean
    set Young modulus = 1000
    set Poisson ratio = 0.3
  end
end
subsection Bodies
  subsection plug
    set Shape      = cylinder
    set Axis start = 0, 0, 0
    set Axis end   = 0, 0, 1
    set Radius     = 0.5
  end
end
subsection Boundaries
  subsection tube
    set Body       = plug
    set Part       = side
    set Constraint = roller
  end
  subsection bottom
    set Body = plug
    set Part = bottom
  end
  subsection piston
    set Body        = plug
    set Part        = top
    set Constraint  = roller
    set Translation = 0; 0; -0.2*t
  end
end
subsection Time
  set Steps = 4
end
subsection Output
  set Points = false
  set Mesh   = false
end
"""
scene.write_text(CONFINED)
result = run(scene, on_ranks=1)
MU, LAMBDA, STRETCH = 1000 / 2.6, 300 / 1.3 / 0.4, 0.8
FORCE = pi / 4 * (MU * (STRETCH**2 - 1) + LAMBDA * log(STRETCH)) / STRETCH
bound("confined cylinder: force, off by",
      result.reactions["piston"][2] / FORCE - 1, 5e-4)
text("confined cylinder: rejected steps", result.summary["rejected_steps"])
