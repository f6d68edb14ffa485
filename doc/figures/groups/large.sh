# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
#
# Large deformation: column, cantilever, collapse.

quiet=("Output/Points = false" "Output/Mesh = false")

# cells, then error over rho g l0 of GIMP, CPDI1, CPDI2, MPM and of AMPLE's GIMP and MPM
ample=(4.1333e-2,6.33e-2 1.2941e-2,9.70e-2 3.6589e-3,8.67e-2 1.0487e-3,8.01e-2 4.3572e-4,8.29e-2)
i=0
for n in 4 8 16 32 64; do
  row=$n
  for name in gimp cpdi1 cpdi2 mpm; do
    run "$name-$n" "large-deformation/column-$name" "Mesh/Cells = 1, $n" "${quiet[@]}"
    row+=,$(sed -n 's/.*"mean_sigma": \([0-9.e+-]*\).*/\1/p' "$name-$n/summary.json")
  done
  echo "$row,${ample[i]}"
  i=$((i + 1))
done >column.csv
plot large-column-error 900,600 <<'GP'
set title 'Column under its own weight, down to half its height (2² points per cell, 40 steps)'
set xlabel 'cell size  h  [m]'
set ylabel 'mean error of vertical stress / (ρ g l_0)  [-]'
set logscale xy
set format y '10^{%T}'
set xrange [0.6:16]
set xtics (0.78125, 1.5625, 3.125, 6.25, 12.5)
set yrange [1e-4:2e-1]
set label 1 'slope 2' at 3,1.2e-3
plot 'column.csv' using (50 / $1):($2 / 4e4) w lp lt 1 title 'GIMP', \
     '' using (50 / $1):($3 / 4e4) w lp lt 3 title 'CPDI1', \
     '' using (50 / $1):($4 / 4e4) w p lt 6 ps 2.4 title 'CPDI2', \
     '' using (50 / $1):($5 / 4e4) w lp lt 4 title 'standard material points', \
     '' using (50 / $1):6 w p lt 8 title 'AMPLE, GIMP', \
     '' using (50 / $1):7 w p lt 7 ps 2 title 'AMPLE, standard', \
     3e-4 * (x / 2)**2 lt 9 notitle
GP

for name in gimp mpm; do
  run "stress-$name" "large-deformation/column-$name" "Mesh/Cells = 1, 32"
  table "stress-$name.csv" "$(last stress-$name/points)" --field stress --component yy
done
# Exact by the height now: of W with height (E / rho g) (q(W0) - q(W)), s = W exp(W).
plot large-column-stress 900,600 <<'GP'
set title 'Column under its own weight: vertical stress of all points, 32 cells'
set xlabel 'vertical stress  [kPa]'
set ylabel 'height now  [m]'
set xrange [-55:5]
set yrange [0:25]
set parametric
set trange [0:1.20216787]
q(w) = w + w**2 / 2
plot 'stress-mpm.csv' using (column('value') / 1e3):'y' w p lt 4 pt 6 ps 1.4 title 'standard material points', \
     'stress-gimp.csv' using (column('value') / 1e3):'y' w p lt 1 pt 7 ps 0.7 title 'GIMP', \
     -10 * t * exp(t), 12.5 * (q(1.20216787) - q(t)) w l lt 8 title 'exact'
GP

cat >elastica.csv <<'CSV'
.25,.08274592,.00411782
.5,.16214358,.01591896
.75,.23561523,.03396632
1,.30172077,.05643324
2,.49345748,.16064172
3,.60325344,.25442018
4,.66996418,.32894124
5,.71379152,.38762836
6,.74457115,.43458883
7,.76736910,.47292743
8,.78498237,.50482773
9,.79905553,.53182056
9.6,.80624,.54613
CSV
beam() { run "$1" large-deformation/beam-gimp "${@:2}"; }
beam fe "Method/Method = finite element" "Method/Degree = 2" "Mesh/Cell size = 0.25" \
  "Method/Fictitious stiffness = 0" "${quiet[@]}"
