# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
#
# Footing and funnel: points move far.

# files FOLDER STEP...: the VTU files of these steps
files() { for step in "${@:2}"; do printf '%s/%05d.vtu\n' "$1" "$step"; done; }

run footing cortis-2017/footing
footing_panels() {
  local name=$1 step labels=()
  local steps=(${2//,/ })
  for step in "${steps[@]}"; do
    labels+=("step $step")
  done
  render "$name" $(files footing/points "${steps[@]}") --columns 2 --label "${labels[@]}" \
    --length-unit m "${@:3}"
}
footing_panels footing-displacement 2,10,15,20 \
  --field displacement --component y --range -1 0 --title u_y --unit m \
  --heading "Rigid footing: vertical displacement at the steps of figure 22, skew Nitsche"
footing_panels footing-stress 10,20 \
  --field stress --component yy --range -600 100 --title "stress yy" \
  --unit "kN/m²" --heading "Rigid footing: vertical stress, skew Nitsche"

run footing-half cortis-2017/footing "Mesh/Cell size = 0.1"
run footing-weighted cortis-2017/footing "Boundaries/*/Enforcement = augmented Lagrangian" \
  "Boundaries/*/Band width = 1e-6"
plot footing-force <<'GP'
set title 'Rigid footing: force on half of it over its penetration, 20 steps'
set xlabel 'penetration  [m]'
set ylabel 'vertical force  [kN/m]'
set xrange [0:1.03]
set yrange [0:*]
force = 'reaction_y of footing [kN]'
plot 'footing/history.csv' using 't':(-column(force)) w lp lt 1 title 'skew Nitsche, γ = 300, h = 0.2 m (the scene)', \
     'footing-half/history.csv' using 't':(-column(force)) w lp lt 2 title 'the same, h = 0.1 m', \
     'footing-weighted/history.csv' using 't':(-column(force)) w lp lt 3 title 'augmented Lagrangian, δ = 10^{-6} h, h = 0.2 m'
GP

run funnel cortis-2017/funnel
steps=(0 2 4 6)
render funnel $(files funnel/points "${steps[@]}") \
  --label "start" "step 2" "step 4" "step 6" --field displacement --component x \
  --range -76 0 --title "u_x" --unit mm \
  --heading "Strip pushed through a funnel: skew Nitsche, factor 100" --length-unit mm
