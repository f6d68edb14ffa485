# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
#
# A block at 60 places and angles in its mesh, drawn at random down to 1e-8 of a
# cell from mesh lines: largest stress of its points and iterations of multigrid,
# sorted, and both against the place of one that is not turned.

positions() {
  /usr/bin/python3 - <<'PY'
import random
from math import cos, radians, sin
random.seed(1)
for i in range(60):
    angle = random.choice([0, 17, 30, 45, random.uniform(0, 90)])
    c, s = cos(radians(angle)), sin(radians(angle))
    little = [10 ** random.uniform(-8, -2) for _ in "xy"]
    x, y = (random.choice([random.random(), e, 1 - e]) / 32 for e in little)
    print(angle, f"{-1 - x!r},{-1.5 - y!r}", f"{3 - x!r},{2.5 - y!r}",
          f"{1.9 * c - 0.5 * s!r},{1.9 * s + 0.5 * c!r}")
PY
}

# measure BELOW ANGLE LOWER UPPER TIP: largest stress, iterations of ./block
measure() {
  local settings=("Bodies/block/Rotation angle = $2"
    "Boundaries/support/Rotation angle = $2"
    "Loads/weight/Value = sin($2*pi/180); -cos($2*pi/180)"
    "Loads/end/Value = sin($2*pi/180); -cos($2*pi/180)"
    "Mesh/Lower corner = $3" "Mesh/Upper corner = $4"
    "Mesh/Cell size = 1/32" "Probes/tip/Location = $5"
    "Method/Aggregate below = $1")
  rm -rf block
  # 500 iterations were not enough where multigrid fails.
  (run block hard-cases/cut-block "${settings[@]}" "Solver/Solver = gmres") >/dev/null || {
    rm -r block
    run block hard-cases/cut-block "${settings[@]}" "Solver/Solver = direct" >/dev/null
  }
  table points.csv "$(last block/points)" --field von_mises_stress >/dev/null
  /usr/bin/python3 - <<'PY'
import csv, json
with open("points.csv") as file:
    stress = max(float(row[-1]) for row in list(csv.reader(file))[1:])
with open("block/summary.json") as file:
    print(stress, json.load(file)["linear_iterations"] or 500, sep=",")
PY
}

for below in 0 0.1; do
  echo "stress,iterations" >"cuts-$below.csv"
  while read -r place; do
    # shellcheck disable=SC2086
    measure "$below" $place >>"cuts-$below.csv"
  done < <(positions)
done

plot cuts 1100,450 <<'GP'
set multiplot layout 1,2 title 'Block 2 × 1 in cells of 1/32, GIMP, 60 places in its mesh'
set logscale y
set format y '10^{%T}'
set xlabel 'place, sorted'
set ylabel 'largest stress of a point [kPa]'
plot '< tail -n +2 cuts-0.csv | cut -d, -f1 | sort -g' using 0:1 w lp lt 1 title 'free nodes', \
     '< tail -n +2 cuts-0.1.csv | cut -d, -f1 | sort -g' using 0:1 w lp lt 3 title 'aggregated below 0.1 (default)'
set format y '%g'
set ylabel 'linear iterations'
plot '< tail -n +2 cuts-0.csv | cut -d, -f2 | sort -g' using 0:1 w lp lt 1 title 'free nodes', \
     '< tail -n +2 cuts-0.1.csv | cut -d, -f2 | sort -g' using 0:1 w lp lt 3 title 'aggregated below 0.1 (default)'
unset multiplot
GP

# The block on mesh lines, then moved out of its cells by a part of one, at its held
# end and below.
for below in 0 0.1; do
  echo "part,stress,iterations" >"position-$below.csv"
  for part in 1e-8 1e-7 1e-6 1e-5 1e-4 1e-3 3e-3 1e-2 3e-2 0.06 0.099 0.101 \
    0.15 0.2 0.3 0.4 0.5 0.6 0.7 0.8 0.9 0.97 0.999; do
    place=$(/usr/bin/python3 -c "
d = $part / 32
print(0, f'{-1 + d!r},{-1.5 + d!r}', f'{3 + d!r},{2.5 + d!r}', '1.9,0.5')")
    # shellcheck disable=SC2086
    echo "$part,$(measure "$below" $place)" >>"position-$below.csv"
  done
done

plot cuts-position 1100,450 <<'GP'
set multiplot layout 1,2 title 'Block 2 × 1 in cells of 1/32, GIMP, not turned: it reaches a part of a cell beyond mesh lines at its held end and below'
set logscale xy
set format xy '10^{%T}'
set xlabel 'part of a cell'
set ylabel 'largest stress of a point [kPa]'
plot 'position-0.csv' using 1:2 w lp lt 1 title 'free nodes', \
     'position-0.1.csv' using 1:2 w lp lt 3 title 'aggregated below 0.1 (default)'
set format y '%g'
set ylabel 'linear iterations'
plot 'position-0.csv' using 1:3 w lp lt 1 title 'free nodes', \
     'position-0.1.csv' using 1:3 w lp lt 3 title 'aggregated below 0.1 (default)'
unset multiplot
GP
