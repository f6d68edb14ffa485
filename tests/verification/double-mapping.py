# debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""DM, DM-G, DM-C and DM-GC: what each part does to stresses. All are on all ranks
in a patch; then GIMP and DM-GC are, by one number of cells and steps."""

import base64
import re
import struct
import zlib

DOUBLE_MAPPING = ("DM", "DM-G", "DM-C", "DM-GC")
METHODS = ("material point", "GIMP") + DOUBLE_MAPPING


def ranks_of(method):
    return None if method in ("GIMP", "DM-GC") else 1


def array(file, name):
    """All pieces of a field of a VTU file that deal.II has written."""
    values = []
    for data in re.findall(
            rf'Name="{name}"[^>]*>\s*(?:<Info.*?</InformationKey>)?\s*(\S+)\s*<',
            file.read_text()):
        size = struct.unpack("<4I", base64.b64decode(data[:24]))[1]
        raw = zlib.decompress(base64.b64decode(data[24:]))
        values += struct.unpack(f"<{size // 4}f", raw)
    return values


def stresses(result):
    """Stress and volume of the last step by the points' ids."""
    file = sorted((result.folder / "points").glob("*.vtu"))[-1]
    ids, stress = array(file, "id"), array(file, "stress")
    n = len(stress) // len(ids)
    return {int(i): (stress[p * n:(p + 1) * n], volume) for p, (i, volume)
            in enumerate(zip(ids, array(file, "volume")))}


def difference(found, wanted):
    """Relative L2 norm, and the largest over the largest stress."""
    squares = [(v * sum((a - b)**2 for a, b in zip(found[i][0], s)),
                v * sum(b * b for b in s)) for i, (s, v) in wanted.items()]
    largest = max(abs(a - b) for i, (s, _) in wanted.items()
                  for a, b in zip(found[i][0], s))
    return ((sum(d for d, _ in squares) / sum(s for _, s in squares))**0.5,
            largest / max(abs(a) for s, _ in wanted.values() for a in s))


# Points of full cells: a linear field is exact.
for method in DOUBLE_MAPPING:
    result = run("prm/verification/patch-aligned.prm", {
        "Method/Method": method, "Mesh/Lower corner": "-5, -5",
        "Mesh/Upper corner": "105, 105"})
    bound(f"patch of full cells, {method}: r_u", result.errors["r_u"], 1e-13)
    bound(f"patch of full cells, {method}: l2_sigma",
          result.errors["l2_sigma"], 1e-12)

# The column, whose points cross many cells, against its exact stress.
error = {}
for method in METHODS:
    for n in (16, 32, 64) if "G" in method else (32,):
        result = run("prm/large-deformation/column-gimp.prm",
                     {"Method/Method": method, "Mesh/Cells": f"1, {n}"},
                     on_ranks=ranks_of(method) if n == 32 else 1)
        error[method, n] = result.errors["l2_sigma"]
        number(f"column, {method}, {n} cells: l2_sigma", error[method, n], 2)
    text(f"column, {method}: Newton iterations in {result.summary['steps']} "
         "steps", result.summary["newton_iterations"])
bound("column of 32 cells: DM-GC over GIMP",
      error["DM-GC", 32] / error["GIMP", 32], 0.5)

# A block in two dimensions, against finite elements on the same mesh, whose
# points start at the same places.
block = "prm/phuong-2023/compressed-block.prm"
wanted = stresses(run(block, {"Method/Method": "finite element"}))
error = {}
for method in METHODS:
    result = run(block, {"Method/Method": method}, on_ranks=ranks_of(method))
    error[method], largest = difference(stresses(result), wanted)
    number(f"block, {method}: stress against FE, L2", error[method], 2)
    number(f"block, {method}: largest", largest, 2)
bound("block: DM-GC over GIMP", error["DM-GC"] / error["GIMP"], 0.95)
bound("block: DM-GC over MPM", error["DM-GC"] / error["material point"], 0.4)

# In 3D, plastic, uniform.
stretched = {}
for method in ("GIMP",) + DOUBLE_MAPPING:
    result = run("prm/large-deformation/stretch-3d.prm",
                 {"Method/Method": method}, on_ranks=ranks_of(method))
    stretched[method] = result.probes["sigma_xx at point"]
    bound(f"stretch in 3D, {method}: stress over GIMP's - 1",
          stretched[method] / stretched["GIMP"] - 1, 1e-10)

# A load that stays: what a step leaves out of balance moves the next one.
for method in ("GIMP", "DM-GC"):
    for steps in (20, 80):
        history = run("prm/large-deformation/column-gimp.prm",
                      {"Method/Method": method, "Mesh/Cells": "1, 32",
                       "Loads/weight/Curve": "min(1.25*t, 1)",
                       "Time/Steps": steps},
                      on_ranks=None if steps == 20 else 1).history()
        top = [step["y at top"] for step in history]
        loaded = 4 * steps // 5 - 1
        number(f"held column, {method}, {steps} steps: top moves after the "
               "last load by", (top[-1] - top[loaded]) / 50, 2)
