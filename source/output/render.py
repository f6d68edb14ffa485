# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Draws VTU files of runs as PNG pictures, for plot.py.

The fields of points are brought onto a fine regular grid by local linear fits
over about a cell, each body by itself, and drawn as filled contours up to where
their density falls to one half: the outline. In 3D a quarter is cut away.
"""

import base64
import math
import os
import sys
import xml.etree.ElementTree as xml
import zlib

TENSOR = ["xx", "xy", "xz", "yx", "yy", "yz", "zx", "zy", "zz"]
VECTOR = ["x", "y", "z"]


def fail(message):
    sys.exit(f"moraine plot: {message}")


try:
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    import numpy as np
    from matplotlib.collections import LineCollection, PolyCollection
    from matplotlib.colors import BoundaryNorm
    from matplotlib.patches import PathPatch
    from matplotlib.path import Path
    from matplotlib.ticker import (LogLocator, MaxNLocator, NullFormatter,
                                   StrMethodFormatter)
    from matplotlib.transforms import nonsingular
    from scipy import ndimage
except ImportError:
    fail("pictures need Debian's packages python3-matplotlib and "
         "python3-scipy, and Debian's own python3")


class Vtu:
    """A VTU file as deal.II writes it; arrays are decoded when asked for."""

    def __init__(self, path):
        if not os.path.isfile(path):
            fail(f"there is no file {path}")
        root = xml.parse(path).getroot()
        self.pieces = root.findall(".//Piece")
        self.time = next((float(a.text) for a in root.iter("DataArray")
                          if a.get("Name") == "TIME"), None)
        self.fields = [a.get("Name") for a in
                       self.pieces[0].find("PointData") or []]
        self.points = self.joined("Points/DataArray")

    def joined(self, path):
        return np.concatenate([decoded(p.find(path)) for p in self.pieces])

    def field(self, name):
        if name not in self.fields:
            fail(f"no field '{name}'; there are {', '.join(self.fields)}")
        return self.joined(f"PointData/DataArray[@Name='{name}']")

    def unit(self, name):
        """Empty if the file names a quantity only."""
        unit = self.pieces[0].find(
            f"PointData/DataArray[@Name='{name}']").get("units", "")
        return shown_unit(unit)

    def corners(self):
        """Places of the corners of all cells."""
        points, cells = (np.array([int(p.get(key)) for p in self.pieces])
                         for key in ("NumberOfPoints", "NumberOfCells"))
        return np.concatenate([
            decoded(piece.find("Cells/DataArray[@Name='connectivity']")) + first
            for piece, first in zip(self.pieces, points.cumsum() - points)
        ]).reshape(cells.sum(), -1)


def decoded(array):
    """The numbers of a compressed DataArray."""
    text = array.text.strip().encode()
    kind = array.get("type").lower()
    if array.get("format") == "ascii":
        values = np.array(text.split(), kind)
    else:
        n = np.frombuffer(base64.b64decode(text[:8])[:4], "<u4")[0]
        end = 4 * math.ceil((12 + 4 * n) / 3)
        sizes = np.frombuffer(base64.b64decode(text[:end]), "<u4")[3:3 + n]
        packed, blocks = base64.b64decode(text[end:]), []
        for size in sizes:
            blocks.append(zlib.decompress(packed[:size]))
            packed = packed[size:]
        values = np.frombuffer(b"".join(blocks), kind)
    n = int(array.get("NumberOfComponents", 1))
    return values.reshape(-1, n) if n > 1 else values


def shown_unit(unit):
    """Nothing of a scene without units, where it only names quantities."""
    words = set(unit.translate(str.maketrans("/^23", "    ")).split())
    if words <= {"length", "force", "time", "stress", "mass"}:
        return ""
    return unit.replace("^2", "²").replace("^3", "³").replace(" ", "·")


def component_of(values, field, component):
    """The column of that name, or the magnitude."""
    n = values.shape[1] if values.ndim > 1 else 1
    if component in ("", "magnitude"):
        return values if n == 1 else np.linalg.norm(values, axis=1)
    names = {3: VECTOR, 9: TENSOR}.get(n, [])
    if component not in names:
        fail(f"{field} has no component '{component}'; "
             f"there are {', '.join(names)}, magnitude")
    return values[:, names.index(component)]


def beside(path, series):
    """The file of another series of the same step, if there is one."""
    folder, name = os.path.split(os.path.abspath(path))
    other = os.path.join(os.path.dirname(folder), series, name)
    return Vtu(other) if os.path.isfile(other) else None


def grid_of(x, volume, value, domains, fits):
    """Density, and the fitted value, on a regular grid: its origin and size.

    A point much larger than others, or stretched, is spread over its domain.
    """
    dim = x.shape[1]
    size = volume ** (1 / dim)
    h = np.median(size)
    low, high = x.min(0) - 3 * h, x.max(0) + 3 * h
    d = max(h / (3 if dim == 2 else 2),
            ((high - low).prod() / (4e5 if dim == 2 else 1e6)) ** (1 / dim))
    shape = np.ceil((high - low) / d).astype(int) + 2
    basis = np.stack([np.ones_like(value), value] +
                     ([*x.T, *(value * x.T)] +
                      [x[:, i] * x[:, j] for i in range(dim)
                       for j in range(i, dim)] if fits else []))
    sums = np.zeros((len(basis), shape.prod()))
    widths = (0.8, 0.7) if domains is None else (0.7,)
    if domains is None:
        domains = size[:, None] / 2 * np.eye(dim)[:, None]
    length = 2 * np.linalg.norm(domains, axis=2).max(0)
    count = np.ceil(length / (1.3 * max(h, d))).astype(int).clip(1, 12)
    for n in np.unique(count):
        here = count == n
        amount = basis[:, here] * volume[here] / (d * n) ** dim
        for k in np.ndindex(*[n] * dim):
            xi = (np.array(k) + 0.5) * 2 / n - 1
            add(x[here] + np.tensordot(xi, domains[:, here], 1), amount,
                low, d, shape, sums)
    sums = sums.reshape(len(basis), *shape)
    for width in widths:  # the wider is smooth, but loses thin bodies
        density = ndimage.gaussian_filter(sums[0], width * h / d)
        lost = 1 - (density >= 0.5).sum() * d ** dim / volume.sum()
        if lost < 0.01:
            break
    for total in sums:
        ndimage.gaussian_filter(total, 0.9 * h / d, output=total)
    with np.errstate(all="ignore"):
        sums[1:] /= sums[0]
    field = fitted(sums, low, d, dim) if fits else sums[1]
    field = np.where(sums[0] > 1e-3, field, np.nan)
    return density, field.clip(value.min(), value.max()), low, d


def add(x, amount, low, d, shape, sums):
    """Share each amount among the corners of the grid's cell around x."""
    cell, rest = np.divmod((x - low) / d, 1)
    for corner in np.ndindex(*[2] * len(shape)):
        to = np.ravel_multi_index((cell.astype(int) + corner).T, shape)
        weight = np.where(corner, rest, 1 - rest).prod(1)
        for total, one in zip(sums, amount):
            total += np.bincount(to, weight * one, len(total))


