// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/output/output_directory.h>

#include <moraine/core/atomic_file.h>
#include <moraine/core/exceptions.h>
#include <moraine/core/ranges.h>
#include <moraine/output/on_root.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <cctype>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <vector>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

namespace moraine
{
  namespace fs = std::filesystem;

  namespace
  {
    /** What a run has from its first step on. */
    constexpr const char *result_names[] = {"history.csv",
                                            "points.pvd",
                                            "mesh.pvd",
                                            "boundaries.pvd",
                                            "domains.pvd",
                                            "contact.pvd"};
    /** What a run has that fails before. */
    constexpr const char *other_names[] = {"summary.json",
                                           "log.txt",
                                           "parameters.prm",
                                           "original.prm"};
    /** What a study has beside the folders of its cases. */
    constexpr const char *study_names[]      = {"study.csv",
                                                "study.prm",
                                                "study.gp",
                                                "study.png"};
    constexpr const char *series_names[]     = {"points",
                                                "mesh",
                                                "boundaries",
                                                "domains",
                                                "contact"};
    constexpr const char *checkpoint_names[] = {"last", "a.h5", "b.h5"};

    /** Whether a file name is of the kind OutputDirectory::vtu_name() gives. */
    bool
    is_numbered_vtu(const fs::path &file)
    {
      const std::string number = file.stem().string();
      return file.extension() == ".vtu" && number.size() >= 5 &&
             all_of(number,
                    [](unsigned char c) { return std::isdigit(c) != 0; });
    }

    /** Results in @p folder that a run has written. */
    std::vector<fs::path>
    results_in(const fs::path &folder)
    {
      std::vector<fs::path> results;
      for (const char *name : result_names)
        if (fs::exists(folder / name))
          results.push_back(folder / name);
      for (const char *series : series_names)
        if (fs::is_directory(folder / series))
          for (const auto &entry : fs::directory_iterator(folder / series))
            if (is_numbered_vtu(entry.path()))
              results.push_back(entry.path());
      for (const char *name : checkpoint_names)
        if (fs::exists(folder / "checkpoints" / name))
          results.push_back(folder / "checkpoints" / name);
      return results;
    }

    void
    check_writable(const fs::path &folder)
    {
      const fs::path probe = folder / ".moraine-writable";
      std::ofstream  file(probe);
      file << "x" << std::flush;
      const bool written = static_cast<bool>(file);
      file.close();
      std::error_code ignored;
      fs::remove(probe, ignored);
      if (!written)
        throw InputError("cannot write into the output directory '" +
                         folder.string() +
                         "'; check its permissions and the space on the disk, "
                         "or choose another one with --output");
    }

    /** Make the folder and its parts, unless it holds results that may not be
     * overwritten. */
    void
    prepare(const fs::path &folder, const bool overwrite)
    {
      std::vector<fs::path> results = results_in(folder);
      if (results.empty() && OutputDirectory::holds_study(folder.string()))
        results.push_back(study_names[0]);
      if (!results.empty() && !overwrite)
        throw InputError("the output directory '" + folder.string() +
                         "' holds results of an earlier run (" +
                         results.front().filename().string() +
                         "); choose another one with --output, or replace "
                         "them with --overwrite");
      for (const char *series : {"points", "mesh"})
        fs::create_directories(folder / series);
      check_writable(folder);
    }



    void
    remove_results(const fs::path &folder)
    {
      for (const fs::path &file : results_in(folder))
        fs::remove(file);
      for (const char *name : other_names)
        fs::remove(folder / name);
      OutputDirectory::remove_study(folder.string());
    }
  } // namespace



  /** Of a folder; the system takes it back from a process that ends, however
   * it ends. */
  class OutputDirectory::Lock
  {
  public:
    explicit Lock(const std::string &folder)
      : file(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC))
    {
      // Some file systems know no locks.
      if (file < 0 || flock(file, LOCK_EX | LOCK_NB) == 0 ||
          errno != EWOULDBLOCK)
        return;
      close(file);
      throw InputError("another run writes into the output directory '" +
                       folder + "' and has not ended");
    }

    ~Lock()
    {
      if (file >= 0)
        close(file);
    }

    Lock(const Lock &) = delete;

  private:
    const int file;
  };



  OutputDirectory::OutputDirectory(const std::string &path,
                                   const bool         overwrite,
                                   const MPI_Comm    &communicator)
    : path(path)
    , communicator(communicator)
  {
    on_root(communicator, [&]() {
      try
        {
          prepare(path, overwrite);
          lock = std::make_unique<Lock>(path);
          remove_results(path);
        }
      catch (const fs::filesystem_error &error)
        {
          throw InputError("cannot make the output directory '" + path +
                           "': " + error.code().message() +
                           "; choose another one with --output");
        }
    });
  }



  OutputDirectory::OutputDirectory(const std::string &path,
                                   const MPI_Comm    &communicator)
    : path(path)
    , communicator(communicator)
  {
    on_root(communicator, [&]() {
      check_writable(path);
      lock = std::make_unique<Lock>(path);
    });
  }



  OutputDirectory::~OutputDirectory() = default;



  bool
  OutputDirectory::holds_results(const std::string &path,
                                 const MPI_Comm    &communicator)
  {
    bool found = false;
    on_root(communicator, [&]() { found = !results_in(path).empty(); });
    return dealii::Utilities::MPI::broadcast(communicator, found);
  }



  bool
  OutputDirectory::holds_study(const std::string &path)
  {
    return fs::exists(fs::path(path) / study_names[0]);
  }



  void
  OutputDirectory::remove_study(const std::string &path)
  {
    for (const char *name : study_names)
      fs::remove(fs::path(path) / name);
    if (results_in(path).empty()) // else it is the summary of a run
      fs::remove(fs::path(path) / "summary.json");
  }



  std::string
  OutputDirectory::file(const std::string &name) const
  {
    return (fs::path(path) / name).string();
  }



  std::string
  OutputDirectory::vtu_name(const std::string &series,
                            const unsigned int number)
  {
    return series + "/" + dealii::Utilities::int_to_string(number, 5) + ".vtu";
  }



  void
  OutputDirectory::remove_vtu_from(const unsigned int number) const
  {
    on_root(communicator, [&]() {
      for (const char *series : series_names)
        for (unsigned int n = number; fs::remove(file(vtu_name(series, n)));)
          ++n;
    });
  }



  void
  OutputDirectory::write_parameter_files(
    const std::string              &original_text,
    const dealii::ParameterHandler &prm) const
  {
    on_root(communicator, [&]() {
      AtomicFile original(file("original.prm"));
      original.stream() << original_text;
      original.commit();
    });
    write_parameters(prm);
  }



  void
  OutputDirectory::write_parameters(const dealii::ParameterHandler &prm) const
  {
    on_root(communicator, [&]() {
      AtomicFile parameters(file("parameters.prm"));
      // Bodies and boundaries keep their order, which their results show.
      prm.print_parameters(parameters.stream(),
                           dealii::ParameterHandler::Text |
                             dealii::ParameterHandler::KeepDeclarationOrder);
      parameters.commit();
    });
  }
} // namespace moraine
