# ranks: 1
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""UMATs in scenes: as our own law; steps and runs that they refuse."""

BLOCK = "tests/bad-input/base.prm"
SAME = {"Method/Volumetric strain": "pointwise", "Time/Steps": 2,
        "Boundaries/left/Enforcement": "augmented Lagrangian",
        "Loads/weight/Value": "0; -3*t"}


def umat(source, constants):
    return {"Materials/soil/Model": "UMAT", "Materials/soil/Library": source,
            "Materials/soil/Young modulus": "",
            "Materials/soil/Poisson ratio": "",
            "Materials/soil/Constants": constants}


ELASTIC = umat(f"{root}/prm/umat/linear-elastic.f", "1000, 0.3")
for strain, limit in (("small", 1e-10), ("finite", 1e-3)):
    # At finite strain the UMAT's law adds up steps, ours does not.
    own, other = [
        run(BLOCK, {**SAME, "Method/Strain": strain, **law}).points("position")
        for law in ({}, ELASTIC)]
    bound(f"{strain} strain: points of a UMAT - points of ours",
          max(abs(a - b) for (x,), (y,) in zip(own, other)
              for a, b in zip(x, y)), limit)

REFUSES = folder / "refuses.for"
REFUSES.write_text("""\
      SUBROUTINE UMAT(STRESS,STATEV,DDSDDE,SSE,SPD,SCD,
     1 RPL,DDSDDT,DRPLDE,DRPLDT,
     2 STRAN,DSTRAN,TIME,DTIME,TEMP,DTEMP,PREDEF,DPRED,CMNAME,
     3 NDI,NSHR,NTENS,NSTATV,PROPS,NPROPS,COORDS,DROT,PNEWDT,
     4 CELENT,DFGRD0,DFGRD1,NOEL,NPT,LAYER,KSPT,KSTEP,KINC)
      INCLUDE 'ABA_PARAM.INC'
      DIMENSION STRESS(6),DDSDDE(6,6),DSTRAN(6),PROPS(*)
      DDSDDE = 0
      DO I = 1, 6
        DDSDDE(I,I) = 1000
        IF (I.GT.3) DDSDDE(I,I) = 500
        STRESS(I) = STRESS(I) + DDSDDE(I,I)*DSTRAN(I)
      END DO
      IF (ABS(DSTRAN(4)).GT.PROPS(1)) PNEWDT = 0.5D0
      IF (ABS(DSTRAN(4)).GT.PROPS(2)) CALL XIT
      END
""")


def refusals(name, constants, expect):
    result = run(BLOCK, umat(REFUSES, constants), expect=expect)
    for line in result.output.splitlines():
        if "UMAT" in line:
            text(name, plain(line.strip()))
    return result


text("steps that took all", refusals(
    "a smaller step", "0.002, 1", 0).summary["steps"])
refusals("the end", "1, 0.002", 1)


def refused(name, settings):
    result = run(BLOCK, {**ELASTIC, **settings}, expect=2)
    text(name, plain(" | ".join(
        line.strip() for line in result.output.splitlines()
        if line.startswith("moraine: "))))


refused("no file", {"Materials/soil/Library": "nowhere.so"})
refused("no such subroutine", {"Materials/soil/Symbol": "vumat"})
refused("too few constants", {"Materials/soil/Constants": "1000"})
refused("no SDVINI", {"Materials/soil/State variables": "3 by SDVINI"})
refused("conjugate gradients", {"Solver/Solver": "amg-cg"})
refused("dynamics", {"Materials/soil/Density": 1,
                     "Time/Integrator": "Newmark"})