def corner_domains(body, density, low, d):
    """Those that fill the corners of a body, which the density rounds off."""
    x, volume, _, domains = body
    if domains is None:
        return []
    signs = [(-1, -1), (1, -1), (1, 1), (-1, 1), (-1, -1)]
    ends = np.stack([x + s * domains[0] + t * domains[1] for s, t in signs], 1)
    least = ndimage.map_coordinates(
        density, np.moveaxis((ends - low) / d, 2, 0), order=1).min(1)
    return [Path(domain, closed=True) for domain in
            ends[(least < 0.28) & (volume > 0.85 * np.median(volume))]]


def rim_of(mesh, volume):
    """All cells, if points fill them: then they are the body."""
    cells = mesh.points[mesh.corners()][:, [0, 1, 2, 3, 0], :2]
    area = 0.5 * np.cross(cells[:, 2] - cells[:, 0], cells[:, 3] - cells[:, 1])
    if abs(area.sum() - volume) < 1e-3 * volume:
        return Path.make_compound_path(*(Path(cell, closed=True)
                                         for cell in cells))


def fitted(sums, low, d, dim):
    """Linear fits by least squares, from the moments around each place."""
    mean, f = sums[2:2 + dim], sums[1]
    slope = sums[2 + dim:2 + 2 * dim] - f * mean
    spread = np.empty(f.shape + (dim, dim))
    for k, (i, j) in enumerate((i, j) for i in range(dim)
                               for j in range(i, dim)):
        c = sums[2 + 2 * dim + k] - mean[i] * mean[j]
        spread[..., i, j] = spread[..., j, i] = c + (0.1 * d * d if i == j
                                                     else 0)
    spread = np.nan_to_num(spread) + 1e-300 * np.eye(dim)
    away = np.stack(np.meshgrid(*[low[i] + d * np.arange(f.shape[i])
                                  for i in range(dim)], indexing="ij")) - mean
    away, slope = np.moveaxis(away, 0, -1), np.moveaxis(slope, 0, -1)
    return f + (np.linalg.solve(spread, np.nan_to_num(slope)[..., None])[..., 0]
                * away).sum(-1)


