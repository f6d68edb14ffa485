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

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** The factor between angles and strains, if it is a strain. */
    double
    half_if_strain(const int kind)
    {
      return kind == 2 ? 0.5 : 1;
    }



    /** Without the blanks that fill it up. */
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
          const char kind = form[i] == '%' && i + 1 < form.size() ?
                              std::toupper(form[i + 1]) :
                              0;
          if (kind == 'I')
            text << *integers++;
          else if (kind == 'R')
            text << *numbers++;
          else if (kind == 'S')
            {
              text << trimmed(words, word_length);
              words += word_length;
            }
          else
            text << form[i];
          i += kind == 'I' || kind == 'R' || kind == 'S';
        }
      return text.str();
    }
  } // namespace



  extern "C"
  {
    void
    xit_()
    {
      throw UmatExit("its UMAT ended the run (CALL XIT)");
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
      const std::string text = filled(
        trimmed(form, form_length), integers, numbers, words, word_length);
      if (*kind == -3)
        throw UmatExit("its UMAT ended the run: " + text);
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
      const auto s = tensor_of_umat(stress, 1, *n_normal, *n_shear);
      *first       = trace(s) / 3;
      *second      = std::sqrt(1.5) * deviator(s).norm();
    }



    void
    sprind_(const double *values,
            double       *principal,
            double       *directions,
            const int    *kind,
            const int    *n_normal,
            const int    *n_shear)
    {
      const Spectrum at = spectrum<3>(
        tensor_of_umat(values, half_if_strain(*kind), *n_normal, *n_shear));
      for (unsigned int A = 0; A < 3; ++A)
        {
          principal[A] = at.values[A];
          for (unsigned int i = 0; i < 3; ++i)
            directions[A + 3 * i] = at.directions[A][i];
        }
    }



    void
    sprinc_(const double *values,
            double       *principal,
            const int    *kind,
            const int    *n_normal,
            const int    *n_shear)
    {
      double directions[9];
      sprind_(values, principal, directions, kind, n_normal, n_shear);
    }



    void
    rotsig_(const double *values,
            const double *rotation,
            double       *rotated,
            const int    *kind,
            const int    *n_normal,
            const int    *n_shear)
    {
      const double shear = half_if_strain(*kind);
      Tensor<2, 3> R;
      for (unsigned int i = 0; i < 9; ++i)
        R[i % 3][i / 3] = rotation[i];
      const Tensor<2, 3> s = tensor_of_umat(values, shear, *n_normal, *n_shear);
      components_for_umat(symmetrize(R * s * transpose(R)),
                          rotated,
                          1 / shear,
                          *n_normal,
                          *n_shear);
    }



    void
    getoutdir_(char *folder, int *length, const std::size_t size)
    {
      const std::string here = std::filesystem::current_path().string();
      std::memset(folder, ' ', size);
      *length = here.copy(folder, size);
    }



    void
    getrank_(int *rank)
    {
      *rank = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
    }
  }
} // namespace moraine
