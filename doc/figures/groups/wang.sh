# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
#
# Wang et al. (2018): simple stretch, doughnut twist, elliptical hole.

quiet=("Output/Points = false" "Output/Mesh = false")
grep -v '^#' "$figures/../../tests/verification/stretch.csv" >exact.csv
for method in fe mpm gimp cpdi1 cpdi2; do
  run "stretch-$method" "wang-2018/stretch-$method" "Output/Residuals = true" "${quiet[@]}"
  # residual, next residual; without that of the step's start and round-off
  awk '/residuals / { for (i = 3; i < NF; ++i) if ($(i+1) >= 1e-13) print $i "," $(i+1) }' \
    "stretch-$method/log.txt" >"order-$method.csv"
done
plot stretch 1000,560 <<'GP'
set multiplot layout 1,2 title 'Simple stretch, E = 1000, ν = 0, ρ_c = 400, 2×2 cells, 20 steps'
set lmargin 10
set bmargin 8
set xlabel 'displacement of the right side  [length]'
set ylabel 'reaction of the right side  [force per thickness]'
set xrange [0:4.2]
set yrange [0:650]
force = 'reaction_x of right [force]'
set key maxrows 3
plot 'exact.csv' using 'displacement':'reaction_x' w l lt 7 title 'exact', \
     'stretch-fe/history.csv' using (0.2*$1):(column(force)) w p lt 1 pt 6 ps 2.2 title 'FE', \
     'stretch-mpm/history.csv' using (0.2*$1):(column(force)) w p lt 2 pt 4 ps 1.9 title 'MPM', \
     'stretch-gimp/history.csv' using (0.2*$1):(column(force)) w p lt 6 pt 1 ps 1.9 title 'GIMP', \
     'stretch-cpdi1/history.csv' using (0.2*$1):(column(force)) w p lt 3 pt 9 ps 1.3 title 'CPDI1', \
     'stretch-cpdi2/history.csv' using (0.2*$1):(column(force)) w p lt 4 pt 2 ps 1 title 'CPDI2'
set logscale xy
set format '10^{%T}'
set xrange [1e-4:1e-1]
set yrange [1e-8:1e-2]
set xlabel 'residual of an iteration  [-]'
set ylabel 'residual of the next one  [-]'
set label 1 'slope 2' at 2e-3,4e-7
plot 'order-fe.csv' w p lt 1 pt 6 ps 2.2 notitle, 'order-mpm.csv' w p lt 2 pt 4 ps 1.9 notitle, \
     'order-gimp.csv' w p lt 6 pt 1 ps 1.9 notitle, 'order-cpdi1.csv' w p lt 3 pt 9 ps 1.3 notitle, \
     'order-cpdi2.csv' w p lt 4 pt 2 ps 1 notitle, 0.4 * x**2 lt 9 notitle
GP

for method in fe mpm cpdi1 cpdi2; do
  run "twist-80-$method" "wang-2018/twist-80-$method" "${quiet[@]}"
  for n in 1 2; do
    # By standard MPM the ring comes apart on the finer mesh.
    run "twist-80-$method-$n" "wang-2018/twist-80-$method" "Mesh/Refinements = $n" \
      "Method/Separation = note" "Method/Return tolerance = 0.3" "Solver/Limit points = pseudo-transient" "${quiet[@]}"
  done
  run "ellipse-$method" "wang-2018/ellipse-$method"
done
# With 2² points the fine cells along the hole run out of points.
run twist-80-mpm-3 wang-2018/twist-80-mpm "Mesh/Refinements = 2" "Method/Points per direction = 3" \
  "Method/Return tolerance = 0.3" "Solver/Limit points = pseudo-transient" "${quiet[@]}"
run shear wang-2018/shear

# curves of four methods over the angle: torque and force of the hole over E
cat >curves.gp <<'GP'
set lmargin 9
set bmargin 7
set key maxrows 2
set yrange [0:*]
set ytics 0.2
tau = "(abs(column('moment of hole [force length]')) / (2 * pi * 25e6))"
f = "(column('force magnitude of hole [force]') / (2 * pi * 5e6))"
array Method[4] = ['fe', 'mpm', 'cpdi1', 'cpdi2']
array Words[4] = ['finite elements', 'standard MPM', 'CPDI1', 'CPDI2']
array Type[4] = [7, 1, 3, 4]
set xlabel 'angle of the hole  α  [°]'
GP
plot twist-80 1000,560 <<'GP'
set multiplot layout 1,2 title 'Doughnut twist, 5×18 cells, 2×2 points per cell, steps of 5°'
load 'curves.gp'
set xrange [0:82]
set ylabel 'force  Σ|r| / (2π · 5 E)  [-]'
set yrange [0:1.2]
plot for [i=1:4] 'twist-80-'.Method[i].'/history.csv' using 't':@f w lp lt Type[i] title Words[i]
set ylabel 'torque  |M| / (2π · 5² E)  [-]'
plot for [i=1:4] 'twist-80-'.Method[i].'/history.csv' using 't':@tau w lp lt Type[i] notitle
GP
plot twist-fine 1000,560 <<'GP'
set multiplot layout 1,2 title 'Doughnut twist, 2×2 points per cell, steps of at most 5°, Limit points = pseudo-transient'
load 'curves.gp'
set xrange [0:82]
set ylabel 'torque  |M| / (2π · 5² E)  [-]'
set yrange [0:1]
set label 1 '10×36 cells' at graph 0.05,0.93
plot for [i=1:4] 'twist-80-'.Method[i].'-1/history.csv' using 't':@tau w lp lt Type[i] ps 0.7 title Words[i]
set label 1 '20×72 cells, standard MPM 3×3 points'
array Run[4] = ['fe-2', 'mpm-3', 'cpdi1-2', 'cpdi2-2']
plot for [i=1:4] 'twist-80-'.Run[i].'/history.csv' using 't':@tau w lp lt Type[i] ps 0.7 notitle, \
     'twist-80-mpm-2/history.csv' using 't':@tau w l lt 1 dt 3 title 'standard MPM, 2×2 points'
GP
plot ellipse-torque 900,560 <<'GP'
set title 'Elliptical hole 6×4, 232 cells, 2×2 points per cell, steps of 5°'
load 'curves.gp'
set xrange [0:72]
set ylabel 'torque  |M| / (2π · 5² E)  [-]'
plot for [i=1:4] 'ellipse-'.Method[i].'/history.csv' using 't':@tau w lp lt Type[i] title Words[i]
GP
plot twist-shear <<'GP'
set title 'Simple shear of the material of the twist, one cell, 120 steps'
set xlabel 'shear  γ  [-]'
set ylabel 'stress  σ / E  [-]'
plot 'shear/history.csv' using 't':(column('sigma_xy at point [stress]') / 1e6) w l lt 1 title 'shear stress σ_{xy}', \
     '' using 't':(-column('sigma_yy at point [stress]') / 1e6) w l lt 4 title 'pressure on the shear plane, -σ_{yy}'
GP
for method in mpm cpdi2; do
  render "ellipse-$method" "ellipse-$method"/points/000{04,06,12}.vtu --columns 3 --mesh \
    --label "20°" "30°" "60°" --field plastic_strain --range 0 2 \
    --heading "Elliptical hole, ${method^^}: points and mesh" --title "plastic strain" \
   
done
render ellipse-domains ellipse-cpdi2/domains/000{04,06,12}.vtu --columns 3 \
  --label "20°" "30°" "60°" --field plastic_strain --range 0 2 \
  --heading "Elliptical hole, CPDI2: domains of the points" --title "plastic strain" \
 