class Panel:
    """What one file shows."""

    def __init__(self, args, number):
        self.args = args
        path = args.files[number]
        data = self.data = Vtu(path)
        self.label = args.label[number] if number < len(args.label) else \
            "" if data.time is None else f"t = {data.time:g}"
        values = data.field(args.field)
        self.value = component_of(values, args.field, args.component) \
            .astype(float)
        self.dim = 3 if np.ptp(data.points[:, 2]) > 0 else 2
        self.name = args.title or name_of(args.field, args.component, self.dim)
        self.unit = args.unit or data.unit(args.field)
        self.cells = data.corners()
        self.x = data.points[:, :self.dim].astype(float)
        self.length_unit = args.length_unit or next(
            (data.unit(name) for name in data.fields
             if name.endswith("displacement")), "")
        mesh = beside(path, "mesh") if self.dim == 2 else None
        self.mesh = mesh if args.mesh else None
        self.surfaces = beside(path, "boundaries") if self.dim == 2 and \
            args.magnify == 1 else None
        self.water = beside(path, "water") if self.dim == 2 else None
        self.bodies = self.bodies_of_points(path) \
            if self.cells.shape[1] == 1 else []

        self.rim = rim_of(mesh, self.bodies[0][1].sum()) \
            if mesh and len(self.bodies) == 1 and args.magnify == 1 else None

    def bodies_of_points(self, path):
        """For each body the arguments of grid_of()."""
        volume = self.data.field("volume").astype(float)
        body = self.data.field("body") if "body" in self.data.fields else \
            np.zeros(len(volume))
        domains, halves = beside(path, "domains"), None
        if domains:
            # Edges of the parallelogram nearest to each domain.
            x = domains.points[domains.corners()][:, :, :self.dim]
            ends = [[1, 2, 5, 6], [2, 3, 6, 7], [4, 5, 6, 7]]
            halves = np.stack([
                (x[:, [v for v in ends[i] if v < x.shape[1]]].mean(1) -
                 x.mean(1)) for i in range(self.dim)]).astype(float)
        if self.args.magnify != 1:
            self.x += (self.args.magnify - 1) * \
                self.data.field("displacement")[:, :self.dim]
        return [(self.x[body == b], volume[body == b], self.value[body == b],
                 halves[:, body == b] if domains else None)
                for b in np.unique(body)]

    def bounds(self):
        places = [self.x] + [m.points[:, :self.dim] for m in
                             (self.mesh, self.surfaces) if m]
        places = np.concatenate(places)
        # Points are in the middle of their domains.
        h = max((np.median(body[1]) ** (1 / self.dim) / 2
                 for body in self.bodies), default=0)
        low, high = places.min(0) - h, places.max(0) + h
        if self.water and len(self.water.points):
            # Lines end at the sides of the mesh.
            high[1] = max(high[1], self.water.points[:, 1].max())
        return low, high

    def draw(self, axes, colours):
        self.draw_solid(axes, colours) if self.dim == 3 and self.bodies else \
            self.draw_flat(axes, colours)
        axes.set_title(self.label, loc="left", fontsize=11)

    def draw_flat(self, axes, colours):
        for body in self.bodies:
            density, field, low, d = grid_of(*body, True)
            x, y = (low[i] + d * np.arange(density.shape[i]) for i in (0, 1))
            outline = Path.make_compound_path(*axes.contourf(
                x, y, density.T, [0.5, 1e9], colors="white",
                alpha=0).collections.pop().get_paths(),
                *corner_domains(body, density, low, d)) \
                if self.rim is None else self.rim
            # What is drawn over it hides the lines inside.
            axes.add_patch(PathPatch(outline, fc="none", ec="#333333", lw=1.8,
                                     joinstyle="round", zorder=1))
            # A value at the lowest level is not below it.
            field += 1e-9 * np.ptp(colours.levels)
            for part in axes.contourf(x, y, field.T, colours.levels,
                                      cmap=colours.map, norm=colours.norm,
                                      extend="both", zorder=1).collections:
                part.set_clip_path(outline, axes.transData)
                part.set_edgecolor("face")
        if not self.bodies and self.dim == 2:
            of_cells = self.value[self.cells].mean(1)
            axes.add_collection(PolyCollection(
                self.x[self.cells], array=of_cells, cmap=colours.map,
                norm=colours.norm, ec="#555555", lw=0.3))
        if self.mesh:
            axes.add_collection(PolyCollection(
                self.mesh.points[self.mesh.corners()][:, :, :2], fc="none",
                ec="#888888", lw=0.4))
        if self.surfaces and len(self.surfaces.points):
            middle = self.surfaces.points[:, :2]
            normal = self.surfaces.field("normal")[:, :2]
            half = normal[:, ::-1] * (-0.5, 0.5) * \
                self.surfaces.field("size")[:, None]
            axes.add_collection(LineCollection(
                np.stack([middle - half, middle + half], 1), color="black",
                lw=2.5, capstyle="projecting"))
        if self.water and len(self.water.points):
            self.draw_water(axes)
        axes.set_aspect("equal")
        axes.set_xlabel(with_unit("x", self.length_unit))
        axes.set_ylabel(with_unit("y", self.length_unit))

    def draw_water(self, axes):
        """The phreatic line, and free water behind the bodies, each with an
        inverted triangle."""
        kind = self.water.field("kind")
        low, high = self.bounds()
        size = 0.025 * (high - low).max()
        lines = [self.water.points[kind == k][:, :2].astype(float)
                 for k in (0, 1)]
        lines = [line[np.argsort(line[:, 0])] for line in lines]
        lines = [line[(line[:, 0] >= low[0]) & (line[:, 0] <= high[0])]
                 for line in lines]
        outside = lines[1] if len(lines[1]) else lines[0]
        axes.fill_between(*outside.T, low[1], color="#cfe4f7", lw=0, zorder=0,
                          where=outside[:, 1] > low[1])
        for line, style, at in zip(lines, ("-", "--"), (0.4, 0.94)):
            if not len(line):
                continue
            axes.plot(*line.T, style, color="#1060c0", lw=1.6, zorder=3)
            x, y = line[int(at * (len(line) - 1))]
            axes.fill([x, x - 0.7 * size, x + 0.7 * size],
                      [y, y + 1.2 * size, y + 1.2 * size], fc="white",
                      ec="#1060c0", lw=1.2, zorder=4)
            for k in (1, 2):
                axes.plot([x - 0.5 * size / k, x + 0.5 * size / k],
                          2 * [y - 0.35 * k * size], color="#1060c0", lw=1.2,
                          zorder=4)

    def draw_solid(self, axes, colours):
        """Seen from where x and z are large and y is small, without the
        quarter that is nearest."""
        low, high = self.bounds()
        view = View(low, high)
        parts = [view.image(*grid_of(*body, False), not self.args.whole)
                 for body in self.bodies]
        depth = np.stack([p[0] for p in parts])
        front = depth.argmin(0)[None]
        value, light = (np.take_along_axis(np.stack([p[k] for p in parts]),
                                           front, 0)[0] for k in (1, 2))
        picture = colours.map(colours.norm(value))
        picture[..., :3] *= light[..., None]
        picture[~np.isfinite(depth.min(0))] = 0
        axes.imshow(picture, extent=view.extent, origin="lower",
                    interpolation="antialiased", zorder=2)
        view.draw_axes(axes, self.length_unit)


