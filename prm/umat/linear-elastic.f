C     SPDX-License-Identifier: LGPL-2.1-or-later
C     Copyright (C) 2026 by the Moraine authors
C
C     Linear elasticity, sigma_n+1 = sigma_n + C : d_epsilon.
C     PROPS(1)  Young's modulus E > 0 [stress]
C     PROPS(2)  Poisson's ratio, larger than -1 and smaller than 0.5
C     STATEV    none
C
      SUBROUTINE UMAT(STRESS,STATEV,DDSDDE,SSE,SPD,SCD,
     1 RPL,DDSDDT,DRPLDE,DRPLDT,
     2 STRAN,DSTRAN,TIME,DTIME,TEMP,DTEMP,PREDEF,DPRED,CMNAME,
     3 NDI,NSHR,NTENS,NSTATV,PROPS,NPROPS,COORDS,DROT,PNEWDT,
     4 CELENT,DFGRD0,DFGRD1,NOEL,NPT,LAYER,KSPT,KSTEP,KINC)
C
      INCLUDE 'ABA_PARAM.INC'
C
      CHARACTER*80 CMNAME
      DIMENSION STRESS(NTENS),STATEV(NSTATV),
     1 DDSDDE(NTENS,NTENS),DDSDDT(NTENS),DRPLDE(NTENS),
     2 STRAN(NTENS),DSTRAN(NTENS),TIME(2),PREDEF(1),DPRED(1),
     3 PROPS(NPROPS),COORDS(3),DROT(3,3),DFGRD0(3,3),DFGRD1(3,3),
     4 KSTEP(4)
C
      IF (NPROPS.LT.2 .OR. NDI.NE.3) CALL XIT
      E = PROPS(1)
      V = PROPS(2)
      G = E/(2.D0*(1.D0 + V))
      ALAME = E*V/((1.D0 + V)*(1.D0 - 2.D0*V))
      DO J = 1, NTENS
        DO I = 1, NTENS
          DDSDDE(I,J) = 0.D0
        END DO
      END DO
      DO I = 1, NDI
        DO J = 1, NDI
          DDSDDE(I,J) = ALAME
        END DO
        DDSDDE(I,I) = ALAME + 2.D0*G
      END DO
      DO I = NDI + 1, NTENS
        DDSDDE(I,I) = G
      END DO
      DO J = 1, NTENS
        DO I = 1, NTENS
          STRESS(I) = STRESS(I) + DDSDDE(I,J)*DSTRAN(J)
        END DO
      END DO
      RETURN
      END
