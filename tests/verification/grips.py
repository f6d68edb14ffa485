# ranks: 2  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A bar is pulled into plastic flow by grid conditions on lines of nodes near its ends,
beyond which it goes on by less than a tenth of a cell, or does so as it is pulled. Its
stress is uniform, that of finite elements whose mesh ends with the bar."""

SCENE = prm("""
Dimension = 2
Mesh/Lower corner = {lower} | Upper corner = {upper} | Cell size = 0.25
Method/Method = {method} | Strain = {strain} | Mesh after step = {after}
Materials/metal/Model = von Mises | Young modulus = 1000 | Poisson ratio = 0.3
Materials/metal/Uniaxial yield stress = {strength}
Bodies/bar/Lower corner = {from}, {below} | Upper corner = {to}, 0.75
Grid conditions/left/Lower corner = -0.1, -1 | Upper corner = 0.1, 2 | Components = x
Grid conditions/right/Lower corner = 2.4, -1 | Upper corner = 2.6, 2 | Components = x
Grid conditions/right/Displacement = {pull}; 0
Grid conditions/below/Lower corner = -1, -0.1 | Upper corner = 4,  0.1
Grid conditions/below/Components = y
Time/Steps = 4
Output/Mesh = false
""")
scene = folder / "scene.prm"
FITTED = {"lower": "0, 0", "upper": "2.5, 0.75", "method": "finite element"}


def pulled(**keys):
    """Stresses xx of the points, and the force of the right grip."""
    scene.write_text(SCENE.format(**{
        "lower": "-1, -1", "upper": "4, 2", "method": "GIMP", "strain": "small",
        "after": "keep", "strength": "10", "from": 0, "to": 2.5, "below": 0,
        "pull": "0.1*t", **keys}))
    result = run(scene)
    return ([stress[0] for stress, in result.points("stress")],
            result.reactions["right"][0])


for strength in ("10", "0: 10, 1: 110"):
    exact = pulled(strength=strength, **FITTED)
    for method in ("material point", "GIMP", "CPDI1", "CPDI2"):
        worst = 0
        for from_, to, below in ((-0.02, 2.52, 0), (-0.005, 2.51, -0.015),
                                 (-0.023, 2.5, -0.024), (0, 2.524, 0)):
            stresses, force = pulled(strength=strength, method=method, to=to,
                                     below=below, **{"from": from_})
            worst = max([worst] + [abs(s / exact[0][0] - 1) for s in stresses])
            force /= (0.75 - below) / 0.75
            worst = max(worst, abs(force / exact[1] - 1))
        bound(f"{method}, strength {strength}: stress and force at four places",
              worst, 1e-5)

# At finite strain the bar is pulled out of the grip: each step stretches what is
# between the lines of nodes by 0.002.
finite = {"strain": "finite", "strength": "5"}
exact = pulled(**finite, **FITTED, after="follow material",
               pull="2.5*(1.002^(4*t)-1)")
for method in ("GIMP", "CPDI1", "CPDI2"):
    stresses, force = pulled(**finite, method=method, after="reset",
                             pull="0.02*t")
    bound(f"{method}, finite strain: stress",
          max(abs(s / exact[0][0] - 1) for s in stresses), 1e-5)
    bound(f"{method}, finite strain: force", force / exact[1] - 1, 1e-5)
