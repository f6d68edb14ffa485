# ranks: 2  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Ground that begins with its geostatic stress stays where it is."""

SCENE = "prm/geotechnics/layers-at-rest.prm"

methods = {
    "finite element": {},
    "finite element, finite strain": {
        "Method/Strain": "finite", "Method/Mesh after step": "follow material"},
    "MPM": {"Method/Method": "material point", "Method/Mesh after step": "reset"},
    "GIMP": {"Method/Method": "GIMP", "Method/Mesh after step": "reset"},
    "GIMP, finite strain": {"Method/Method": "GIMP", "Method/Strain": "finite",
                            "Method/Mesh after step": "reset"},
    "CPDI1": {"Method/Method": "CPDI1", "Method/Mesh after step": "reset"},
    "CPDI2, finite strain": {
        "Method/Method": "CPDI2", "Method/Strain": "finite",
        "Method/Mesh after step": "reset"},
}
for name, settings in methods.items():
    for integrator in ("quasi-static", "Newmark")[:1 if "finite" in name else 2]:
        result = run(SCENE, {**settings, "Time/Integrator": integrator})
        which = f"{name}, {integrator}: "
        # The surface settles by 0.04 m if gravity is turned on.
        bound(which + "displacement of the surface",
              max(abs(row["u_y at surface"]) for row in result.history()), 1e-13)
        bound(which + "stress, relative error", result.errors["l2_sigma"], 1e-12)


def at_rest(which, settings, sand, clay):
    """A body without weight carries what lies on it."""
    exact = f"(y > 6 ? 0.5 * ({sand}) : 0.7 * ({clay}))"
    result = run(SCENE, {**settings, "Exact solution/Stress":
                         f"-{exact}; -(y > 6 ? {sand} : {clay}); -{exact}; 0"})
    bound(which + ": displacement of the surface",
          max(abs(row["u_y at surface"]) for row in result.history()), 1e-13)
    bound(which + ": stress, relative error", result.errors["l2_sigma"], 1e-12)


at_rest("gravity on the sand alone", {"Loads/weight/Bodies": "above"},
        "20 + 20*(10-y)", "100")
at_rest("clay without density", {"Loads/weight/Bodies": "above",
                                 "Materials/clay/Density": 0},
        "20 + 20*(10-y)", "100")
at_rest("gravity on the clay alone", {"Loads/weight/Bodies": "below"},
        "20", "20 + 18*(6-y)")


def balance(result):
    """What is out of balance at the start, of all forces; hardly any is no finding."""
    if "initial-imbalance" not in result.ids():
        return "in equilibrium"
    return f"{100 * result.finding('initial-imbalance')['value']:.2g} %"


text("in equilibrium", balance(run(SCENE)))
text("without the surcharge", balance(run(SCENE, {
    "Loads/surcharge/Value": "0; 0"})))
text("the same in dynamics", balance(run(SCENE, {
    "Loads/surcharge/Value": "0; 0", "Time/Integrator": "Newmark"})))

# What gravity makes of elastic ground has the default K0.
elastic = {"Materials/clay/Model": "linear elastic",
           "Materials/clay/Shear yield stress": "",
           "Bodies/below/K0": "", "Bodies/above/K0": ""}
result = run(SCENE, {**elastic, "Exact solution/Stress": ""})
text("K0 left out", balance(result))
by_gravity = run(SCENE, {
    **elastic, "Exact solution/Stress": "", "Bodies/below/Initial stress": "",
    "Bodies/above/Initial stress": "", "Bodies/above/Surcharge": "",
    "Probes/deep/Location": "2.2, 0.2", "Probes/deep/Quantities": "stress"})
result = run(SCENE, {
    **elastic, "Exact solution/Stress": "",
    "Probes/deep/Location": "2.2, 0.2", "Probes/deep/Quantities": "stress"})
for component in ("xx", "zz"):
    ratio, exact = (probes[f"sigma_{component} at deep"] / probes["sigma_yy at deep"]
                    for probes in (result.probes, by_gravity.probes))
    bound(f"sigma_{component} over sigma_yy, less that of gravity",
          ratio - exact, 1e-10)

