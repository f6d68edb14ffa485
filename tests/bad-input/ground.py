# ranks: 1
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Mistakes in initial stress and in stages that bodies come and go in."""

LAYERS = "prm/geotechnics/layers-at-rest.prm"
COLUMN = "prm/geotechnics/fill-and-dig.prm"
TUNNEL = "prm/geotechnics/dug-tunnel.prm"


def refused(name, scene, settings):
    result = run(scene, settings, expect=2)
    text(name, plain(" | ".join(
        line.strip() for line in result.output.splitlines()
        if line.startswith("moraine: "))))
    text("  no results are written",
         not (result.folder / "history.csv").exists())


refused("K0 beyond yield", LAYERS, {"Bodies/below/K0": 0.1})
refused("K0 beyond yield, finite strain", LAYERS, {
    "Bodies/below/K0": 2.2, "Method/Strain": "finite",
    "Method/Mesh after step": "follow material"})
refused("negative K0", LAYERS, {"Bodies/below/K0": "0.5 - y"})
refused("K0 that is no number", LAYERS, {"Bodies/below/K0": "Jaky"})
refused("K0 of nothing", LAYERS, {"Bodies/below/Initial stress": ""})
refused("surcharge of stress that is given", LAYERS, {
    "Bodies/above/Initial stress": "0; -20; 0; 0", "Bodies/above/K0": ""})
refused("geostatic without gravity", LAYERS, {
    "Loads/weight/Type": "body force"})
refused("geostatic before gravity", LAYERS, {"Loads/weight/Curve": "t"})
refused("geostatic without density or surcharge", LAYERS, {
    "Materials/clay/Density": 0, "Materials/sand/Density": 0,
    "Bodies/above/Surcharge": ""})
refused("too few components", LAYERS, {
    "Bodies/below/Initial stress": "-1; -1", "Bodies/below/K0": ""})
refused("geostatic of a point file", "prm/verification/patch-random.prm", {
    "Bodies/square/Initial stress": "geostatic"})

refused("a stage with an unknown body", COLUMN, {"Stages/dug/Bodies": "grond"})
refused("a stage without bodies", COLUMN, {"Stages/dug/Bodies": "none"})
refused("a stage with what bodies are made from", TUNNEL, {
    "Stages/dig/Bodies": "ground, bore"})
refused("velocity of a body that comes later", COLUMN, {
    "Stages/alone/Time/Integrator": "Newmark",
    "Bodies/fill/Initial velocity": "0; -1"})
result = run(COLUMN, {"Stages/filled/Bodies": "fill"}, expect=2)
text("a body that nothing holds", plain(result.summary["message"]))
