# ranks: 1 # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""What dashpots send back of pressure waves that fall on them at an angle: the
fraction of the energy, beside that of plane waves."""

from cmath import exp, pi
from math import cos, radians, sin, sqrt

rho, lam, mu = 3, 1, 1
c_p, c_s = 1, 1 / sqrt(3)
DEPTHS = {"low": 0.15, "middle": 0.4, "high": 0.65}
KINDS = (("P", 1), ("S", 1), ("P", -1), ("S", -1))  # down 1, up -1


def wave(kind, way, w):
    """Of the potential cos(pi x) exp(i (w t + way k y)), or sin(pi x) of shear
    waves: k, and at y = 0 the factors of sin in u_x, cos in u_y, sin in s_xy
    and cos in s_yy."""
    k = sqrt((w / (c_p if kind == "P" else c_s))**2 - pi**2)
    if kind == "P":
        return (k, -pi, 1j * way * k, -2j * mu * way * pi * k,
                -lam * (pi**2 + k**2) - 2 * mu * k**2)
    return (k, 1j * way * k, -pi, mu * (pi**2 - k**2), -2j * mu * way * pi * k)


def solve(A, b):
    """Gauss with pivots."""
    n = len(b)
    A = [list(row) + [value] for row, value in zip(A, b)]
    for i in range(n):
        p = max(range(i, n), key=lambda r: abs(A[r][i]))
        A[i], A[p] = A[p], A[i]
        for r in range(n):
            if r != i:
                factor = A[r][i] / A[i][i]
                A[r] = [x - factor * y for x, y in zip(A[r], A[i])]
    return [A[i][n] / A[i][i] for i in range(n)]


def energy(amplitudes, w, way):
    """Flow of energy normal to the boundary, over a common factor."""
    return sum(wave(kind, way, w)[0] * abs(a)**2
               for (kind, its_way), a in zip(KINDS, amplitudes) if its_way == way)


def exact(w, incident=(1, 0)):
    """Reflected energy of pressure and shear waves that fall on dashpots, s_xy
    = rho c_s v_x and s_yy = rho c_p v_y at y = 0."""
    def misfit(kind, way):
        _, u_x, u_y, s_xy, s_yy = wave(kind, way, w)
        return (s_xy - rho * c_s * 1j * w * u_x, s_yy - rho * c_p * 1j * w * u_y)
    down = [incident[0] * a + incident[1] * b
            for a, b in zip(misfit("P", 1), misfit("S", 1))]
    p, s = misfit("P", -1), misfit("S", -1)
    up = solve([[p[0], s[0]], [p[1], s[1]]], [-down[0], -down[1]])
    amplitudes = [*incident, *up]
    return energy(amplitudes, w, -1) / energy(amplitudes, w, 1)


def measured(history, w, turn):
    """Amplitudes of the four waves from the spectra at three depths."""
    rows, right = [], []
    x = 0.25
    dt = history[1]["t"] - history[0]["t"]
    for name, y in DEPTHS.items():
        spectrum = [sum(row[f"u_{d} at {name}"] * exp(-1j * w * row["t"])
                        for row in history) * dt for d in "xy"]
        u_x = cos(turn) * spectrum[0] + sin(turn) * spectrum[1]
        u_y = -sin(turn) * spectrum[0] + cos(turn) * spectrum[1]
        waves = [(wave(kind, way, w), way) for kind, way in KINDS]
        rows.append([f[1] * sin(pi * x) * exp(1j * way * f[0] * y)
                     for f, way in waves])
        rows.append([f[2] * cos(pi * x) * exp(1j * way * f[0] * y)
                     for f, way in waves])
        right += [u_x, u_y]
    normal = [[sum(r[i].conjugate() * r[j] for r in rows) for j in range(4)]
              for i in range(4)]
    return solve(normal, [sum(r[i].conjugate() * b for r, b in zip(rows, right))
                          for i in range(4)])


for name, scene, turn in (
        ("aligned", "prm/dynamics/oblique-aligned.prm", 0),
        ("inclined", "prm/dynamics/oblique-inclined.prm", radians(17))):
    history = run(scene).history()
    for angle in (20, 30, 40, 50, 60):
        w = pi * c_p / sin(radians(angle))
        found = measured(history, w, turn)
        share = energy(found, w, -1) / energy(found, w, 1)
        # What comes back from the other end has some shear waves in it.
        expected = exact(w, found[:2])
        number(f"{name}, {angle} degrees: reflected energy", share, 2)
        number(f"{name}, {angle} degrees: of these plane waves", expected, 2)
        number(f"{name}, {angle} degrees: of a pressure wave alone", exact(w), 2)