# Expressions say the same.
exact = "-(y > 6 ? 0.5 * (20 + 20*(10-y)) : 0.7 * (100 + 18*(6-y)))"
vertical = "-(y > 6 ? 20 + 20*(10-y) : 100 + 18*(6-y))"
given = {f"Bodies/{body}/{key}": value
         for body in ("below", "above")
         for key, value in (("K0", ""), ("Surcharge", ""),
                            ("Initial stress",
                             f"{exact}; {vertical}; {exact}; 0"))}
result = run(SCENE, given)
text("expressions", balance(result))
bound("displacement of the surface",
      max(abs(row["u_y at surface"]) for row in result.history()), 1e-13)

# Gravity along x, and ground whose surface is normal to gravity, inclined, in
# cells that it cuts; K0 = 1.
SOIL = prm("""
Dimension = 2
Mesh/Lower corner = 0, 0 | Upper corner = 8, 8 | Cell size = 1
Method/Method = finite element | Mesh after step = keep
Materials/soil/Young modulus = 20e3 | Poisson ratio = 0.25 | Density = 2
Bodies/ground/Shape = polygon | Vertices = 0 0; 8 0; 8 7; 0 3
Bodies/ground/Initial stress = geostatic | K0 = 1
Grid conditions/right/Side = right
Grid conditions/base/Side = bottom
Grid conditions/others/Side = left | Components = x
Loads/weight/Type = gravity | Value = 5; -10
""")
scene = folder / "inclined.prm"
scene.write_text(SOIL)
text("inclined surface", balance(run(scene)))
text("half the cells", balance(run(scene, {"Mesh/Cell size": 0.5})))
scene = folder / "sideways.prm"
scene.write_text(SOIL.replace("5; -10", "10; 0").replace("8 7; 0 3", "8 8; 0 8")
                 .replace("K0 = 1", "K0 = 0.25")
                 .replace("Side = left\nset Components = x", "Side = top\nset Components = y")
                 .replace("bottom\n", "bottom\nset Components = y\n"))
result = run(scene, {"Exact solution/Stress": "-20*x; -5*x; -5*x; 0"})
text("gravity along x", balance(result))
bound("stress, relative error", result.errors["l2_sigma"], 1e-12)

# A mesh that is no box, which the ground fills.
scene = folder / "generator.prm"
scene.write_text(SOIL.replace(
    "set Lower corner = 0, 0\nset Upper corner = 8, 8\nset Cell size = 1\n",
    "set Type = generator\nset Generator = hyper_rectangle\n"
    "set Arguments = 0, 0 : 8, 8 : true\nset Refinements = 2\n"
    "set Side names = left: 0, right: 1, bottom: 2, top: 3\n")
    .replace("= polygon", "= mesh").replace("5; -10", "0; -10")
    .replace("set Vertices = 0 0; 8 0; 8 7; 0 3\n", "")
    .replace("K0 = 1", "K0 = 0.5")
    .replace("Side = right", "Side = right\nset Components = x"))
result = run(scene, {"Exact solution/Stress": "10*(y-8); 20*(y-8); 10*(y-8); 0"})
text("mesh of a generator", balance(result))
bound("stress, relative error", result.errors["l2_sigma"], 1e-12)

# In three dimensions.
scene = folder / "cube.prm"
scene.write_text(SOIL.replace("Dimension = 2", "Dimension = 3")
                 .replace("0, 0\n", "0, 0, 0\n").replace("8, 8\n", "2, 2, 4\n")
                 .replace("5; -10", "0; 0; -10").replace("= polygon", "= mesh")
                 .replace("set Vertices = 0 0; 8 0; 8 7; 0 3\n", "")
                 .replace("K0 = 1", "K0 = 0.5")
                 .replace("Side = right", "Side = right\nset Components = x")
                 .replace("others", "front").replace("Side = left", "Side = front")
                 .replace("Components = x\nend\nend", "Components = y\nend\nend\n"
                          + prm("""
Grid conditions/left/Side = left | Components = x
Grid conditions/back/Side = back | Components = y""")))
result = run(scene, {
    "Exact solution/Stress": "10*(z-4); 10*(z-4); 20*(z-4); 0; 0; 0"})
text("three dimensions", balance(result))
bound("stress, relative error", result.errors["l2_sigma"], 1e-12)
