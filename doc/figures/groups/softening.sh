# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
#
# Softening: what a shear band dissipates over the size of the cells, and where
# a band goes in other meshes.

# energy FILE H SHEARED SCENE [SETTING...]: a line "H,energy" of FILE.csv, over
# that of a straight band of one cell
energy() {
  run band "hard-cases/$4" "${@:5}"
  /usr/bin/python3 - "$2" "$3" >>"$1.csv" <<'PY'
import csv, math, sys
h, layer = float(sys.argv[1]), sys.argv[2] == "layer"
column = "reaction_x of top [force]" if layer else "reaction_y of top [force]"
u = force = work = 0
with open("band/history.csv") as file:
    for row in csv.DictReader(file):
        t = next(float(row[name]) for name in row if name.split(" [")[0] == "t")
        u_next = (0.012 if layer else 0.02) * t
        force_next = float(row[column]) / h if layer else -float(row[column])
        work += (u_next - u) * (force + force_next) / 2
        u, force = u_next, force_next
if layer:
    exact = 0.89 * math.sqrt(3) * 0.02 * 0.125 / 2 - 0.01 / 1000 * (1 + h) / 2
else:
    exact = 0.9 * math.sqrt(3) * 0.08 * 0.125 / 2 * math.sqrt(2)
print(h, (work - (0.1 if layer else 0.2) * u) / exact, sep=",")
PY
  rm -r band
}

none="Materials/*/Softening length = 0"
files=("Output/Points = false" "Output/Mesh = false")
for h in 0.25 0.125 0.0625 0.03125; do
  energy layer $h layer softening "Constants/h = $h"
  energy layer-none $h layer softening "Constants/h = $h" "$none"
  n=$(/usr/bin/python3 -c "print(round(2 / $h))")
  energy layer-gimp $h layer softening "Constants/h = $h" "Method/Method = GIMP" \
    "Constants/s = 0.125" "Bodies/below/Point grid = 4, $n" \
    "Bodies/band/Point grid = 4, 4" "Bodies/above/Point grid = 4, $n"
done
for n in 8 16 32; do
  h=$(/usr/bin/python3 -c "print(1 / $n)")
  energy plate $h plate softening-plate "Mesh/Cells = $n, $((2 * n))" "${files[@]}"
  energy plate-none $h plate softening-plate "Mesh/Cells = $n, $((2 * n))" "$none" "${files[@]}"
  energy plate-gimp $h plate softening-plate "Mesh/Cells = $n, $((2 * n))" \
    "Method/Method = GIMP" "Method/Mesh after step = keep" "${files[@]}"
done

plot softening 950,600 <<'GP'
set title 'Energy of a shear band that softens, over that of one straight row of cells'
set xlabel 'cell size h [m]'
set ylabel 'energy / energy of a band of softening length'
set logscale xy 2
set xrange [0.027:0.29]
set yrange [0.2:4]
plot 'layer-none.csv' w lp lt 1 title 'layer, no length', \
     'layer.csv' w lp lt 3 title 'layer', \
     'layer-gimp.csv' w lp lt 4 title 'layer, GIMP, two rows', \
     'plate-none.csv' w lp lt 8 title '45°, no length', \
     'plate.csv' w lp lt 2 title '45°', \
     'plate-gimp.csv' w lp lt 5 title '45°, GIMP', \
     1 w l lt 9 title 'exact'
GP

for n in 8 16 32; do
  run "plate-$n" hard-cases/softening-plate "Mesh/Cells = $n, $((2 * n))"
done
run plate-flat hard-cases/softening-plate "Mesh/Cells = 8, 32"
render softening-bands "$(last plate-8/points)" "$(last plate-16/points)" "$(last plate-32/points)" "$(last plate-flat/points)" \
  --columns 4 --label "8 x 16" "16 x 32" "32 x 64" "8 x 32" --field plastic_strain \
  --range 0 0.2 --heading "Accumulated plastic strain, softening length 1/8"
