// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_material_umat_library_h
#define moraine_material_umat_library_h

#include <moraine/core/exceptions.h>

#include <deal.II/base/symmetric_tensor.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace moraine
{
  /** A UMAT has ended the run by XIT or an error message. */
  class UmatExit : public ComputationError
  {
  public:
    using ComputationError::ComputationError;

    unsigned int point = 0; ///< among those of Material::respond()
  };

  /** What a UMAT gets and gives at one point; shear components of strains are
   * angles. */
  struct UmatCall
  {
    /** In: at @f$t_n@f$, out: at @f$t_{n+1}@f$. */
    dealii::SymmetricTensor<2, 3> stress;
    double                       *state   = nullptr; ///< the same, `STATEV`
    int                           n_state = 0;

    dealii::Tensor<2, 6> tangent; ///< out, transposed `DDSDDE`

    dealii::SymmetricTensor<2, 3> strain;           ///< `STRAN`, at @f$t_n@f$
    dealii::SymmetricTensor<2, 3> strain_increment; ///< `DSTRAN`

    /** Transposed `DROT`, `DFGRD0`, `DFGRD1`: Fortran goes by columns. */
    dealii::Tensor<2, 3> rotation = dealii::unit_symmetric_tensor<3>(),
                         F_n = rotation, F = rotation;

    double time      = 0; ///< at @f$t_n@f$
    double step      = 1; ///< `DTIME`
    bool   is_finite = false;

    double new_step = 1; ///< out, `PNEWDT`
  };

  /** A shared library with a UMAT, open as long as this exists. */
  class UmatLibrary
  {
  public:
    /**
     * @param file a shared library, or a source in Fortran (.f, .for, .f90)
     * which gfortran compiles, once in a run
     * @param symbol of the UMAT: as it is, or in lower case with an underscore
     * @throws InputError that says what is wrong with which of them
     */
    UmatLibrary(const std::string &file, const std::string &symbol);

    /** With `PROPS` and `CMNAME`, 80 characters. @throws UmatExit if it calls
     * XIT. */
    void
    call(UmatCall                  &point,
         const std::vector<double> &constants,
         const std::string         &name) const;

    bool
    has_sdvini() const
    {
      return sdvini != nullptr;
    }

    /** The state variables that SDVINI sets at the place @p x. */
    void
    call_sdvini(std::vector<double> &state, dealii::Point<3> x) const;

    /** How a source was compiled; else empty. */
    const std::string &
    compilation() const
    {
      return command;
    }

  private:
    std::string                            command;
    std::unique_ptr<void, int (*)(void *)> handle;
    void                                  *umat   = nullptr;
    void                                  *sdvini = nullptr;
  };
} // namespace moraine

#endif
