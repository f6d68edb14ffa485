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

  /** The tensor with Abaqus' components 11, 22, 33, 12, 13, 23, of which those
   * of shear are multiplied by @p shear. */
  inline dealii::SymmetricTensor<2, 3>
  tensor_of_umat(const double *values,
                 const double  shear    = 1,
                 const int     n_normal = 3,
                 const int     n_shear  = 3)
  {
    dealii::SymmetricTensor<2, 3> result;
    for (int i = 0; i < n_normal; ++i)
      result.access_raw_entry(i) = values[i];
    for (int i = 0; i < n_shear; ++i)
      result.access_raw_entry(3 + i) = shear * values[n_normal + i];
    return result;
  }

  /** The reverse. */
  inline void
  components_for_umat(const dealii::SymmetricTensor<2, 3> &tensor,
                      double                              *values,
                      const double                         shear    = 1,
                      const int                            n_normal = 3,
                      const int                            n_shear  = 3)
  {
    for (int i = 0; i < n_normal; ++i)
      values[i] = tensor.access_raw_entry(i);
    for (int i = 0; i < n_shear; ++i)
      values[n_normal + i] = shear * tensor.access_raw_entry(3 + i);
  }

  /** What a UMAT gets and gives at one point; shear strains are angles,
   * matrices are stored by columns. */
  struct UmatCall
  {
    /** In: at @f$t_n@f$, out: at @f$t_{n+1}@f$. */
    std::array<double, 6> stress{};
    double               *state   = nullptr; ///< the same, `STATEV`
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

    /** @param constants `PROPS`
     * @param name `CMNAME`, 80 characters
     * @throws UmatExit if it calls XIT */
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
