# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
#
# Studies of dynamics and of double mapping: error against time. Times are the
# least of three runs; the group takes a quarter of an hour and is not among those
# that run if none is named.

for name in dynamics-column dynamics-flight double-mapping-static \
  double-mapping-dynamic double-mapping-flight; do
  least $name
done

cat >panels.gp <<'GP'
set logscale xy
set format y '10^{%T}'
set xlabel 'wall time  [s]'
set key below center vertical Left reverse maxrows 3 width -2 title ' ' font ',5'
set key font ',11'
set bmargin 6.5
# Rows of a study with this number of steps (0: all) and this series.
row(n, name, value) = n == 0 || column('Time/Steps') == n ? of(name, value) : NaN
GP

plot dynamics-study 1200,1040 <<'GP'
load 'panels.gp'
set multiplot layout 2,2 title 'Pulse in a column, h = 0.5, 0.25 and 0.125 m: stress at the end over the time of the case'
set ylabel 'relative error of stress, L_2  [-]'
set xtics (0.1, 0.2, 0.5, 1, 2, 5)
set yrange [1e-3:1e-1]
array M[6] = ['FE Q1', 'FE Q2', 'MPM APIC', 'GIMP APIC', 'CPDI2 APIC', 'DM-GC APIC']
array T[6] = ['FE Q1', 'FE Q2', 'MPM', 'GIMP', 'CPDI2 (CPDI1 alike)', 'DM-GC']
set title 'methods, column that stands, Δt = 1.25 ms'
set xrange [0.1:5]
plot for [i=1:6] 'dynamics-column.csv' using (column('wall_seconds')):(row(800, M[i], column('error'))) w lp lt i title T[i]
set title 'methods, column that flies, Δt = 0.625 ms'
plot for [i=1:6] 'dynamics-flight.csv' using (column('wall_seconds')):(row(1600, M[i], column('error'))) w lp lt i title T[i]
array X[5] = ['APIC', 'FLIP', 'blend', 'FMPM', 'PIC']
set title 'transfers, GIMP, column that flies, Δt = 0.625 ms'
set yrange [3e-3:1]
plot for [i=1:5] 'dynamics-flight.csv' using (column('wall_seconds')):(row(1600, 'GIMP '.X[i], column('error'))) w lp lt i title X[i]
set title 'steps, column that flies'
set yrange [3e-3:1e-1]
plot for [i=1:3] n=200*2**i 'dynamics-flight.csv' using (column('wall_seconds')):(row(n, 'FE Q1', column('error'))) w lp lt i dt 2 pt 2*i+2 title sprintf('FE Q1, Δt = %g ms', 1e3/n), \
     for [i=1:3] n=200*2**i 'dynamics-flight.csv' using (column('wall_seconds')):(row(n, 'GIMP APIC', column('error'))) w lp lt i title sprintf('GIMP, Δt = %g ms', 1e3/n)
unset multiplot
GP

plot double-mapping-study 1500,560 <<'GP'
load 'panels.gp'
set multiplot layout 1,3 title 'Double mapping, cells halved from point to point: stress at the end over the time of the case'
set ylabel 'relative error of stress, L_2  [-]'
array M[6] = ['MPM', 'GIMP', 'DM', 'DM-G', 'DM-C', 'DM-GC']
set title 'at rest: column under its weight, 40 steps'
set xtics (0.02, 0.05, 0.1, 0.2, 0.5)
set xrange [0.02:0.5]
plot for [i=1:6] 'double-mapping-static.csv' using (column('wall_seconds')):(row(0, M[i], column('error'))) w lp lt i title M[i]
set xtics (0.5, 1, 2, 5, 10)
set title 'pulse, points stay in their cells, 3200 steps'
set xrange [0.5:10]
plot for [i=1:6] 'double-mapping-dynamic.csv' using (column('wall_seconds')):(row(0, M[i], column('error'))) w lp lt i title M[i]
set title 'pulse, points cross cells, 1600 steps'
set xrange [0.3:10]
plot for [i=1:6] 'double-mapping-flight.csv' using (column('wall_seconds')):(row(0, M[i], column('error'))) w lp lt i title M[i]
unset multiplot
GP
