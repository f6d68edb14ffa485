// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/material/umat_library.h>

#include <moraine/core/words.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>

#include <dlfcn.h>
#include <stdlib.h>

namespace moraine
{
  namespace
  {
    namespace fs = std::filesystem;

    /** A folder for compiled sources and copies, removed at the end. */
    struct ScratchFolder
    {
      ScratchFolder()
      {
        if (mkdtemp(path.data()) == nullptr)
          throw InputError("cannot make the folder '" + path +
                           "' for compiled UMATs: " + std::strerror(errno));
        for (const char *include : {"/ABA_PARAM.INC", "/aba_param.inc"})
          std::ofstream(path + include) << "      implicit real*8 (a-h, o-z)\n"
                                           "      parameter (nprecd = 2)\n";
      }

      ~ScratchFolder()
      {
        std::error_code ignored;
        fs::remove_all(path, ignored);
      }

      std::string path = fs::temp_directory_path() / "moraine-umat-XXXXXX";
    };



    const std::string &
    scratch()
    {
      static const ScratchFolder folder;
      return folder.path;
    }



    /** @return what @p command prints, if it fails. */
    std::string
    run(const std::string &command)
    {
      std::FILE *const pipe = popen((command + " 2>&1").c_str(), "r");
      if (pipe == nullptr)
        return std::strerror(errno);
      std::string text;
      char        part[256];
      while (std::fgets(part, sizeof(part), pipe) != nullptr)
        text += part;
      return pclose(pipe) == 0 ? "" : text + "it failed";
    }



    /** The library that gfortran makes of @p source, if it has not yet; @p
     * command is how. */
    std::string
    compile(const std::string &source, std::string &command)
    {
      const std::string path = fs::canonical(source).string();
      const std::string library =
        scratch() + '/' + std::to_string(std::hash<std::string>()(path)) +
        ".so";
      // As Abaqus: preprocessed, 132 columns, no local variable outlives a
      // call.
      command =
        "gfortran -shared -fPIC -O2 -cpp -std=legacy -w -frecursive -fexceptions "
        "-ffixed-line-length-132 -ffree-line-length-none -I " +
        scratch() + " -o " + library + ' ' + one_word(path);
      const std::string error = fs::exists(library) ? "" : run(command);
      if (!error.empty())
        throw InputError("'" + command + "' says:\n" + error);
      return library;
    }



    /** Open @p library. If another material has it open, open a copy: they must
     * share no variables (COMMON, SAVE). */
    void *
    open_library(const std::string &library)
    {
      static unsigned int n_copies = 0; // one name is one library
      void *const open = dlopen(library.c_str(), RTLD_LAZY | RTLD_NOLOAD);
      if (open == nullptr)
        return dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
      dlclose(open);
      const std::string copy =
        scratch() + "/copy-" + std::to_string(n_copies++) + ".so";
      fs::copy_file(library, copy);
      void *const result = dlopen(copy.c_str(), RTLD_NOW | RTLD_LOCAL);
      fs::remove(copy);
      return result;
    }



    /** Fortran takes all by address, lengths of texts last. */
    template <typename... Arguments>
    void
    call_fortran(void *routine, const Arguments... arguments)
    {
      reinterpret_cast<void (*)(Arguments...)>(routine)(arguments...);
    }



    double *
    first(dealii::SymmetricTensor<2, 3> &tensor)
    {
      static_assert(sizeof(tensor) == 6 * sizeof(double));
      return &tensor.access_raw_entry(0); // 11, 22, 33, 12, 13, 23
    }
  } // namespace



  UmatLibrary::UmatLibrary(const std::string &file, const std::string &symbol)
    : handle(nullptr, dlclose)
  {
    std::error_code none;
    if (!fs::is_regular_file(file, none))
      throw InputError("there is no file '" + file + "'");
    const std::string extension = lower_case(fs::path(file).extension());
    const bool        is_source =
      extension == ".f" || extension == ".for" || extension == ".f90";
    handle.reset(open_library(is_source ? compile(file, command) :
                                          fs::canonical(file).string()));
    if (handle == nullptr)
      throw InputError("'" + file + "' cannot be loaded: " + dlerror());

    const std::string underscored = lower_case(symbol) + '_';
    umat                          = dlsym(handle.get(), symbol.c_str());
    if (umat == nullptr)
      umat = dlsym(handle.get(), underscored.c_str());
    if (umat == nullptr)
      throw InputError("'" + file + "' has neither the symbol '" + symbol +
                       "' nor '" + underscored + "'");
    sdvini = dlsym(handle.get(), "sdvini_");
  }



  void
  UmatLibrary::call(UmatCall                  &point,
                    const std::vector<double> &constants,
                    const std::string         &name) const
  {
    double    energies[3]{}, heat[2]{}, heat_slopes[12]{};
    double    no_state = 0, temperature = 0, place[3]{}, length = 1;
    double    times[2]{point.time, point.time};
    const int three = 3, six = 6, one = 1, n_constants = constants.size();
    const int step[4]{1, 1, point.is_finite, 0};
    call_fortran(umat,
                 first(point.stress),
                 point.n_state > 0 ? point.state : &no_state,
                 point.tangent.begin_raw(),
                 &energies[0],
                 &energies[1],
                 &energies[2],
                 &heat[0],
                 &heat_slopes[0],
                 &heat_slopes[6],
                 &heat[1],
                 first(point.strain),
                 first(point.strain_increment),
                 times,
                 &point.step,
                 &temperature,
                 &temperature,
                 &temperature,
                 &temperature,
                 name.data(),
                 &three,
                 &three,
                 &six,
                 &point.n_state,
                 constants.data(),
                 &n_constants,
                 place,
                 point.rotation.begin_raw(),
                 &point.new_step,
                 &length,
                 point.F_n.begin_raw(),
                 point.F.begin_raw(),
                 &one,
                 &one,
                 &one,
                 &one,
                 step,
                 &one,
                 name.size());
  }



  void
  UmatLibrary::call_sdvini(std::vector<double> &state, dealii::Point<3> x) const
  {
    const int n = state.size(), three = 3, one = 1;
    call_fortran(
      sdvini, state.data(), &x[0], &n, &three, &one, &one, &one, &one);
  }
} // namespace moraine
