# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Lamb's problem in plane strain: an elastic half-plane under the strip load of
absorbing.md, and the springs that, beside dashpots, come nearest to what it
does to ground of 3 m x 4 m in its corner. m, kPa, t, s.

Potentials A exp(-alpha z) cos kx and D exp(-beta z) sin kx for every wave number k
and frequency; frequencies lie below the real axis, out of the way of the Rayleigh
wave's pole, which is taken back in time by exp(eps t)."""

import numpy as np

E, NU, RHO, HALF_WIDTH, PRESSURE, RISE = 2000.0, 0.41, 1.0, 0.5, 32.0, 0.2
DEPTH, WIDTH = 4.0, 3.0
G = E / 2 / (1 + NU)
M = E * (1 - NU) / (1 + NU) / (1 - 2 * NU)
C_P, C_S = np.sqrt(M / RHO), np.sqrt(G / RHO)

WINDOW, SAMPLES, MOST_FREQUENCIES = 4.0, 800, 241  # up to 60 Hz
STEP = WINDOW / SAMPLES
EPS = 6 / WINDOW
time = np.arange(SAMPLES) * STEP  # from the start of the load
load = PRESSURE * (1 - abs(time % (2 * RISE) / RISE - 1)) * (time <= 0.65)
spectrum = np.fft.rfft(load * np.exp(-EPS * time)) * STEP
omega = 2 * np.pi * np.fft.rfftfreq(SAMPLES, STEP) - 1j * EPS
D_K = 0.01
k = np.arange(D_K / 2, 60, D_K)


def root(square):
    value = np.sqrt(square)
    return np.where(value.real < 0, -value, value)


def field(x, z):
    """u_x, u_z (down), sigma_xx, sigma_zz, sigma_xz at all times."""
    found = np.zeros((5, len(omega)), complex)
    strip = 2 * np.sin(k * HALF_WIDTH) / k
    c, s = np.cos(k * x), np.sin(k * x)
    for i in range(MOST_FREQUENCIES):
        p, q = (omega[i] / C_P) ** 2, (omega[i] / C_S) ** 2
        a, b = root(k * k - p), root(k * k - q)
        f = 2 * k * k - q
        rayleigh = f * f - 4 * k * k * a * b
        A = -strip * f / (G * rayleigh) * np.exp(-a * z)
        D = 2 * k * a * strip / (G * rayleigh) * np.exp(-b * z)
        found[:, i] = [
            (-(k * A + b * D) * s).sum(), ((-a * A - k * D) * c).sum(),
            G * ((-(q - 2 * p + 2 * k * k) * A - 2 * k * b * D) * c).sum(),
            G * ((f * A + 2 * k * b * D) * c).sum(),
            G * ((2 * k * a * A + f * D) * s).sum()]
    found *= spectrum * D_K / np.pi
    return np.fft.irfft(found, SAMPLES) / STEP * np.exp(EPS * time)


places = 0.25 * (np.arange(16) + 0.5)
base = np.array([field(x, DEPTH) for x in places if x < WIDTH])
side = np.array([field(WIDTH, z) for z in places if z < DEPTH])
# Outward: traction, displacement, dashpot, spring times the radius.
parts = [(base, 3, 1, C_P, 2 * G), (base, 4, 0, C_S, G / 2),
         (side, 2, 0, C_P, 2 * G), (side, 4, 1, C_S, G / 2)]
print("u_y at one, elastic, 0.625 s after the start: %.2f mm"
      % (-1e3 * field(0.01, 1.01)[1][time.searchsorted(0.625 - 1e-9)]))

# t + c v + u k / r_b = 0 in the mean of squares over boundary and time.
radii = []
for end in (0.4, 0.5, 0.6, 0.65):
    now = time < end + STEP / 2
    t, rest, pull = ([] for _ in range(3))
    for where, i_t, i_u, c, spring in parts:
        u, v = where[:, i_u], np.gradient(where[:, i_u], STEP, axis=1)
        t.append(where[:, i_t][:, now].ravel())
        rest.append((where[:, i_t] + RHO * c * v)[:, now].ravel())
        pull.append(spring * u[:, now].ravel())
    t, rest, pull = map(np.concatenate, (t, rest, pull))
    radius = -(pull @ pull) / (pull @ rest)
    radii.append(radius)
    print(f"{end} s of load: r_b = {radius:.2f} m; of the traction is left",
          ", ".join(f"{name}: {np.linalg.norm(rest + pull / r) / np.linalg.norm(t):.3f}"
                    for name, r in (("no springs", np.inf), ("4 m", 4), ("9.9 m", 9.9),
                                    ("this", radius))))
print(f"mean: r_b = {np.mean(radii):.2f} m")
