# ranks: 1 2
# Simple shear of Cortis et al. (2017), section 5.3. Published: the error of the
# shear stress is below 2e-8 wherever the support is in its cell.
for x_A in (0, 1e-6, 1e-3, 0.1, 1, 10, 25, 50, 75, 90, 99.9, 99.999, 100):
    errors = run("prm/cortis-2017/simple-shear.prm",
                 {"Constants/xA": x_A}).errors
    bound(f"x_A = {x_A:g}: r_sigma_xy", errors["r_sigma_xy"],
          1e-9 if 1 <= x_A <= 99 else 2e-8)
