# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
#
# Contained block and simple shear: published errors.

run block cortis-2017/block-30
render block-30 "$(last block/points)" --mesh "$(last block/mesh)" \
  --field displacement --component magnitude --range 0 1 \
  --heading "Contained block at 30 degrees, skew Nitsche" \
  --title "|u|" --unit mm --length-unit mm --size 640 640 --point-scale 0.8 \
  --wall 0 0 86.60 50 --wall 87.47 50.5 37.47 137.1 \
  --wall 36.60 136.6 -50 86.60 0 0

study block-study cortis-2017/block-study "Mesh/Cell size = 10" \
  "Constants/angle = {{0|30|45}}"
plot block-study 900,680 <<'GP'
set title 'Contained block, h = 10 mm: error of the weighted basis over its band width'
set xlabel 'band width over cell size  δ/h  [-]'
set ylabel 'mean relative error of displacement  r_u  [-]'
set logscale xy
set format '10^{%T}'
set xrange [0.5e-8:2e-1]
set yrange [1e-17:1e3]
set key top left maxrows 5
at(angle, name) = column('Constants/angle') == angle ? of(name, column('error')) : NaN
set label 1 'published, table 1 (δ/h = 10^{-6}): 30°, 45°, 0°' at 1.2e-6,2.5e-10
data = 'block-study/study.csv'
band = 'Constants/band'
plot data using (column(band)):(at( 0, 'weighted, no reaction')) w lp lt 4 pt 10 title 'no reaction,  0°', \
     data using (column(band)):(at(30, 'weighted, no reaction')) w lp lt 4 pt 11 title '30°', \
     data using (column(band)):(at(45, 'weighted, no reaction')) w lp lt 4 pt 8 title '45°', \
     data using (column(band)):(at( 0, 'weighted')) w lp lt 3 pt 6 title 'with reaction,  0°', \
     data using (column(band)):(at(30, 'weighted')) w lp lt 3 pt 7 title '30°', \
     data using (column(band)):(at(45, 'weighted')) w lp lt 3 pt 4 title '45°', \
     1.173e-8 lt 8 dt 3 title 'published 30°', 2.036e-9 lt 8 dt 4 title '45°'
GP
