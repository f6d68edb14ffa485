C     SPDX-License-Identifier: LGPL-2.1-or-later
C     Copyright (C) 2026 by the Moraine authors
C
C     Drucker and Prager's plasticity, linear elastic up to the cone
C       f = sqrt(J2) + ETA p - K,  p = tr(sigma)/3, tension positive;
C     flow by ETAB in place of ETA. The return is to the cone or, where
C     that is beyond it, to the apex p = K/ETA.
C     PROPS(1)  Young's modulus E > 0 [stress]
C     PROPS(2)  Poisson's ratio, larger than -1 and smaller than 0.5
C     PROPS(3)  ETA >= 0; 0 is von Mises with the shear strength K
C     PROPS(4)  ETAB, 0 to ETA
C     PROPS(5)  K >= 0 [stress], larger than 0 if ETA = 0
C     STATEV(1) accumulated plastic strain, sqrt(2/3 e_p : e_p)
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
      DIMENSION TRIAL(6),S(6)
C
      IF (NPROPS.LT.5 .OR. NSTATV.LT.1 .OR. NTENS.NE.6) CALL XIT
      E = PROPS(1)
      V = PROPS(2)
      ETA = PROPS(3)
      ETAB = PROPS(4)
      AK = PROPS(5)
      G = E/(2.D0*(1.D0 + V))
      ALAME = E*V/((1.D0 + V)*(1.D0 - 2.D0*V))
      BULK = ALAME + 2.D0*G/3.D0
C
C     elastic trial
      DO J = 1, 6
        DO I = 1, 6
          DDSDDE(I,J) = 0.D0
        END DO
      END DO
      DO I = 1, 3
        DO J = 1, 3
          DDSDDE(I,J) = ALAME
        END DO
        DDSDDE(I,I) = ALAME + 2.D0*G
        DDSDDE(I+3,I+3) = G
      END DO
      SIZE = 0.D0
      DO I = 1, 6
        TRIAL(I) = STRESS(I)
        DO J = 1, 6
          TRIAL(I) = TRIAL(I) + DDSDDE(I,J)*DSTRAN(J)
        END DO
        SIZE = MAX(SIZE, ABS(TRIAL(I)))
      END DO
      P = (TRIAL(1) + TRIAL(2) + TRIAL(3))/3.D0
      AJ2 = 0.D0
      DO I = 1, 3
        S(I) = TRIAL(I) - P
        S(I+3) = TRIAL(I+3)
        AJ2 = AJ2 + 0.5D0*S(I)**2 + S(I+3)**2
      END DO
      Q = SQRT(AJ2)
      F = Q + ETA*P - AK
      IF (F.LE.1.D-13*(SIZE + AK)) THEN
        DO I = 1, 6
          STRESS(I) = TRIAL(I)
        END DO
        RETURN
      END IF
C
      AMOD = G + BULK*ETA*ETAB
      DGAM = F/AMOD
      IF (Q.LT.G*DGAM) THEN
C       apex; all of the deviatoric strain is plastic
        APEX = AK/ETA
        DO I = 1, 3
          STRESS(I) = APEX
          STRESS(I+3) = 0.D0
        END DO
        DO J = 1, 6
          DO I = 1, 6
            DDSDDE(I,J) = 0.D0
          END DO
        END DO
        VOL = (P - APEX)/BULK
        DEV = AJ2/(2.D0*G*G)
        STATEV(1) = STATEV(1) + SQRT(2.D0/3.D0*(DEV + VOL*VOL/3.D0))
        RETURN
      END IF
C
C     cone; S becomes s / sqrt(J2)
      DO I = 1, 6
        S(I) = S(I)/Q
        STRESS(I) = TRIAL(I) - DGAM*G*S(I)
        IF (I.LE.3) STRESS(I) = STRESS(I) - DGAM*BULK*ETAB
      END DO
      STATEV(1) = STATEV(1)
     1 + DGAM*SQRT(2.D0/3.D0*(0.5D0 + ETAB**2/3.D0))
      ALONG = 2.D0*G*G*DGAM/Q
      DO J = 1, 6
        DO I = 1, 6
          FLOW = G*S(I)
          AWAY = G*S(J)
          UNIT = 0.D0
          IF (I.LE.3) FLOW = FLOW + BULK*ETAB
          IF (J.LE.3) AWAY = AWAY + BULK*ETA
          IF (I.EQ.J .AND. I.LE.3) UNIT = 1.D0
          IF (I.EQ.J .AND. I.GT.3) UNIT = 0.5D0
          IF (I.LE.3 .AND. J.LE.3) UNIT = UNIT - 1.D0/3.D0
          DDSDDE(I,J) = DDSDDE(I,J) - FLOW*AWAY/AMOD
     1     - ALONG*(UNIT - 0.5D0*S(I)*S(J))
        END DO
      END DO
      RETURN
      END
