# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
#
# Ring, quarter of a ring and hollow sphere.

run ring boundaries/ring
run quarter boundaries/ring-roller
render ring "$(last ring/points)" "$(last quarter/points)" --columns 2 \
  --label "ring, 20 cells across" "quarter on rollers, 20 cells across" \
  --field von_mises_stress --heading "Elastic ring, pressure 1 inside: skew Nitsche" \
  --title "von Mises stress" --range 0.3 2.1

run sphere boundaries/hollow-sphere
render hollow-sphere "$(last sphere/points)" --mesh --field displacement \
  --component magnitude --heading "Octant of a hollow sphere, 8 cells across: skew Nitsche" \
  --title "|u|" --range 0 3e-4

for scene in ring ring-roller; do
  study "$scene-study" "boundaries/$scene" "Study/Error = l2_u" \
    "Mesh/Cells = {{20, 20|40, 40|80, 80|120, 120|160, 160}}" "${enforcements[@]}"
done
plot ring-error 900,560 <<'GP'
set multiplot layout 1,2 title 'Elastic ring: error of the displacement over the points'
set logscale xy
set format y '10^{%T}'
set xlabel 'cell size  h  (outer radius 1)  [-]'
set ylabel 'relative L2 error of displacement  [-]'
set xrange [0.012:0.14]
set xtics (0.0144, 0.0288, 0.0575, 0.115)
set yrange [2e-5:1]
set label 1 'slope 2' at 0.03,7e-5
set lmargin 9
set rmargin 1
set bmargin 8
error(name) = of(name, column('error'))
# one legend for both, half below each
set label 2 'both arcs prescribed' at 0.014,0.5
plot for [i=1:5] 'ring-study/study.csv' using (2.3 / column('Mesh/Cells')):(error(Name[i])) w lp lt i title i < 4 ? Title[i] : '', \
     0.12 * x**2 lt 9 notitle
set label 2 'inner arc and sides on rollers'
unset ylabel
plot for [i=1:5] 'ring-roller-study/study.csv' using (2.3 / column('Mesh/Cells')):(error(Name[i])) w lp lt i title i > 3 ? Title[i] : '', \
     0.12 * x**2 lt 9 notitle
GP
