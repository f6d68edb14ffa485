# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Bodies and surfaces drawn by expressions: results depend neither on the number
an expression is multiplied with, nor on where the scene lies."""

LOADED = """
subsection Mesh
  set Lower corner = 0, 0
  set Upper corner = 10, 4
  set Cell size = 1
end
subsection Method
  set Method = finite element
end
subsection Materials
  subsection soil
    set Young modulus = 1e4
    set Poisson ratio = 0.3
  end
end
subsection Bodies
  subsection soil
    set Shape = expression
    set Expression = {scale} * (4.5 - abs(x - 5))
  end
end
subsection Grid conditions
  subsection base
    set Side = bottom
  end
end
subsection Loads
  subsection crest
    set Type = surface traction
    set Points = 10 3.5; 0 3.5
    set Value = 0; -2
  end
end
"""
for scale in 1, 1e-3, 1e-6, 1e4:
    (folder / "loaded.prm").write_text(LOADED.format(scale=scale))
    result = run(folder / "loaded.prm")
    force = result.summary["reactions"]["base"][1]
    bound(f"level times {scale:g}: force on 9 of width, off 18",
          abs(force / 18 - 1), 1e-9)

ROLLER = """
subsection Mesh
  set Lower corner = {x}, {y}
  set Upper corner = {x} + 4, {y} + 3
  set Cell size = 0.25
end
subsection Method
  set Method = material point
  set Strain = finite
end
subsection Materials
  subsection soil
    set Young modulus = 1000
    set Poisson ratio = 0.3
    set Density = 1
  end
end
subsection Bodies
  subsection soil
    set Shape = expression
    set Expression = min(y - {y} - 0.6 - 0.2*sin(2*(x - {x})), {y} + 2.6 - y)
  end
end
subsection Boundaries
  subsection bed
    set Surface = expression
    set Expression = y - {y} - 0.6 - 0.2*sin(2*(x - {x}))
    set Constraint = roller
  end
end
subsection Grid conditions
  subsection left
    set Side = left
    set Components = x
  end
end
subsection Loads
  subsection weight
    set Type = gravity
    set Value = 0; -10
  end
end
subsection Probes
  subsection toe
    set Location = {x} + 3.9, {y} + 1.2
  end
end
subsection Time
  set Steps = 4
end
"""
results = []
for x, y in (0, 0), (4.2e5, 4.6e6):
    (folder / "roller.prm").write_text(
        ROLLER.replace("{x} + 4", repr(x + 4)).replace("{y} + 3", repr(y + 3))
        .replace("{x} + 3.9, {y} + 1.2", f"{x + 3.9!r}, {y + 1.2!r}")
        .format(x=x, y=y))
    results.append(run(folder / "roller.prm"))
here, there = results
for name, value in here.probes.items():
    number(name, value, 5)
bound("far from the origin they differ by", max(
    abs(there.probes[name] - value) for name, value in here.probes.items()) /
    max(map(abs, here.probes.values())), 1e-5)
bound("force of the bed differs by", max(
    abs(a - b) for a, b in zip(there.summary["reactions"]["bed"],
                               here.summary["reactions"]["bed"])) /
    max(map(abs, here.summary["reactions"]["bed"])), 1e-5)
