# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
#
# Patch test, column, loads and rigid motion: exact solutions.

run patch verification/patch
run patch-random verification/patch-random
render patch "$(last patch/points)" "$(last patch-random/points)" --columns 2 \
  --label "one point per cell, clipped" "1600 random points" --field stress --component xx \
  --range 0 20 --diverging --heading "Patch test: exact stress xx is 10 everywhere" \
  --title "stress xx" --unit "N/mm²" --length-unit mm

for h in 4 1; do
  run "column-$h" verification/column "Mesh/Cell size = $h"
  table "column-$h.csv" "$(last column-$h/points)" --field stress --component yy
done
plot column-stress <<'GP'
set title 'Column under its own weight: vertical stress of all points (MPM, 2² per cell)'
set xlabel 'vertical stress  [10^{-3} N/mm²]'
set ylabel 'height  y  [mm]'
set xrange [-1.05:0.05]
set yrange [0:50]
plot 'column-4.csv' using (1e3 * column('value')):'y' w p lt 1 pt 6 ps 1.6 title 'h = 4 mm', \
     'column-1.csv' using (1e3 * column('value')):'y' w p lt 4 pt 7 ps 0.6 title 'h = 1 mm', \
     '+' using (-0.02 * (50 - 50 * $0 / 99)):(50 * $0 / 99) w l lt 8 title 'exact'
GP

study column-study verification/column "Study/Error = l2_sigma" \
  "Mesh/Cell size = {{4|2|1|0.5}}" \
  "Study/Series/MPM 2x2/Settings = Method/Points per direction = 2" \
  "Study/Series/MPM 3x3/Settings = Method/Points per direction = 3" \
  "Study/Series/GIMP 2x2/Settings = Method/Method = GIMP" \
  "Study/Series/FE Q1/Settings = Method/Method = finite element"
plot column-error 900,560 <<'GP'
set title 'Column under its own weight: error of stress'
set xlabel 'cell size  h  [mm]'
set ylabel 'relative L2 error of stress over the points  [-]'
set logscale xy
set xrange [0.45:4.4]
set xtics (0.5, 1, 2, 4)
set yrange [2e-3:6e-2]
set ytics (0.002, 0.005, 0.01, 0.02, 0.05)
set label 1 'slope 1' at 1.5,8.5e-3
data = 'column-study/study.csv'
h = 'Mesh/Cell size'
plot data using (column(h)):(of('MPM 2x2', column('error'))) w lp lt 1 pt 6 ps 2.2 title 'MPM, 2² points per cell', \
     data using (column(h)):(of('MPM 3x3', column('error'))) w lp lt 3 title 'MPM, 3² points per cell', \
     data using (column(h)):(of('GIMP 2x2', column('error'))) w lp lt 4 pt 2 title 'GIMP, 2² points per cell', \
     data using (column(h)):(of('FE Q1', column('error'))) w lp lt 7 title 'FE Q1', \
     0.0065 * x lt 9 notitle
GP

run loads verification/loads
# All loads together, times the curve 0, 2, 1 at t = 0, 1, 2.
plot loads <<'GP'
set title 'Every kind of load at once: what the supports carry (MPM, 2² points per cell)'
set xlabel 'time  t  [-]'
set ylabel 'force  [N/mm]'
set xrange [0:2]
set yrange [0:1250]
curve(t) = t < 1 ? 2 * t : 3 - t
of_all(d) = column('reaction_'.d.' of left [force]') + column('reaction_'.d.' of base [force]')
set key maxrows 2
plot 'loads/history.csv' using 't':(of_all('x')) w p lt 1 ps 2 title 'reactions, x', \
     'loads/history.csv' using 't':(of_all('y')) w p lt 4 ps 2 title 'reactions, y', \
     425.6 * curve(x) lt 1 title 'minus the loads, x: 425.6 f(t)', \
     513 * curve(x) lt 4 title 'minus the loads, y: 513 f(t)'
GP

run motion verification/rigid-motion
render rigid-motion motion/points/000{00,10}.vtu --columns 2 \
  --label "start" "after 10 steps" --field displacement --component magnitude --range 0 50 \
  --heading "Rigid motion by 3.7 and 2.1 cells" --title "|u|" --unit "mm" --length-unit mm
