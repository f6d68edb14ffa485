# ranks: 2  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Boundaries that are parts of a body's rim do what the same surfaces do that
are given once more."""

surfaces = run("prm/boundaries/ring-roller.prm")
parts = run("prm/boundaries/ring-parts.prm")
for name, reaction in surfaces.reactions.items():
    size = max(map(abs, reaction))
    bound(f"reaction of {name}: relative difference",
          max(abs(a - b) for a, b in
              zip(parts.reactions[name], reaction)) / size, 1e-9)
for name, error in surfaces.errors.items():
    bound(f"{name}: relative difference",
          abs(parts.errors[name] / error - 1), 1e-8)

unknown = run("prm/boundaries/ring-parts.prm",
              {"Boundaries/inner/Part": "ring/iner"}, expect=2)
text("a part that is not there",
     unknown.output[unknown.output.index("section"):].strip())
