# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
#
# README and tutorials.

run footing cortis-2017/footing
render footing "$(last footing/points)" --field displacement --component y \
  --heading "Rigid footing, pushed in by 1 m"

run tilted boundaries/tilted-roller
render tilted-roller "$(last tilted/points)" --field stress --component yy \
  --heading "Block on a slope of 25 degrees" --title "vertical stress"

# The tutorial programs write block.vtu (step-1, step-2) and step-3.vtu.
for step in 1 2 3; do
  mkdir "step-$step"
  (cd "step-$step" && "$build/doc/step-$step" >log)
done
for step in 1 2; do
  render "step-$step" "step-$step/block.vtu" --field stress --component xx --range 15 61 \
    --heading "step-$step" --title "stress xx" --unit "N/mm²" --length-unit mm
done
render step-3 step-3/step-3.vtu --field mean_stress --range -4.5 0 \
  --heading "step-3: block on a slope" --title "mean stress" --unit "N/mm²" --length-unit mm
