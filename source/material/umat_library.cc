// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/material/umat_library.h>

#include <moraine/core/words.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <mutex>
#include <set>
#include <sstream>
#include <vector>

#include <dlfcn.h>
#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ;

namespace moraine
{
  namespace
  {
    namespace fs = std::filesystem;

    using Number  = double *;
    using Integer = const int *;

    using UmatFunction = void (*)(Number      STRESS,
                                  Number      STATEV,
                                  Number      DDSDDE,
                                  Number      SSE,
                                  Number      SPD,
                                  Number      SCD,
                                  Number      RPL,
                                  Number      DDSDDT,
                                  Number      DRPLDE,
                                  Number      DRPLDT,
                                  Number      STRAN,
                                  Number      DSTRAN,
                                  Number      TIME,
                                  Number      DTIME,
                                  Number      TEMP,
                                  Number      DTEMP,
                                  Number      PREDEF,
                                  Number      DPRED,
                                  char       *CMNAME,
                                  Integer     NDI,
                                  Integer     NSHR,
                                  Integer     NTENS,
                                  Integer     NSTATV,
                                  Number      PROPS,
                                  Integer     NPROPS,
                                  Number      COORDS,
                                  Number      DROT,
                                  Number      PNEWDT,
                                  Number      CELENT,
                                  Number      DFGRD0,
                                  Number      DFGRD1,
                                  Integer     NOEL,
                                  Integer     NPT,
                                  Integer     LAYER,
                                  Integer     KSPT,
                                  Integer     KSTEP,
                                  Integer     KINC,
                                  std::size_t length_of_CMNAME);

    using SdviniFunction = void (*)(Number  STATEV,
                                    Number  COORDS,
                                    Integer NSTATV,
                                    Integer NCRDS,
                                    Integer NOEL,
                                    Integer NPT,
                                    Integer LAYER,
                                    Integer KSPT);



    /** The files that are open, by device and number. */
    std::set<std::string> &
    open_files()
    {
      static std::set<std::string> files;
      return files;
    }



    std::mutex &
    mutex()
    {
      static std::mutex mutex;
      return mutex;
    }



    /** A folder for compiled sources and copies, removed at the end. */
    class ScratchFolder
    {
    public:
      ScratchFolder()
      {
        std::error_code none;
        fs::path        base = fs::temp_directory_path(none);
        if (none)
          base = ".";
        std::string name = (base / "moraine-umat-XXXXXX").string();
        if (mkdtemp(name.data()) == nullptr)
          throw InputError("cannot make a folder in '" + base.string() +
                           "' for compiled UMATs: " + std::strerror(errno));
        path  = name;
        owner = getpid();
        for (const char *include : {"ABA_PARAM.INC", "aba_param.inc"})
          std::ofstream(path / include) << "      implicit real*8 (a-h, o-z)\n"
                                           "      parameter (nprecd = 2)\n";
      }

      ~ScratchFolder()
      {
        std::error_code ignored;
        if (getpid() == owner)
          fs::remove_all(path, ignored);
      }

      /** A new name in it. */
      std::string
      file(const std::string &name)
      {
        return (path / (std::to_string(n_files++) + "-" + name)).string();
      }

      fs::path path;

    private:
      pid_t        owner;
      unsigned int n_files = 0;
    };



    ScratchFolder &
    scratch()
    {
      static ScratchFolder folder;
      return folder;
    }



    std::string
    in_case(std::string text, int (*change)(int))
    {
      std::transform(text.begin(), text.end(), text.begin(), [&](char c) {
        return static_cast<char>(change(static_cast<unsigned char>(c)));
      });
      return text;
    }



    bool
    is_source(const std::string &file)
    {
      const std::string extension =
        in_case(fs::path(file).extension().string(), std::tolower);
      return extension == ".f" || extension == ".for" || extension == ".f90";
    }



    /** @return what it printed, if it failed. */
    std::string
    run(const std::vector<std::string> &command)
    {
      std::vector<char *> arguments;
      for (const std::string &word : command)
        arguments.push_back(const_cast<char *>(word.c_str()));
      arguments.push_back(nullptr);

      const std::string          log = scratch().file("log");
      posix_spawn_file_actions_t actions;
      posix_spawn_file_actions_init(&actions);
      posix_spawn_file_actions_addopen(
        &actions, 1, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
      posix_spawn_file_actions_adddup2(&actions, 1, 2);
      pid_t     child;
      const int failed = posix_spawnp(
        &child, arguments[0], &actions, nullptr, arguments.data(), environ);
      posix_spawn_file_actions_destroy(&actions);
      if (failed)
        return command[0] + ": " + std::strerror(failed);
      int status = 0;
      while (waitpid(child, &status, 0) == -1 && errno == EINTR)
        ;
      if (WIFEXITED(status) && WEXITSTATUS(status) == 0)
        return "";
      std::ostringstream text;
      text << std::ifstream(log).rdbuf();
      return text.str().empty() ? command[0] + " failed" : text.str();
    }



    struct Compiled
    {
      std::string library, command;
    };

    /** The library of a source, compiled unless it is the same as before. */
    Compiled
    compile(const std::string &file)
    {
      static std::map<std::string, Compiled> known;
      std::ostringstream                     key;
      key << fs::canonical(file).string() << ' ' << fs::file_size(file) << ' '
          << fs::last_write_time(file).time_since_epoch().count();
      const auto found = known.find(key.str());
      if (found != known.end())
        return found->second;
      Compiled result;
      result.library = scratch().file(fs::path(file).stem().string() + ".so");
      // As Abaqus has it: 132 columns, preprocessed, local variables that a
      // call leaves behind are lost.
      const std::vector<std::string> command{"gfortran",
                                             "-shared",
                                             "-fPIC",
                                             "-O2",
                                             "-cpp",
                                             "-std=legacy",
                                             "-w",
                                             "-frecursive",
                                             "-fexceptions",
                                             "-ffixed-line-length-132",
                                             "-ffree-line-length-none",
                                             "-I",
                                             scratch().path.string(),
                                             "-o",
                                             result.library,
                                             file};
      for (const std::string &word : command)
        result.command += (result.command.empty() ? "" : " ") + word;
      const std::string message = run(command);
      if (!message.empty())
        throw InputError("'" + result.command + "' says:\n" + message);
      return known[key.str()] = result;
    }



    std::string
    identity_of(const std::string &file)
    {
      return fs::canonical(file).string();
    }
  } // namespace



