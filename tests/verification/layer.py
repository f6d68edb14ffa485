# ranks: 2  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Amplification of shear waves by a layer of soil on rock: spectra of the
surface over those of an outcrop of the rock, twice the incident wave."""

from cmath import cos, exp, sin, sqrt
from math import pi

TABLE = ((0, 0), (0.04, 0.01), (0.08, 0), (0.12, -0.01), (0.16, 0))


def incident(t):
    for (t0, v0), (t1, v1) in zip(TABLE, TABLE[1:]):
        if t0 <= t < t1:
            return v0 + (v1 - v0) * (t - t0) / (t1 - t0)
    return 0


def outcrop(w):
    """The spectrum of twice the incident displacement."""
    n, T = 8000, 0.16
    dt = T / n
    return 2 * sum(incident((i + 0.5) * dt) * exp(-1j * w * (i + 0.5) * dt)
                   for i in range(n)) * dt / (1j * w)


def exact(w, alpha, beta):
    """Of a layer with Rayleigh's damping on rock without."""
    rho, H, Z = 2, 20, 2.4 * 500
    G = 80e3 * (1 + 1j * w * beta)
    k = sqrt(rho * (w * w - 1j * w * alpha) / G)
    return 1 / abs(cos(k * H) + 1j * G * k / (w * Z) * sin(k * H))


w1, w2 = 2 * pi * 2.5, 2 * pi * 7.5
for name, ratio in (("undamped", 0), ("damped by 5 %", 0.05)):
    history = run("prm/dynamics/layer-compliant-base.prm", {
        "Bodies/layer/Damping ratio": ratio,
        "Bodies/layer/Damping frequencies": "2.5, 7.5"} if ratio else {}).history()
    factors = (2 * ratio * w1 * w2 / (w1 + w2), 2 * ratio / (w1 + w2))
    dt = history[1]["t"] - history[0]["t"]
    for f in (2.5, 3.75, 5, 6.25, 7.5):
        w = 2 * pi * f
        surface = sum(row["u_x at surface"] * exp(-1j * w * row["t"])
                      for row in history) * dt
        found = abs(surface / outcrop(w))
        number(f"{name}, {f} Hz: amplification", found, 4)
        number(f"{name}, {f} Hz: exact", exact(w, *factors), 4)
        bound(f"{name}, {f} Hz: error", abs(found / exact(w, *factors) - 1), 0.01)
    number(f"{name}: displacement left at the end over its peak",
           abs(history[-1]["u_x at surface"])
           / max(abs(row["u_x at surface"]) for row in history), 1)