class View:
    """A parallel projection of a box."""

    def __init__(self, low, high):
        self.low, self.high = low, high
        self.centre = (low + high) / 2
        along = np.array([-1, 1.6, -1]) / math.sqrt(4.56)
        right = np.array([1.6, 1, 0]) / math.sqrt(3.56)
        self.axes = np.stack([right, np.cross(right, along), along])
        ends = self.project(np.array([[(low, high)[k >> i & 1][i] for i in
                                       range(3)] for k in range(8)]))
        self.begin, self.end = ends.min(0), ends.max(0)
        self.extent = [self.begin[0], self.end[0], self.begin[1], self.end[1]]
        self.step = max(self.end[:2] - self.begin[:2]) / 700

    def project(self, x):
        return x @ self.axes.T

    def image(self, density, value, low, d, cut):
        """Depth, value and light in each pixel."""
        n = np.ceil((self.end - self.begin)[:2] / self.step).astype(int) + 1
        is_in = density >= 0.5
        x = low + d * np.argwhere(is_in & ~ndimage.binary_erosion(is_in))
        if cut:
            everywhere = low + d * np.argwhere(is_in)
            faces = abs(everywhere[:, :2] - self.centre[:2]).min(1) < d
            x = np.concatenate([x, everywhere[faces]])
            x = x[self.keeps(x) >= -d]
        # The nearest of the grid's places on the surface, as squares.
        seen = self.project(x)
        seen = seen[np.argsort(-seen[:, 2])]
        pixel = np.rint((seen[:, :2] - self.begin[:2]) / self.step).astype(int)
        depth = np.full(n, np.inf)
        reach = int(d / self.step) + 1
        for shift in np.ndindex(2 * reach + 1, 2 * reach + 1):
            to = (pixel + shift - reach).clip(0, n - 1).T
            np.minimum.at(depth, tuple(to), seen[:, 2])
        hit = np.isfinite(depth)
        start = np.stack([*(self.begin[:2, None] +
                            self.step * np.argwhere(hit).T), depth[hit] - d])
        at, light = self.surface(density, low, d, cut, start)
        found = np.isfinite(at[0])
        result = np.full((3, *n), np.inf)
        shown = np.where(found, (at - low[:, None]) / d, 0)
        value = np.where(np.isnan(value), np.nanmean(value), value)
        result[:, hit] = np.where(found, [
            (at * self.axes[2][:, None]).sum(0),
            ndimage.map_coordinates(value, shown, order=1), light], np.inf)
        return result.transpose(0, 2, 1)

    def keeps(self, x):
        """How far a place is from what is cut away, there negative."""
        return np.maximum(self.centre[0] - x[:, 0], x[:, 1] - self.centre[1])

    def surface(self, density, low, d, cut, start):
        """Where lines of sight come into the body, and how bright it is."""
        def inside(seen):
            x = self.axes.T @ seen
            level = ndimage.map_coordinates(
                density, (x - low[:, None]) / d, order=1) - 0.5
            return np.minimum(level, self.keeps(x.T) / d) if cut else level
        at = np.full(start.shape, np.nan)
        before = np.full(start.shape[1], -1.0)
        for k in range(26):
            seen = start + [[0], [0], [0.25 * k * d]]
            level = inside(seen)
            hits = np.isnan(at[0]) & (level >= 0)
            back = level / np.where(level > before, level - before, 1)
            at[:, hits] = (seen - [[0], [0], [0.25 * d]] * back)[:, hits]
            before = level
        place = np.nan_to_num(at)
        normal = np.stack([inside(place + e) - inside(place - e) for e in
                           0.7 * d * np.eye(3)[..., None]])
        normal /= np.linalg.norm(normal, axis=0) + 1e-30
        light = 0.72 + 0.28 * np.clip(
            np.array([0.25, -0.55, 0.8]) @ normal, 0, 1)
        return self.axes.T @ at, light

    def draw_axes(self, axes, unit):
        """Numbers on three edges of the box, its other edges as thin lines."""
        low, high = self.low, self.high
        corner = {k: self.project(np.array([(low, high)[k >> i & 1][i]
                                            for i in range(3)])[None])[0, :2]
                  for k in range(8)}
        for k in range(8):
            for i in range(3):
                if not k >> i & 1:
                    axes.plot(*np.stack([corner[k], corner[k | 1 << i]]).T,
                              color="#aaaaaa", lw=0.7, zorder=1)
        away = 0.02 * max(self.end[:2] - self.begin[:2])
        for i, (start, side) in enumerate([(0, (-0.4, -1)), (1, (0.7, -0.8)),
                                           (0, (-1, 0))]):
            fixed = np.array([(low, high)[start >> j & 1][j] for j in range(3)])
            for tick in nice_ticks(low[i], high[i], 4):
                fixed[i] = tick
                place = self.project(fixed[None])[0, :2]
                axes.plot(*np.stack([place, place + 0.4 * away *
                                     np.array(side)]).T, color="black", lw=0.8)
                axes.text(*(place + away * np.array(side)), f"{tick:g}",
                          ha="center" if i == 0 else "left" if i == 1
                          else "right", va="top" if i < 2 else "center")
            fixed[i] = self.centre[i]
            axes.text(*(self.project(fixed[None])[0, :2] +
                        4.5 * away * np.array(side)),
                      with_unit("xyz"[i], unit), ha="center", va="center")
        axes.set_aspect("equal")
        axes.axis("off")


