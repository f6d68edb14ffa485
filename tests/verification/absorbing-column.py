# debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A pulse in a column whose base absorbs it, against d'Alembert's solution:
errors over the peak at all times, at depths of 5, 10 and 15 m."""

from math import sqrt

E, nu, rho, L = 20e3, 0.25, 1.5, 20
M = E * (1 - nu) / ((1 + nu) * (1 - 2 * nu))
G = E / (2 * (1 + nu))
c = sqrt(M / rho)
dt = 2e-5  # of the reference


def pulse(t):
    return 300 * max(0, 1 - abs(t / 0.25 - 1))


def impulse(t):
    """The integral of the pulse."""
    if t <= 0:
        return 0
    if t < 0.25:
        return 600 * t * t
    return 75 - 600 * max(0, 0.5 - t)**2


def waves(k):
    """Displacement of the waves that go down from the top and up from the base,
    from which a spring k sends them: 2 rho c up' = -k (down(t - L/c) + up)."""
    delay = L / c / dt
    down, up = [], []

    def late(values, i):
        x = i - delay
        if x <= 0:
            return 0
        j = int(x)
        return values[j] + (x - j) * (values[j + 1] - values[j])

    u = 0
    factor = k / (2 * rho * c) * dt / 2
    for i in range(int(1 / dt) + 2):
        down.append(impulse(i * dt) / (rho * c) + late(up, i))
        before, now = late(down, i - 1), late(down, i)
        u = u * (1 - factor) / (1 + factor) - factor * (before + now) / (1 + factor)
        up.append(u)
    return down, up


def exact(z, t, fields):
    """Displacement and stress (tension positive) at depth z."""
    def at(values, t):
        if t <= 0:
            return 0, 0
        j = int(t / dt)
        slope = (values[j + 1] - values[j]) / dt
        return values[j] + slope * (t - j * dt), slope
    down, up = fields
    (d, d_rate), (r, r_rate) = at(down, t - z / c), at(up, t - (L - z) / c)
    return d + r, rho * c * (r_rate - d_rate)


def errors(history, fields, depth, column, part, scale=1):
    """Largest error at any time over the peak."""
    values = [exact(depth, row["t"], fields)[part] * scale for row in history]
    sign = -1 if part == 0 else 1  # y points up, z down
    return (max(abs(row[column] - sign * value)
                for row, value in zip(history, values))
            / max(map(abs, values)))


def print_errors(name, history, fields, d_u, d_s, column, scale=1):
    for z in (5, 10, 15):
        number(f"{name}, z{z}: error of u_y over its peak",
               errors(history, fields, z - d_u, f"u_y at z{z}", 0, scale), 2)
        number(f"{name}, z{z}: error of s_yy over its peak",
               errors(history, fields, z - d_s, f"sigma_yy at {column}{z}", 1,
                      scale), 2)


def stored(row, k):
    """Kinetic, strain and spring energy."""
    return (row["kinetic energy of nodes"] + row["strain energy"]
            + 0.25 * k * row["u_y at base"]**2 / 2)


SCENES = {
    ("viscous", "fe"): "prm/phuong-2023/column-viscous-fe.prm",
    ("viscous", "gimp"): "prm/phuong-2023/column-viscous-gimp.prm",
    ("viscous", "mpm"): "prm/phuong-2023/column-viscous-mpm.prm",
    ("viscoelastic", "fe"): "prm/phuong-2023/column-viscoelastic-fe.prm",
    ("viscoelastic", "gimp"): "prm/phuong-2023/column-viscoelastic-gimp.prm",
    ("viscoelastic", "mpm"): "prm/phuong-2023/column-viscoelastic-mpm.prm",
}
STIFFNESS = {"viscous": 0, "viscoelastic": 2 * G / 20}
FIELDS = {kind: waves(k) for kind, k in STIFFNESS.items()}
for kind, fields in FIELDS.items():
    history = run(SCENES[kind, "fe"]).history()
    print_errors(f"FE, {kind}", history, fields, 0, 0.0528, "s")
    peak = min(row["u_y at z10"] for row in history)
    number(f"FE, {kind}: largest settlement at 10 m", -peak, 4)
    number(f"FE, {kind}: final settlement at 10 m", -history[-1]["u_y at z10"], 5)
    number(f"FE, {kind}: largest compression at 10 m",
           -min(row["sigma_yy at s10"] for row in history), 3)
    if kind == "viscoelastic":
        number(f"FE, {kind}: tension at 10 m from t =",
               min(row["t"] for row in history if row["sigma_yy at s10"] > 1), 3)
    bound(f"FE, {kind}: energy out of balance",
          max(abs(row["energy out of balance"]) for row in history)
          / history[-1]["external work"], 1e-12)
    # Without load it falls in every step, while there is some.
    energies = [stored(row, STIFFNESS[kind]) for row in history
                if row["t"] > 0.5001]
    bound(f"FE, {kind}: steps without load in which energy does not fall",
          sum(b >= a for a, b in zip(energies, energies[1:])
              if a > 1e-4 * energies[0]), 0)

# Points of DM-GC that stay, at the full load.
history = run("prm/phuong-2023/column-viscoelastic-dmgc.prm").history()
print_errors("DM-GC, viscoelastic", history, FIELDS["viscoelastic"], 0, 0.0625, "s")

# Springs of a virtual layer, of a medium that is named: M/delta.
history = run("prm/phuong-2023/column-viscous-fe.prm", {
    "Grid conditions/base/Virtual thickness": 20,
    "Grid conditions/base/Outer density": rho,
    "Grid conditions/base/Outer wave speeds": f"{c}, {sqrt(G / rho)}",
}).history()
print_errors("FE, Kelvin-Voigt", history, waves(M / 20), 0, 0.0528, "s")

# At a thousandth of the load the material hardly moves through the mesh, as in
# the linear solution; at the full load the pulse shortens it by 1.3 %.
for method in ("gimp", "mpm"):
    for kind, fields in FIELDS.items():
        history = run(SCENES[kind, method], {"Loads/pulse/Curve": "0.001"},
                      on_ranks=1 if kind == "viscous" else None).history()
        print_errors(f"{method}, {kind}", history, fields, 0.0625,
                     0.0625, "z", 1e-3)
history = run("prm/phuong-2023/column-viscous-gimp.prm", on_ranks=1).history()
number("gimp, full load: final settlement at 10 m",
       -history[-1]["u_y at z10"], 4)

# In 3D, with cells of 1 m that load and base cut.
history = run("prm/phuong-2023/column-viscous-3d.prm").history()
number("3D: error of u_z at 10 m over its peak",
       max(abs(row["u_z at z10"] + exact(10, row["t"], FIELDS["viscous"])[0])
           for row in history) / -history[-1]["u_z at z10"], 2)
number("3D: final settlement at 10 m", -history[-1]["u_z at z10"], 4)
