# ranks: 2  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A condition whose motion starts at a speed: a body with this velocity follows
it, one with another is told to jump, and one that moves where it is held at rest
is refused."""

from math import pi, sin

SCENE = prm("""
Mesh/Lower corner = {lower}, 0 | Upper corner = {upper}, 1 | Cell size = 0.5
Method/Method = finite element | Mesh after step = keep
Materials/m/Young modulus = 1e9 | Poisson ratio = 0 | Density = 1
Bodies/b/Lower corner = 0, 0 | Upper corner = 4, 1 | Initial velocity = {velocity}; 0
/
{hand}
Grid conditions/
{condition}
Grid conditions/low/Side = bottom | Components = y
Time/Integrator = {integrator} | End time = 1 | Steps = 100
Probes/right/Location = 4, 0.5 | Kind = interpolated
Output/Write = end
""")
SIDE = prm("""
hand/Side = left | Components = x | Displacement = {motion}; 0
""")
SURFACE = prm("""
Boundaries/hand/Body = b | Part = left | Constraint = roller
Boundaries/hand/Translation = {motion}; 0
""")
SINE = "sin(2*pi*t)"


def of(velocity, motion=SINE, surface=False, integrator="Newmark", **options):
    """The bar is so stiff that both of its ends move alike."""
    scene = folder / "scene.prm"
    scene.write_text(SCENE.format(
        velocity=velocity, integrator=integrator,
        lower=-0.75 if surface else 0, upper=4.25 if surface else 4,
        hand=SURFACE.format(motion=motion) if surface else "",
        condition="" if surface else SIDE.format(motion=motion)))
    return run(scene, **options)


def jumps(result):
    return [f"{one['value']:.2e}" for one in result.summary.get("hints", [])
            if one["id"] == "velocity-jump"]


for integrator in ("Newmark", "generalised-alpha", "Bathe", "energy-momentum"):
    result = of("2*pi", integrator=integrator)
    bound(f"{integrator}: displacement of the free end - exact",
          max(abs(row["u_x at right"] - sin(2 * pi * row["t"]))
              for row in result.history()), 1e-4)
    text("  told", jumps(result))
text("rounded to 4 digits: told", jumps(of("6.283")))
for surface in (False, True):
    for velocity in ("0", "2*pi", "7"):
        name = "surface" if surface else "side"
        text(f"{name}, velocity {velocity}: told",
             jumps(of(velocity, surface=surface)))
text("held at rest, velocity 1",
     of("1", motion="0", expect=2).output.strip().split(": ", 2)[2])

# A block that turns about its corner, held there by a hand that turns alike.
spin = scene_file("spin.prm", """
Mesh/Lower corner = 0, 0 | Upper corner = 1, 1 | Cell size = 0.25
Method/Method = finite element | Strain = finite
Materials/m/Young modulus = 1e7 | Poisson ratio = 0.3 | Density = 1
Bodies/b/Shape = mesh | Initial velocity = -2*pi*y; 2*pi*x
Grid conditions/hand/Lower corner = -0.1, -0.1 | Upper corner = 0.3, 0.3
Grid conditions/hand/Rotation angle = 360*t
Time/Integrator = energy-momentum | End time = 1 | Steps = 100
Probes/far/Location = 1, 1 | Kind = interpolated
Output/Write = end
""")
result = run(spin)
rows = result.history()
bound("spin: far corner after a turn, from where it was",
      max(abs(rows[-1][f"u_{c} at far"]) for c in "xy"), 1e-3)
bound("spin: angular momentum over exact - 1",
      max(abs(row["angular_momentum_z"] / (4 * pi / 3) - 1) for row in rows), 2e-3)
text("spin: told", jumps(result))
