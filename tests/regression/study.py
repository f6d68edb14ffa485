# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Studies, shortened: rows, errors, the table, the plot and what fails."""



def study(scene, settings, expect=0, on_ranks=1):
    result = run(scene, settings, command="study", expect=expect,
                 on_ranks=on_ranks)
    result.rows = result.study_rows()
    return result


def show(result, *columns):
    for row in result.rows:
        text("  row", plain(", ".join(row[c] for c in columns)))


beam = study("prm/studies/fe-mpm.prm", {"Mesh/Cell size": "{{20|10}}"})
text("fe-mpm, rows", len(beam.rows))
show(beam, "Series", "Mesh/Cell size", "status", "unknowns", "points")
error = {(row["Series"], row["Mesh/Cell size"]): float(row["error"])
         for row in beam.rows}
for series in ("FE Q1", "FE Q2", "MPM 4x4", "GIMP 4x4"):
    number(f"error of {series}, h = 10", error[series, "10"], 4)
at_least("error of FE Q1 over that of FE Q2",
         error["FE Q1", "10"] / error["FE Q2", "10"], 3)
text("seconds are positive", all(float(row["wall_seconds"]) > 0 and
                                 float(row["seconds in assembly"]) > 0
                                 for row in beam.rows))
text("memory is there", all(1 < float(row["peak_memory_mib"]) < 4096
                            for row in beam.rows))
# gnuplot also leaves a file of an empty picture.
picture = (beam.folder / "study.png").read_bytes()
text("picture", "PNG" if picture[1:4] == b"PNG" and len(picture) > 30000
     else f"NO: {len(picture)} bytes")
text("  said", "plot in" in beam.output and "gnuplot" not in beam.output)
script = (beam.folder / "study.gp").read_text()
for line in ("set multiplot", "set xlabel", "set ylabel", "set logscale"):
    for found in dict.fromkeys(l for l in script.splitlines()
                               if l.startswith(line)):
        text("plot", found)
text("curves in each panel", [panel.count(" with linespoints")
                              for panel in script.split("plot ")[1:]])
header, *rows = ([cell.strip() for cell in line.split("|")[1:-1]]
                 for line in beam.output.splitlines() if line.startswith("|"))
order = {(row[0], row[1]): row[header.index("order")] for row in rows}
number("order of FE Q1", float(order["FE Q1", "10"]), 3)
text("order of the first size", order["FE Q1", "20"])
table = [line for line in beam.output.splitlines() if line.startswith("|")]
text("table", f"{len(table)} lines, {' '.join(table[0].split())}")

# Steps are the last choice, and numbers of cells a list: orders in the mesh,
# curves that do not join different steps, errors over the largest stress.
column = study("prm/studies/large-column.prm",
               {"Mesh/Cells": "{{1, 8|1, 32}}", "Time/Steps": "{{5|10}}",
                "Study/Panels": "Steps = 5, | Steps = 10, FE"}, on_ranks=2)
header, *rows = ([cell.strip() for cell in line.split("|")[1:-1]]
                 for line in column.output.splitlines() if line.startswith("|"))
for row in rows:
    if row[0] == "FE Q1":
        text("  column", ", ".join(
            [*row[:3], row[header.index("error")], row[header.index("order")]]))
script = (column.folder / "study.gp").read_text()
text("curves in each panel", [panel.count(" with linespoints")
                              for panel in script.split("plot ")[1:]])
text("points of the first curve",
     script[:script.index("EOD\n", 20)].count("\n") - 1)

again = run("prm/studies/fe-mpm.prm", {"Mesh/Cell size": "20"}, command="study",
            extra=["--output", str(beam.folder)], expect=2)
message = next(l for l in again.output.splitlines() if "moraine: " in l)
text("not written over", plain(message[message.index("moraine: "):]))

