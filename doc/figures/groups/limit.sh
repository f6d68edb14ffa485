# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
#
# Limit loads: a toggle that snaps through, a slope that fails.

moved=("Time/Arc length = 0" "Loads/push/Value = 0; 0"
  "Grid conditions/crown/Components = x, y"
  "Grid conditions/crown/Displacement = 0; -0.8*t")
run toggle hard-cases/toggle
run toggle-moved hard-cases/toggle "${moved[@]}"
run toggle-gimp hard-cases/toggle "Method/Method = GIMP" "Method/Degree = 1" \
  "Mesh/Cell size = 0.05"
# The beam's closed form, as the test has it.
/usr/bin/python3 - "$figures/../../tests/verification/limit-load.py" >beam.csv <<'PY'
import sys
text = open(sys.argv[1]).read()
names = {}
exec(text[:text.index("\ndef curve(")], names)
print("w,t")
for k in range(1, 83):
    print(f"{k / 100},{names['beam_load'](k / 100)}")
PY

plot limit-toggle <<'GP'
set title 'Toggle, half span 5 m, rise 0.4 m, thickness 0.2 m: snap-through'
set xlabel 'displacement of the crown  [m]'
set ylabel 'load factor  t  [-]'
set xrange [0:0.82]
set yrange [0:1]
plot 'toggle/history.csv' using (-column('u_y at crown [length]')):'t' w p lt 1 ps 1.6 title 'FE Q2, along the path', \
     'toggle-gimp/history.csv' using (-column('u_y at crown [length]')):'t' w p lt 4 title 'GIMP, along the path', \
     'toggle-moved/history.csv' using (-column('u_y at crown [length]')):(-column('reaction_y of crown [force]') / 100) w l lt 3 title 'FE Q2, crown moved', \
     'beam.csv' using 'w':'t' w l lt 8 title 'shallow beam, closed form'
GP

large=("Method/Strain = finite" "Method/Mesh after step = default")
run slope hard-cases/slope-gimp
run slope-fe hard-cases/slope-fe
# Without a stiffness of empty parts it ends at t = 0.825; see the page.
run slope-large hard-cases/slope-gimp "${large[@]}" "Method/Fictitious stiffness = 1e-3"
run slope-fe-large hard-cases/slope-fe "${large[@]}" "Mesh/Refinements = 2"

plot limit-slope <<'GP'
set title 'Slope 2:1, 8 m high, c_u = 20 kPa: load factor over settlement'
set xlabel 'settlement of the crest  [m]'
set ylabel 'part of the weight  t  [-]'
set yrange [0:1]
plot 'slope/history.csv' using (-column('u_y at crest [length]')):'t' w lp lt 1 ps 1.2 title 'small strain, GIMP, h = 0.5 m', \
     'slope-fe/history.csv' using (-column('u_y at crest [length]')):'t' w l lt 8 title 'small strain, FE Q2, h = 0.25 m', \
     'slope-large/history.csv' using (-column('u_y at crest [length]')):'t' w lp lt 4 ps 1.2 title 'finite strain, GIMP, h = 0.5 m', \
     'slope-fe-large/history.csv' using (-column('u_y at crest [length]')):'t' w l lt 3 title 'finite strain, FE Q2, h = 0.5 m'
GP
render limit-slope-flow "$(last slope/points)" --field displacement --component magnitude \
  --title "|u|" --unit m --length-unit m \
  --heading "Displacement at failure, small strain, GIMP, h = 0.5 m"
