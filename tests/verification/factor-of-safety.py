# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Factor of safety of a slope by strength reduction, against the worst slip
circle (an upper bound; Taylor's stability number), in other meshes, with other
methods and steps: a failure must be one of equilibrium. Bounds that hold no
answer."""
import csv
import json
import math

SCENE = "prm/geotechnics/factor-of-safety.prm"
HEIGHT, WEIGHT, STRENGTH = 8, 2 * 9.81, 32


def stability_of_circle(ground, a, b, depth):
    """F gamma / c of the circle with centre a, b that reaches down to depth
    below the foot: its resisting moment over that of the weight, c = gamma = 1.
    ground: crest and foot of the slope between level ground."""
    (left, top), (x0, _), (x1, foot), (right, _) = ground
    radius = b - foot + depth
    if not b > top or depth < 0:
        return math.inf
    start = a - math.sqrt(max(0, radius**2 - (b - top)**2))
    end = a + math.sqrt(max(0, radius**2 - (b - foot)**2))
    if not (left < start < x0 and x1 < end < right):
        return math.inf
    # The integral of (a - x) (ground(x) - b + sqrt(radius^2 - (x - a)^2)): the
    # root in closed form, the rest by Simpson's rule, exact on straight ground.
    arc = [math.sqrt(radius**2 - (x - a)**2)**3 / 3 for x in (start, end)]
    moment = arc[1] - arc[0]
    for (u, v), (p, q) in (((start, x0), (top, top)), ((x0, x1), (top, foot)),
                           ((x1, end), (foot, foot))):
        middle = (a - (u + v) / 2) * ((p + q) / 2 - b)
        moment += (v - u) / 6 * ((a - u) * (p - b) + 4 * middle + (a - v) * (q - b))
    angle = math.asin((end - a) / radius) + math.asin((a - start) / radius)
    return radius**2 * angle / moment if moment > 0 else math.inf


def worst_circle(ground, depth):
    """The smallest over all circles above firm ground, in steps that halve."""
    (x0, top), (x1, foot) = ground[1:3]
    height = top - foot
    best = min((stability_of_circle(ground, (x0 + x1) / 2 + i * height / 8,
                                    top + 0.05 * height * 1.25**j, depth),
                (x0 + x1) / 2 + i * height / 8,
                top + 0.05 * height * 1.25**j)
               for i in range(-8, 9) for j in range(40))
    step = height / 8
    while step > 1e-4 * height:
        found = min((stability_of_circle(ground, best[1] + i * step,
                                         best[2] + j * step, depth),
                     best[1] + i * step, best[2] + j * step)
                    for i in (-1, 0, 1) for j in (-1, 0, 1))
        step = step / 2 if found[1:] == best[1:] else step
        best = found
    return best[0]


def study(settings, expect=0, on_ranks=1):
    result = run(SCENE, settings, command="study", expect=expect,
                 on_ranks=on_ranks)
    result.cases = json.loads((result.folder / "summary.json").read_text())[
        "cases"]
    return result


# Taylor (1937): 0.181 for slopes below 53 degrees on deep ground.
deep = worst_circle([(-600, 1), (0, 1), (1, 0), (600, 0)], 30)
number("stability number, 45 degrees on deep ground", 1 / deep, 3)
ground = [(0, 12), (10, 12), (26, 4), (40, 4)]
circle = STRENGTH / WEIGHT * worst_circle(ground, 4)
number("2:1 with firm ground in half its height", STRENGTH / WEIGHT /
       HEIGHT / circle, 3)
number("factor of safety of the worst circle", circle, 4)

# The ends of the interval are trials of one that is halved from 1.25 and 1.3.
for h, lower, upper in (1, 1.275, 1.3), (0.5, 1.2625, 1.275):
    found = study({"Mesh/Cell size": h, "Strength reduction/Lower factor": lower,
                   "Strength reduction/Upper factor": upper,
                   "Strength reduction/Tolerance": 0.005})
    case, = found.cases
    factor = case["factor_of_safety"]
    number(f"Cell size = {h}, factor of safety", factor, 4)
    bound("  over that of the worst circle - 1", factor / circle - 1, 0.012)
    text("  trials", ", ".join(
        f"{trial['factor']:.4f} {'stood' if trial['status'] == 'ok' else 'failed'}"
        for trial in case["trials"]))
    bound("  interval", case["failed_at"] - case["stood_at"], 0.005)
    # Without friction strength / F under the weight is strength under F times
    # the weight: a path that ends in another trial ends at the same F t.
    ends = [trial["factor"] * trial["time"] for trial in case["trials"]
            if trial["status"] != "ok"]
    bound("  F t at the end of paths, spread", max(ends) / min(ends) - 1, 2e-3)
    bound("  and off the factor", min(ends) / factor - 1, 4e-3)
    text("  said", next(line for line in found.output.splitlines()
                        if "factor of safety 1" in line).strip())

# It is equilibrium that is missing: finite elements with steps that may be a
# hundred times as short find the same.
case, = study({"Method/Method": "finite element", "Time/Smallest step": "1e-5",
               "Strength reduction/Lower factor": 1.275,
               "Strength reduction/Upper factor": 1.3,
               "Strength reduction/Tolerance": 0.025}).cases
text("finite element",
     f"stood at {case['stood_at']}, failed at {case['failed_at']}")

# Points that nobody says to move stay: soil that slid would stand again.
moving = study({"Method/Mesh after step": "{{keep|default|reset}}",
                "Mesh/Cell size": 2, "Time/Steps": 20,
                "Strength reduction/Upper factor": 2,
                "Strength reduction/Tolerance": 0.05}, expect=1)
for case in moving.cases:
    text(case["case"], f"{case['status']}, stood at {case.get('stood_at')}, "
         f"failed at {case.get('failed_at')}")
with open(moving.folder / "study.csv") as file:
    text("rows", sum(1 for _ in csv.DictReader(file)) ==
         sum(len(case["trials"]) for case in moving.cases))
for line in moving.output.splitlines():
    if "points move" in line or "points stay" in line:
        text("  said", line.strip())

for name, settings in (
        ("lower fails", {"Strength reduction/Lower factor": 1.4}),
        ("upper stands", {"Strength reduction/Upper factor": 1.2,
                          "Mesh/Cell size": 2}),
        # A path that has not come to the end of time says nothing.
        ("few steps along the path", {"Time/Arc length": 0.05, "Time/Steps": 6,
                                      "Mesh/Cell size": 2,
                                      "Strength reduction/Upper factor": 10})):
    result = study(settings, expect=1, on_ranks=2 if name == "upper stands" else 1)
    text(name, result.cases[0]["status"])
    text("  said", next(line for line in result.output.splitlines()
                        if "no factor of safety" in line).strip()[:110])
    text("  trials", len(result.cases[0]["trials"]))

# What a factor does in a plain run: the strength is divided, of what is named.
plain_run = {"Mesh/Cell size": 2, "Output/Points": "false",
             "Output/Mesh": "false", "Time/Steps": 4}
weaker = run(SCENE, {**plain_run, "Strength reduction/Factor": 1.25})
same = run(SCENE, {**plain_run, "Materials/clay/Shear yield stress": 32 / 1.25})
bound("Factor = 1.25 and c_u / 1.25 differ by", max(
    abs(weaker.probes[name] / same.probes[name] - 1) for name in same.probes),
    1e-9)