block = study("prm/studies/enforcement.prm", {"Mesh/Cell size": "10"})
show(block, "Series", "status", "unknowns", "points")
for row in block.rows:
    if row["Series"] in ("skew Nitsche 10", "symmetric Nitsche 20"):
        bound(f"r_u of {row['Series']}", float(row["error"]), 1e-10)

ring = study("prm/studies/enforcement-ring.prm", {"Mesh/Cell size": "0.115"})
cantilever = study("prm/studies/enforcement-cantilever.prm",
                   {"Mesh/Cell size": "4"})
for name, result in (("ring", ring), ("cantilever", cantilever)):
    error = {row["Series"]: float(row["error"]) for row in result.rows}
    text(f"{name}, rows", len(result.rows))
    number(f"{name}, skew Nitsche", error["skew Nitsche 10"], 3)
    at_least(f"{name}, weighted 1e-6, places over skew Nitsche",
             error["weighted 1e-6, places"] / error["skew Nitsche 10"], 3)
    for series in ("weighted 1e-6", "augmented Lagrangian 1e-6", "penalty 1e3"):
        bound(f"{name}, {series} over skew Nitsche",
              error[series] / error["skew Nitsche 10"], 3)

solvers = study("prm/studies/solvers.prm", {"Mesh/Cell size": "5"})
show(solvers, "Series", "status", "unknowns")
number("linear iterations are counted: 1 or more", float(
    int(solvers.rows[1]["linear_iterations"]) > 0), 1)
bound("direct and amg-cg differ by", float(solvers.rows[0]["error"]) -
      float(solvers.rows[1]["error"]), 1e-6)

failing = study("prm/studies/solvers.prm",
                {"Mesh/Cell size": "2.5", "Solver/Maximum linear iterations": 1,
                 "Time/Smallest step": 0.5}, expect=1, on_ranks=2)
show(failing, "Series", "status")
wrong = study("prm/studies/solvers.prm",
              {"Mesh/Cell size": "5", "Bodies/beam/Upper corner":
               "{{100|200}}, 100"}, expect=2)
show(wrong, "Series", "Bodies/beam/Upper corner", "status", "message")
# The first case says nothing of errors: the others do.
mixed = study("prm/studies/enforcement.prm",
              {"Study/Error": "", "Mesh/Cell size": "10",
               "Bodies/block/Upper corner": "{{300|100}}, 100"}, expect=2)
text("errors of the other cases", "plot in" in mixed.output)
for settings in ({"Study/Error": "probe u_z at corner"},
                 {"Study/Group by": "Cel size"},
                 {"Study/Reference value": "0"},
                 {"Method/Degree": "{{1|3}}"},
                 {"Study/Series/direct/Settings": "Solver/Slover = direct"},
                 {"Boundaries/*/Enforcement": "penalty"},
                 {"Study/Group by": "Cell size",
                  "Mesh/Cell size": "{{10|5}}", "Time/Steps": "{{1|2}}"},
                 {"Time/Steps": "{{1|2|3|4|5|6|7|8|9|10}}",
                  "Title": "{{1|2|3|4|5|6|7|8|9|10}}" * 6}):
    result = run("prm/studies/solvers.prm",
                 {"Mesh/Cell size": "10", **settings}, command="study", expect=2)
    message = next(l for l in result.output.splitlines() if "moraine: " in l)
    text("wrong", plain(message[message.index("moraine: "):]))

# A mistake that one of two ranks sees ends the study, whatever the other does.
alone = run("tests/bad-input/base.prm", {
    "Mesh/Cell size": "{{1|2}}", "Grid conditions/foot/Lower corner": "0, 0",
    "Grid conditions/foot/Upper corner": "1, 1",
    "Grid conditions/foot/Displacement": "0; sqrt(0.6-t)-sqrt(0.6)"},
    command="study", expect=2, on_ranks=2)
text("one rank's mistake is named",
     "section 'Grid conditions/foot', key 'Displacement'" in alone.output)
