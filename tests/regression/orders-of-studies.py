# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Orders of a study are those in the size of cells or of steps, whatever the order
of cases and wherever a choice of these stands; each case has its own reference
value, and no other error than the rest."""


def table(result):
    """Header and rows of the table."""
    return ([cell.strip() for cell in line.split("|")[1:-1]]
            for line in result.output.splitlines() if line.startswith("|"))


# A bar whose cells or steps are halved, also in other ways than by their own numbers.
bar = scene_file("bar.prm", """
Mesh/Type = generator | Generator = hyper_rectangle | Arguments = 0, 0 : 1, 1 : true
Mesh/Refinements = 2
Method/Method = finite element | Mesh after step = keep
Materials/elastic/Young modulus = 1 | Poisson ratio = 0 | Density = 1
Bodies/bar/Lower corner = 0, 0 | Upper corner = 1, 1
Grid conditions/held/Side = 0 | Components = x
Grid conditions/base/Side = 2 | Components = y
Constants/n = 4
Probes/tip/Location = 1, 0.5 | Kind = interpolated
""")
PULLED = {"Loads/pull/Type": "body force",
          "Loads/pull/Value": "pi*pi/4*sin(pi/2*x); 0",
          "Exact solution/Displacement": "sin(pi/2*x); 0",
          "Study/Error": "l2_u"}
# On the same mesh, in 4000 steps it is there.
SWINGS = {"Bodies/bar/Initial velocity": "0.01*sin(pi/2*x); 0",
          "Study/Error": "probe u_x at tip",
          "Study/Reference value": 0.0044953453}
TIME = {"Integrator": "Newmark", "End time": 0.5}
STAGE = {f"Stages/swings/Time/{key}": value
         for key, value in {**TIME, "Steps": "{{16|8}}"}.items()}
for name, settings in (
        ("Refinements", {**PULLED, "Mesh/Refinements": "{{2|3}}"}),
        ("the same by a constant, reversed", {
            **PULLED, "Mesh/Refinements": "$n", "Constants/n": "{{3|2}}"}),
        ("Steps", {**SWINGS, **{f"Time/{key}": TIME[key] for key in TIME},
                   "Time/Steps": "{{8|16}}"}),
        ("Steps by a constant, reversed", {
            **SWINGS, **{f"Time/{key}": TIME[key] for key in TIME},
            "Time/Steps": "2*$n", "Constants/n": "{{8|4}}"}),
        ("Steps of a stage, reversed", {**SWINGS, **STAGE}),
        ("Young modulus", {
            **PULLED, "Materials/elastic/Young modulus": "{{2|4}}"}),
        ("constant that is a number of cells nowhere", {
            **PULLED, "Materials/elastic/Young modulus": "$n",
            "Constants/n": "{{2|4}}"})):
    header, *rows = table(run(bar, settings, command="study"))
    text(f"{name}: order", rows[-1][header.index("order")])

STRETCHED = {"Loads/pull/Type": "side traction", "Loads/pull/Side": "1",
             "Loads/pull/Value": "0.01; 0", "Study/Error": "probe u_x at tip"}
stiff = run(bar, {**STRETCHED,
                  "Study/Series/soft/Settings": "Study/Reference value = 0.0101",
                  "Study/Series/stiff/Settings": "Study/Reference value = 0.00505; "
                  "Materials/elastic/Young modulus = 2"}, command="study")
header, *rows = table(stiff)
for row in rows:
    text(f"reference of {row[0]}: error", row[header.index("error")])
other = run(bar, {**STRETCHED, "Study/Reference value": 0.01,
                  "Study/Series/one/Settings": "Time/Steps = 1",
                  "Study/Series/two/Settings": "Study/Error = probe u_y at tip"},
            command="study", expect=None)
text("another error", f"exit code {other.code}, " + plain(
    other.output.strip().splitlines()[-1]))
