# ranks: 1 # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A pulse in a cavity, and a pressure that is held: a ring with an absorbing rim
against the infinite medium, which is one dimensional elements along the radius,
so many that nothing comes back."""

from math import pi, sin

lam, mu, rho = 1, 1, 3


def infinite_medium(pressure, t_end, interval):
    """Displacements at radius 1 and 3, every interval: linear elements in the
    radius, lumped mass, central differences."""
    h, substeps = 0.02, 6
    n = int((t_end / 2 + 4) / h)
    dt = interval / substeps
    r = [1 + i * h for i in range(n + 1)]
    middle = [1 + (i + 0.5) * h for i in range(n)]
    rate = [dt / (rho * r[i] * h * (0.5 if i == 0 else 1)) for i in range(n + 1)]
    u, v = [0.0] * (n + 1), [0.0] * (n + 1)
    found = []
    for step in range(round(t_end / dt)):
        if step % substeps == 0:
            found.append((u[0], u[100]))
        t = step * dt
        force = [0.0] * (n + 1)
        force[0] = pressure(t)
        reach = min(n, int(t / h) + 4)
        for i in range(reach):
            e_r = (u[i + 1] - u[i]) / h
            e_t = (u[i + 1] + u[i]) / (2 * middle[i])
            s_r = ((lam + 2 * mu) * e_r + lam * e_t) * middle[i]
            s_t = ((lam + 2 * mu) * e_t + lam * e_r) * h / 2
            force[i] += s_r - s_t
            force[i + 1] -= s_r + s_t
        for i in range(reach + 1):
            v[i] += rate[i] * force[i] * (0.5 if step == 0 else 1)
            u[i] += dt * v[i]
    found.append((u[0], u[100]))
    return found


def pulse(t):
    return sin(pi * t / 4)**2 if t < 4 else 0


reference = infinite_medium(pulse, 14, 0.1)
for name, settings in (("springs", {}),
                       ("dashpots alone", {"Boundaries/rim/Spring radius": 0})):
    history = run("prm/dynamics/cavity-pulse.prm", settings).history()
    for k, place in enumerate(("r1", "r3")):
        values = [both[k] for both in reference[len(reference) - len(history):]]
        errors = [abs(row[f"u_x at {place}"] - value) / max(values)
                  for row, value in zip(history, values)]
        # The rim answers after 8 at radius 1, after 6 at radius 3.
        early = [error for row, error in zip(history, errors)
                 if row["t"] < (8, 6)[k]]
        number(f"pulse, {name}: largest error at {place} over its peak", max(errors), 2)
        number(f"pulse, {name}: before the rim answers", max(early), 2)
number("pulse: peak at radius 1 in the infinite medium",
       max(u for u, _ in reference), 4)
number("pulse: peak at radius 3 in the infinite medium",
       max(u for _, u in reference), 4)

for name, settings in (("springs", {}),
                       ("dashpots alone", {"Boundaries/rim/Spring radius": 0})):
    result = run("prm/dynamics/cavity-held.prm", settings)
    number(f"held, {name}: displacement of the wall over 1/(2 G), less 1",
           result.probes["u_x at r1"] / 0.5 - 1, 2)
