# debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""An embankment under its weight, then shaken through rock that takes the waves
back: its weight, its lowest frequency against that of a shear beam, what its
crest makes of a wave."""

from cmath import exp
from math import pi, sqrt

WEIGHT = 2 * 9.81 * 12 * (44 + 8) / 2
C_S = sqrt(100e3 / 2.6 / 2)

def frequency_of_shear_beam():
    """Of a wedge cut off at its crest on a rigid base: (z w')' + k^2 z w = 0 from
    z = 8/3 m below its tip, w' = 0, to 44/3 m, w = 0."""
    def at_base(k, n=2000):
        z, w, q = 8 / 3, 1., 0.  # q = z w'
        h = 12 / n
        for _ in range(n):
            middle = w + h / 2 * q / z, q - h / 2 * k * k * z * w
            z += h / 2
            w, q = w + h * middle[1] / z, q - h * k * k * z * middle[0]
            z += h / 2
        return w
    low, high = 0.1, 0.2
    for _ in range(40):
        k = (low + high) / 2
        low, high = (k, high) if at_base(k) > 0 else (low, k)
    return k * C_S / 2 / pi


def incident(t):
    x = (3 * pi * (t - 1.4)) ** 2
    return 0.1 * (1 - 2 * x) * exp(-x).real


def spectrum(times, values, f):
    return sum(v * exp(-2j * pi * f * t) for t, v in zip(times, values)) * 0.01


def amplification(rows, f, key="u_x at crest"):
    """Of a displacement over that of an outcrop, twice the incident one."""
    times = [row["t"] for row in rows]
    outcrop = 2 * spectrum(times, map(incident, times), f) / (2j * pi * f)
    return abs(spectrum(times, [row[key] for row in rows], f) / outcrop)


def shake(name, settings):
    result = run("prm/dynamics/embankment.prm", {**settings, **QUIET})
    rows = result.history()
    bound(f"{name}: reaction under the weight over it - 1",
          rows[1]["reaction_y of rock"] / WEIGHT - 1, 1e-8)
    number(f"{name}: settlement of the crest", -rows[0]["u_y at crest"], 3)
    rows = rows[2:]
    bound(f"{name}: settlement of the crest while it shakes, over that before",
          rows[-1]["u_y at crest"] / 0.0105, 0.01)
    number(f"{name}: largest displacement of the crest",
           max(abs(row["u_x at crest"]) for row in rows), 3)
    number(f"{name}: largest velocity of the crest over that of an outcrop",
           max(abs(b["u_x at crest"] - a["u_x at crest"])
               for a, b in zip(rows, rows[1:])) / 0.01 / 0.2, 3)
    for f in (1, 2, 3, 4, 5):
        number(f"{name}: amplification at {f} Hz", amplification(rows, f), 3)
    bound(f"{name}: the base at 1 Hz over the outcrop - 1",
          amplification(rows, 1, "u_x at base") - 1, 0.02)
    lowest = max((amplification(rows, f / 100), f / 100)
                 for f in range(300, 450, 5))
    number(f"{name}: largest amplification", lowest[0], 2)
    number(f"{name}: at a frequency of", lowest[1], 3)
    bound(f"{name}: energy out of balance",
          result.summary["energy"]["balance_error"], 1e-10)
    return lowest[1]


number("shear beam: frequency", frequency_of_shear_beam(), 3)
shake("GIMP", {})
shake("finite element", {"Method/Method": "finite element",
                         "Method/Mesh after step": "keep"})
