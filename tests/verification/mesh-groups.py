# ranks: 2  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Physical groups of a mesh file as bodies: layers of slanted quadrilaterals with
materials, weights and stages of their own; geostatic stress counts each once."""

NX, NY = 4, 6
HEIGHT = [0, 0.8, 2, 3, 3.7, 5, 6]  # of rows of cells; three layers of two rows
LAYERS = {"rock": 21, "clay": 22, "fill": 23}
DENSITY = {"rock": 2.5, "clay": 1.5, "fill": 2}
E = {"rock": 4000, "clay": 1000, "fill": 2000}


def mesh(name, names=True):
    """A block of width 4; inner nodes of rows are moved sideways."""
    nodes, cells = [], []
    for j, y in enumerate(HEIGHT):
        for i in range(NX + 1):
            nodes.append((i + (0.15 if 0 < i < NX and j % 2 else 0), y))
    for j in range(NY):
        for i in range(NX):
            a = j * (NX + 1) + i + 1
            tag = 21 + j // 2
            cells.append(f"3 2 {tag} {tag} {a} {a + 1} {a + NX + 2} {a + NX + 1}")
    top = NY * (NX + 1)
    for i in range(NX):
        cells.append(f"1 2 1 1 {i + 1} {i + 2}")
        cells.append(f"1 2 3 3 {top + i + 1} {top + i + 2}")
    for j in range(NY):
        for column in (0, NX):
            a = j * (NX + 1) + column + 1
            cells.append(f"1 2 2 2 {a} {a + NX + 1}")
    groups = ['1 1 "base"', '1 2 "sides"', '1 3 "surface"']
    if names:
        groups += [f'2 {tag} "{layer}"' for layer, tag in LAYERS.items()]
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames",
             len(groups), *groups, "$EndPhysicalNames", "$Nodes", len(nodes),
             *(f"{k} {x} {y} 0" for k, (x, y) in enumerate(nodes, 1)), "$EndNodes",
             "$Elements", len(cells),
             *(f"{k} {cell}" for k, cell in enumerate(cells, 1)), "$EndElements"]
    file = folder / name
    file.write_text("\n".join(map(str, lines)) + "\n")
    return file


def layers(groups):
    """The scene with bodies of these names and groups."""
    return prm("\n".join((
        f"Mesh/Type = file | File = {mesh('layers.msh')}",
        "Method/Method = finite element",
        *(f"Materials/{layer}/Young modulus = {E[layer]} | Poisson ratio = 0"
          f" | Density = {DENSITY[layer]}" for layer in LAYERS),
        *(f"Bodies/{name}/Shape = mesh | Group = {group} | Material = {name}"
          for name, group in groups.items()),
        "Grid conditions/sides/Side = sides | Components = x",
        "Grid conditions/base/Side = base",
        "Loads/weight/Type = gravity | Value = 0; -10*min(t, 1)",
        *(f"Probes/{name}/Location = {place} | Kind = interpolated" for name, place in
          (("rock", "1, 2"), ("clay", "2, 3.7"), ("top", "3, 6"))))))


SCENE = layers({layer: layer for layer in LAYERS})
scene = folder / "layers.prm"
scene.write_text(SCENE)
BOTTOM = {"rock": 0, "clay": 2, "fill": 3.7}
TOP = {"rock": 2, "clay": 3.7, "fill": 6}


def pressure(layer, y, layers=LAYERS):
    """Weight above a place in a layer."""
    return 10 * (DENSITY[layer] * (TOP[layer] - y) +
                 sum(DENSITY[other] * (TOP[other] - BOTTOM[other])
                     for other in layers if BOTTOM[other] >= TOP[layer]))


def settlement(y, layers=LAYERS):
    return sum((min(y, TOP[layer]) - BOTTOM[layer]) / E[layer] *
               (pressure(layer, BOTTOM[layer], layers) +
                pressure(layer, min(y, TOP[layer]), layers)) / 2
               for layer in layers if y > BOTTOM[layer])


def stress_error(result):
    """Of the vertical stress of points, over the largest."""
    return max(abs(s[4] + pressure(layer, y[1])) for y, s in
               result.points("position", "stress")
               for layer in LAYERS if BOTTOM[layer] < y[1] < TOP[layer]
               ) / pressure("rock", 0)


# Quadratic elements have the quadratic displacement; linear ones are exact at
# nodes, but for what the slanted cells make of it.
for method, settings in (
        ("Q2", {"Method/Degree": 2, "Method/Mesh after step": "keep"}),
        ("Q1", {"Method/Mesh after step": "keep"}),
        ("MPM", {"Method/Method": "material point"})):
    result = run(scene, settings)
    text(f"{method}: volumes", " ".join(
        line.split()[-1] for line in result.output.splitlines()
        if line.startswith("  body ")))
    for name, y in (("rock", 2), ("clay", 3.7), ("top", 6)):
        bound(f"{method}: u_y at {name} over the exact one - 1",
              result.probes[f"u_y at {name}"] / -settlement(y) - 1,
              1e-10 if method == "Q2" else 3e-3)

# Geostatic stress is in balance: nothing moves, and each layer weighs once.
ground = {f"Bodies/{layer}/Initial stress": "geostatic" for layer in LAYERS}
held = run(scene, {**ground, "Loads/weight/Value": "0; -10",
                   "Method/Degree": 2, "Method/Mesh after step": "keep"})
bound("geostatic: settlement", held.probes["u_y at top"], 1e-12)
bound("geostatic: stress", stress_error(held), 1e-6)

# The fill is dug away, and two groups are one body.
dug = run(scene, {
    "Method/Degree": 2, "Method/Mesh after step": "keep",
    "Stages/all/Time/End time": 1, "Stages/dug/Time/End time": 2,
    "Stages/dug/Bodies": "rock, clay"})
last = dug.history()[-1]
bound("dug: settlement of the clay - 1",
      last["u_y at clay"] / -settlement(3.7, ("rock", "clay")) - 1, 1e-10)
bound("dug: weight on the base - 1",
      last["reaction_y of base"] / (4 * pressure("rock", 0, ("rock", "clay"))) - 1,
      1e-10)
two = folder / "two.prm"
two.write_text(layers({"rock": "rock", "fill": "clay, fill"}))
result = run(two)
text("two groups: volumes", " ".join(
    line.split()[-1] for line in result.output.splitlines()
    if line.startswith("  body ")))
# A half-space cut by a group.
cut = run(scene, {
    "Bodies/soil/Shape": "half-space", "Bodies/soil/Point": "0, 5",
    "Bodies/soil/Normal": "0, 1", "Bodies/low/Shape": "intersection",
    "Bodies/low/Operands": "soil, fill", "Bodies/low/Material": "fill",
    "Bodies/fill/Material": "", "Probes/top/Location": "3, 5"})
text("a group and a half-space: volumes", " ".join(
    line.split()[-1] for line in cut.output.splitlines()
    if line.startswith("  body ")))

# Extruded: prisms over the same cells.
deep = folder / "deep.prm"
deep.write_text(SCENE.replace("Components = x\n", "Components = x, z\n")
                .replace("Value = 0; ", "Value = 0; 0; ")
                .replace("0; 0; -10*min(t, 1)", "0; -10*min(t, 1); 0")
                .replace("Location = 1, 2", "Location = 1, 2, 1")
                .replace("Location = 2, 3.7", "Location = 2, 3.7, 1")
                .replace("Location = 3, 6", "Location = 3, 6, 1"))
result = run(deep, {"Dimension": 3, "Mesh/Extrusion layers": 1,
                    "Mesh/Extrusion height": 2,
                    "Method/Mesh after step": "keep"})
text("extruded: volumes", " ".join(
    line.split()[-1] for line in result.output.splitlines()
    if line.startswith("  body ")))


def refused(name, settings, file=scene):
    result = run(file, settings, expect=2)
    text(name, plain(result.output.strip()))


refused("no group named", {"Bodies/fill/Group": ""})
refused("unknown group", {"Bodies/fill/Group": "clai"})
refused("a group twice", {"Bodies/fill/Group": "fill, fill"})
refused("two bodies with one group", {"Bodies/fill/Group": "clay"})
refused("groups by number", {"Bodies/fill/Group": "23", "Mesh/File":
                             mesh("numbers.msh", names=False)})
refused("rim of a group", {"Boundaries/a/Body": "clay"})
refused("group that moves", {"Bodies/fill/Translation": "1, 0"})
refused("group of a disc", {"Bodies/fill/Shape": "disc", "Bodies/fill/Radius": 1,
                            "Bodies/fill/Centre": "2, 4"})
refused("group of a box", {"Mesh/Type": "box", "Mesh/File": "",
                           "Mesh/Lower corner": "0, 0",
                           "Mesh/Upper corner": "4, 6", "Mesh/Cells": "4, 6",
                           "Grid conditions/base/Side": "bottom",
                           "Grid conditions/sides/Side": "left"})
