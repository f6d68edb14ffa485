# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A dam with a phreatic line: its base bears weight and water together, two ranks and
a run that is resumed do the same, and its dry side fails with water at a strength with
which it stands without."""

DAM = "prm/geotechnics/dam.prm"
METHODS = {"GIMP": {}, "FE": {"Method/Method": "finite element"},
           "MPM": {"Method/Method": "material point"},
           "CPDI1": {"Method/Method": "CPDI1"}}
COARSE = {"Mesh/Cell size": 2, "Time/Steps": 4}


def wet_area(height, n=4000):
    """Below the phreatic line, which ends at `height` on the left."""
    area = 0
    for i in range(n):
        x = 44 * (i + 0.5) / n
        top = min(x / 2, 10, (44 - x) / 2)
        area += 44 / n * min(top, height * (1 if x < 16 else (44 - x) / 28))
    return area


# Without yielding forces balance to round-off.
for method, settings in METHODS.items():
    for name, saturated, weight, allowed in (
            ("one density", "", 18 * 240, 1e-8),
            ("two densities", 2, 18 * 240 + 2 * wet_area(8), 1e-2)):
        result = run(DAM, {**settings, **COARSE, "Time/Steps": 2,
                           "Materials/fill/Cohesion": 1000,
                           "Materials/fill/Saturated density": saturated})
        row = result.history()[-1]
        bound(f"{method}, {name}: weight",
              (row["reaction_y of base"] + row["force_y of water"]) / weight - 1, allowed)
        bound(f"{method}, {name}: horizontal balance",
              (row["reaction_x of base"] + row["force_x of water"]) / 320, 1e-8)
        bound(f"{method}, {name}: push of the water, of 320 kN/m",
              row["force_x of water"] / 320 - 1, 2e-2)

one = run(DAM, COARSE, on_ranks=1)
two = run(DAM, COARSE, on_ranks=2)
for key in ("u_x at crest", "u_y at crest", "sigma_yy at core", "pore_pressure at core",
            "total_sigma_yy at core"):
    bound(f"two ranks, {key}", two.probes[key] / one.probes[key] - 1, 1e-8)

through = run(DAM, {**COARSE, "Output/Checkpoint every": "1 step"})
history = (through.folder / "history.csv").read_bytes()
run(through.folder, command="resume", extra=["--from", 3])
text("resumed: history is that of a run without a break",
     history == (through.folder / "history.csv").read_bytes())

for name, settings in (("dry", {"Water/Level": "0.3*t"}), ("with water", {})):
    result = run(DAM, {**COARSE, **settings, "Strength reduction/Factor": 1.5},
                 expect=None)
    text(f"strength over 1.5, {name}", result.summary["status"])
