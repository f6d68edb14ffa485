# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
#
# The study of cuts: 40 places of a block in its mesh, ten ways; takes some minutes
# and is not among the groups that run if none is named. Its table is left in
# $MORAINE_TABLES if that names a folder.

/usr/bin/python3 "$figures/cut_study.py" "$build/moraine"
[ -z "${MORAINE_TABLES:-}" ] || cp cut-study.csv "$MORAINE_TABLES"

for way in "free nodes" "stiffness 1e-8" "stiffness 1e-4" "stiffness 1e-2" \
  "aggregated below 0.1" "aggregated below 0.5" "ghost factor 0.01" \
  "ghost factor 0.1" "ghost factor 1" "ghost factor 10"; do
  for column in 3 4 5; do
    awk -F, -v way="$way" -v column=$column '$1 == way && $2 == "GIMP" {
      value = $column; print (value < 0 ? -value : value) }' cut-study.csv |
      sort -g >"$way-$column.csv"
  done
done

panels=$(
  cat <<'GP'
set multiplot layout 1,3 title 'Block 2 × 1 in cells of 1/32, GIMP, 40 places in its mesh, sorted'
set logscale y
set xlabel 'place'
set key maxrows 3 width -3 samplen 1.5 font ',11'
set bmargin 7
set format y '10^{%T}'
set ylabel 'displacement over aligned − 1  [-]'
plot for [i=1:|W|] W[i].'-3.csv' using 0:1 w lp lt L[i] title W[i]
set ylabel 'largest stress of a point over aligned  [-]'
plot for [i=1:|W|] W[i].'-4.csv' using 0:1 w lp lt L[i] title W[i]
set format y '%g'
set ylabel 'iterations of multigrid (500: no convergence)'
plot for [i=1:|W|] W[i].'-5.csv' using 0:1 w lp lt L[i] title W[i]
unset multiplot
GP
)
plot cut-study 1500,560 <<GP
array W[6] = ['free nodes', 'stiffness 1e-8', 'stiffness 1e-4', 'stiffness 1e-2', 'aggregated below 0.1', 'aggregated below 0.5']
array L[6] = [1, 2, 5, 8, 3, 4]
$panels
GP
plot cut-study-ghost 1500,560 <<GP
array W[5] = ['aggregated below 0.1', 'ghost factor 0.01', 'ghost factor 0.1', 'ghost factor 1', 'ghost factor 10']
array L[5] = [3, 1, 2, 5, 8]
$panels
GP
