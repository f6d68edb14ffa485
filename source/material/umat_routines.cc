// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// The routines of Abaqus that UMATs call. The program exports them.

#include <moraine/material/spectral.h>
#include <moraine/material/umat_library.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <set>
#include <sstream>
#include <string>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** In Abaqus' order; @p of_strain: with angles for shear. */
    SymmetricTensor<2, 3>
    tensor_of(const double *values,
              const bool    of_strain,
              const int     n_normal,
              const int     n_shear)
    {
      constexpr auto        pairs = voigt_pairs<3>();
      SymmetricTensor<2, 3> result;
      for (int i = 0; i < n_normal; ++i)
        result[i][i] = values[i];
      for (int i = 0; i < n_shear; ++i)
        result[pairs[3 + i][0]][pairs[3 + i][1]] =
          (of_strain ? 0.5 : 1) * values[n_normal + i];
      return result;
    }



    Spectrum
    spectrum_of(const double *values,
                const int     kind,
                const int     n_normal,
                const int     n_shear)
    {
      return spectrum<3>(tensor_of(values, kind == 2, n_normal, n_shear));
    }



    /** Of characters that blanks fill up. */
    std::string
    trimmed(const char *characters, const std::size_t length)
    {
      std::string text(characters, length);
      text.erase(text.find_last_not_of(std::string(" \0", 2)) + 1);
      return text;
    }



    /** @p form with the next number or word for each %I, %R and %S. */
    std::string
    filled(const std::string &form,
           const int         *integers,
           const double      *numbers,
           const char        *words,
           const std::size_t  word_length)
    {
      std::ostringstream text;
      for (std::size_t i = 0; i < form.size(); ++i)
        {
          const char kind =
            form[i] == '%' && i + 1 < form.size() ? std::toupper(form[++i]) : 0;
          if (kind == 'I')
            text << *integers++;
          else if (kind == 'R')
            text << *numbers++;
          else if (kind == 'S')
            {
              text << trimmed(words, word_length);
              words += word_length;
            }
          else if (kind)
            text << '%' << form[i];
          else
            text << form[i];
        }
      return text.str();
    }
  } // namespace
} // namespace moraine



extern "C"
{
  // Of no header: Fortran calls them.
  void
  xit_();
  void
  stdb_abqerr_(const int    *kind,
               const char   *form,
               const int    *integers,
               const double *numbers,
               const char   *words,
               std::size_t   form_length,
               std::size_t   word_length);
  void
  sinv_(const double *stress,
        double       *first,
        double       *second,
        const int    *n_normal,
        const int    *n_shear);
  void
  sprinc_(const double *values,
          double       *principal,
          const int    *kind,
          const int    *n_normal,
          const int    *n_shear);
  void
  sprind_(const double *values,
          double       *principal,
          double       *directions,
          const int    *kind,
          const int    *n_normal,
          const int    *n_shear);
  void
  rotsig_(const double *values,
          const double *rotation,
          double       *rotated,
          const int    *kind,
          const int    *n_normal,
          const int    *n_shear);
  void
  getoutdir_(char *folder, int *length, std::size_t size);
  void
  getrank_(int *rank);



  void
  xit_()
  {
    throw moraine::UmatExit("its UMAT ended the run (CALL XIT)");
  }



  void
  stdb_abqerr_(const int        *kind,
               const char       *form,
               const int        *integers,
               const double     *numbers,
               const char       *words,
               const std::size_t form_length,
               const std::size_t word_length)
  {
    const std::string text =
      moraine::filled(moraine::trimmed(form, form_length),
                      integers,
                      numbers,
                      words,
                      word_length > 0 ? word_length : 8);
    if (*kind == -3)
      throw moraine::UmatExit("its UMAT ended the run: " + text);
    // Points by the thousand may say the same.
    static std::set<std::string> said;
    if (said.size() < 100 && said.insert(text).second)
      std::cerr << (*kind == 1 ? "UMAT: " : "UMAT warns: ") << text
                << std::endl;
  }



  void
  sinv_(const double *stress,
        double       *first,
        double       *second,
        const int    *n_normal,
        const int    *n_shear)
  {
    const auto s = moraine::tensor_of(stress, false, *n_normal, *n_shear);
    *first       = dealii::trace(s) / 3;
    *second      = std::sqrt(1.5) * dealii::deviator(s).norm();
  }



  void
  sprinc_(const double *values,
          double       *principal,
          const int    *kind,
          const int    *n_normal,
          const int    *n_shear)
  {
    const auto at = moraine::spectrum_of(values, *kind, *n_normal, *n_shear);
    for (unsigned int A = 0; A < 3; ++A)
      principal[A] = at.values[A];
  }



  void
  sprind_(const double *values,
          double       *principal,
          double       *directions,
          const int    *kind,
          const int    *n_normal,
          const int    *n_shear)
  {
    const auto at = moraine::spectrum_of(values, *kind, *n_normal, *n_shear);
    for (unsigned int A = 0; A < 3; ++A)
      {
        principal[A] = at.values[A];
        for (unsigned int i = 0; i < 3; ++i)
          directions[A + 3 * i] = at.directions[A][i];
      }
  }



  void
  rotsig_(const double *values,
          const double *rotation,
          double       *rotated,
          const int    *kind,
          const int    *n_normal,
          const int    *n_shear)
  {
    const bool           of_strain = *kind == 2;
    dealii::Tensor<2, 3> R;
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        R[i][j] = rotation[i + 3 * j];
    const dealii::Tensor<2, 3> s =
      moraine::tensor_of(values, of_strain, *n_normal, *n_shear);
    const auto     turned = R * s * dealii::transpose(R);
    constexpr auto pairs  = moraine::voigt_pairs<3>();
    for (int i = 0; i < *n_normal; ++i)
      rotated[i] = turned[i][i];
    for (int i = 0; i < *n_shear; ++i)
      rotated[*n_normal + i] =
        (of_strain ? 2 : 1) * turned[pairs[3 + i][0]][pairs[3 + i][1]];
  }



  void
  getoutdir_(char *folder, int *length, const std::size_t size)
  {
    const std::string here = std::filesystem::current_path().string();
    std::memset(folder, ' ', size);
    std::memcpy(folder, here.data(), std::min(size, here.size()));
    *length = std::min(size, here.size());
  }



  void
  getrank_(int *rank)
  {
    *rank = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
  }
}
