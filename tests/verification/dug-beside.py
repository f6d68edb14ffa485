# ranks: 2  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Ground at rest stays so: on a base that absorbs after the ground beside was dug
away, or before; on a base longer than the ground; between walls a cell apart."""

SCENE = prm("""
Mesh/Lower corner = -1, -0.2 | Upper corner = 6, 7.3 | Cell size = 0.5
Method/Method = {method} | Strain = finite
Materials/clay/Young modulus = 20000 | Poisson ratio = 0.25 | Density = 2
Bodies/
{bodies}
Grid conditions/
{nodes}
Boundaries/
{boundaries}
Loads/weight/Type = gravity | Value = 0; -10
Output/Points = false | Mesh = false
/
{more}
""")
BODY = prm("""
{name}/Lower corner = {lower} | Upper corner = {upper} | Initial stress = geostatic
{more}
""")
BASE = prm("""
base/Enforcement = {enforcement} | Points = {points}
""")
WALL = prm("""
{part}/Body = ground | Part = {part} | Constraint = roller
""")
STAGE = prm("""
{name}/
{keys}
{name}/Time/End time = {end}
{time}
""")
LEFT = prm("""
left/Lower corner = -0.01, -1 | Upper corner = 0.01, 9 | Components = x
""")
RIGHT = LEFT.replace("left", "right").replace("-0.01", "5.99").replace("0.01,", "6.01,")
PROBE = prm("""
Probes/top/Location = 1, 5.9
""")
# rho c_p is 219.09.
PUSH = prm("""
Loads/push/Type = surface traction | Body = ground | Part = top
Loads/push/Value = 0; if(t > 2, 21.909, 0)
""")
scene = folder / "scene.prm"


def run_scene(**parts):
    scene.write_text(SCENE.format(**parts))
    return run(scene)


def moved(rows):
    """How far the top comes from where it is in the first of these rows."""
    return max(abs(row["u_y at top"] - rows[0]["u_y at top"]) for row in rows)


NEWMARK = "set Integrator = Newmark\nset Steps = 20"
REST = STAGE.format(name="rest", keys="set Bodies = ground, beside", end=1, time="")
DIG = STAGE.format(name="dig", keys="set Bodies = ground", end=2, time="")
LATE = (DIG + STAGE.format(name="wait", keys="set Absorbing = base", end=3, time=NEWMARK))
EARLY = (STAGE.format(name="absorb", keys="set Absorbing = base", end=2, time=NEWMARK)
         + STAGE.format(name="dig", keys="set Bodies = ground", end=3, time=NEWMARK))
GROUNDS = BODY.format(name="ground", lower="0, 0", upper="3, 6", more="") \
    + BODY.format(name="beside", lower="3, 0", upper="6, 6", more="")

for method, enforcement in (("GIMP", "augmented Lagrangian"), ("GIMP", "skew Nitsche"),
                            ("finite element", "augmented Lagrangian")):
    for title, stages, nodes in (("dug, then absorbing", LATE, LEFT + RIGHT),
                                 ("absorbing, then dug", EARLY, LEFT)):
        result = run_scene(
            method=method, bodies=GROUNDS, nodes=nodes,
            boundaries=BASE.format(enforcement=enforcement, points="0 0; 6 0"),
            more=f"subsection Stages\n{REST}{stages}end\n{PROBE}")
        rows = [row for row in result.history() if row["t"] >= 2]
        late = [row for row in rows if row["t"] > 2.8]
        name = f"{method}, {enforcement}, {title}"
        if stages == LATE:
            bound(f"{name}: moves", moved(rows), 2e-4)
        bound(f"{name}: reaction over weight - 1",
              max(abs(row["reaction_y of base"] / 360 - 1) for row in late), 0.01)
        text("  found", result.found())

# A load on top moves it by p / (rho c_p): dashpots are below the rest alone.
for method in ("GIMP", "finite element"):
    waits = STAGE.format(name="push", keys="set Absorbing = base", end=3, time=NEWMARK)
    result = run_scene(
        method=method, bodies=GROUNDS, nodes=LEFT + RIGHT,
        boundaries=BASE.format(enforcement="augmented Lagrangian", points="0 0; 6 0"),
        more=PUSH + f"subsection Stages\n{REST}{DIG}{waits}end\n{PROBE}")
    rows = result.history()
    at = [row["u_y at top"] for row in rows if row["t"] > 2.49]
    bound(f"{method}, pushed: velocity over p / (rho c_p) - 1",
          abs((at[-1] - at[0]) / 0.5 / 0.1 - 1), 0.03)

# The base is a meter too long on both sides; walls hold the ground.
for method in ("GIMP", "finite element"):
    result = run_scene(
        method=method, bodies=BODY.format(name="ground", lower="0.3, 0.1",
                                          upper="4.4, 6.1", more="set K0 = 0.5"),
        nodes="", boundaries=BASE.format(enforcement="augmented Lagrangian",
                                         points="-0.7 0.1; 5.4 0.1")
        + WALL.format(part="left") + WALL.format(part="right"),
        more="subsection Time\nset Integrator = Newmark\nset Steps = 10\nend\n" + PROBE)
    bound(f"{method}, long base: reaction over weight - 1",
          max(abs(row["reaction_y of base"] / 492 - 1) for row in result.history()), 0.025)

# Each wall alone makes things worse, both together are in balance.
for y in (0, 0.1, 0.15, 0.25, 0.3):
    result = run_scene(
        method="GIMP", bodies=BODY.format(name="ground", lower=f"0.25, {y}",
                                          upper=f"0.75, {y + 6}", more="set K0 = 0.5"),
        nodes="", boundaries=BASE.format(enforcement="skew Nitsche",
                                         points=f"0.25 {y}; 0.75 {y}")
        + WALL.format(part="left") + WALL.format(part="right"), more="")
    bound(f"walls a cell apart, base at {y}: reaction over K0 gamma H^2/2 - 1",
          result.reactions["left"][0] / 180 - 1, 0.01)
