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
    if strain == "small":
        other = run(BLOCK, {**SAME, **ELASTIC, "Method/Strain": strain,
                            "Materials/soil/Tangent": "symmetric",
                            "Solver/Solver": "amg-cg"}).points("position")
        bound("the same by conjugate gradients",
              max(abs(a - b) for (x,), (y,) in zip(own, other)
                  for a, b in zip(x, y)), limit)

# A law with history on two ranks, and after a break.
PLASTIC = {**umat(f"{root}/prm/umat/drucker-prager.f", "1000, 0.3, 0.3, 0.1, 3"),
           "Materials/soil/State variables": "0", "Method/Strain": "finite",
           "Loads/weight/Value": "0; -0.6*t", "Output/Checkpoint every": "1 step"}


def state(result):
    return sorted(result.points("position", "statev_1"),
                  key=lambda point: [round(x, 5) for x in point[0]])


def distance(a, b):
    return max(abs(x - y) for (p, s), (q, t) in zip(state(a), state(b))
               for x, y in zip((*p, s), (*q, t)))


through, on_two = [run(BLOCK, PLASTIC, on_ranks=n) for n in (1, 2)]
text("yields", max(s for _, s in state(through)) > 1e-3)
bound("two ranks - one", distance(through, on_two), 1e-9)
history = (through.folder / "history.csv").read_bytes()
run(through.folder, command="resume", extra=["--from", 3], on_ranks=1)
text("history is that of a run without a break",
     history == (through.folder / "history.csv").read_bytes())

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
      IF (ABS(DSTRAN(4)).GT.PROPS(1)) PNEWDT = 0.3D0
      IF (ABS(DSTRAN(4)).GT.PROPS(2)) CALL XIT
      END
""")


def refusals(name, constants, expect):
    result = run(BLOCK, umat(REFUSES, constants), expect=expect)
    for line in result.output.splitlines():
        if "UMAT" in line:
            text(name, plain(line.strip()))
    return result


smaller = refusals("a smaller step", "0.002, 1", 0)
text("steps that took all", smaller.summary["steps"])
text("the same on two ranks", smaller.summary["steps"] == run(
    BLOCK, umat(REFUSES, "0.002, 1"), on_ranks=2).summary["steps"])
refusals("the end", "1, 0.002", 1)
text("the end on two ranks", "its UMAT ended the run (CALL XIT)" in run(
    BLOCK, umat(REFUSES, "1, 0.002"), expect=1, on_ranks=2).output)
for name, settings in (("drucker-prager.f", PLASTIC),
                       ("linear-elastic.f", ELASTIC),
                       ("refuses.for", umat(REFUSES, "0.002, 0.005"))):
    for line in run(BLOCK, settings, command="check").output.splitlines():
        if "law of" in line or "nothing wrong" in line:
            text(f"check of {name}", line.strip())


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