def nice_ticks(low, high, n):
    ticks = MaxNLocator(n, steps=[1, 2, 2.5, 5, 10]).tick_values(low, high)
    return [t for t in ticks if low - 1e-9 * abs(high - low) <= t <=
            high + 1e-9 * abs(high - low)]


def with_unit(name, unit):
    return f"{name} [{unit}]" if unit else name


def name_of(field, component, dim):
    """A field in words."""
    words = field.replace("_", " ").replace("von mises", "von Mises")
    if component in VECTOR:
        return f"{dict(x='horizontal', y='vertical')[component]} {words}" \
            if dim == 2 and component != "z" else f"{words} in {component}"
    return f"{words} {component}".strip().replace(" magnitude", "")


class Colours:
    """Bands between round numbers, without the outermost 2 % of the values."""

    def __init__(self, args, panels):
        value = np.concatenate([panel.value for panel in panels])
        value = value[np.isfinite(value)]
        ends = args.range or np.quantile(value, [0.01, 0.99])
        ends = nonsingular(*ends, expander=0.5, tiny=1e-9)
        if args.diverging and not args.range:
            ends = [-max(map(abs, ends)), max(map(abs, ends))]
        self.levels = MaxNLocator(12, steps=[1, 2, 2.5, 5, 10]).tick_values(
            *ends)
        self.map = plt.get_cmap("RdBu_r" if args.diverging else "viridis")
        self.norm = BoundaryNorm(self.levels, self.map.N, extend="both")
        self.beyond = ["neither", "min", "max", "both"][
            (value.min() < self.levels[0]) +
            2 * (value.max() > self.levels[-1])]


