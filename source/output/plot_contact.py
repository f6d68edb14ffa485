# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Draws the tractions of contact on the rim of bodies, for plot.py: as arrows on the
rim, and pressure and shear traction over the path along it."""

import csv

import render
from render import np, plt

FACES = 0.5  # cosine of the angle to the nearest place that touches
REACH = 0.2  # of the length in contact: gaps that are shown


def names_of(run, n):
    """Of the boundaries, in the order of their numbers."""
    try:
        with open(run / "history.csv") as file:
            header = next(csv.reader(file))
    except (OSError, StopIteration):
        header = []
    names = [c.split(" [")[0].removeprefix("contact area of ") for c in header
             if c.startswith("contact area of ")]
    return names if len(names) >= n else [f"boundary {b}" for b in range(n)]


def near_contact(x, normal, gap, touches):
    """Places that touch, and those beside them that face the surface."""
    first = x[touches]
    nearest = np.array([np.argmin(((first - at) ** 2).sum(1)) for at in x])
    faces = (normal * normal[touches][nearest]).sum(1) > FACES
    length = np.linalg.norm(np.ptp(first, axis=0))
    return touches | (faces & (np.abs(gap) < REACH * length))


def in_order(x, normal):
    """Numbers of places along the rim, the body on the left of the way."""
    tangent = np.stack([-normal[:, 1], normal[:, 0]], 1)
    # A rim that closes begins anywhere.
    here = int(np.argmin(x @ tangent.mean(0)))
    left, order = set(range(len(x))) - {here}, [here]
    while left:
        rest = np.fromiter(left, int)
        away = x[rest] - x[here]
        # Back only if there is nothing ahead.
        cost = np.linalg.norm(away, axis=1) * \
            np.where(away @ tangent[here] >= -1e-12, 1, 3)
        here = int(rest[np.argmin(cost)])
        left.remove(here)
        order.append(here)
    return np.array(order)


def breaks(x, size):
    """Numbers of places in order at which another part of the rim begins."""
    steps = np.linalg.norm(np.diff(x, axis=0), axis=1)
    return np.flatnonzero(steps > 4 * np.maximum(size[1:], size[:-1])) + 1


class Rim:
    """The part of a rim at one boundary: places in order, tractions."""

    def __init__(self, data, boundary):
        mine = data.field("boundary") == boundary
        x, n = (values[mine][:, :2].astype(float) for values in
                (data.points, data.field("normal")))
        touches = data.field("status")[mine] > 0
        self.touches = bool(touches.any())
        if not self.touches:
            return
        shown = near_contact(x, n, data.field("gap")[mine], touches)
        shown = np.flatnonzero(shown)
        shown = shown[in_order(x[shown], n[shown])]
        shown = self.parts_that_touch(shown, x, data.field("size")[mine],
                                      touches)
        self.x, self.n = x[shown], n[shown]
        self.traction = data.field("traction")[mine][shown][:, :2].astype(float)
        size = data.field("size")[mine][shown].astype(float)
        steps = np.linalg.norm(np.diff(self.x, axis=0), axis=1)
        self.path = np.concatenate([[0], steps.cumsum()]) + size[0] / 2
        tangent = np.stack([-self.n[:, 1], self.n[:, 0]], 1)
        self.pressure = -(self.traction * self.n).sum(1)
        self.shear = (self.traction * tangent).sum(1)
        for name in ("path", "pressure", "shear"):
            setattr(self, name, np.insert(getattr(self, name),
                                          breaks(self.x, size), np.nan))

    @staticmethod
    def parts_that_touch(order, x, size, touches):
        """Without the parts of the rim of which no place touches."""
        return np.concatenate([
            part for part in np.split(order, breaks(x[order], size[order]))
            if touches[part].any()])

    def draw_arrows(self, axes, unit):
        axes.plot(*self.x.T, ".", color="black", ms=2.5)
        largest = np.linalg.norm(self.traction, axis=1).max()
        length = np.linalg.norm(np.ptp(self.x, axis=0))
        few = np.unique(np.linspace(0, len(self.x) - 1, 40).astype(int))
        arrows = self.traction[few] * 0.25 * length / (largest or 1)
        axes.quiver(*(self.x[few] - arrows).T, *arrows.T, angles="xy",
                    scale_units="xy", scale=1, units="inches", width=0.018,
                    color="C0")
        ends = np.concatenate([self.x, self.x[few] - arrows])
        low, high = ends.min(0), ends.max(0)
        margin = 0.08 * (high - low).max()
        axes.set_xlim(low[0] - margin, high[0] + margin)
        axes.set_ylim(low[1] - margin, high[1] + margin)
        axes.set_aspect("equal")
        axes.set_xlabel(render.with_unit("x", unit))
        axes.set_ylabel(render.with_unit("y", unit))

    def draw_curves(self, axes, unit, of_stress):
        axes.plot(self.path, self.pressure, lw=1.6, label="normal stress, compression positive")
        axes.plot(self.path, self.shear, lw=1.6, color="C3",
                  label="shear stress")
        axes.axhline(0, color="#888888", lw=0.8)
        axes.set_xlabel(render.with_unit(
            "distance along the surface", unit))
        axes.set_ylabel(render.with_unit("stress on the body", of_stress))
        axes.grid(color="#dddddd")
        axes.legend(frameon=False)


def draw(vtu, run, path):
    data = render.Vtu(vtu)
    if np.ptp(data.points[:, 2]) > 0:
        render.fail("tractions of contact are drawn in 2D; in 3D ParaView "
                    f"shows {vtu}")
    numbers = np.unique(data.field("boundary")).astype(int)
    names = names_of(run, numbers.max() + 1)
    rims = {names[b]: rim for b in numbers
            if (rim := Rim(data, b)).touches}
    if not rims:
        render.fail(f"nothing touches a surface in {vtu}")
    units = data.unit("gap"), data.unit("traction")
    figure, axes = plt.subplots(len(rims), 2, squeeze=False,
                                figsize=(11, 4.6 * len(rims)),
                                layout="constrained",
                                gridspec_kw={"width_ratios": [2, 3]})
    for (name, rim), (left, right) in zip(rims.items(), axes):
        rim.draw_arrows(left, units[0])
        rim.draw_curves(right, *units)
        left.set_title(f"{name}, t = {data.time:g}", loc="left", fontsize=11)
    figure.savefig(path, dpi=110)
