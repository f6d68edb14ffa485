# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""'moraine test-material': tables of tests of one point against closed forms, the
scene that is shipped, pictures with measured values, two ranks."""

import csv
import math

E, NU, YIELD = 10000, 0.3, 40
G, K = E / (2 * (1 + NU)), E / (3 * (1 - 2 * NU))
M = K + 4 * G / 3
scene = scene_file("scene.prm", f"""
Materials/clay/Model = von Mises | Uniaxial yield stress = {YIELD}
Materials/clay/Young modulus = {E} | Poisson ratio = {NU}
Material test/Initial stress = -80, -80, -80 | Steps = 20
""")
n = 0


def test(kind, legs, settings=None, file=scene, on_ranks=1):
    """The rows of the table, by name."""
    global n
    n += 1
    where = folder / f"out-{n}"
    result = run(file, {"Material test/Kind": kind, "Material test/Legs": legs,
                        **(settings or {})}, command="test-material",
                 extra=["--output", where], on_ranks=on_ranks)
    table = next(where.glob("*.csv"))
    with open(table) as rows:
        rows = [{key.split(" [")[0]: float(value) for key, value in row.items()}
                for row in csv.DictReader(rows)]
    bound(f"{kind}, {legs}: errors of tangents",
          max(row["tangent_error"] for row in rows), 2e-5)
    return result, table, rows


def near(name, value, exact):
    bound(f"  {name} over exact - 1", value / exact - 1, 1e-9)


result, table, rows = test("triaxial drained",
                           "to strain -0.02, until q = 0, 2 cycles")
text("says", plain(result.output))
text("columns", table.read_text().splitlines()[0])
text("rows", [(row["leg"], row["step"]) for row in rows[::20]])
near("q", max(row["q"] for row in rows), YIELD)
near("Young's modulus", 10 / rows[1]["axial_compression"] *
     (rows[1]["q"] / 10), E)
near("volume", rows[20]["eps_v"], -YIELD / 3 / K)
bound("  lateral stress", max(abs(row["sigma_xx"] + 80) for row in rows), 1e-9)
bound("  q at the end", rows[-1]["q"], 1e-9)
near("strain left", rows[-1]["eps_zz"], -0.02 + YIELD / E)
near("plastic strain", rows[-1]["plastic_strain"], 0.02 - YIELD / E)

for strain in ("small", "finite"):
    _, _, rows = test("triaxial undrained", "to strain -0.1",
                      {"Method/Strain": strain})
    bound("  volume", max(abs(row["eps_v"]) for row in rows), 1e-13)
    near("q", rows[-1]["q"], YIELD)
    near("pore pressure", rows[-1]["excess_pore_pressure"], YIELD / 3)
    near("total mean stress", rows[-1]["p_total"], -80 - YIELD / 3)
_, _, rows = test("triaxial drained", "to strain 0.02")
near("q of extension", rows[-1]["q"], -YIELD)
near("eps_q of extension", rows[1]["eps_q"],
     -2 / 3 * (1 + NU) * rows[1]["eps_zz"])
_, _, rows = test("oedometer", "to stress -100")
near("modulus", (rows[-1]["sigma_zz"] + 80) / rows[-1]["eps_zz"], M)
_, _, rows = test("oedometer", "to strain -0.3", {"Method/Strain": "finite"})
near("tangent of flow", (rows[-1]["sigma_zz"] - rows[-2]["sigma_zz"]) /
     (rows[-1]["eps_zz"] - rows[-2]["eps_zz"]), K)
for height in ("stress", "height"):
    _, _, rows = test(f"simple shear constant {height}", "to strain 0.05")
    near("k", rows[-1]["sigma_xz"], YIELD / math.sqrt(3))
    near("q", rows[-1]["q"], YIELD)
    near("shear modulus", rows[1]["sigma_xz"] / rows[1]["gamma_xz"], G)
_, _, rows = test("biaxial", "to strain -0.001")
near("plane modulus", (rows[-1]["sigma_zz"] + 80) / rows[-1]["eps_zz"],
     E / (1 - NU ** 2))
_, _, rows = test("isotropic", "to stress -200")
near("bulk modulus", (rows[-1]["p"] + 80) / rows[-1]["eps_v"], K)
_, _, rows = test("general", "to 1, to 0, to 1", {
    "Material test/Control": "strain zz -0.001; stress xx -70; strain xz 1e-3"})
near("stress xz", rows[20]["sigma_xz"], 1e-3 * G)
near("stress zz", rows[20]["sigma_zz"], -80 - 0.001 * E + 10 * NU)
bound("  back at 0", rows[40]["eps_zz"], 1e-15)
near("again", rows[60]["sigma_zz"], rows[20]["sigma_zz"])
_, _, rows = test("triaxial drained", "to strain -0.02", {
    "Strength reduction/Factor": 2})
near("q over a factor", rows[-1]["q"], YIELD / 2)

# A whole scene has its materials tested too; ranks write one table.
tables = [test("oedometer", "to strain -0.1",
               file="prm/geotechnics/factor-of-safety.prm", on_ranks=ranks)[1]
          for ranks in (1, 2)]
text("two ranks", tables[0].read_bytes() == tables[1].read_bytes())


def png(path):
    content = path.read_bytes() if path.exists() else b""
    return "a picture" if content[:4] == b"\x89PNG" and len(content) > 2e4 \
        else f"NO: {len(content)} bytes"


shipped = run("prm/studies/triaxial.prm", command="test-material",
              extra=["--output", folder / "shipped"])
text("shipped", plain(shipped.output))
text("picture", png(folder / "shipped/material-test-clay.png"))
with open(folder / "shipped/material-test-clay.csv") as rows:
    rows = list(csv.DictReader(rows))
near("q at its end", float(rows[-1]["q [kPa]"]), 100)
bare = run("prm/studies/triaxial.prm", {"Title": "bare"}, command="test-material",
           extra=["--output", folder / "bare", "--set",
                  "Material test/Measured ="])
text("measured values are drawn",
     (folder / "bare/material-test-clay.png").read_bytes() !=
     (folder / "shipped/material-test-clay.png").read_bytes())
for name, content in (("other-names", "time,force\n1,2\n"),
                      ("one-column", "q\n1\n"), ("words", "p,q\none,two\n")):
    (folder / f"{name}.csv").write_text(content)
    wrong = run(scene, {"Material test/Legs": "to strain -0.1",
                        "Material test/Measured": f"{name}.csv"},
                command="test-material", extra=["--output", folder / "wrong"])
    text(name, plain(wrong.output.strip().splitlines()[-1]))

# Soils, c = 10, friction 30 degrees, confined by 100: closed forms.
SOIL = {"Materials/clay/Uniaxial yield stress": "",
        "Materials/clay/Young modulus": 20000, "Materials/clay/Cohesion": 10,
        "Materials/clay/Friction angle": 30,
        "Material test/Initial stress": "-100, -100, -100"}
for model, compression, extension in (
        ("Mohr-Coulomb", 234.641016, -78.213672),
        ("Drucker-Prager", 135.081404, -76.421150)):
    for legs, q in (("to strain -0.1", compression),
                    ("to strain 0.1", extension)):
        _, _, rows = test("triaxial drained", legs, {
            **SOIL, "Materials/clay/Model": model,
            "Materials/clay/Dilation angle": 30})
        bound(f"  {model}: q over exact - 1", abs(rows[-1]["q"] / q - 1), 1e-8)
