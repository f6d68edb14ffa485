# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
#
# Deep beam and slender cantilever.

run deep cortis-2017/deep-beam
render deep-beam "$(last deep/points)" --mesh --field displacement --component y \
  --heading "Deep beam under its own weight, h = 10 mm, 4² points per cell" --title "u_y" \
  --unit mm --length-unit mm

# What differs from finite elements on the same mesh: their u_y is the reference
# value of the study, one study for each cell size.
deep_beam_studies() {
  local h=$1 points=$2 reference
  run "deep-fe-$h" cortis-2017/deep-beam-conforming "Mesh/Cell size = $h" \
    "Method/Method = finite element"
  reference=$(tail -n 1 "deep-fe-$h/history.csv" | sed 's/.*,//')
  for support in -conforming ""; do
    local series=()
    [ "$support" ] || series=(
      "Study/Series/multipliers/Settings = Boundaries/support/Enforcement = augmented Lagrangian"
      "Study/Series/default/Settings = Boundaries/support/Enforcement = skew Nitsche")
    study "deep$support-$h" "cortis-2017/deep-beam$support" \
      "Mesh/Cell size = {{$h}}" "Method/Points per direction = {{$points}}" \
      "Study/Error = probe u_y at A" "Study/Reference value = $reference" \
      "${series[@]}"
  done
}
deep_beam_studies 10 "3|4|5|10|15|20|25|40"
for h in 5 2 1; do deep_beam_studies $h 4; done

cat >table-2.csv <<'CSV'
3,1.6653e-3
5,5.9450e-4
10,1.4812e-4
15,6.5788e-5
20,3.6998e-5
25,2.3676e-5
40,1.0277e-5
CSV
cat >table-3.csv <<'CSV'
10,9.313e-4
5,3.110e-4
2,7.558e-5
1,2.670e-5
CSV
plot deep-beam-error 900,560 <<'GP'
set multiplot layout 1,2 title 'Deep beam: u_y at the corner, material points against finite elements on the same mesh'
set logscale xy
set format y '10^{%T}'
set yrange [3e-6:2e-2]
set key maxrows 4
set lmargin 9
set rmargin 2
set ylabel '|u_y / u_y of finite elements - 1|  [-]'
set xlabel 'points per cell and direction  n  [-]'
set xrange [2.5:50]
set xtics (3, 5, 10, 20, 40)
n = 'Method/Points per direction'
set label 1 'slope -2' at 10,3e-4
plot 'deep-conforming-10/study.csv' using (column(n)):'error' w lp lt 7 title 'support of the nodes', \
     'deep-10/study.csv' using (column(n)):(of('multipliers', column('error'))) w p lt 3 title 'augmented Lagrangian, δ = 10^{-3} h', \
     '' using (column(n)):(of('default', column('error'))) w lp lt 1 title 'skew Nitsche, γ = 10 (default)', \
     'table-2.csv' w p lt 8 title 'published, table 2', \
     0.03 / x**2 lt 9 notitle
set xlabel 'cell size  h  [mm]'
set xrange [0.8:13]
set xtics (1, 2, 5, 10)
unset ylabel
set label 1 'slope 1.5' at 3.3,4.5e-5
h = 'Mesh/Cell size'
plot '< for h in 10 5 2 1; do cat deep-conforming-$h/study.csv; done' using (column(h)):(column(n) == 4 ? column('error') : NaN) w lp lt 7 title 'support of the nodes', \
     '< for h in 10 5 2 1; do cat deep-$h/study.csv; done' using (column(h)):(column(n) == 4 ? of('multipliers', column('error')) : NaN) w p lt 3 title 'augmented Lagrangian, δ = 10^{-3} h', \
     '' using (column(h)):(column(n) == 4 ? of('default', column('error')) : NaN) w lp lt 1 title 'skew Nitsche, γ = 10 (default)', \
     'table-3.csv' w p lt 8 title 'published, table 3', \
     1.2e-5 * x**1.5 lt 9 notitle
GP

# Deflection of the free end: u_x at 90 degrees, -u_y at 0.
for angle in 0 45 90; do
  run "cantilever-$angle" "cortis-2017/cantilever-$angle" "Output/Mesh = false" \
    "Output/Points = false"
  sed "1s/ at tip \[length\]/ at $angle/g" "cantilever-$angle/history.csv" >"load-$angle.csv"
done
paste -d, load-{0,45,90}.csv >cantilever-load.csv
plot cantilever-load 900,700 <<'GP'
set multiplot title 'Slender cantilever: h = 2 mm, 100 points per cell, skew Nitsche, γ = 10'
set lmargin 11
set xrange [0:0.21]
set size 1,0.62
set origin 0,0.35
set key top left maxrows 3 inside notitle
set ylabel 'deflection near the free end  [mm]'
set yrange [0:60]
set format x ''
w(angle) = angle == 0 ? -column('u_y at 0') : angle == 90 ? column('u_x at 90') : (column('u_x at 45') - column('u_y at 45')) / sqrt(2)
force = 'column(1) * 0.2'
plot 'cantilever-load.csv' using (@force):(w(0)) w lp lt 1 pt 6 ps 2 title '0°', \
     '' using (@force):(w(90)) w lp lt 4 pt 2 title '90°', \
     '' using (@force):(w(45)) w lp lt 3 title '45°'
set size 1,0.36
set origin 0,0
set format x '%g'
set xlabel 'body force  [N/mm²]'
set ylabel 'difference  [%]'
set yrange [-1:0.5]
set ytics 0.5
set key bottom right
plot 'cantilever-load.csv' using (@force):(100 * (w(45) / w(90) - 1)) w lp lt 3 title '45° against 90°', \
     '' using (@force):(100 * (w(0) / w(90) - 1)) w lp lt 1 pt 6 title '0° against 90°'
GP

first=("Mesh/Cell size = {{4|2|1}}" "Method/Points per direction = 5"
  "Time/End time = 0.05" "Time/Steps = 1")
for angle in 45 90; do
  study "cantilever-study-$angle" "cortis-2017/cantilever-$angle" "${first[@]}" \
    "${enforcements[@]}"
done
paste -d, cantilever-study-45/study.csv \
  <(cut -d, -f5 cantilever-study-90/study.csv | sed 's/u_x at tip/w at 90/') \
  >cantilever-study.csv
plot cantilever-difference 900,640 <<'GP'
set title 'Slender cantilever, first load step, 25 points per cell: 45° against 90°'
set xlabel 'cell size  h  [mm]'
set ylabel '|w at 45° / w at 90° - 1|  [-]'
set logscale xy
set format y '10^{%T}'
set xrange [0.9:4.5]
set xtics (1, 2, 4)
set yrange [5e-4:3e-1]
set label 1 'slope 1.5' at 2.1,2e-3
w(name) = of(name, (column('u_x at tip') - column('u_y at tip')) / sqrt(2))
plot for [i=1:5] 'cantilever-study.csv' using (column('Mesh/Cell size')):(abs(w(Name[i]) / column('w at 90') - 1)) w lp lt i title Title[i], \
     8e-4 * x**1.5 lt 9 notitle
GP

# Bent beams, with fewer points so that they can be told apart.
for angle in 45 90; do
  run "bent-$angle" "cortis-2017/cantilever-$angle" "Method/Points per direction = 4"
done
render cantilever "$(last bent-90/points)" "$(last bent-45/points)" --columns 2 \
  --label "90 degrees" "45 degrees" --mesh --field von_mises_stress --range 0 250 \
  --heading "Slender cantilever under the full load, skew Nitsche, h = 2 mm" \
  --title "von Mises stress" --unit "N/mm²" --length-unit mm
