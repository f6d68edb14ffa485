# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
#
# README and tutorials.

run footing cortis-2017/footing
render footing "$(last footing/points)" --mesh "$(last footing/mesh)" \
  --field displacement --component y --range -1 0 \
  --heading "Rigid footing, pushed in by 1 m" \
  --title "vertical displacement" --unit m --length-unit m \
  --wall 0 2 0.5 2 0.5 3 --wall 0 3 0 0 3 0 3 3

slope="-21.13 45.32 0 0 90.63 42.26"
run tilted boundaries/tilted-roller
render tilted-roller "$(last tilted/points)" --mesh "$(last tilted/mesh)" \
  --field stress --component yy --range -5.5 0 \
  --heading "Block on a slope of 25 degrees" \
  --title "vertical stress" --unit "N/mm²" --length-unit mm --wall $slope

# The tutorial programs write block.vtu (step-1, step-2) and step-3.vtu.
for step in 1 2 3; do
  mkdir "step-$step"
  (cd "step-$step" && "$build/doc/step-$step" >log)
done
for step in 1 2; do
  render "step-$step" "step-$step/block.vtu" \
    --field stress --component xx --range 15 61 \
    --heading "step-$step" --title "stress xx" --unit "N/mm²" \
    --length-unit mm --size 900 520 --grid 0 0 110 50 10 --point-scale 0.7
done
render step-3 step-3/step-3.vtu --field mean_stress --range -4.5 0 \
  --heading "step-3: block on a slope" --title "mean stress" --unit "N/mm²" \
  --length-unit mm --grid -30 -10 100 95 5 --wall $slope