beam b2
render beam-domains b2/domains/000{10,50}.vtu --mesh --columns 2 --label "20 kN" "100 kN" \
  --field stress --component xx --diverging --range -2000000 2000000 \
  --heading "Cantilever, GIMP, h = 0.5 m, 2² points per cell: their domains" \
  --title "stress xx" --unit Pa --length-unit m
beam b6 "Method/Points per direction = 6" "Mesh/Cell size = 0.25"
plot large-beam 900,640 <<'GP'
set title 'Cantilever bent by a force at its end: how far the end moves'
set xlabel 'P l² / (E I),  E of plane strain  [-]'
set ylabel 'displacement of the end / length  [-]'
set xrange [0:9.8]
set yrange [0:0.9]
set label 1 'deflection v' at 3,0.72
set label 2 'shortening u' at 4,0.22
u(c) = -(2 * column('u_'.c.' at second [length]') - column('u_'.c.' at first [length]')) / 10
p = 9.6
plot 'fe/history.csv' using (p * column('t')):(u('y')) w l lt 7 title 'FE Q2, h = 0.25 m', \
     '' using (p * column('t')):(u('x')) w l lt 7 notitle, \
     'b6/history.csv' using (p * column('t')):(u('y')) every 3 w p lt 1 pt 6 title 'GIMP, h = 0.25 m, 6² points per cell', \
     '' using (p * column('t')):(u('x')) every 3 w p lt 1 pt 6 notitle, \
     'b2/history.csv' using (p * column('t')):(u('y')) every 3::1 w p lt 4 pt 2 title 'GIMP, h = 0.5 m, 2² points per cell', \
     '' using (p * column('t')):(u('x')) every 3::1 w p lt 4 pt 2 notitle, \
     'elastica.csv' using 1:2 w lp lt 8 dt 3 title 'elastica (no shear, no extension)', \
     '' using 1:3 w lp lt 8 dt 3 notitle
GP

for h in 1 0.5 0.25; do
  run "collapse-$h" large-deformation/collapse "Mesh/Cell size = $h"
done
render collapse "$(last collapse-0.5/points)" --mesh --field plastic_strain \
  --heading "Collapse at full gravity, GIMP, h = 0.5 m, 2² points per cell" \
  --title "plastic strain κ" --length-unit m
run collapse-fe large-deformation/collapse "Method/Method = finite element" "Method/Degree = 2" "Method/Points per direction = 3" \
  "Mesh/Cell size = 0.5" "Method/Fictitious stiffness = 0" "${quiet[@]}" \
  "Probes/toe/Kind = interpolated" "Probes/toe/Location = 7.875, 0.125" \
  "Probes/top/Kind = interpolated" "Probes/top/Location = 0.125, 7.875"
plot collapse-load 900,600 <<'GP'
set title 'Collapse of a block: points nearest to the toe and to the top of the axis'
set xlabel 'weight  [kN/m³]'
set ylabel 'x of the toe, y of the top  [m]'
set xrange [0:10]
set yrange [4:15]
set label 1 'toe' at 8.3,12.6
set label 2 'top' at 8.3,6.8
x = "column('x at toe [length]')"
y = "column('y at top [length]')"
plot 'collapse-fe/history.csv' using (10 * column('t')):(@x) w l lt 7 title 'FE Q2, h = 0.5 m', '' using (10 * column('t')):(@y) w l lt 7 notitle, \
     'collapse-1/history.csv' using (10 * column('t')):(@x) w p lt 4 pt 2 title 'GIMP, h = 1 m', '' using (10 * column('t')):(@y) w p lt 4 pt 2 notitle, \
     'collapse-0.5/history.csv' using (10 * column('t')):(@x) w p lt 1 pt 6 title 'GIMP, h = 0.5 m', '' using (10 * column('t')):(@y) w p lt 1 pt 6 notitle, \
     'collapse-0.25/history.csv' using (10 * column('t')):(@x) w p lt 3 pt 4 ps 0.8 title 'GIMP, h = 0.25 m', '' using (10 * column('t')):(@y) w p lt 3 pt 4 ps 0.8 notitle
GP
