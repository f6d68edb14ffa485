#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""`moraine plot`: PNG pictures of a finished run.

    moraine plot OUTPUT --field stress --component xy
    moraine plot OUTPUT --history "u_y at top" reaction --against t
    moraine plot OUTPUT --of contact
    moraine plot A.vtu B.vtu --columns 2 --field displacement -o both.png
    moraine plot material-test-clay.csv --measured laboratory.csv

OUTPUT is the folder of a run. Without -o pictures go into OUTPUT/plots.
"""

import argparse
import csv
import pathlib
import re
import sys

sys.dont_write_bytecode = True
import render  # noqa: E402

MOST_CURVES = 8
QUANTITIES = {"u": "displacement", "v": "velocity", "a": "acceleration",
              "path_length": "path length", "sigma": "stress",
              "total_sigma": "total stress", "pore_pressure": "pore pressure"}


def arguments():
    parser = argparse.ArgumentParser(
        prog="moraine plot",
        description="Make PNG pictures of a finished run: the displacement "
        "and the whole history if nothing else is asked for.")
    parser.add_argument("files", nargs="+", metavar="OUTPUT",
                        help="folder of a run; or VTU files, one per panel; "
                        "or the CSV file of a material test")
    parser.add_argument("--field",
                        help="colour points by this field of the VTU files")
    parser.add_argument("--of",
                        choices=["points", "domains", "mesh", "contact"],
                        default="points", help="what is coloured; contact: "
                        "tractions on the rims of bodies (2D)")
    parser.add_argument("--step", type=int, default=-1,
                        help="number of the VTU file; the last if left out")
    parser.add_argument("--history", nargs="*", metavar="COLUMN",
                        help="curves of columns of history.csv, or of all "
                        "that have these words in their name")
    parser.add_argument("--against", default="t", metavar="COLUMN",
                        help="column on the horizontal axis")
    parser.add_argument("--measured", metavar="FILE.csv",
                        help="drawn over a material test, by columns of the "
                        "same names")
    render.add_arguments(parser)
    parser.add_argument("-o", "--output", help="PNG file, or CSV file of a "
                        "field's values")
    return parser.parse_args()


def vtu_of(run, series, step):
    """A VTU file of a run."""
    found = {int(path.stem): path for path in (run / series).glob("*.vtu")}
    if not found:
        render.fail(f"there are no VTU files in {run / series}")
    step = max(found) if step < 0 else step
    if step not in found:
        render.fail(f"--step: found {step}, allowed: {min(found)} to "
                    f"{max(found)}")
    return found[step]


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
    as many curves as can be told apart."""
    quantities = {}
    for column in columns:
        name = re.split(r" of | at ", name_of(column))[0]
        name = re.sub(r"_(x|y|z|xx|xy|xz|yy|yz|zz)$", "", name)
        label = render.with_unit(QUANTITIES.get(name, name), unit_of(column))
        quantities.setdefault(label, []).append(column)
    return [(label, group[i:i + MOST_CURVES])
            for label, group in quantities.items()
            for i in range(0, len(group), MOST_CURVES)]


def unit_of(column):
    unit = re.search(r"\[(.*)\]$", column)
    return render.shown_unit(unit[1]) if unit else ""


def draw_history(args, run, path):
    data = run / "history.csv"
    if not data.is_file():
        render.fail(f"there is no file {data}")
    with open(data) as file:
        rows = list(csv.reader(file))
    if len(rows) < 2:
        render.fail(f"{data} has no rows")
    values = {column: [float(row[i]) for row in rows[1:]]
              for i, column in enumerate(rows[0])}
    against = columns_of(rows[0], [args.against])[0]
    columns = columns_of(rows[0], args.history) if args.history else \
        [c for c in rows[0] if c != against and any(values[c])]
    if not columns:
        render.fail(f"{data} has no other column than {against} that is not "
                    "zero")
    render.draw_curves(panels_of(columns), values, name_of, against,
                       unit_of(against), str(path))


def table_of(path):
    """Numbers of a CSV file by names of columns, and the units of these."""
    with open(path, encoding="utf-8-sig") as file:
        rows = [row for row in csv.reader(file) if row]
    try:
        columns = {name_of(column).strip(): [float(row[i]) for row in rows[1:]]
                   for i, column in enumerate(rows[0])}
    except (IndexError, ValueError) as error:
        render.fail(f"{path} is no table of numbers under names: {error}")
    units = {name_of(column).strip(): unit_of(column) for column in rows[0]}
    for name, other in (("p", "p_compression"), ("p_compression", "p"),
                        ("eps_zz", "axial_compression"),
                        ("axial_compression", "eps_zz")):
        if name in columns and other not in columns:
            columns[other] = [-value for value in columns[name]]
    return columns, units


def draw_test(path, measured, output):
    """A material test: q over p and over the strain, volume over ln p."""
    computed, units = table_of(path)
    others = table_of(measured)[0] if measured else {}
    unknown = [name for name in others if name not in computed]
    if unknown:
        render.fail(f"{measured}: found column '{unknown[0]}', allowed: "
                    f"{', '.join(computed)}")
    strain = next(name for name in ("gamma_xz", "axial_compression", "eps_q")
                  if name in computed)
    panels = [("p_compression", "q"),
              (strain, "sigma_xz" if strain == "gamma_xz" else "q"),
              ("p_compression", "eps_v")]
    if others and not any(a in others and b in others for a, b in panels):
        render.fail(f"{measured}: found no two columns that a panel shows: " +
                    ", ".join(f"{b} over {a}" for a, b in panels))
    render.draw_over(panels, computed, units, others,
                     {2} if max(computed["p_compression"]) > 0 else set(),
                     str(output))


def file_name(args, first):
    """Another one for each picture of a run: the words of the command."""
    words = [first] + [word.removeprefix("--") for word in sys.argv[1:]
                       if word not in (args.files[0], "--field", "--history",
                                       "--component")]
    return re.sub(r"[^\w.-]+", "_", "-".join(filter(None, words))) + ".png"


def main():
    args = arguments()
    run = pathlib.Path(args.files[0])
    if not run.exists():
        render.fail(f"there is no folder or file '{run}'")
    if run.suffix == ".csv":
        output = args.output or run.with_suffix(".png")
        draw_test(run, args.measured, output)
        print(output)
        return
    if not run.is_dir():
        run = None
        if args.history is not None or not args.output:
            render.fail("VTU files need -o FILE.png, and have no --history")
    elif len(args.files) > 1:
        render.fail("one folder at a time; or several VTU files")
    if args.of == "contact" and (not run or args.field or args.component):
        render.fail("--of contact draws tractions of the folder of a run, "
                    "without --field and --component")
    folder = run / "plots" if run else None
    if folder and not args.output:
        folder.mkdir(exist_ok=True)
    if args.of == "contact":
        import plot_contact
        path = args.output or folder / file_name(args, "")
        plot_contact.draw(str(vtu_of(run, args.of, args.step)), run, path)
        print(path)
        return
    asks_for_field = args.field or args.component or args.output
    if args.history is not None or not asks_for_field:
        path = args.output or folder / (
            file_name(args, "history") if args.history else "history.png")
        draw_history(args, run, path)
        print(path)
    if args.history is None:
        first = "" if args.field else "displacement"
        args.field = args.field or first
        path = args.output or folder / file_name(args, first)
        if run:
            args.files = [str(vtu_of(run, args.of, args.step))]
        render.draw(args, str(path))
        print(path)


main()