  UmatLibrary::UmatLibrary(const std::string &file, const std::string &symbol)
  {
    const std::lock_guard<std::mutex> lock(mutex());
    std::error_code                   none;
    if (!fs::is_regular_file(file, none))
      throw InputError("there is no file '" + file + "'");
    std::string library = file;
    if (is_source(file))
      {
        const Compiled compiled = compile(file);
        library                 = compiled.library;
        command                 = compiled.command;
      }
    identity           = identity_of(library);
    std::string opened = identity;
    const bool  copy   = open_files().count(identity) > 0;
    if (copy)
      {
        opened = scratch().file(fs::path(library).filename().string());
        fs::copy_file(identity, opened);
      }
    handle                  = dlopen(opened.c_str(), RTLD_NOW | RTLD_LOCAL);
    const std::string error = handle ? "" : dlerror();
    if (copy)
      fs::remove(opened, none);
    if (handle == nullptr)
      throw InputError("'" + file + "' cannot be loaded: " + error);

    const std::string lower = in_case(symbol, std::tolower);
    for (const std::string &name :
         {symbol, lower + "_", lower, in_case(symbol, std::toupper)})
      if (umat == nullptr)
        umat = dlsym(handle, name.c_str());
    if (umat == nullptr)
      {
        dlclose(handle);
        throw InputError("'" + file + "' has none of the symbols '" + symbol +
                         "', '" + lower + "_', '" + lower + "', '" +
                         in_case(symbol, std::toupper) + "'");
      }
    for (const char *name : {"sdvini_", "sdvini", "SDVINI"})
      if (sdvini == nullptr)
        sdvini = dlsym(handle, name);
    if (copy)
      identity.clear();
    else
      open_files().insert(identity);
  }



  UmatLibrary::~UmatLibrary()
  {
    const std::lock_guard<std::mutex> lock(mutex());
    dlclose(handle);
    if (!identity.empty())
      open_files().erase(identity);
  }



  void
  UmatLibrary::call(UmatCall          &point,
                    const double      *constants,
                    const int          n_constants,
                    const std::string &name) const
  {
    char material[80];
    std::memset(material, ' ', sizeof(material));
    std::memcpy(material, name.data(), std::min(name.size(), sizeof(material)));

    double    energies[3]{}, heat[2]{}, heat_slopes[2][6]{};
    double    times[2]{point.time, point.time};
    double    temperature[2]{}, fields[2]{}, x[3]{}, length = 1;
    double    dummy_state[1]{};
    const int normal = 3, shear = 3, all = 6, one = 1;
    const int step[4]{1, 1, point.is_finite, 0};
    reinterpret_cast<UmatFunction>(umat)(point.stress.data(),
                                         point.n_state > 0 ? point.state :
                                                             dummy_state,
                                         point.tangent.data(),
                                         &energies[0],
                                         &energies[1],
                                         &energies[2],
                                         &heat[0],
                                         heat_slopes[0],
                                         heat_slopes[1],
                                         &heat[1],
                                         point.strain.data(),
                                         point.strain_increment.data(),
                                         times,
                                         &point.step,
                                         &temperature[0],
                                         &temperature[1],
                                         &fields[0],
                                         &fields[1],
                                         material,
                                         &normal,
                                         &shear,
                                         &all,
                                         &point.n_state,
                                         const_cast<double *>(constants),
                                         &n_constants,
                                         x,
                                         point.rotation.data(),
                                         &point.new_step,
                                         &length,
                                         point.F_n.data(),
                                         point.F.data(),
                                         &one,
                                         &one,
                                         &one,
                                         &one,
                                         step,
                                         &one,
                                         sizeof(material));
  }



  void
  UmatLibrary::set_state(double *state, const int n, const double (&x)[3]) const
  {
    double    place[3]{x[0], x[1], x[2]};
    const int three = 3, one = 1;
    reinterpret_cast<SdviniFunction>(
      sdvini)(state, place, &n, &three, &one, &one, &one, &one);
  }
} // namespace moraine
