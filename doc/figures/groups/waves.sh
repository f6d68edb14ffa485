# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
#
# Waves: tutorials 7 and 8, the embankment of the README.

# Of the table of step-7: t, settlement, exact, stress, exact for both bases.
"$build/doc/step-7" | awk '/base$/ { file = $1 ".csv" }
  $1 ~ /^[0-9.]+$/ { print $1 "," $4 > file }'
cat >exact.gp <<'GP'
c = sqrt(20e3 * 0.75 / 1.25 / 0.5 / 1.5)
p(t) = abs(t / 0.25 - 1) < 1 ? 300 * (1 - abs(t / 0.25 - 1)) : 0
z = 10.053
GP
plot step-7 900,520 <<'GP'
load 'exact.gp'
set title 'Pulse in a column of 20 m: vertical stress in the middle'
set xlabel 'time  [s]'
set ylabel 'stress  [kPa]'
set xrange [0:0.6]
set yrange [-450:200]
set samples 601
plot 'fixed.csv' using 1:2 w p lt 4 pt 7 title 'fixed base', \
     'absorbing.csv' using 1:2 w p lt 1 pt 7 title 'absorbing base', \
     -p(x - z / c) - p(x - (40 - z) / c) + p(x - (40 + z) / c) + p(x - (80 - z) / c) w l lt 8 lw 1 title 'exact', \
     -p(x - z / c) w l lt 8 lw 1 notitle
GP

run embankment dynamics/embankment
# Two seconds of shaking begin at t = 1.
files=() labels=()
for time in 1.3 1.4 1.48 1.54 1.68; do
  file=$(sed -n "s/.*timestep=\"$time\".*file=\"\([^\"]*\)\".*/\1/p" embankment/points.pvd)
  files+=("embankment/$file")
  labels+=("t = $time s")
done
render embankment "${files[@]}" --columns 1 --label "${labels[@]}" --field displacement \
  --component x --diverging --range -0.03 0.03 --magnify 100 \
  --heading "An embankment 12 m high, shaken through its rock; displacements × 100"
