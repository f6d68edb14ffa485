# ranks: 1
# debug: no
# The deep beam of Cortis et al. (2017), section 5.2: u_y at the lower right
# corner against finite elements on the same mesh, |u / u_FE - 1|. Published in
# tables 2 and 3; the digits here are from an independent calculation and agree
# with the tables but for 40^2 points, where the paper has 1.0277e-5.
independent = {(10, 3): 1.66533e-3, (10, 5): 5.94501e-4, (10, 10): 1.48117e-4,
               (10, 15): 6.57887e-5, (10, 20): 3.69980e-5,
               (10, 25): 2.36763e-5, (10, 40): 9.24756e-6,
               (5, 4): 3.1103e-4, (2, 4): 7.5583e-5, (1, 4): 2.6698e-5,
               (10, 4): 9.3134e-4}
scene = "prm/cortis-2017/deep-beam.prm"
conforming = {"Grid conditions/support/Side": "left"}
name = "u_y at A"


def corner(h, n, method, support):
    settings = {"Constants/h": h, "Constants/n": n, "Method/Method": method,
                "Output/Points": "false", "Output/Mesh": "false"}
    if support == "conforming":
        settings.update(conforming)
        settings["Boundaries/support/Enforcement"] = "penalty"
        settings["Boundaries/support/Penalty factor"] = 1e-12
        settings["Boundaries/support/Carry reaction"] = "false"
    return run(scene, settings).probes[name]


reference = {h: corner(h, 2, "finite element", "conforming")
             for h in (10, 5, 2, 1)}
for (h, n), expected in independent.items():
    found = {support: abs(corner(h, n, "material point", support)
                          / reference[h] - 1)
             for support in ("conforming", "implicit")}
    bound(f"h = {h}, {n}^2 points: conforming over independent - 1",
          found["conforming"] / expected - 1, 5e-5)
    bound(f"h = {h}, {n}^2 points: implicit - conforming",
          found["implicit"] - found["conforming"], 1e-7)
