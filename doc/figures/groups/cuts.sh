# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
#
# A block at 60 places and angles in its mesh, drawn at random down to 1e-8 of a
# cell from mesh lines: largest stress of its points and iterations of multigrid,
# sorted.

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

for below in 0 0.1; do
  echo "stress,iterations" >"cuts-$below.csv"
  while read -r angle lower upper tip; do
    settings=("Bodies/block/Rotation angle = $angle"
      "Boundaries/support/Rotation angle = $angle"
      "Loads/weight/Value = sin($angle*pi/180); -cos($angle*pi/180)"
      "Loads/end/Value = sin($angle*pi/180); -cos($angle*pi/180)"
      "Mesh/Lower corner = $lower" "Mesh/Upper corner = $upper"
      "Mesh/Cell size = 1/32" "Probes/tip/Location = $tip"
      "Method/Aggregate below = $below")
    rm -rf block
    # 500 iterations were not enough where multigrid fails.
    (run block hard-cases/cut-block "${settings[@]}" "Solver/Solver = gmres") >/dev/null || {
      rm -r block
      run block hard-cases/cut-block "${settings[@]}" "Solver/Solver = direct"
    }
    table points.csv "$(last block/points)" --field von_mises_stress >/dev/null
    /usr/bin/python3 - >>"cuts-$below.csv" <<'PY'
import csv, json
with open("points.csv") as file:
    stress = max(float(row[-1]) for row in list(csv.reader(file))[1:])
with open("block/summary.json") as file:
    print(stress, json.load(file)["linear_iterations"] or 500, sep=",")
PY
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
