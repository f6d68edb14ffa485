# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
#
# Contained block and simple shear: published errors.

run block cortis-2017/block-30
render block-30 "$(last block/points)" --mesh --field displacement --component magnitude \
  --range 0 1 --heading "Contained block at 30 degrees, skew Nitsche" --title "|u|" \
  --unit mm --length-unit mm

study block-study cortis-2017/block-study "Mesh/Cell size = 10" \
  "Constants/angle = {{0|30|45}}"
plot block-study 900,660 <<'GP'
set title 'Contained block, h = 10 mm: error over the band width'
set xlabel 'band width over cell size  δ/h  [-]'
set ylabel 'mean relative error of displacement  r_u  [-]'
set logscale xy
set format '10^{%T}'
set xrange [0.5e-8:2e-1]
set yrange [1e-17:10]
data = 'block-study/study.csv'
band = 'Constants/band'
error(angle, name) = column('Constants/angle') == angle ? of(name, column('error')) : NaN
set label 1 'published, 30°' right at 1.7e-1,4e-8
set label 2 'published, 0°, 45°, 90°' right at 1.7e-1,5e-10
plot data using (column(band)):(error( 0, 'weighted')) w lp lt 4 pt 10 title 'weighted,  0°', \
     data using (column(band)):(error(30, 'weighted')) w lp lt 4 pt 11 title 'weighted, 30°', \
     data using (column(band)):(error(45, 'weighted')) w lp lt 4 pt  8 title 'weighted, 45°', \
     data using (column(band)):(error( 0, 'augmented Lagrangian')) w lp lt 3 pt 6 title 'multipliers,  0°', \
     data using (column(band)):(error(30, 'augmented Lagrangian')) w lp lt 3 pt 7 title 'multipliers, 30°', \
     data using (column(band)):(error(45, 'augmented Lagrangian')) w lp lt 3 pt 4 title 'multipliers, 45°', \
     1.173e-8 lt 8 dt 2 notitle, 1.573e-9 lt 8 dt 2 notitle, 2.036e-9 lt 8 dt 2 notitle
GP

run shear cortis-2017/simple-shear
render simple-shear "$(last shear/points)" --field displacement --component y --range 0 10 \
  --heading "Simple shear at x_A = 10 mm, skew Nitsche" --title "u_y" --unit mm \
  --length-unit mm

study shear-study cortis-2017/simple-shear "Study/Error = r_sigma_xy" \
  "Constants/x_A = {{0|1e-6|1e-3|0.1|1|5|10|20|25|30|40|50|60|70|75|80|90|95|99|99.9|99.999|100}}" \
  "${enforcements[@]}"
plot simple-shear-error <<'GP'
set title 'Simple shear: error of the shear stress over the place of the square'
set xlabel 'x_A  [mm]'
set ylabel 'mean relative error  r_{σxy}  [-]'
set logscale y
set format y '10^{%T}'
set xrange [-3:103]
set yrange [1e-17:1e-4]
set label 1 'published bound (figure 16): 2e-8' at 4,5e-8
data = 'shear-study/study.csv'
place = 'Constants/x_A'
plot for [i=1:5] data using (column(place)):(of(Name[i], column('error'))) w lp lt i title Title[i], \
     2e-8 lt 8 dt 2 notitle
GP
