# ranks: 2  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A body that is torn apart by its own discretisation is no result: the run
ends, or, where that is wanted, goes on and says so."""

scene = "prm/large-deformation/bar-stretched.prm"
points = {"Method/Method": "material point", "Method/Points per direction": 4}
frozen = {"Method/Method": "GIMP", "Method/Domain update": "frozen"}
half_again = {"Boundaries/pulled/Translation": "2.5*t; 0", "Time/Steps": 10}


def place(message):
    """Where the part is that came off."""
    x, y = message.split("around (")[1].split(")")[0].split(", ")
    return float(x), float(y)


for name, settings in (("4 x 4 points", points), ("frozen boxes", frozen)):
    torn = run(scene, settings, expect=1)
    message = torn.summary["message"]
    text(f"{name}: status", torn.summary["status"])
    text("  body", message.split(" came apart")[0])
    # What has come off is right of the middle: 2.5 at first.
    x, y = place(message)
    bound("  place is in the bar", max(0, 2.5 - x, x - 20, -y, y - 1), 0)
    bound("  time of the tear over that of the end",
          torn.history()[-1]["t"], 0.4)

on = run(scene, {**points, "Method/Separation": "note"})
text("going on: status", on.summary["status"])
text("  warning", on.ids().count("separation"))
bound("  force carried at the end", on.reactions["pulled"][0], 1e-6)

for name, settings in (
        ("GIMP, corners, 1.5 times", {"Method/Method": "GIMP", **half_again}),
        ("CPDI2, 1.5 times", {"Method/Method": "CPDI2", **half_again}),
        ("CPDI2, 4 times", {"Method/Method": "CPDI2"})):
    whole = run(scene, settings)
    text(f"{name}: status", whole.summary["status"])
    text("  warnings", whole.found())
    at_least("  force", whole.reactions["pulled"][0], 250)
