# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
#
# Step 11: triaxial tests and a footing on sand.

"$build/doc/step-11" >step-11.txt
# c, phi and psi; sigma_3 and the largest q of each test.
sed -n '1s/[^0-9. ]//gp' step-11.txt | awk '{ print "c = " $1 "; phi = " $2 }' >strength.gp
awk '/eps_1/ { exit } NR > 2 { print $1 "," $2 }' step-11.txt >peaks.csv
plot step-11-tests 900,480 <<'GP'
load 'strength.gp'
set title sprintf('Stress circles at the peaks and the fitted strength: c = %.1f kPa, φ = %.1f°', c, phi)
set xlabel 'normal stress  σ  [kPa]'
set ylabel 'shear stress  τ  [kPa]'
set size ratio -1
set xrange [0:640]
set yrange [0:260]
set angles degrees
set style fill transparent solid 0.12 border lt 1
set key off
plot 'peaks.csv' using ($1 + $2 / 2):(0):($2 / 2) with circles lt 1, \
     c + tan(phi) * x lt 4
GP

run fine geotechnics/footing-sand
run coarse geotechnics/footing-sand "Mesh/Cell size = 2/7" "Mesh/Upper corner = 6, 2/7"
render step-11 "$(last fine/points)" --field plastic_strain --range 0 0.6 \
  --heading "Footing on sand: accumulated plastic strain at 80 mm, h = 2/15 m"
plot step-11-force 900,560 <<'GP'
set title 'Rough strip footing on sand, φ = ψ = 30°, no surcharge (GIMP)'
set xlabel 'settlement  [mm]'
set ylabel 'force  [kN/m]'
set xrange [0:80]
set yrange [0:700]
set key below maxrows 1
t = 't'
force = 'reaction_y of footing [kN]'
plot 'coarse/history.csv' using (80 * column(t)):(-2 * column(force)) w l lt 1 title 'h = 2/7 m', \
     'fine/history.csv' using (80 * column(t)):(-2 * column(force)) w l lt 4 title 'h = 2/15 m', \
     18 * 4 / 2 * 14.7543 lt 8 title 'formula, N_γ = 14.754'
GP

# Step 13: a wall that tilts away from sand, and the forces on it.
"$build/doc/step-13" >step-13.txt
awk '/^[ 0-9.]+$/ { gsub(/^ +/, ""); gsub(/ +/, ","); print }' step-13.txt >forces.csv
awk -F, 'NF == 4' forces.csv >sand.csv
awk -F, 'NF == 6' forces.csv >clay.csv
plot step-13-force 900,440 <<'GP'
set multiplot layout 1,2
set xlabel 'top of the wall moves by [mm]'
set ylabel 'force on the wall [kN/m]'
set xrange [0:42]
set title 'Sand'
set yrange [60:100]
plot 'sand.csv' u 1:2 w lp lt 1 t 'smooth', 'sand.csv' u 1:3 w lp lt 4 t 'rough, normal part', \
     83.3 lt 9 t 'Rankine', 72.8 lt 9 lc rgb '#D55E00' t 'Coulomb'
set title 'Clay, smooth wall'
set yrange [140:230]
plot 'clay.csv' u 1:2 w lp lt 7 t 'wall pulls', 'clay.csv' u 1:3 w lp lt 1 t 'wall lets go', \
     'clay.csv' u 1:5 w lp lt 4 t 'clay cracks, too', 150 lt 9 t 'exact: 150', \
     160 lt 9 lc rgb '#D55E00' t 'exact: 160'
unset multiplot
GP
run tilts geotechnics/retaining-wall "Grid conditions/base/Components = x, y" \
  "Boundaries/wall/Translation = " "Boundaries/wall/Rotation angle = 0.4584*t" \
  "Boundaries/wall/Rotation centre = 0, 0" "Boundaries/wall/Friction angle = 15" \
  "Method/Strain = small" "Method/Mesh after step = keep"
moraine_plot tilts --of contact -o "$figures/step-13.png"
