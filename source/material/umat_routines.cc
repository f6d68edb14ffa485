// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// The routines of Abaqus that UMATs call. The program exports them.

#include <moraine/material/spectral.h>
#include <moraine/material/umat_library.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <set>
#include <sstream>
#include <utility>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** Of @p n normal and @p m shear components, angles for @p kind 2. */
    SymmetricTensor<2, 3>
    tensor_of(const double *values, const int kind, const int n, const int m)
    {
      SymmetricTensor<2, 3> result;
      std::copy_n(values, n, &result.access_raw_entry(0));
      for (int i = 0; i < m; ++i)
        result.access_raw_entry(3 + i) = values[n + i] / kind;
      return result;
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
      for (auto c = form.begin(); c != form.end(); ++c)
        {
          const char kind = *c == '%' && c + 1 != form.end() ? c[1] : '%';
          if (kind == 'I' || kind == 'i')
            text << *integers++;
          else if (kind == 'R' || kind == 'r')
            text << *numbers++;
          else if (kind == 'S' || kind == 's')
            text << trimmed(std::exchange(words, words + word_length),
                            word_length);
          else
            {
              text << *c;
              continue;
            }
          ++c;
        }
      return text.str();
    }
  } // namespace



  extern "C"
  {
    using In      = const double *;
    using Integer = const int *;
    using Out     = double *;

    void
    xit_()
    {
      throw UmatExit("its UMAT ended the run (CALL XIT)");
    }



    void
    stdb_abqerr_(Integer           kind,
                 const char       *form,
                 Integer           integers,
                 In                numbers,
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



    // kind: 1 stress, 2 strain; n and m: NDI and NSHR

    void
    sinv_(In stress, Out first, Out second, Integer n, Integer m)
    {
      const auto s = tensor_of(stress, 1, *n, *m);
      *first       = trace(s) / 3;
      *second      = std::sqrt(1.5) * deviator(s).norm();
    }



    void
    sprind_(In a, Out values, Out axes, Integer kind, Integer n, Integer m)
    {
      const Spectrum at = spectrum<3>(tensor_of(a, *kind, *n, *m));
      for (unsigned int A = 0; A < 3; ++A)
        {
          values[A] = at.values[A];
          for (unsigned int i = 0; i < 3; ++i)
            axes[A + 3 * i] = at.directions[A][i];
        }
    }



    void
    sprinc_(In a, Out values, Integer kind, Integer n, Integer m)
    {
      double axes[9];
      sprind_(a, values, axes, kind, n, m);
    }



    void
    rotsig_(In a, In rotation, Out rotated, Integer kind, Integer n, Integer m)
    {
      Tensor<2, 3> R;
      for (unsigned int i = 0; i < 9; ++i)
        R[i % 3][i / 3] = rotation[i];
      const Tensor<2, 3> s      = tensor_of(a, *kind, *n, *m);
      const auto         turned = symmetrize(R * s * transpose(R));
      std::copy_n(&turned.access_raw_entry(0), *n, rotated);
      for (int i = 0; i < *m; ++i)
        rotated[*n + i] = *kind * turned.access_raw_entry(3 + i);
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
