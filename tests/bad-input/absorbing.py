# ranks: 1 # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Absorbing boundaries that cannot be."""

base = "prm/phuong-2023/column-viscous-gimp.prm"


def refused(name, settings, scene=base):
    result = run(scene, settings, expect=2)
    lines = [line for line in result.output.splitlines() if line.strip()]
    text(name, plain(" | ".join(lines)))
    if (result.folder / "history.csv").exists():
        text(name, "NO, results were made")


B = "Boundaries/base/"
side = "prm/phuong-2023/column-viscous-fe.prm"
refused("quasi-static", {"Time/Integrator": "quasi-static"})
refused("a side in a quasi-static scene", {"Time/Integrator": "quasi-static"},
        side)
refused("surface on nothing", {B + "Points": "0 -0.9; 0.25 -0.9"})
refused("side without a body", {"Mesh/Lower corner": "0, -1"}, side)
refused("no density", {"Materials/soil/Density": 0})
refused("two kinds of springs", {B + "Spring radius": 20,
                                 B + "Virtual thickness": 3})
refused("springs by radius and given", {B + "Spring radius": 20,
                                        B + "Spring stiffness": "1, 2"})
refused("one stiffness", {B + "Spring stiffness": "1"})
refused("negative dashpot", {B + "Dashpot factors": "1, -1"})
refused("speeds without density", {B + "Outer wave speeds": "200, 100"})
refused("density without speeds", {B + "Outer density": 2})
refused("impedances twice", {B + "Outer density": 2,
                             B + "Outer wave speeds": "200, 100",
                             B + "Outer impedances": "400, 200"})
refused("a curve of nothing", {B + "Incident curve": "0: 0, 1: 1"})
refused("one component", {B + "Incident velocity": "1"})
refused("a curve that goes back", {B + "Incident velocity": "1; 0",
                                   B + "Incident curve": "0: 0, 2: 1, 1: 1"})
refused("a wave that is not a number", {B + "Incident velocity": "0/t; 0"})
refused("prescribed displacement", {B + "Displacement": "0; 0.1*t"})
refused("enforcement", {B + "Enforcement": "penalty"})
refused("springs of what is fixed", {B + "Constraint": "fixed",
                                     B + "Spring radius": 20})
refused("springs of a grid condition that is fixed", {
    "Grid conditions/left/Spring radius": 20})
refused("no side", {"Grid conditions/low/Constraint": "absorbing",
                    "Grid conditions/low/Lower corner": "0, 0",
                    "Grid conditions/low/Upper corner": "1, 1"})
