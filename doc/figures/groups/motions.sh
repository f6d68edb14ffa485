# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
#
# Manufactured motions: error over cells, and over steps on a fine mesh.

# error FILE NUMBER SCENE METHOD [SETTING...]: a line "NUMBER,error" of FILE.csv
error() {
  local transfer=FLIP
  [[ $4 != "finite element" ]] || transfer=APIC # not used
  run last "dynamics/manufactured-$3" "Method/Method = $4" \
    "Time/Velocity transfer = $transfer" "Output/Points = false" \
    "Output/Mesh = false" "${@:5}"
  /usr/bin/python3 -c "import json
print('$2', json.load(open('last/summary.json'))['errors']['l2_u'], sep=',')" >>"$1.csv"
  rm -r last
}

for n in 8 16 32 64 128; do
  error bar-fe $n bar "finite element" "Constants/n = $n"
  error bar-gimp $n bar GIMP "Constants/n = $n"
  error bar-cpdi2 $n bar CPDI2 "Constants/n = $n"
  error bar-mpm $n bar "material point" "Constants/n = $n"
  error bar-mpm-small $n bar "material point" "Constants/n = $n" "Constants/G = 5e-3"
done
for n in 16 32 64; do
  error vortex-fe $n vortex "finite element" "Constants/n = $n"
  error vortex-gimp $n vortex GIMP "Constants/n = $n"
  error vortex-cpdi2 $n vortex CPDI2 "Constants/n = $n"
done
for steps in 8 16 32 64; do
  error steps-fe $steps bar "finite element" "Constants/n = 256" "Time/Steps = $steps"
  error steps-gimp $steps bar GIMP "Constants/n = 256" "Time/Steps = $steps"
  error steps-cpdi2 $steps bar CPDI2 "Constants/n = 256" "Time/Steps = $steps"
done

plot manufactured 1200,460 <<'GP'
set multiplot layout 1,3
set logscale xy
set format y '10^{%T}'
set ylabel 'relative error of displacement, l_2'
set key below maxrows 2 samplen 1.2 spacing 1.3 font ',11'
set title 'Bar: cells and steps'
set xlabel 'cells n'
set xrange [7:150]
set xtics (8, 16, 32, 64, 128)
set yrange [3e-5:3]
plot 'bar-fe.csv' w lp lt 8 title 'FE', 'bar-gimp.csv' w lp lt 1 title 'GIMP', \
     'bar-cpdi2.csv' w lp lt 3 title 'CPDI2', 'bar-mpm.csv' w lp lt 4 title 'MPM', \
     'bar-mpm-small.csv' w lp lt 6 title 'MPM, G/10', 0.4 / x**2 w l lt 9 title 'order 2'
set title 'Vortex: cells and steps'
set xrange [14:75]
plot 'vortex-fe.csv' w lp lt 8 title 'FE', 'vortex-gimp.csv' w lp lt 1 title 'GIMP', \
     'vortex-cpdi2.csv' w lp lt 3 title 'CPDI2', 40 / x**2 w l lt 9 title 'order 2'
set title 'Bar, 256 cells: steps'
set xlabel 'steps'
set xrange [7:75]
plot 'steps-fe.csv' w lp lt 8 title 'FE', 'steps-gimp.csv' w lp lt 1 title 'GIMP', \
     'steps-cpdi2.csv' w lp lt 3 title 'CPDI2', 0.3 / x**2 w l lt 9 title 'order 2'
unset multiplot
GP
