# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
#
# The study of cell means: error against time, which shows wall times. The group
# takes a quarter of an hour and is not among those that run if none is named; its
# tables are left in $MORAINE_TABLES if that names a folder.

/usr/bin/python3 "$figures/locking_study.py" "$build/moraine"
[ -z "${MORAINE_TABLES:-}" ] || cp ./*.csv "$MORAINE_TABLES"

plot locking-study 1500,560 <<'GP'
set multiplot layout 1,3 title 'Cells halved from point to point: error over the wall time of the case'
set logscale xy
set format y '10^{%T}'
set xlabel 'wall time  [s]'
set ylabel 'relative error  [-]'
set key maxrows 3 width -2
set bmargin 7
of_case(p, w, value) = strcol('problem') eq p && strcol('way') eq w ? value : NaN
array W[5] = ['FE pointwise', 'FE cell mean', 'FE Q2', 'GIMP pointwise', 'GIMP cell mean']
array L[5] = [1, 3, 8, 5, 4]
set xrange [0.01:2]
set title "Cook's membrane, ν = 1/3: tip"
set yrange [3e-4:1]
plot for [i=1:5] 'cook.csv' using (column('seconds')):(of_case('Cook 0.3333', W[i], column('error'))) w lp lt L[i] title W[i]
set title "Cook's membrane, ν = 0.4999: tip"
plot for [i=1:5] 'cook.csv' using (column('seconds')):(of_case('Cook 0.4999', W[i], column('error'))) w lp lt L[i] title W[i]
set title 'strip footing, ν = 0.49: load at the end'
set xrange [0.02:200]
set yrange [1e-3:3]
plot for [i=1:5] 'footing.csv' using (column('seconds')):(of_case('bearing', W[i], column('error'))) w lp lt L[i] title W[i]
unset multiplot
GP
