# ranks: 1 2
# The contained block of Cortis et al. (2017), section 5.1. Published, at 0, 30,
# 45 and 90 degrees: r_u 1.573e-9, 1.173e-8, 2.036e-9, 1.573e-9 and r_sigma_xx
# 5.804e-9, 1.299e-8, 9.133e-9, 5.804e-9.
import math

sides = ("bottom", "moved", "top", "left")
paper = {f"Boundaries/{side}/{key}": value for side in sides for key, value in
         (("Enforcement", "weighted"), ("Band width", 1e-6),
          ("Carry reaction", "false"))}
for name in ("0", "30", "45", "90", "17-offset"):
    scene = f"prm/cortis-2017/block-{name}.prm"
    default = run(scene).errors
    bound(f"{name}: r_u", default["r_u"], 1e-10)
    for component in ("xx", "yy", "zz"):
        bound(f"{name}: r_sigma_{component}",
              default[f"r_sigma_{component}"], 1e-9)
    literal = run(scene, paper).errors
    bound(f"{name}: r_u with the paper's setting", literal["r_u"], 1e-6)
    text(f"{name}: its order of magnitude",
         round(math.log10(literal["r_u"])))

cube = run("prm/cortis-2017/block-3d.prm").errors
bound("3d: r_u", cube["r_u"], 1e-9)
bound("3d: r_sigma_xx", cube["r_sigma_xx"], 1e-9)
