# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
#
# The study of points per cell: error against time, which shows wall times. Times are
# the least of three runs; the group takes ten minutes and is not among those that run
# if none is named; its tables are left in $MORAINE_TABLES if that names a folder.

for name in cut plastic column beam; do
  least points-per-cell-$name
done

# The footing's load, which is a reaction, over (2 + pi) k.
for i in 1 2 3; do
  for method in GIMP CPDI1; do
    for n in 1 2 3 4; do
      for h in 0.5 0.25 0.125; do
        run "bearing-$method-$n-$h-$i" hard-cases/bearing-gimp \
          "Method/Method = $method" "Method/Points per direction = $n" \
          "Mesh/Cell size = $h" "Mesh/Upper corner = 5, $h" "Output/Points = false" "Output/Mesh = false"
      done
    done
  done
done
/usr/bin/python3 - <<'PY'
import csv, glob, json, math
with open("bearing.csv", "w") as file:
    out = csv.writer(file, lineterminator="\n")
    out.writerow(["Series", "Method/Points per direction", "h", "error",
                  "wall_seconds", "points", "newton_iterations"])
    for name in sorted(glob.glob("bearing-*-1/summary.json")):
        runs = [json.load(open(name.replace("-1/", f"-{i}/"))) for i in (1, 2, 3)]
        method, n, h = name.split("-")[1:4]
        out.writerow([method, n, h,
                      -runs[0]["reactions"]["footing"][1] / (2 + math.pi) - 1,
                      min(run["wall_seconds"] for run in runs),
                      runs[0]["points"], runs[0]["newton_iterations"]])
PY
[ -z "${MORAINE_TABLES:-}" ] || cp ./*.csv "$MORAINE_TABLES"

plot points-per-cell 1500,1040 <<'GP'
set multiplot layout 2,3 title 'Points per direction of a cell, cells halved from point to point (column: quartered): error over the wall time'
set logscale xy
set format y '10^{%T}'
set xlabel 'wall time  [s]'
set key below center vertical Left reverse maxrows 4 width -2 title ' ' font ',5'
set key font ',11'
set bmargin 7.5
array C[4] = [5, 1, 3, 4]
of_points(name, n, value) = column('Method/Points per direction') == n && strcol('status') eq 'ok' ? of(name, value) : NaN
set ylabel 'relative error of displacement, L_2  [-]'
set title 'cylinder cut by squares, elastic: GIMP (MPM, CPDI1 alike)'
plot for [n=1:4] 'points-per-cell-cut.csv' using (column('wall_seconds')):(of_points('GIMP', n, column('error'))) w lp lt C[n] title sprintf('%d × %d points', n, n)
set title 'the same, half plastic: GIMP (MPM, CPDI1 alike)'
plot for [n=1:4] 'points-per-cell-plastic.csv' using (column('wall_seconds')):(of_points('GIMP', n, column('error'))) w lp lt C[n] title sprintf('%d × %d points', n, n)
set ylabel 'relative error of the load  [-]'
set title 'bearing capacity: GIMP'
of_load(name, n, value) = column('Method/Points per direction') == n ? of(name, value) : NaN
plot for [n=1:4] 'bearing.csv' using (column('wall_seconds')):(of_load('GIMP', n, abs(column('error')))) w lp lt C[n] title sprintf('%d × %d points', n, n)
set ylabel 'mean error of stress over the largest  [-]'
set title 'column to half its height: GIMP, MPM'
plot for [n=1:4] 'points-per-cell-column.csv' using (column('wall_seconds')):(of_points('GIMP', n, column('error'))) w lp lt C[n] title sprintf('GIMP %d × %d', n, n), \
     for [n=1:4] 'points-per-cell-column.csv' using (column('wall_seconds')):(of_points('MPM', n, column('error'))) w lp lt C[n] dt 2 title sprintf('MPM %d × %d', n, n)
set ylabel 'relative error of the deflection  [-]'
set title 'cantilever bent: GIMP (1 × 1 ends early)'
plot for [n=2:4] 'points-per-cell-beam.csv' using (column('wall_seconds')):(of_points('GIMP', n, column('error'))) w lp lt C[n] title sprintf('%d × %d points', n, n)
set title 'cantilever bent: CPDI1 (1 × 1 ends early)'
plot for [n=2:4] 'points-per-cell-beam.csv' using (column('wall_seconds')):(of_points('CPDI1', n, column('error'))) w lp lt C[n] title sprintf('%d × %d points', n, n)
unset multiplot
GP