def add_arguments(parser):
    """How a picture looks; what it shows is left to the caller."""
    parser.add_argument("--label", nargs="+", default=[],
                        help="above each panel; its time if left out")
    parser.add_argument("--columns", type=int, default=1, help="of panels")
    parser.add_argument("--mesh", action="store_true",
                        help="draw the active cells too (2D)")
    parser.add_argument("--whole", action="store_true",
                        help="cut nothing away (3D)")
    parser.add_argument("--magnify", type=float, default=1.0, metavar="FACTOR",
                        help="draw points at this many times their "
                        "displacement")
    parser.add_argument("--heading", default="", help="above the picture")
    parser.add_argument("--diverging", action="store_true",
                        help="colours from blue over white to red")
    parser.add_argument("--component", default="",
                        help="of the field: x, y, z; xx, xy, ...; magnitude")
    parser.add_argument("--range", nargs=2, type=float,
                        help="values at the ends of the colour bar")
    parser.add_argument("--title", help="name of the field")
    parser.add_argument("--unit", default="", help="unit of the field")
    parser.add_argument("--length-unit", default="", help="unit of the axes")


def draw_curves(panels, values, name_of_column, against, unit, path):
    """Panels (label, columns) of values by column below each other."""
    figure, axes = plt.subplots(len(panels), 1, squeeze=False, sharex=True,
                                figsize=(9, 0.6 + 2.6 * len(panels)),
                                layout="constrained")
    for place, (of_axis, columns) in zip(axes.flat, panels):
        for column in columns:
            place.plot(values[against], values[column], "o-", ms=3, lw=1.6,
                       label=name_of_column(column))
        place.set_ylabel(of_axis)
        place.grid(color="#dddddd")
        place.legend(loc="upper left", bbox_to_anchor=(1.01, 1), frameon=False)
    axes[-1, 0].set_xlabel(with_unit(name_of_column(against), unit))
    figure.savefig(path, dpi=110)


