# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
#
# Volume that hardly changes: mean stress below a strip footing, load over way;
# an embankment of undrained clay.

for how in pointwise "cell mean"; do
  run "bearing-${how% *}" hard-cases/bearing-gimp "Method/Volumetric strain = $how"
  run "fe-${how% *}" hard-cases/bearing-fe "Method/Volumetric strain = $how"
done

render bearing-stress "$(last bearing-pointwise/points)" "$(last bearing-cell/points)" \
  --columns 2 --label "pointwise" "cell mean" --field mean_stress --range -6 2 \
  --title "mean stress" --unit kPa --length-unit m \
  --heading "Mean stress at a settlement of 0.01 m, GIMP, h = 1/8, Poisson's ratio 0.49"

plot bearing-load <<'GP'
set title 'Strip footing, half width 1 m, h = 1/8 m (FE 2/15 m), ν = 0.49'
set xlabel 'settlement  [m]'
set ylabel 'reaction over half width and k  [-]'
plot 'bearing-pointwise/history.csv' using (0.01 * column('t')):(-column('reaction_y of footing [force]')) w lp lt 1 title 'GIMP, pointwise', \
     'fe-pointwise/history.csv' using (0.01 * column('t')):(-column('reaction_y of footing [force]')) w lp lt 8 title 'FE, pointwise', \
     'bearing-cell/history.csv' using (0.01 * column('t')):(-column('reaction_y of footing [force]')) w lp lt 3 title 'GIMP, cell mean', \
     'fe-cell/history.csv' using (0.01 * column('t')):(-column('reaction_y of footing [force]')) w lp lt 4 title 'FE, cell mean', \
     2 + pi w l lt 9 title '2 + π'
GP

undrained=("Materials/clay/Poisson ratio = 0.49" "Time/End time = 1" "Time/Steps = 20")
run slope-pointwise geotechnics/slope "${undrained[@]}" "Method/Volumetric strain = pointwise"
run slope-cell geotechnics/slope "${undrained[@]}" "Method/Volumetric strain = cell mean"
run slope-fe geotechnics/slope "${undrained[@]}" "Method/Volumetric strain = cell mean" \
  "Method/Method = finite element"
run slope-q2 geotechnics/slope "${undrained[@]}" "Method/Method = finite element" \
  "Method/Degree = 2" "Method/Points per direction = 3"

render undrained-stress "$(last slope-pointwise/points)" "$(last slope-cell/points)" "$(last slope-q2/points)" \
  --columns 1 --label "GIMP, pointwise" "GIMP, cell mean" "FE Q2" --field mean_stress \
  --range -250 50 --title "mean stress" --unit kPa --length-unit m \
  --heading "Mean stress under the full weight, h = 0.5 m, Poisson's ratio 0.49"

plot undrained-settlement <<'GP'
set title 'Embankment of undrained clay, finite strain, h = 0.5 m, ν = 0.49'
set xlabel 'part of the weight  [-]'
set ylabel 'settlement of the crest  [m]'
plot 'slope-pointwise/history.csv' using (column('t')):(-column('u_y at crest [m]')) w lp lt 1 title 'GIMP, pointwise', \
     'slope-cell/history.csv' using (column('t')):(-column('u_y at crest [m]')) w lp lt 3 title 'GIMP, cell mean', \
     'slope-fe/history.csv' using (column('t')):(-column('u_y at crest [m]')) w lp lt 4 title 'FE, cell mean', \
     'slope-q2/history.csv' using (column('t')):(-column('u_y at crest [m]')) w lp lt 8 title 'FE Q2'
GP
