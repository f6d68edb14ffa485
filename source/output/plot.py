#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""`moraine plot`: PNG pictures of a finished run.

    moraine plot OUTPUT                               fields and history below
    moraine plot OUTPUT --field stress --component xy
    moraine plot OUTPUT --history "u_y at top" reaction --against t
    moraine plot A.vtu B.vtu --columns 2 --field displacement -o both.png

OUTPUT is the folder of a run. Without -o pictures go into OUTPUT/plots.
"""

import argparse
import csv
import pathlib
import re
import subprocess
import sys

sys.dont_write_bytecode = True
import render  # noqa: E402

COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9",
           "#555555", "#000000"]


def arguments():
    parser = argparse.ArgumentParser(
        prog="moraine plot",
        description="Make PNG pictures of a finished run: the displacement "
        "and the whole history if nothing else is asked for.")
    parser.add_argument("files", nargs="+", metavar="OUTPUT",
                        help="folder of a run; or VTU files, one per panel")
    parser.add_argument("--field",
                        help="colour points by this field of the VTU files")
    parser.add_argument("--of", choices=["points", "domains", "mesh"],
                        default="points", help="what is coloured")
    parser.add_argument("--step", type=int, default=-1,
                        help="number of the VTU file; the last if left out")
    parser.add_argument("--history", nargs="*", metavar="COLUMN",
                        help="curves of columns of history.csv, or of all "
                        "that have these words in their name")
    parser.add_argument("--against", default="t", metavar="COLUMN",
                        help="column on the horizontal axis")
    render.add_arguments(parser)
    parser.add_argument("-o", "--output", help="PNG file, or CSV file of a "
                        "field's values")
    return parser.parse_args()


def vtu_of(run, series, step):
    """A VTU file of a run."""
    found = sorted((run / series).glob("*.vtu"))
    if not found:
        render.fail(f"there are no VTU files in {run / series}")
    if step < 0:
        return found[-1]
    for path in found:
        if int(path.stem) == step:
            return path
    render.fail(f"--step: found {step}, allowed: {int(found[0].stem)} to "
                f"{int(found[-1].stem)}")


def draw_field(args, run, path):
    if run:
        args.files = [str(vtu_of(run, args.of, args.step))]
        has_mesh = any((run / "mesh").glob("*.vtu"))
        if not args.mesh and not args.grid and has_mesh and args.of != "mesh":
            args.mesh = [str(vtu_of(run, "mesh", args.step))]
    render.draw(args, str(path))


def columns_of(header, words):
    """Columns with these names, or else with these words in their names."""
    chosen = []
    for word in words:
        same = [c for c in header if name_of(c) == word or c == word]
        found = same or [c for c in header if word in c]
        if not found:
            render.fail(f"history.csv has no column '{word}'; there are "
                        f"{', '.join(name_of(c) for c in header)}")
        chosen += [c for c in found if c not in chosen]
    return chosen


def name_of(column):
    return column.split(" [")[0]


def panels_of(columns):
    """(label of the axis, columns) of each panel: one for each quantity, with
    as many curves as there are colours."""
    quantities = {}
    for column in columns:
        unit = re.search(r"\[(.*)\]$", column)
        name = re.split(r" of | at ", name_of(column))[0]
        name = re.sub(r"_(x|y|z|xx|xy|xz|yy|yz|zz)$", "", name)
        label = name + (f" [{unit[1]}]" if unit else "")
        quantities.setdefault(label, []).append(column)
    n = len(COLOURS)
    return [(label, group[i:i + n]) for label, group in quantities.items()
            for i in range(0, len(group), n)]


def quoted(text):
    return "'" + text.replace("'", "''") + "'"


def script_of(panels, header, against, data, path):
    """Gnuplot's commands for panels below each other."""
    x = header.index(against) + 1
    lines = [
        f"set terminal pngcairo noenhanced size 1000,{300 * len(panels)} "
        "font 'DejaVu Sans,12'",
        f"set output {quoted(str(path))}",
        "set datafile separator ','", "set datafile missing 'nan'",
        "set grid lc rgb '#dddddd' lt 1 lw 1", "set border lw 1.2",
        "set key at graph 1.02, graph 1 left top vertical Left reverse",
        f"set xlabel {quoted(against)}",
        "set lmargin 12", "set rmargin 34",
        f"set multiplot layout {len(panels)},1"]
    for label, columns in panels:
        curves = [
            f"{quoted(str(data))} skip 1 using {x}:{header.index(column) + 1} "
            f"with linespoints pt 7 ps 0.6 lw 2 lc rgb '{colour}' "
            f"title {quoted(name_of(column))}"
            for column, colour in zip(columns, COLOURS)]
        lines += [f"set ylabel {quoted(label)}", "plot " + ", ".join(curves)]
    return "\n".join(lines + ["unset multiplot", ""])


def draw_history(args, run, path):
    data = run / "history.csv"
    if not data.is_file():
        render.fail(f"there is no file {data}")
    with open(data) as file:
        header = next(csv.reader(file), [])
    if not header:
        render.fail(f"{data} has no rows")
    against = columns_of(header, [args.against])[0]
    columns = columns_of(header, args.history) if args.history else \
        [c for c in header if c != against]
    if not columns:
        render.fail(f"{data} has no other column than {against}; a scene with "
                    "probes or boundaries has")
    script = script_of(panels_of(columns), header, against, data, path)
    try:
        subprocess.run(["gnuplot"], input=script, text=True, check=True,
                       stderr=subprocess.DEVNULL)
    except FileNotFoundError:
        render.fail("curves are drawn by gnuplot, which is not here (Debian "
                    "package gnuplot-nox)")
    except subprocess.CalledProcessError:
        render.fail(f"gnuplot could not draw {path}")


def main():
    args = arguments()
    run = pathlib.Path(args.files[0])
    if not run.is_dir():
        run = None
        if args.history is not None:
            render.fail(f"--history: there is no folder '{args.files[0]}'")
        if not pathlib.Path(args.files[0]).exists():
            render.fail(f"there is no folder or file '{args.files[0]}'")
    elif len(args.files) > 1:
        render.fail("one folder at a time; or several VTU files")
    if run is None and not args.output:
        render.fail("VTU files need -o FILE.png")
    folder = run / "plots" if run else None
    if folder and not args.output:
        folder.mkdir(exist_ok=True)
    if args.history is None:
        render.start_display()
    both = args.history is None and args.field is None and not args.output
    if args.history is not None or both:
        path = args.output or folder / "history.png"
        draw_history(args, run, path)
        print(path)
    if args.history is None:
        args.field = args.field or "displacement"
        name = "-".join(filter(None, [args.field, args.component]))
        path = args.output or folder / f"{name}.png"
        draw_field(args, run, path)
        print(path)


main()