def draw_over(panels, computed, units, measured, logarithmic, path):
    """Panels (x, y) of columns beside each other, measured values as dots."""
    figure, axes = plt.subplots(1, len(panels), squeeze=False,
                                figsize=(4.2 * len(panels), 3.8),
                                layout="constrained")
    for i, (place, (x, y)) in enumerate(zip(axes.flat, panels)):
        place.plot(computed[x], computed[y], lw=1.6, label="computed")
        place.plot(computed[x][0], computed[y][0], "o", ms=5, color="C0",
                   mfc="white", label="start")
        if x in measured and y in measured:
            place.plot(measured[x], measured[y], "x", ms=5, color="C3",
                       label="measured")
        if i in logarithmic:
            place.set_xscale("log")
            place.xaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
            place.xaxis.set_major_formatter(StrMethodFormatter("{x:g}"))
            place.xaxis.set_minor_formatter(NullFormatter())
        place.set_xlabel(with_unit(x, units.get(x, "")))
        place.set_ylabel(with_unit(y, units.get(y, "")))
        place.grid(color="#dddddd")
    max(axes.flat, key=lambda place: len(place.lines)).legend(frameon=False)
    figure.savefig(path, dpi=110)


def draw(args, path):
    """Draw args.files as the PNG file `path`, or write a CSV table of them."""
    panels = [Panel(args, i) for i in range(len(args.files))]
    if path.endswith(".csv"):
        return np.savetxt(path, np.concatenate([
            np.column_stack([p.data.points, p.value]) for p in panels]),
            "%.8g", ",", header="x,y,z,value", comments="")
    if len(panels) % args.columns:
        fail("the panels do not fill the columns")
    colours = Colours(args, panels)
    rows = len(panels) // args.columns
    bounds = [panel.bounds() for panel in panels]
    low = np.min([b[0] for b in bounds], 0)
    high = np.max([b[1] for b in bounds], 0)
    flat = panels[0].dim == 2
    ratio = (high[1] - low[1]) / (high[0] - low[0]) if flat else 0.9
    width = min(8.4 / args.columns, 6 / ratio)
    figure, axes = plt.subplots(
        rows, args.columns, squeeze=False, layout="constrained",
        figsize=(args.columns * width + 1.9, rows * (width * ratio + 0.7)
                 + (0.4 if args.heading else 0)))
    for panel, place in zip(panels, axes.flat):
        panel.draw(place, colours)
        if flat:
            margin = 0.03 * (high - low).max()
            place.set_xlim(low[0] - margin, high[0] + margin)
            place.set_ylim(low[1] - margin, high[1] + margin)
    bar = figure.colorbar(
        plt.cm.ScalarMappable(colours.norm, colours.map), ax=axes,
        ticks=colours.levels, extend=colours.beyond, shrink=0.9,
        label=with_unit(panels[0].name, panels[0].unit))
    bar.ax.tick_params(length=0)
    bar.formatter.set_powerlimits((-2, 4))
    bar.update_ticks()
    figure.suptitle(args.heading)
    figure.savefig(path, dpi=110)
