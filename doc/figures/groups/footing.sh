# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
#
# A footing under repeated load beside boundaries that reflect or absorb, and on
# ground 23 m wide and deep, from whose ends nothing returns while it runs. Cells
# of 0.125 m. Prints the tables of absorbing.md, and from the exact solution
# for an elastic half-plane the radius of the springs. Takes some ten minutes.

cells="Mesh/Cell size = 0.125"
large=("Mesh/Lower corner = 0, -23" "Mesh/Upper corner = 23, 0.25"
  "Bodies/ground/Material = clay" "Bodies/outside/Shape = polygon"
  "Bodies/outside/Vertices = 3 0; 3 -4; 0 -4; 0 -23; 23 -23; 23 0"
  "Bodies/outside/Initial stress = geostatic" "Bodies/outside/Material = rest"
  "Materials/rest/Young modulus = 2000" "Materials/rest/Poisson ratio = 0.41"
  "Materials/rest/Density = 1")
radii="2.5 5 9 11.7 20 40" # of the scenes: 9.9
for method in dmgc gimp; do
  for kind in fixed viscous viscoelastic; do
    run "$kind-$method" "phuong-2023/footing-$kind-$method" "$cells"
  done
  run "large-$method" "phuong-2023/footing-fixed-$method" "$cells" "${large[@]}"
  of=Boundaries
  [ $method = dmgc ] || of="Grid conditions"
  for radius in $radii; do
    run "$radius-$method" "phuong-2023/footing-viscoelastic-$method" "$cells" \
      "$of/base/Spring radius = $radius" "$of/right/Spring radius = $radius"
  done
done

/usr/bin/python3 "$figures/half_plane.py"
/usr/bin/python3 - <<'PY'
import csv
from math import sqrt

def stresses(name):
    """t, vertical stress and settlement at one, deviatoric stress at two, without
    the weight."""
    with open(name + "/history.csv") as file:
        rows = [{key.split(" [")[0]: float(value) for key, value in row.items()}
                for row in csv.DictReader(file)][2:]
    def deviatoric(row):
        x, y, z, s = (row[f"sigma_{c} at two"] for c in ("xx", "yy", "zz", "xy"))
        return sqrt(((x - y)**2 + (y - z)**2 + (z - x)**2) / 2 + 3 * s * s)
    found = [(row["t"], row["sigma_yy at one"], deviatoric(row),
              -1e3 * row["u_y at one"]) for row in rows]
    with open(name + ".csv", "w") as file:
        file.writelines("%r,%r,%r,%r\n" % row for row in found)
    return found

radii = ("2.5", "5", "9", "viscoelastic", "11.7", "20", "40")
for method in ("dmgc", "gimp"):
    large = stresses("large-" + method)
    of_load = max(abs(row[1] - large[0][1]) for row in large)
    peak = max(row[2] for row in large)
    for kind in ("fixed", "viscous", *radii, "large"):
        rows = stresses(f"{kind}-{method}")
        one = max(abs(a[1] - b[1]) / of_load for a, b in zip(rows, large))
        two = max(abs(a[2] - b[2]) / peak for a, b in zip(rows, large))
        settled = min(rows, key=lambda row: abs(row[0] - 0.9))[3]
        print(f"{kind}-{method}: pressure at one up to",
              "%.2f," % -min(row[1] for row in rows), "differs by",
              "%.4f;" % one, "q at two in the second load",
              "%.2f," % max(row[2] for row in rows if row[0] > 0.675),
              "differs by", "%.5f;" % two,
              "settlement of one at 0.9 s %.2f mm" % settled)
        if kind == "fixed":
            for share in (0.01, 0.02):
                print("  differs at one by", share, "from t =",
                      next(a[0] for a, b in zip(rows, large)
                           if abs(a[1] - b[1]) > share * of_load))
        if kind in radii:
            with open(f"radius-{method}.csv", "a") as file:
                file.write("%s,%r,%r\n" % ("9.9" if kind[0] == "v" else kind,
                                            100 * one, 100 * two))
        if kind == "viscous":
            with open(f"none-{method}.gp", "w") as file:
                file.write("one = %r\ntwo = %r\n" % (100 * one, 100 * two))
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

plot footing-radius 900,420 <<'GP'
set multiplot layout 1,2
set logscale x
set xrange [2:50]
set xtics (2.5, 5, 10, 20, 40)
set yrange [0:5]
set xlabel 'spring radius  [m]'
set ylabel 'difference from the large mesh  [%]'
set key top right
set title 'Vertical stress at one, h = 0.125 m'
load 'none-dmgc.gp'; a = one; b = two
load 'none-gimp.gp'
set arrow 1 from 9.9,0 to 9.9,5 nohead lt 9 dt 3
plot 'radius-dmgc.csv' using 1:2 w lp lt 1 title 'DM-GC', a w l lt 1 dt 2 title 'dashpots alone', \
     'radius-gimp.csv' using 1:2 w lp lt 3 title 'GIMP', one w l lt 3 dt 2 title 'dashpots alone'
set title 'Deviatoric stress at two'
plot 'radius-dmgc.csv' using 1:3 w lp lt 1 title 'DM-GC', b w l lt 1 dt 2 title 'dashpots alone', \
     'radius-gimp.csv' using 1:3 w lp lt 3 title 'GIMP', two w l lt 3 dt 2 title 'dashpots alone'
unset multiplot
GP

plot footing-settlement 900,420 <<'GP'
set xrange [0.25:0.925]
set xlabel 'time  [s]'
set ylabel 'settlement  [mm]'
set yrange [0:32]
set key top left
set title 'Settlement of point one, DM-GC, h = 0.125 m'
plot 'viscous-dmgc.csv' using 1:4 w l lt 1 title 'viscous', \
     '5-dmgc.csv' using 1:4 w l lt 6 title 'springs of 5 m', \
     'viscoelastic-dmgc.csv' using 1:4 w l lt 3 title 'springs of 9.9 m', \
     'large-dmgc.csv' using 1:4 w l lt 8 dt 2 title 'large mesh'
GP

render footing-plastic "$(last fixed-dmgc/points)" "$(last viscous-dmgc/points)" "$(last viscoelastic-dmgc/points)" \
  --columns 3 --label "fixed" "viscous" "viscoelastic" --field plastic_strain \
  --range 0 0.005 --heading "Plastic strain at t = 0.925 s, DM-GC, h = 0.125 m" \
  --title "plastic strain" --length-unit m
