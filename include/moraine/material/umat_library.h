// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_material_umat_library_h
#define moraine_material_umat_library_h

#include <moraine/core/exceptions.h>

#include <array>
#include <cstddef>
#include <string>

namespace moraine
{
  /** A UMAT, or a routine that it calls, has ended the run by XIT or an error
   * message. */
  class UmatExit : public ComputationError
  {
  public:
    using ComputationError::ComputationError;

    unsigned int point = 0; ///< among those of Material::respond()
  };

  /**
   * What a UMAT gets and gives at one point, in Abaqus' order 11, 22, 33, 12,
   * 13, 23 with angles for shear strains, matrices by columns.
   */
  struct UmatCall
  {
    /** In: at @f$t_n@f$, out: at @f$t_{n+1}@f$. */
    std::array<double, 6> stress{};
    double               *state   = nullptr; ///< in and out, `STATEV`
    int                   n_state = 0;

    std::array<double, 36> tangent{}; ///< out, `DDSDDE`

    std::array<double, 6> strain{};           ///< `STRAN`, at @f$t_n@f$
    std::array<double, 6> strain_increment{}; ///< `DSTRAN`
    std::array<double, 9> rotation{{1, 0, 0, 0, 1, 0, 0, 0, 1}}; ///< `DROT`
    std::array<double, 9> F_n{{1, 0, 0, 0, 1, 0, 0, 0, 1}};      ///< `DFGRD0`
    std::array<double, 9> F{{1, 0, 0, 0, 1, 0, 0, 0, 1}};        ///< `DFGRD1`

    double time      = 0; ///< at @f$t_n@f$
    double step      = 1; ///< `DTIME`
    bool   is_finite = false;

    /** Out: < 1 if the step has to be smaller. */
    double new_step = 1;
  };

  /**
   * A shared library with a UMAT, open as long as this exists. A file that is
   * open already is opened as a copy, so that two materials of one file share
   * no variables (COMMON, SAVE).
   */
  class UmatLibrary
  {
  public:
    /**
     * @param file a shared library, or a source in Fortran (.f, .for, .f90)
     * which gfortran compiles once
     * @param symbol of the UMAT: as it is, in lower case with an underscore,
     * or in upper case
     * @throws InputError that says what is wrong with which of them
     */
    UmatLibrary(const std::string &file, const std::string &symbol);

    UmatLibrary(const UmatLibrary &) = delete;

    ~UmatLibrary();

    /** @param constants `PROPS`
     * @param name `CMNAME`, 80 characters
     * @throws UmatExit if it calls XIT */
    void
    call(UmatCall          &point,
         const double      *constants,
         const int          n_constants,
         const std::string &name) const;

    /** Whether it has SDVINI. */
    bool
    sets_state() const
    {
      return sdvini != nullptr;
    }

    /** The state variables that its SDVINI sets at @p x. */
    void
    set_state(double *state, const int n, const double (&x)[3]) const;

    /** How the file was compiled; empty if it was given as a library. */
    const std::string &
    compilation() const
    {
      return command;
    }

  private:
    std::string identity; ///< of the file, among those that are open
    std::string command;
    void       *handle = nullptr;
    void       *umat   = nullptr;
    void       *sdvini = nullptr;
  };
} // namespace moraine

#endif
