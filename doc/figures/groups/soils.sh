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
