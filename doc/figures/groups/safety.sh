# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
#
# An embankment to failure: the factor of safety of step 9. A slope beside a
# reservoir that is emptied fast: step 12.

run stands geotechnics/factor-of-safety
(run fails geotechnics/factor-of-safety "Strength reduction/Factor = 1.3") >fails.txt || true

render step-9 "$(last stands/points)" "$(last fails/points)" --columns 1 \
  --label "c_u = 32 kPa, the whole weight" "c_u / 1.3, just before it fails" \
  --field plastic_strain --range 0 0.5 \
  --heading "Accumulated plastic strain, h = 1 m"

moraine study safety geotechnics/factor-of-safety
/usr/bin/python3 - <<'PY' >trials.csv
import json
for trial in sorted(json.load(open("safety/summary.json"))["cases"][0]["trials"],
                    key=lambda trial: trial["factor"]):
    if trial["status"] == "ok":
        print(trial["factor"], -trial["probes"]["u_y at crest"], sep=",")
PY
for factor in 1.05 1.1 1.15 1.2 1.26 1.27 1.28 1.283; do
  run trial geotechnics/factor-of-safety "Strength reduction/Factor = $factor"
  /usr/bin/python3 -c "import json
print($factor, -json.load(open('trial/summary.json'))['probes']['u_y at crest'], sep=',')" >>trials.csv
  rm -r trial
done
sort -n -t, trials.csv -o trials.csv

/usr/bin/python3 -c "import json
print('F =', json.load(open('safety/summary.json'))['cases'][0]['factor_of_safety'])" >factor.gp

plot step-9-settlement <<'GP'
set title 'Settlement of the crest under the whole weight (GIMP, h = 1 m)'
set xlabel 'factor F by which the strength is divided'
set ylabel 'settlement [m]'
set xrange [1:1.35]
set yrange [0:0.15]
set key off
load 'factor.gp'
set arrow from F,0 to F,0.15 nohead dt 2
set label 'no equilibrium' at F + 0.005,0.11
plot 'trials.csv' w lp lt 1 notitle
GP

# Step 12: it fails before the reservoir is empty.
(run fast geotechnics/drawdown "Constants/inside = 0" \
  'Water/Level = max(min(10, 20 - 10*t), $ground)' "Water/Free level = min(10, 20 - 10*t)" \
  "Water/Curve = min(t, 1)" "Loads/weight/Curve = min(t, 1)" \
  "Time/End time = 2" "Time/Steps = 20") >fast.txt || true
render step-12 "$(last fast/points)" --field plastic_strain --range 0 0.003
