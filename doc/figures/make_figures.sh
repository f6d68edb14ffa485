#!/bin/bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
#
# Runs scenes, studies and tutorial programs and makes the pictures of
# doc/figures/ from their results:
#   doc/figures/make_figures.sh [BUILD FOLDER [GROUP...]]
# BUILD FOLDER is build/release if left out; a GROUP is one of the scripts in
# groups/ without its ending (all but 'studies', 'points', 'locking', 'contact' and
# 'cut-study' if left out). Needs what ./moraine test installs. Pictures of studies that show wall times
# come from moraine study itself.

set -euo pipefail
figures=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
prm=$figures/../../prm
build=$(readlink -f "${1:-$figures/../../build/release}")
[ $# -gt 1 ] && groups=("${@:2}") || groups=(start block beams penetration ring basics large wang waves motions footing hard cuts softening safety soils limit)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export OMP_NUM_THREADS=1

# moraine COMMAND NAME SCENE [SETTING...]: results in ./NAME. Cases of a study that
# end early, which it tells by a 1, are rows of its table.
moraine() {
  local words=() setting
  for setting in "${@:4}"; do words+=(--set "$setting"); done
  "$build/moraine" "$1" "$prm/$3.prm" --output "$2" "${words[@]}" >"$2.log" 2>&1 ||
    { [ $? = 1 ] && [ "$1" = study ]; } || {
    cat "$2.log"
    exit 1
  }
}
run() { moraine run "$@"; }

# What is drawn is the table of ./NAME/study.csv, not the plot of the study
# (error against time). Gnuplot cuts a text at a comma, so they go.
study() {
  moraine study "$@" "Output/Points = false" "Output/Mesh = false"
  /usr/bin/python3 - "$1/study.csv" <<'PY'
import csv, sys
with open(sys.argv[1]) as file:
    rows = [[text.replace(",", "") for text in row] for row in csv.reader(file)]
with open(sys.argv[1], "w") as file:
    csv.writer(file, lineterminator="\n").writerows(rows)
PY
}

# least NAME [SETTING...]: runs prm/studies/NAME.prm three times; NAME.csv has the
# least times.
least() {
  local i
  for i in 1 2 3; do study "$1-$i" "studies/$1" "${@:2}"; done
  /usr/bin/python3 - "$1" <<'PY'
import csv, sys
runs = []
for i in (1, 2, 3):
    with open(f"{sys.argv[1]}-{i}/study.csv") as file:
        runs.append(list(csv.DictReader(file)))
with open(sys.argv[1] + ".csv", "w") as file:
    out = csv.DictWriter(file, runs[0][0], lineterminator="\n")
    out.writeheader()
    for rows in zip(*runs):
        out.writerow(min(rows, key=lambda row: float(row["wall_seconds"] or 0)))
PY
}

# Settings that make a study compare the enforcements; style.gp names them too.
enforcements=()
for setting in "skew Nitsche 10: skew Nitsche" \
  "symmetric Nitsche 20: symmetric Nitsche; Nitsche factor = 20" \
  "augmented Lagrangian 1e-6: augmented Lagrangian; Band width = 1e-6" \
  "weighted 1e-6 of places: weighted; Band width = 1e-6; Held in a cell = places" \
  "penalty 1e6: penalty; Penalty factor = 1e6"; do
  words=${setting#*: }
  enforcements+=("Study/Series/${setting%%:*}/Settings = Boundaries/*/Enforcement = ${words//; /; Boundaries/*/}")
done

# last FOLDER: its last VTU file
last() { find "$1" -name '*.vtu' | sort | tail -n 1; }

# What 'moraine plot' does.
moraine_plot() { /usr/bin/python3 "$figures/../../source/output/plot.py" "$@"; }

# render NAME ...: draw fields of VTU files as NAME.png
render() { moraine_plot "${@:2}" -o "$figures/$1.png"; }

# table NAME.csv ...: write the values of a field into ./NAME.csv
table() { moraine_plot "${@:2}" -o "$1"; }

# plot NAME [WIDTH,HEIGHT]: gnuplot draws NAME.png by the commands it reads
plot() {
  { echo "set terminal pngcairo enhanced size ${2:-900,600} font 'DejaVu Sans,13'"
    echo "set output '$figures/$1.png'"
    cat "$figures/style.gp" -
  } | gnuplot
}

for group in "${groups[@]}"; do
  echo "$group"
  mkdir "$work/$group"
  cd "$work/$group"
  source "$figures/groups/$group.sh"
done
