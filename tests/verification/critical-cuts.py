# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Bodies that hardly fill any cell, that poke into cells, share them or leave and
enter them as they move, and a bar stretched until points are cells apart."""

from math import cos, isclose, log, radians, sin, sqrt

METHODS = "GIMP", "material point", "CPDI1", "CPDI2", "finite element", "DM-GC"


def largest_stress(result):
    """von Mises stress of the points (plane strain)."""
    return max(sqrt(((a - b) ** 2 + (b - c) ** 2 + (c - a) ** 2) / 2 + 3 * t * t)
               for ((a, t, _, _, b, _, _, _, c),) in result.points("stress"))


def shifted(lower, upper, dx, dy, h):
    """A mesh moved by (-dx, -dy) cells."""
    return {"Mesh/Lower corner": f"{lower[0] - dx * h!r}, {lower[1] - dy * h!r}",
            "Mesh/Upper corner": f"{upper[0] - dx * h!r}, {upper[1] - dy * h!r}"}


# A strip one cell thick, or half of one. Exact: force E u A / L along it; stress
# E u / L; across it 6 F (L / 2) / thickness^2 by the force F that is found.
STRIP = "prm/hard-cases/thin-strip.prm"
H = 0.125


def strip(method, cells, angle, dy, across, settings):
    c, s = cos(radians(angle)), sin(radians(angle))
    x, y = (-s, c) if across else (c, s)
    result = run(STRIP, {
        **shifted((-1, -1.5), (3, 2.5), 0.37, dy, H),
        "Method/Method": method,
        "Bodies/strip/Upper corner": f"2, {cells * H!r}",
        "Bodies/strip/Rotation angle": angle,
        "Boundaries/moved/Displacement": f"{0.01 * x!r}*t; {0.01 * y!r}*t",
        **settings})
    force = result.reactions["moved"]
    return force[0] * x + force[1] * y, largest_stress(result), result


def strips(method, cells, across, settings={}):
    """Least and largest force, largest stress over what is right, warnings."""
    forces, stresses, notes = [], [], 0
    cuts = [(angle, dy) for angle in (0, 17, 45)
            for dy in (0, 1e-8, 0.5, 0.75, 1 - 1e-6)]
    for angle, dy in cuts if across else cuts[::2]:
        f, s, result = strip(method, cells, angle, dy, across, settings)
        t = cells * H
        forces.append(f)
        stresses.append(s / (6 * f / t ** 2 if across else 5.))
        # The body is thin for its cells, which matters where it bends.
        notes += sum(one["id"] != "thin-body"
                     for one in result.summary.get("warnings", []))
        notes += result.summary["rejected_steps"]
    return min(forces), max(forces), max(stresses), notes


# DM-GC takes its stiffness from Gauss points of whole cells.
for method in METHODS:
    for cells, of_dm_gc in (1, 0.05), (0.5, 0.15):
        low, high, stress, notes = strips(method, cells, False)
        exact = 1000 * 0.01 / 2 * cells * H
        bound(f"{method}, {cells} cells thick: force over exact - 1",
              max(high / exact - 1, 1 - low / exact),
              of_dm_gc if method == "DM-GC" else 1e-8)
        bound("  stress over exact - 1", stress - 1,
              0.6 if method == "DM-GC" else 1e-4)
        text("  warnings and rejected steps", notes)
for cells in 1, 0.5:
    _, free, unbounded, _ = strips("GIMP", cells, True,
                                   {"Method/Aggregate below": 0})
    _, high, stress, notes = strips("GIMP", cells, True)
    bound(f"bent, {cells} cells thick: force over that of free nodes - 1",
          high / free - 1, 0.02)
    bound("  stress over that of the force", stress, 3)
    at_least("  with free nodes", unbounded, 1000)
    low, high, stress, notes = strips("finite element", cells, True,
                                      {"Method/Degree": 2})
    beam = 12 * 1000 * (cells * H) ** 3 / 12 * 0.01 / 2 ** 3
    bound("  degree 2: force over that of a beam - 1",
          max(high / beam - 1, 1 - low / beam), 0.012)
    bound("  stress over that of the force - 1", stress - 1, 0.02)

# A corner pokes into a row of cells, at a node of it and between two.
BLOCK = "prm/hard-cases/cut-block.prm"
down = "sin(pi/4); -cos(pi/4)"
turned = {"Bodies/block/Rotation angle": 45,
          "Boundaries/support/Rotation angle": 45,
          "Loads/weight/Value": down, "Loads/end/Value": down,
          "Probes/tip/Location":
              f"{1.49 * sqrt(0.5)}, {2.49 * sqrt(0.5)}"}
for method in METHODS:
    found = []
    for dx, poke in (0, 0), (0, 1e-6), (0.3, 1e-6), (0.3, 1e-9), (0.3, 1e-3):
        result = run(BLOCK, {**turned, "Method/Method": method,
                             **shifted((-1, -1.5), (3, 2.5), dx, -poke, H)})
        found.append(largest_stress(result))
    bound(f"corner, {method}: largest stress over that without - 1",
          max(found) / found[0] - 1, 0.5)

# Two bodies in one cell: the force is that of springs in a row, to O(h).
TWO = "prm/hard-cases/two-in-a-cell.prm"
for h, allowed in (0.125, 0.1), (0.0625, 0.05):
    worst = 0
    for dx in 0, 1e-6, 0.3, 0.8:
        result = run(TWO, {**shifted((-1, -1.5), (3, 2.5), dx, 0.6, h),
                           "Mesh/Cell size": h})
        x, y = result.reactions["moved"]
        force = x * cos(radians(17)) + y * sin(radians(17))
        worst = max(worst, abs(force * (1 / 1000 + 1 / 10) / 0.01 - 1))
    bound(f"two bodies, h = {h}: force over exact - 1", worst, allowed)

# A stiff sliver in cells that a soft body fills costs at most one row of its
# eight cells, and no iterations.
for contrast, part in (1e5, 1e-3), (1e9, 1e-8), (1e9, 0.3):
    results = [
        run(TWO, {"Mesh/Lower corner": f"{-part * h!r}, -0.5",
                  "Mesh/Upper corner": f"{2.5 - part * h!r}, 1.5",
                  "Mesh/Cell size": h, "Method/Aggregate below": 0.1,
                  "Bodies/left/Rotation angle": 0,
                  "Bodies/right/Rotation angle": 0,
                  "Materials/stiff/Young modulus": contrast,
                  "Materials/soft/Young modulus": 1,
                  "Boundaries/moved/Displacement": "0.01*t; 0",
                  "Solver/Solver": "gmres"}) for h in (0.125, 0.03125)]
    name = f"a sliver of {part} h, {contrast:g} times as stiff"
    bound(f"{name}: force over exact - 1",
          results[0].reactions["moved"][0] / 0.01 - 1, 1 / 7 + 1e-3)
    bound(f"{name}: iterations", results[1].summary["linear_iterations"], 20)

# A body that leaves cells and enters others at every step.
for method in [m for m in METHODS if m != "finite element"]:
    result = run("prm/hard-cases/carried-block.prm", {
        "Method/Method": method,
        **shifted((-1, -1), (3, 3), 0.3, 0.73, H)})
    later = [row for row in result.history() if row["t"] > 0.21]
    bound(f"carried, {method}: reaction over weight - 1",
          max(abs(row["reaction_y of support"] - 1) for row in later), 1e-10)
    points = result.points("stress", "displacement")
    bound("  largest stress over that at rest", max(-s[4] for s, _ in points), 1.05)
    at_least("  smallest", min(-s[4] for s, _ in points), 0)
    bound("  sideways", max(abs(u[0] - 0.8) for _, u in points), 1e-5)
    text("  rejected steps", result.summary["rejected_steps"])

# A bar stretched to four times its length: neo-Hookean, free to contract.
BAR = "prm/large-deformation/bar-stretched.prm"
E = 1000


def exact_force(stretch, nu):
    """P_11 with no stress across: mu (l_2^2 - 1) + lam ln(l_1 l_2) = 0."""
    mu, lam = E / 2 / (1 + nu), E * nu / (1 + nu) / (1 - 2 * nu)
    low, high = 0.01, 1.
    for _ in range(100):
        middle = (low + high) / 2
        if mu * (middle ** 2 - 1) + lam * log(stretch * middle) > 0:
            high = middle
        else:
            low = middle
    return (mu * (stretch ** 2 - 1) + lam * log(stretch * low)) / stretch


def force_error(result, nu=0.3):
    return max(abs(row["reaction_x of pulled"]
                   / exact_force(1 + 3 * row["t"], nu) - 1)
               for row in result.history() if row["t"] > 0)


for name, settings in (
        ("GIMP, corners", {"Method/Method": "GIMP"}),
        ("GIMP, stretch", {"Method/Method": "GIMP",
                           "Method/Domain update": "stretch"}),
        ("CPDI1", {"Method/Method": "CPDI1"}),
        ("CPDI2", {"Method/Method": "CPDI2"}),
        ("finite element", {"Method/Method": "finite element"})):
    worst = told = 0
    for n, (dx, dy) in enumerate(((0.37, 0.7), (1e-3, 1e-6))):
        result = run(BAR, {**settings, **QUIET,
                           **shifted((0, -1), (21, 2), dx, dy, 0.5)},
                     on_ranks=n % 2 + 1)
        worst = max(worst, force_error(result))
        told += len(result.summary.get("warnings", []))
    text(f"stretched by 4, {name}: warnings", told)
    bound(f"stretched by 4, {name}: force over exact - 1, all steps", worst, 1e-6)

# With means over cells, which are the default then.
for method in ("GIMP", "CPDI1", "CPDI2"):
    for nu, steps in ((0.4999, 60), (0.4999, 150))[:2 if method == "GIMP" else 1]:
        result = run(BAR, {"Method/Method": method, **QUIET,
                           **shifted((0, -1), (21, 2), 0.37, 0.7, 0.5),
                           "Materials/rubber/Poisson ratio": nu,
                           "Time/Steps": steps},
                     on_ranks=1 + (steps == 60))
        bound(f"stretched by 4, {method}, nu = {nu}, {steps} steps: force over "
              "exact - 1, all steps", force_error(result, nu), 1e-6)


def error_when_told(result):
    """Of the force in the step that says that points are too far apart."""
    t = result.finding("points-apart")["t"]
    row, = (row for row in result.history() if isclose(row["t"], t, rel_tol=1e-5))
    return row["reaction_x of pulled"] / exact_force(1 + 3 * row["t"], 0.3) - 1


for n, (name, settings) in enumerate((
        ("GIMP, frozen", {"Method/Method": "GIMP",
                          "Method/Domain update": "frozen"}),
        *((f"material point, {n} per direction",
           {"Method/Method": "material point", "Method/Points per direction": n})
          for n in (2, 4)))):
    torn = run(BAR, {**QUIET, **settings}, expect=1, on_ranks=n % 2 + 1)
    bound(f"stretched by 4, {name}: force over exact - 1 when it is told",
          error_when_told(torn), 0.12)
    text("  says that it tears", "came apart" in torn.summary["message"])
