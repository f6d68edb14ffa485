# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
#
# A footing under repeated load beside boundaries that reflect or absorb, and on
# ground 16 m wide and deep, from whose ends nothing returns until t = 0.73 s and
# little after that. Cells of 0.125 m. Prints the table of footing-dynamic.md.
# Takes some twenty minutes.

cells="Mesh/Cell size = 0.125"
large=("Mesh/Lower corner = 0, -15.625" "Mesh/Upper corner = 16, 0.5"
  "Bodies/ground/Lower corner = 0, -3.75" "Bodies/ground/Upper corner = 3, 0.25"
  "Bodies/ground/Material = clay" "Bodies/outside/Shape = polygon"
  "Bodies/outside/Vertices = 3 0.25; 3 -3.75; 0 -3.75; 0 -15.625; 16 -15.625; 16 0.25"
  "Bodies/outside/Material = rest" "Materials/rest/Young modulus = 2000"
  "Materials/rest/Poisson ratio = 0.41" "Materials/rest/Density = 1"
  "Loads/footing/Points = 0.5 0.25; 0 0.25" "Probes/one/Location = 0.01, -0.76"
  "Probes/two/Location = 0.51, -0.26" "Stages/waves/Absorbing = right, base")
for method in dmgc gimp; do
  for kind in fixed viscous viscoelastic; do
    run "$kind-$method" "phuong-2023/footing-$kind-$method" "$cells"
  done
  run "large-$method" "phuong-2023/footing-fixed-$method" "$cells" "${large[@]}"
done

/usr/bin/python3 - <<'PY'
import csv
from math import sqrt

def stresses(name):
    """t, vertical stress at one, deviatoric stress at two, without the weight."""
    with open(name + "/history.csv") as file:
        rows = [{key.split(" [")[0]: float(value) for key, value in row.items()}
                for row in csv.DictReader(file)][2:]
    def deviatoric(row):
        x, y, z, s = (row[f"sigma_{c} at two"] for c in ("xx", "yy", "zz", "xy"))
        return sqrt(((x - y)**2 + (y - z)**2 + (z - x)**2) / 2 + 3 * s * s)
    found = [(row["t"], row["sigma_yy at one"], deviatoric(row)) for row in rows]
    with open(name + ".csv", "w") as file:
        file.writelines("%r,%r,%r\n" % row for row in found)
    return found

for method in ("dmgc", "gimp"):
    large = stresses("large-" + method)
    of_load = max(abs(row[1] - large[0][1]) for row in large)
    peak = max(row[2] for row in large)
    for kind in ("fixed", "viscous", "viscoelastic", "large"):
        rows = stresses(f"{kind}-{method}")
        print(f"{kind}-{method}: pressure at one up to",
              "%.2f," % -min(row[1] for row in rows), "differs by",
              "%.4f;" % max(abs(a[1] - b[1]) / of_load
                            for a, b in zip(rows, large)),
              "q at two in the second load",
              "%.2f," % max(row[2] for row in rows if 0.525 < row[0] < 0.775),
              "differs by", "%.4f" % max(abs(a[2] - b[2]) / peak
                                         for a, b in zip(rows, large)))
PY

plot footing-dynamic 900,760 <<'GP'
set multiplot layout 2,1
set xrange [0.25:0.925]
set xlabel 'time  [s]'
unset key
set title 'Vertical stress at one, DM-GC, h = 0.125 m'
set ylabel '[kPa]'
plot 'fixed-dmgc.csv' using 1:2 w l lt 4, 'viscous-dmgc.csv' using 1:2 w l lt 1, \
     'viscoelastic-dmgc.csv' using 1:2 w l lt 3, 'large-dmgc.csv' using 1:2 w l lt 8 dt 2
set key
set title 'Deviatoric stress at two'
plot 'fixed-dmgc.csv' using 1:3 w l lt 4 title 'fixed', \
     'viscous-dmgc.csv' using 1:3 w l lt 1 title 'viscous', \
     'viscoelastic-dmgc.csv' using 1:3 w l lt 3 title 'viscoelastic', \
     'large-dmgc.csv' using 1:3 w l lt 8 dt 2 title 'large mesh'
unset multiplot
GP

render footing-plastic "$(last fixed-dmgc/points)" "$(last viscous-dmgc/points)" "$(last viscoelastic-dmgc/points)" \
  --columns 3 --label "fixed" "viscous" "viscoelastic" --field plastic_strain --range 0 0.005 \
  --grid 0 -4 3 0 0.125 --size 400 560 --heading "Plastic strain at t = 0.925 s, DM-GC, h = 0.125 m" \
  --title "plastic strain" --unit "-" --length-unit m
