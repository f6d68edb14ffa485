# ranks: 1
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Each material model, with parameters that differ from place to place or fall with
plastic strain, on one rank and on two, and after a break (UMAT: umat.py)."""

BLOCK = "tests/bad-input/base.prm"
SCENE = {"Output/Checkpoint every": "1 step", "Loads/weight/Value": "0; -0.8*t"}
SOIL = {"Young modulus": "1000 + 20*y", "Cohesion": "0: 3.8, 0.1: 3.3",
        "Friction angle": "20 + x", "Dilation angle": 5}
MODELS = {
    "linear elastic": {"Young modulus": "1000 + 20*y"},
    "neo-Hookean": {},
    "von Mises": {"Uniaxial yield stress": "0: 6, 0.1: 5.5"},
    "Mohr-Coulomb": {**SOIL, "Tensile strength": "6 + 0.1*y",
                     "Largest plastic dilation": 0.001},
    "Tresca": {"Shear strength": "0: 3.5, 0.1: 3"},
    "Drucker-Prager": SOIL,
    "Cam-clay": {"Young modulus": "", "Poisson ratio": "", "Critical state angle": 25,
                 "Compression index": 0.02, "Swelling index": 0.005,
                 "Shear modulus": "400 + 10*y", "Minimum pressure": 2,
                 "POP": "50 + y",
                 "/Loads/weight/Value": "0; -7*t",
                 "/Boundaries/left/Points": "0.5 0.5; 4.5 0.5"},
}


def points(result):
    """Sorted by where they are to five digits: another number of ranks writes
    them in another order."""
    values = [(tuple(x), tuple(s)) for x, s in result.points("position", "stress")]
    return sorted(values, key=lambda point: [round(x, 5) for x in point[0]])


def block(model, keys):
    strain = "small" if model in ("linear elastic", "Mohr-Coulomb") else "finite"
    return {**SCENE, "Method/Strain": strain, "Materials/soil/Model": model,
            **{key[1:] if key[0] == "/" else f"Materials/soil/{key}": value
               for key, value in keys.items()}}


for model, keys in MODELS.items():
    settings = block(model, keys)
    through, on_two = [run(BLOCK, settings, on_ranks=n) for n in (1, 2)]
    if "plastic_share" in through.summary:
        at_least(f"{model}: plastic share", through.summary["plastic_share"], 0.1)
    bound(f"{model}: two ranks - one",
          max(abs(a - b) for p, q in zip(points(through), points(on_two))
              for u, v in zip(p, q) for a, b in zip(u, v)), 1e-6)
    for result, n in ((through, 1), (on_two, 2)):
        before = result.history()
        run(result.folder, command="resume", extra=["--from", 3], on_ranks=n)
        bound(f"{model}: after a break on {n}",
              max(abs(a[key] - b[key]) for a, b in zip(before, result.history())
                  for key in a), 0 if n == 1 else 1e-8)

# Tresca is Mohr-Coulomb without friction and without a limit of tension.
settings = {"Method/Strain": "finite", "Materials/soil/Softening length": 2}
tresca, mohr_coulomb = [
    run(BLOCK, {**block(model, {key: "0: 3.5, 0.1: 3", **others}), **settings})
    for model, key, others in (("Tresca", "Shear strength", {}),
                               ("Mohr-Coulomb", "Cohesion",
                                {"Tensile strength": "none"}))]
bound("Tresca with a table - Mohr-Coulomb",
      max(abs(a - b) for p, q in zip(points(tresca), points(mohr_coulomb))
          for u, v in zip(p, q) for a, b in zip(u, v)), 0)
perfect = run(BLOCK, {**block("Tresca", {"Shear strength": 3.5})})
at_least("what softening does to the points",
         max(abs(a - b) for p, q in zip(points(tresca), points(perfect))
             for u, v in zip(p, q) for a, b in zip(u, v)), 1e-3)
